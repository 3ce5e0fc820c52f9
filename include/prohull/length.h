#pragma once

#include <optional>
#include <string_view>

#include "prohull/detail/names.h"

namespace prohull {

/// Units of length ("mm", "cm", "m", "in", "ft"), each with its length in metres. With that number as
/// ReadOptions::scale, a file in the unit is read in metres.
Names<double> length_units();

/// A length as people write it: "0.5" in the unit of a mesh, "0.5%" of the diagonal of the mesh's bounding box, "1mm".
struct Length {
  double number = 0;      ///< finite, at least 0
  std::string_view unit;  ///< empty: that of the mesh; "%"; or one of length_units()

  bool needs_metres() const { return !unit.empty() && unit != "%"; }
  /// In the unit of a mesh, which is the metre if the length needs that. `diagonal` is that of finite_bounding_box.
  double of(double diagonal) const;
};

/// Nothing if the text is no length. There may be a plus before the number, and spaces behind it.
std::optional<Length> length_of(std::string_view text);

}  // namespace prohull
