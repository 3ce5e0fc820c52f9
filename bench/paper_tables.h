#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "prohull/hull_builder.h"

namespace prohull::bench {

/// A row of P&T Tables 1, 2 and 4; index 0 is the first strategy, 1 the second.
struct PaperModel {
  std::string_view key;  ///< file names of the model contain it
  std::size_t faces;
  std::array<double, 2> seconds;               ///< Table 1, to 2,000 faces, on an 800 MHz Pentium III
  std::array<double, 2> void_percent_at_2000;  ///< Table 2
  std::array<double, 2> void_percent_at_200;
  std::size_t lines_that_meet;         ///< Table 4, of 10,000
  std::array<double, 4> kdop_seconds;  ///< for k = 6, 14, 18, 26
  double hull_seconds;

  std::optional<double> seconds_of(Strategy strategy, std::size_t hull_faces) const;
  std::optional<double> void_percent(Strategy strategy, std::size_t hull_faces) const;
};

/// A row of P&T Table 3, for one strategy: 10,000 segments against the horse.
struct PaperBase {
  std::size_t faces;
  double seconds, tests, splits;
};
/// Null but for the horse, the paper's strategies and sizes.
const PaperBase* paper_base(const PaperModel* model, Strategy strategy, std::size_t faces);

/// The last row of Table 3: no hull.
constexpr PaperBase kPaperBruteForce{96966, 362.63, 35751, 0};

/// The paper's model in the paper's own resolution, or null: told by its name and its number of faces.
const PaperModel* paper_model(std::string_view name, std::size_t faces);

}  // namespace prohull::bench
