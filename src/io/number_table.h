#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/place.h"

namespace prohull {

/// What each row of a table of numbers must have: points, or rows of a matrix.
struct Columns {
  std::string_view array;               ///< its name in an .npz file: "segments"
  std::vector<std::string_view> names;  ///< "x0", "y0", "z0", "x1", ...
  std::size_t per_point = 3;            ///< how many numbers the points have
  bool lines_count = true;              ///< messages of a .csv file say the line: false of the argument of an option
};

/// Takes the rows of a table one after the other.
using RowSink = std::function<void(std::span<const double> row, Place place)>;

// One reader for each format. They throw InputError(Malformed) with the place; whether numbers are finite is up to the
// sink. `file` stands in messages.

/// An array of shape (n, columns) or (n, points, per_point).
void read_npy(std::string_view content, const std::string& file, const Columns& columns, const RowSink& sink);
void read_csv(std::string_view content, const std::string& file, const Columns& columns, const RowSink& sink);

/// How many numbers the first line of a .csv file has that is no line of names; 0 if there is none.
std::size_t numbers_per_line(std::string_view content, const std::string& file);

/// "x0,y0,z0"
std::string joined(std::span<const std::string_view> names);

}  // namespace prohull
