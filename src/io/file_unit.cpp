#include "io/file_unit.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "io/file_content.h"
#include "io/mesh_readers.h"
#include "prohull/detail/extension.h"

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

/// The first tag of an element, from its name on: that of the root. Empty if there is none.
std::string_view root_tag(std::string_view xml) {
  for (std::size_t at = xml.find('<'); at != xml.npos; at = xml.find('<')) {
    xml.remove_prefix(at);
    if (!xml.starts_with("<?") && !xml.starts_with("<!")) return xml.substr(1, xml.find('>') - 1);
    xml.remove_prefix(std::min(xml.size(), xml.find(xml.starts_with("<!--") ? "-->" : ">")));
  }
  return {};
}

/// What `unit` says in the root, an element of that name in any namespace; empty if it is not there.
std::string_view said_unit(std::string_view xml, std::string_view element) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::string_view tag = root_tag(xml), name = tag.substr(0, tag.find_first_of(kBlanks));
  if (name.substr(name.find(':') + 1) != element) return {};
  for (std::size_t at = name.size(); (at = tag.find("unit", at)) != tag.npos; at += 4) {
    const std::size_t quote = tag.find_first_not_of(" \t\r\n=", at + 4);
    const bool is_unit =
        kBlanks.find(tag[at - 1]) != tag.npos && quote != tag.npos && (tag[quote] == '"' || tag[quote] == '\'');
    if (is_unit) return tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
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
  if (suffix == ".dae" || suffix == ".zae") return {1, true};  // readers make metres of them
  if (suffix == ".3mf") return {length_of_unit(said_unit(xml_in(content, name, ".model"), "model")), true};
  if (suffix == ".amf") return {length_of_unit(said_unit(xml_in(content, name, ".amf"), "amf")), true};
  if (suffix == ".gltf" || is_glb(content)) return {1, false};
  return {};
}

}  // namespace prohull
