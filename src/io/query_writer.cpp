#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <variant>

#include "io/append.h"
#include "io/file.h"
#include "io/npy_header.h"
#include "io/query_format.h"
#include "io/zip_file.h"
#include "prohull/detail/extension.h"
#include "prohull/error.h"

namespace prohull {
namespace {

/// The number of the query of each answer, as `offsets` of a batch have them.
std::vector<std::size_t> queries_of(const std::vector<std::size_t>& offsets) {
  std::vector<std::size_t> queries;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) queries.resize(offsets[i + 1], i);
  return queries;
}

/// In the files of numpy.
template <class T>
constexpr std::string_view kNumpyType = "<i8";
template <>
constexpr std::string_view kNumpyType<double> = "<f8";
template <>
constexpr std::string_view kNumpyType<bool> = "|b1";

void append_text(std::string& out, bool value) { out += value ? '1' : '0'; }
template <class Number>
void append_text(std::string& out, Number value) {
  append_number(out, value);
}

/// Columns of as many rows each.
class Table {
 public:
  explicit Table(std::size_t rows) : rows_(rows) {}

  /// Adds a column: at(i) is the value in row i, of type std::int64_t, double or bool.
  template <class T>
  void add(std::string_view name, std::function<T(std::size_t row)> at) {
    columns_.push_back(Column<T>{name, std::move(at)});
  }
  void add_points(const std::array<std::string_view, 3>& names, const std::function<Vec3(std::size_t row)>& at) {
    for (int axis = 0; axis < 3; ++axis)
      add<double>(names[std::size_t(axis)], [at, axis](std::size_t i) { return at(i)[axis]; });
  }

  std::string csv() const {
    std::string out;
    for_each_column(out, [&](const auto& column) { out += column.name; });
    for (std::size_t i = 0; i < rows_; ++i)
      for_each_column(out, [&](const auto& column) { append_text(out, column.at(i)); });
    return out;
  }

  /// An array for each column.
  std::string npz() const {
    ZipWriter zip;
    const auto add_array = [&]<class T>(const Column<T>& column) {
      std::string array = npy_header(kNumpyType<T>, {rows_});
      for (std::size_t i = 0; i < rows_; ++i) append_bytes(array, column.at(i));
      zip.add(std::string(column.name) + ".npy", array);
    };
    for (const AnyColumn& column : columns_) std::visit(add_array, column);
    return zip.finish();
  }

  /// One array, of columns of doubles.
  std::string npy() const {
    std::string out = npy_header(kNumpyType<double>, {rows_, columns_.size()});
    for (std::size_t i = 0; i < rows_; ++i)
      for (const AnyColumn& column : columns_) append_bytes(out, std::get<Column<double>>(column).at(i));
    return out;
  }

 private:
  template <class T>
  struct Column {
    std::string_view name;
    std::function<T(std::size_t row)> at;
  };
  using AnyColumn = std::variant<Column<std::int64_t>, Column<double>, Column<bool>>;

  /// Makes a line of what `append` appends for each column.
  template <class Append>
  void for_each_column(std::string& out, Append append) const {
    for (const AnyColumn& column : columns_) {
      if (&column != columns_.data()) out += ',';
      std::visit(append, column);
    }
    out += '\n';
  }

  std::size_t rows_;
  std::vector<AnyColumn> columns_;
};

QueryFormat format_for(std::string_view what, const std::filesystem::path& path, QueryFormat binary) {
  const auto format = query_format(path);
  if (format == binary || format == QueryFormat::Csv) return *format;
  throw InputError(Defect::UnknownFormat, fmt::format("{}: {} are written to {} or .csv; name the file like that",
                                                      path.string(), what, extension_of(binary)));
}

}  // namespace

std::string_view extension_of(QueryFormat format) {
  return format == QueryFormat::Npy ? ".npy" : format == QueryFormat::Npz ? ".npz" : ".csv";
}

std::optional<QueryFormat> query_format(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  for (const QueryFormat format : {QueryFormat::Npy, QueryFormat::Npz, QueryFormat::Csv})
    if (extension == extension_of(format)) return format;
  return {};
}

QueryFormat segments_format(const std::filesystem::path& path) {
  return format_for("segments", path, QueryFormat::Npy);
}

QueryFormat hits_format(const std::filesystem::path& path) { return format_for("hits", path, QueryFormat::Npz); }

namespace {

void write_answers(const std::filesystem::path& path, const Table& table) {
  write_file(path, hits_format(path) == QueryFormat::Csv ? table.csv() : table.npz());
}

}  // namespace

void write_hits(const std::filesystem::path& path, const HitBatch& batch, HitsOf of) {
  const auto& hits = batch.hits;
  const std::vector<std::size_t> queries = queries_of(batch.offsets);
  Table table(hits.size());
  table.add<std::int64_t>(of == HitsOf::Segments ? "segment" : "ray", [&](std::size_t i) { return queries[i]; });
  table.add<double>("t", [&](std::size_t i) { return hits[i].t; });
  table.add<std::int64_t>("face", [&](std::size_t i) { return index(hits[i].face); });
  table.add_points({"x", "y", "z"}, [&](std::size_t i) { return hits[i].position; });
  table.add<bool>("entering", [&](std::size_t i) { return hits[i].entering; });
  write_answers(path, table);
}

void write_faces_met(const std::filesystem::path& path, const FaceBatch& batch) {
  const std::vector<std::size_t> queries = queries_of(batch.offsets);
  Table table(batch.faces.size());
  table.add<std::int64_t>("triangle", [&](std::size_t i) { return queries[i]; });
  table.add<std::int64_t>("face", [&](std::size_t i) { return index(batch.faces[i]); });
  write_answers(path, table);
}

void write_face_pairs(const std::filesystem::path& path, const FacePairBatch& batch) {
  const std::vector<std::size_t> poses = queries_of(batch.offsets);
  Table table(batch.pairs.size());
  table.add<std::int64_t>("pose", [&](std::size_t i) { return poses[i]; });
  table.add<std::int64_t>("face_a", [&](std::size_t i) { return index(batch.pairs[i].a); });
  table.add<std::int64_t>("face_b", [&](std::size_t i) { return index(batch.pairs[i].b); });
  write_answers(path, table);
}

void write_inside(const std::filesystem::path& path, const std::vector<bool>& inside) {
  Table table(inside.size());
  table.add<std::int64_t>("point", std::identity());
  table.add<bool>("inside", [&](std::size_t i) { return inside[i]; });
  write_answers(path, table);
}

void write_distances(const std::filesystem::path& path, std::span<const ClosestPoint> distances) {
  Table table(distances.size());
  table.add<std::int64_t>("point", std::identity());
  table.add<double>("distance", [&](std::size_t i) { return distances[i].distance; });
  table.add<double>("lower", [&](std::size_t i) { return distances[i].lower; });
  table.add<double>("upper", [&](std::size_t i) { return distances[i].upper; });
  table.add<std::int64_t>("face", [&](std::size_t i) { return index(distances[i].face); });
  table.add_points({"x", "y", "z"}, [&](std::size_t i) { return distances[i].position; });
  write_answers(path, table);
}

void write_segments(const std::filesystem::path& path, std::span<const Segment> segments) {
  Table table(segments.size());
  table.add_points({"x0", "y0", "z0"}, [&](std::size_t i) { return segments[i].a; });
  table.add_points({"x1", "y1", "z1"}, [&](std::size_t i) { return segments[i].b; });
  write_file(path, segments_format(path) == QueryFormat::Csv ? table.csv() : table.npy());
}

void write_points(const std::filesystem::path& path, std::span<const Vec3> points) {
  Table table(points.size());
  table.add_points({"x", "y", "z"}, [&](std::size_t i) { return points[i]; });
  write_file(path, format_for("points", path, QueryFormat::Npy) == QueryFormat::Csv ? table.csv() : table.npy());
}

}  // namespace prohull
