#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "inputs.h"
#include "options.h"
#include "prohull/enclosure.h"
#include "prohull/repair.h"

namespace prohull::cli {

/// `prohull verify`, with or without --union.
struct VerifyOptions {
  std::filesystem::path hull, original, report;
  std::vector<std::filesystem::path> more;  ///< files after the second one
  InputOptions hull_input, original_input;
  HullSide side = HullSide::Outer;
  OpenShells open_shells = OpenShells::Keep;
  bool solid_only = false, finite_only = false, is_union = false, inside = false, any_scale = false;
  std::string offset = "0,0,0";
  std::string link;  ///< of the files of pieces, with --union
  Length gap;
  std::size_t max_steps = 0;
};

/// "(1, 2, 3)"
std::string text_of_point(const Vec3& p);

void print_worst(std::size_t faces_outside, const std::string& mesh, const std::vector<Offender>& worst);

/// Returns the exit code.
int run_verify_union(const VerifyOptions& options);

}  // namespace prohull::cli
