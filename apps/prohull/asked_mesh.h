#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "inputs.h"
#include "prohull/mesh_query.h"
#include "prohull/triangle_mesh.h"

namespace prohull::cli {

/// What is said of a mesh as a solid; sentences, which may be empty.
struct SolidNotes {
  std::string turned;  ///< what was inside out
  std::string open;    ///< that the mesh is not closed, and has no inside

  /// Makes the mesh, which is closed, the solid that it stands for (outward_solid).
  static SolidNotes turning(TriangleMesh& closed, const std::filesystem::path& path);

  static SolidNotes not_closed(const std::filesystem::path& path);

  bool is_inside_out() const { return !turned.empty(); }
  std::vector<std::string> all() const;

  /// As lines of the summary. With --quiet, what has no inside is told on standard error.
  void say_them() const;
};

/// The mesh that queries are about: that of a mesh file, or the finest level of a .phull file.
class AskedMesh {
 public:
  /// Throws InputError(EmptyMesh) if it has no faces.
  AskedMesh(const std::filesystem::path& path, const InputOptions& options);

  std::size_t face_count() const { return faces_; }
  Box box() const;
  /// A mesh that is not closed becomes the solid that `prohull repair` makes of it, unless that is a wrap: that would
  /// be another solid.
  void close();
  /// A closed mesh as outward_solid makes it. Before the index is made.
  SolidNotes turn_outwards();

  /// The mesh or hull goes into the index. What `make` throws then names the file.
  QueryIndex index(const std::function<QueryIndex(MeshOrHull)>& make);
  /// The index of the engine with this name, which index_called (paper/engines.h) makes.
  QueryIndex index(std::string_view engine);

  nlohmann::json facts() const;
  /// The first lines of the summary.
  void say_what() const;

 private:
  std::filesystem::path path_;
  MeshOrHull mesh_or_hull_;
  std::size_t faces_;
  FinestLevel finest_level_;
  std::vector<std::string> repairs_;  ///< what has closed it
};

/// Queries that are made at random.
struct RandomQueries {
  std::size_t count = 0;  ///< 0: they are read from a file
  std::uint64_t seed = 1;
  std::filesystem::path file;  ///< to write them to; may be empty

  /// What the name of the file ends in. `noun` is "segments" or "points", here and below.
  std::string suffix(std::string_view noun) const;
  /// Nothing is said of queries that are read.
  void say_what(std::string_view noun) const;
};

/// The options --random, which goes to `group`, --seed and --write-NOUN. `spread` is a sentence: where the queries lie.
void add_random_queries(CLI::App& command, CLI::App& group, RandomQueries& random, std::string_view noun,
                        std::string_view spread);

/// --engine, one of `engines`.
void add_engine_option(CLI::App& command, std::string& engine, std::span<const std::string_view> engines);

/// How many threads --threads is.
unsigned threads_used(unsigned threads);

/// How long the steps of a command with queries took.
struct QuerySeconds {
  double read = 0, index = 0, query = 0, write = 0;

  nlohmann::json facts() const { return {{"read", read}, {"index", index}, {"query", query}, {"write", write}}; }
  void say_them() const;
};

}  // namespace prohull::cli
