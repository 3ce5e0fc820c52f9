#include "io/file_unit.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "io/file_content.h"
#include "io/mesh_readers.h"
#include "prohull/detail/extension.h"
#include "prohull/error.h"

namespace prohull {
namespace {

constexpr double kMillimetre = 0.001;

double length_of_unit(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, double>, 8> kUnits{{{"micron", 1e-6},
                                                                       {"millimeter", kMillimetre},
                                                                       {"centimeter", 0.01},
                                                                       {"meter", 1},
                                                                       {"inch", 0.0254},
                                                                       {"feet", 0.3048},
                                                                       {"foot", 0.3048},
                                                                       {"", kMillimetre}}};
  const auto known = std::ranges::find(kUnits, name, [](const auto& unit) { return unit.first; });
  return known == kUnits.end() ? 0 : known->second;
}

/// What `unit` says in the first tag of that name; empty if it is not there.
std::string_view said_unit(std::string_view xml, std::string_view tag) {
  std::size_t begin = xml.find(tag);
  if (begin == xml.npos) return {};
  std::string_view attributes = xml.substr(begin, xml.find('>', begin) - begin);
  for (const std::string_view blank : {" ", "\t", "\n", "\r"}) {
    const std::size_t at = attributes.find(std::string(blank) + "unit=");
    if (at == attributes.npos) continue;
    std::string_view value = attributes.substr(at + 6);
    return value.empty() ? value : value.substr(1, value.find(value[0], 1) - 1);
  }
  return {};
}

/// The text of the model in a 3MF archive, or of an AMF file, which may be in an archive.
std::string xml_in(std::string_view content, const std::filesystem::path& name, std::string_view suffix) {
  if (!is_zip(content)) return std::string(content.substr(0, 4096));
  const std::vector<std::string> members = zip_members(content, name);
  const auto model =
      std::ranges::find_if(members, [&](const std::string& member) { return lower_case_extension(member) == suffix; });
  return model == members.end() ? "" : zip_member(content, name, *model).bytes;
}

}  // namespace

FileUnit unit_of_file(std::string_view content, const std::filesystem::path& name) {
  const std::string suffix = lower_case_extension(without_gz(name));
  if (suffix == ".dae" || suffix == ".zae") return {1, true};  // prohull-import makes metres of them
  if (suffix == ".3mf") return {length_of_unit(said_unit(xml_in(content, name, ".model"), "<model")), true};
  if (suffix == ".amf") return {length_of_unit(said_unit(xml_in(content, name, ".amf"), "<amf")), true};
  if (suffix == ".gltf" || is_glb(content)) return {1, false};
  return {};
}

}  // namespace prohull
