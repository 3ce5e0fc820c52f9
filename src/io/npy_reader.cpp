#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/byte_cursor.h"
#include "io/npy_header.h"
#include "io/number_table.h"
#include "io/number_type.h"
#include "prohull/detail/names.h"

namespace prohull {
namespace {

constexpr std::pair<std::string_view, NumberType> kTypes[]{
    {"f4", NumberType::Float32}, {"f8", NumberType::Float64}, {"i1", NumberType::Int8},  {"i2", NumberType::Int16},
    {"i4", NumberType::Int32},   {"i8", NumberType::Int64},   {"u1", NumberType::UInt8}, {"u2", NumberType::UInt16},
    {"u4", NumberType::UInt32},  {"u8", NumberType::UInt64}};

class NpyReader {
 public:
  NpyReader(std::string_view content, const std::string& file, const Columns& columns)
      : content_(content), file_(file), columns_(columns), header_(read_npy_header(content, file)) {
    set_type();
    check_shape();
    check_size();
  }

  void read(const RowSink& sink) const {
    std::vector<double> row(columns_.names.size());
    for (std::size_t i = 0; i < rows(); ++i) {
      for (std::size_t j = 0; j < row.size(); ++j) {
        ByteCursor cursor(content_, header_.size + place_of(i, j) * size_of(type_), order_);
        row[j] = read_number(cursor, type_);
      }
      sink(row, {Place::Unit::Row, i});
    }
  }

 private:
  std::size_t rows() const { return header_.shape[0]; }

  /// Of the number in row i and column j, among all numbers. In Fortran order the first index runs fastest.
  std::size_t place_of(std::size_t i, std::size_t j) const {
    if (!header_.fortran_order) return i * columns_.names.size() + j;
    if (header_.shape.size() == 2) return i + rows() * j;
    const std::size_t point = j / columns_.per_point, axis = j % columns_.per_point, points = header_.shape[1];
    return i + rows() * (point + points * axis);
  }

  void set_type() {
    const std::string_view name = std::string_view(header_.type).substr(std::min<std::size_t>(1, header_.type.size()));
    const char order = header_.type.empty() ? '\0' : header_.type[0];
    const auto known = value_of<NumberType>(kTypes, name);
    if (!known || !(order == '<' || order == '>' || (order == '|' && size_of(*known) == 1)))
      fail(
          fmt::format("its elements are of type {}; expected integers, or floating point of 32 or 64 bits: save "
                      "array.astype('float64')",
                      in_quotes(header_.type)));
    type_ = *known;
    order_ = order == '>' ? std::endian::big : std::endian::little;
  }

  void check_shape() const {
    const std::vector<std::size_t>& shape = header_.shape;
    const std::size_t width = columns_.names.size(), per_point = columns_.per_point;
    const bool flat = shape.size() == 2 && shape[1] == width;
    const bool points = shape.size() == 3 && shape[1] == width / per_point && shape[2] == per_point;
    if (!flat && !points)
      fail(fmt::format("its shape is {}; {} have the shape (n, {}) or (n, {}, {}), each row {}", shape_text(shape),
                       columns_.array, width, width / per_point, per_point, joined(columns_.names)));
  }

  void check_size() const {
    const std::size_t row_size = columns_.names.size() * size_of(type_), left = content_.size() - header_.size;
    if (rows() > left / row_size)
      fail(fmt::format("the file ends after {} of {} rows; it is truncated or its shape is wrong", left / row_size,
                       rows()));
    if (left > rows() * row_size)
      fail(fmt::format("{} bytes follow the {} rows; save one array in a file", left - rows() * row_size, rows()));
  }

  [[noreturn]] void fail(std::string_view message) const {
    prohull::fail(file_, {Place::Unit::Byte, header_.size}, message);
  }

  std::string_view content_;
  const std::string& file_;
  const Columns& columns_;
  NpyHeader header_;
  NumberType type_{};
  std::endian order_ = std::endian::little;
};

}  // namespace

void read_npy(std::string_view content, const std::string& file, const Columns& columns, const RowSink& sink) {
  NpyReader(content, file, columns).read(sink);
}

}  // namespace prohull
