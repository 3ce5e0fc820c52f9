#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "prohull/hull_builder.h"

namespace prohull::bench {

/// A row of P&T Tables 1 and 2; index 0 is the first strategy, 1 the second.
struct PaperModel {
  std::string_view key;  ///< file names of the model contain it
  std::size_t faces;
  std::array<double, 2> seconds;               ///< Table 1, to 2,000 faces, on an 800 MHz Pentium III
  std::array<double, 2> void_percent_at_2000;  ///< Table 2
  std::array<double, 2> void_percent_at_200;

  std::optional<double> seconds_of(Strategy strategy, std::size_t hull_faces) const;
  std::optional<double> void_percent(Strategy strategy, std::size_t hull_faces) const;
};

/// The paper's model in the paper's own resolution, or null: told by its name and its number of faces.
const PaperModel* paper_model(std::string_view name, std::size_t faces);

}  // namespace prohull::bench
