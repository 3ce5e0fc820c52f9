#include "asked_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "console.h"
#include "options.h"
#include "outputs.h"
#include "paper/engines.h"
#include "prohull/closed_solid.h"
#include "prohull/detail/inside_out.h"
#include "prohull/detail/summary.h"
#include "prohull/error.h"

namespace prohull::cli {

AskedMesh::AskedMesh(const std::filesystem::path& path, const InputOptions& options)
    : path_(path), mesh_or_hull_(read_mesh_or_hull(path, options)) {
  const auto* const hull = std::get_if<ProgressiveHull>(&mesh_or_hull_);
  faces_ = hull ? hull->original_face_count() : std::get<TriangleMesh>(mesh_or_hull_).face_count();
  finest_level_ = hull ? hull->finest_level() : FinestLevel::Input;  // of a mesh file nothing has to be said
  if (faces_ == 0)
    throw InputError(Defect::EmptyMesh, input_name(path) + ": it has no faces, so that there is nothing to ask");
}

Box AskedMesh::box() const {
  const auto* const mesh = std::get_if<TriangleMesh>(&mesh_or_hull_);
  return bounding_box(mesh ? *mesh : std::get<ProgressiveHull>(mesh_or_hull_).original());
}

void AskedMesh::close() {
  auto* const mesh = std::get_if<TriangleMesh>(&mesh_or_hull_);
  naming(path_, [&] {
    const ClosedSolidOptions how;
    if (!mesh || is_closed(*mesh) || !repaired_mesh(*mesh, how.repair).closed) return;
    ClosedSolid solid = closed_solid(*mesh, how);
    if (solid.source != Source::Mesh || !solid.verdict.certified) return;
    *mesh = std::move(solid.mesh);
    repairs_ = describe(solid.input.repairs);
  });
}

SolidNotes AskedMesh::turn_outwards() {
  auto* const mesh = std::get_if<TriangleMesh>(&mesh_or_hull_);
  return naming(path_, [&] { return mesh && is_closed(*mesh) ? SolidNotes::turning(*mesh, path_) : SolidNotes{}; });
}

QueryIndex AskedMesh::index(const std::function<QueryIndex(MeshOrHull)>& make) {
  return naming(path_, [&] { return make(std::move(mesh_or_hull_)); });
}

QueryIndex AskedMesh::index(std::string_view engine) {
  return index([engine](MeshOrHull asked) {
    return std::visit([&](auto& mesh_or_hull) { return index_called(engine, std::move(mesh_or_hull)); }, asked);
  });
}

nlohmann::json AskedMesh::facts() const {
  return {{"path", path_.string()},
          {"faces", faces_},
          {"finest_level", name_of(finest_level_names(), finest_level_)},
          {"repairs", repairs_}};
}

void AskedMesh::say_what() const {
  say("{}: {}\n", input_name(path_), counted(faces_, "face"));
  if (!repairs_.empty())
    say("  it is not closed, and the solid is asked that `prohull repair` makes of it: {}\n",
        fmt::join(repairs_, "; "));
  if (const std::string finest = described_finest_level(finest_level_); !finest.empty())
    say("  these are faces of {}: the finest level of the file is not the input itself\n", finest);
}

void add_engine_option(CLI::App& command, std::string& engine, std::span<const std::string_view> engines) {
  const std::vector<std::string> words(engines.begin(), engines.end());
  add_value(command, "--engine", engine, CLI::detail::join(words, "|"),
            "How the answers are found; docs/queries.md explains each. auto is the fastest that is exact.")
      ->transform(one_of("--engine", words))
      ->capture_default_str();
}

unsigned threads_used(unsigned threads) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  return threads == 0 ? cores : std::min(threads, cores);
}

void QuerySeconds::say_them() const {
  say("  read {:.2f} s, index {:.2f} s, query {:.2f} s, write {:.2f} s\n", read, index, query, write);
}

std::string RandomQueries::suffix(std::string_view noun) const {
  return file.empty() ? "" : output_suffix(file, {noun, {".npy", ".csv"}});
}

void RandomQueries::say_what(std::string_view noun) const {
  if (count > 0)
    say("{} random {}, seed {}\n", grouped(count), count == 1 ? noun.substr(0, noun.size() - 1) : noun, seed);
}

void add_random_queries(CLI::App& command, CLI::App& group, RandomQueries& random, std::string_view noun,
                        std::string_view spread) {
  CLI::Option* const count = add_optional_number(group, "--random", random.count, {1, 1e9},
                                                 fmt::format("Number of random {} to ask. {}", noun, spread));
  add_number(command, "--seed", random.seed, kSeed,
             fmt::format("Number that the random {0} depend on. The same seed gives the same {0}.", noun))
      ->needs(count);
  add_value(command, fmt::format("--write-{}", noun), random.file, "FILE",
            fmt::format("File for the random {}, .npy or .csv.", noun))
      ->needs(count);
}

SolidNotes SolidNotes::turning(TriangleMesh& closed, const std::filesystem::path& path) {
  OutwardSolid solid = outward_solid(std::move(closed), input_name(path));
  closed = std::move(solid.mesh);
  return {std::move(solid.turned), {}};
}

SolidNotes SolidNotes::not_closed(const std::filesystem::path& path) {
  return {{},
          input_name(path) + " is not closed: only its faces count, not what lies inside (`prohull repair` closes it)"};
}

std::vector<std::string> SolidNotes::all() const {
  std::vector<std::string> sentences{turned, open};
  std::erase(sentences, "");
  return sentences;
}

void SolidNotes::say_them() const {
  for (const std::string& sentence : all())
    if (console().quiet && sentence != turned)
      tell_error(sentence);
    else
      say("  {}\n", sentence);
}

}  // namespace prohull::cli
