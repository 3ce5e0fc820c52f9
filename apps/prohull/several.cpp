#include "several.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "command.h"
#include "prohull/detail/extension.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"

namespace fs = std::filesystem;

namespace prohull::cli {
namespace {

constexpr std::string_view kNameInName = "{name}";

bool is_mesh_file(const fs::path& path) {
  const std::vector<std::string> known = read_mesh_extensions();
  return fs::is_regular_file(path) && std::ranges::find(known, lower_case_extension(without_gz(path))) != known.end();
}

std::vector<fs::path> meshes_in(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (is_mesh_file(entry.path())) found.push_back(entry.path());
  if (found.empty())
    throw InputError(Defect::CannotRead, fmt::format("{}: no mesh file is in this folder", folder.string()));
  std::ranges::sort(found);
  return found;
}

}  // namespace

std::vector<fs::path> mesh_files(const std::vector<fs::path>& named) {
  std::vector<fs::path> files;
  for (const fs::path& path : named)
    if (fs::is_directory(path))
      std::ranges::copy(meshes_in(path), std::back_inserter(files));
    else
      files.push_back(path);
  return files;
}

fs::path named_after(const fs::path& pattern, const fs::path& in) {
  std::string name = pattern.string();
  const auto at = name.find(kNameInName);
  if (at != std::string::npos && is_standard_stream(in))
    refuse(fmt::format("{}: standard input has no name that could stand there; name the file to write", name));
  if (at != std::string::npos)
    name.replace(at, kNameInName.size(), (in.extension() == ".gz" ? in.stem().stem() : in.stem()).string());
  return name;
}

fs::path pattern_of(const fs::path& out, const std::string& tail) {
  const bool is_folder = !out.empty() && (!out.has_filename() || fs::is_directory(out));
  return is_folder ? out / (std::string(kNameInName) + tail) : out;
}

void check_outputs(const std::vector<fs::path>& meshes,
                   const std::function<NamedOutputs(const fs::path&)>& outputs_of) {
  for (const auto& [option, file] : outputs_of(std::string(kNameInName) + ".stl"))
    if (!file.empty() && named_after(file, "a.stl") == file)
      refuse(
          fmt::format("{}: several meshes need several names; put {{name}} where the name of the mesh goes, as in {} "
                      "'{}'{}",
                      output_name(file), option, (file.parent_path() / ("{name}" + file.extension().string())).string(),
                      option == std::string_view("-o") ? ", or end -o in / for a folder" : ""));
  std::vector<fs::path> outputs;
  for (const fs::path& mesh : meshes)
    for (const auto& [option, file] : outputs_of(mesh)) outputs.push_back(file);
  check_files(meshes, outputs);
}

int run_each(const std::vector<fs::path>& meshes, const std::string& head,
             const std::function<MeshOutcome(const fs::path&)>& one) {
  std::size_t width = 4, done = 0;
  for (const fs::path& mesh : meshes) width = std::max(width, mesh.filename().string().size());
  int exit_code = kDone;
  say("{:<{}}  {}\n", "mesh", width, head);
  for (const fs::path& mesh : meshes) {
    try {
      const MeshOutcome outcome = one(mesh);
      for (const std::string& row : outcome.rows)
        say("{:<{}}  {}\n", &row == &outcome.rows.front() ? mesh.filename().string() : "", width, row);
      exit_code = std::max(exit_code, outcome.exit_code);
      done += outcome.is_as_asked;
    } catch (const InputError& error) {
      tell_error(error.what());
      exit_code = kBadInput;
    }
  }
  say("{} of {}: as asked\n", done, counted(meshes.size(), "mesh", "meshes"));
  return exit_code;
}

}  // namespace prohull::cli
