#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/place.h"

namespace prohull {

/// What each row of a table of numbers must have: points, of three coordinates each.
struct Columns {
  std::string_view array;               ///< its name in an .npz file: "segments"
  std::vector<std::string_view> names;  ///< "x0", "y0", "z0", "x1", ...
};

/// Takes the rows of a table one after the other.
using RowSink = std::function<void(std::span<const double> row, Place place)>;

// One reader for each format. They throw InputError(Malformed) with the place; whether numbers are finite is up to the
// sink. `file` stands in messages.

/// An array of shape (n, columns) or (n, points, 3).
void read_npy(std::string_view content, const std::string& file, const Columns& columns, const RowSink& sink);
void read_csv(std::string_view content, const std::string& file, const Columns& columns, const RowSink& sink);

/// "x0,y0,z0"
std::string joined(std::span<const std::string_view> names);

}  // namespace prohull
