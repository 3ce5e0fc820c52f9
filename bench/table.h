#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace prohull::bench {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Cells; empty for what is not finite.
std::string number(double value, int digits, std::string_view unit = "");
/// Without what cells may not hold.
std::string as_cell(std::string text);
/// Of ours from the paper's: "+1.5 %".
std::string difference(double ours, double papers);

/// Of those numbers that are finite, the upper one of two in the middle; kUnknown if there is none.
double median(std::vector<double> numbers);

/// Rows of text under named columns, for readers and for programs.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// Requires one cell for each column; none may hold a comma, a quote or a bar.
  void add(std::vector<std::string> cells);

  bool empty() const { return rows_.empty(); }
  std::string markdown() const;
  std::string csv() const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace prohull::bench
