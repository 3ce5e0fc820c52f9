#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "asked_mesh.h"
#include "inputs.h"
#include "outputs.h"
#include "prohull/mesh_query.h"

namespace prohull::cli {

// What the commands share that ask a mesh about points.

struct PointOptions {
  std::filesystem::path in, points, out, report;
  std::string out_format;
  InputOptions input;
  RandomQueries random;
  std::string engine = "auto";
  unsigned threads = 0;
  bool is_about_inside = false;  ///< and not of the faces alone
  bool closes = false;           ///< a mesh that is not closed, where answers do not number its faces
  double bytes_per_point = 45;   ///< of memory, measured
};

/// `answers` are what -o takes, "the answers".
void add_point_options(CLI::App& command, PointOptions& options, const OutputKind& answers);

struct PointAnswers {
  std::string summary;  ///< "3 of 10 points are inside (30.00 %)"
  nlohmann::json facts;
  std::function<void(const std::filesystem::path&)> write;
};
using AskPoints = std::function<PointAnswers(const QueryIndex&, const std::vector<Vec3>&, const BatchOptions&)>;

int run_points(const PointOptions& options, const OutputKind& answers, const AskPoints& ask);

}  // namespace prohull::cli
