#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "io/byte_cursor.h"
#include "io/npy_header.h"
#include "io/number_table.h"

namespace prohull {
namespace {

using Load = double (*)(std::string_view bytes, std::size_t position, std::endian order);

template <class Number>
double load(std::string_view bytes, std::size_t position, std::endian order) {
  return static_cast<double>(ByteCursor(bytes, position, order).read<Number>());
}

struct NumberType {
  std::string_view name;  // kind and bytes
  std::size_t size;
  Load load;
};

constexpr std::array<NumberType, 10> kTypes = {{{"f4", 4, load<float>},
                                                {"f8", 8, load<double>},
                                                {"i1", 1, load<std::int8_t>},
                                                {"i2", 2, load<std::int16_t>},
                                                {"i4", 4, load<std::int32_t>},
                                                {"i8", 8, load<std::int64_t>},
                                                {"u1", 1, load<std::uint8_t>},
                                                {"u2", 2, load<std::uint16_t>},
                                                {"u4", 4, load<std::uint32_t>},
                                                {"u8", 8, load<std::uint64_t>}}};

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
      for (std::size_t j = 0; j < row.size(); ++j)
        row[j] = type_->load(content_, header_.size + place_of(i, j) * type_->size, order_);
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
    type_ = std::find_if(kTypes.begin(), kTypes.end(), [&](const NumberType& t) { return t.name == name; });
    const bool known = type_ != kTypes.end() && (order == '<' || order == '>' || (order == '|' && type_->size == 1));
    if (!known)
      fail(
          fmt::format("its elements are of type {}; expected integers, or floating point of 32 or 64 bits: save "
                      "array.astype('float64')",
                      in_quotes(header_.type)));
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
    const std::size_t row_size = columns_.names.size() * type_->size, left = content_.size() - header_.size;
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
  const NumberType* type_ = nullptr;
  std::endian order_ = std::endian::little;
};

}  // namespace

void read_npy(std::string_view content, const std::string& file, const Columns& columns, const RowSink& sink) {
  NpyReader(content, file, columns).read(sink);
}

}  // namespace prohull
