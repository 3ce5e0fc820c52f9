#include "certificate_output.h"

#include <fmt/format.h>

#include <algorithm>

#include "console.h"
#include "options.h"
#include "prohull/detail/extension.h"

namespace prohull::cli {
namespace {

bool is_packed(const std::filesystem::path& path) {
  return lower_case_extension(path) == ".gz" || lower_case_extension(path) == ".zip";
}

std::filesystem::path unpacked(const std::filesystem::path& path) { return is_packed(path) ? path.stem() : path; }

}  // namespace

CLI::Option* add_certificate_option(CLI::App& command, std::filesystem::path& file, const std::string& what,
                                    const std::string& limits) {
  return add_value(command, "--certificate", file, "FILE",
                   "Also write a certificate: a file with which prohull_check, a program of one C file that shares "
                   "nothing with this one, decides again from the bytes of " +
                       what + " and of the original what is proven (docs/certificate.md)." + limits);
}

void check_certified(const std::filesystem::path& certificate, const std::filesystem::path& original,
                     const std::string& suffix, const std::vector<std::string>& checkable) {
  if (certificate.empty()) return;
  if (is_standard_stream(original))
    refuse(
        "--certificate: the original comes from standard input, but it has to be a file that can be checked; save it "
        "and name the file");
  if (std::ranges::find(kCheckable, lower_case_extension(unpacked(original))) == kCheckable.end())
    refuse(
        fmt::format("--certificate: {}: prohull_check reads .stl, .obj, .ply and .off files only; save the mesh as one "
                    "of these, and name that file as the original",
                    original.string()));
  if (std::ranges::find(checkable, suffix) == checkable.end())
    refuse(fmt::format("--certificate: prohull_check reads no {} files; write {}", suffix, alternatives(checkable)));
}

CertifiedOriginal certified_original(const std::filesystem::path& certificate, const TriangleMesh& mesh,
                                     const std::filesystem::path& path, const InputOptions& options) {
  if (certificate.empty()) return {};
  CertifiedOriginal original{mesh, options.factor()};
  const bool has_polygons = lower_case_extension(unpacked(path)) != ".stl";
  if (has_polygons) read_mesh(path, {.non_finite = NonFinite::Keep, .divided = &original.divided});
  return original;
}

void print_certificate(const std::filesystem::path& file, const Certificate& certificate,
                       const std::vector<std::filesystem::path>& hull, const std::filesystem::path& original) {
  std::string command = "prohull_check " + file.string();
  for (const auto& name : hull) command += " " + name.string();
  say("{}: certificate ({}); to check it: {} {}{}\n", output_name(file), fmt::join(certificate.claims, ", "), command,
      unpacked(original).string(), is_packed(original) ? ", once that is unpacked" : "");
  if (const std::size_t flat = certificate.flat_triangles_in_doubt; flat > 0)
    say("  prohull_check may not prove it: {} without area {} on the hull, and on no edge of another one\n",
        counted(flat, "triangle"), flat == 1 ? "lies" : "lie");
}

}  // namespace prohull::cli
