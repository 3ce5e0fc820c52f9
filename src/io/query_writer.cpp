#include <fmt/format.h>

#include <cstdint>
#include <numeric>

#include "io/append.h"
#include "io/extension.h"
#include "io/file.h"
#include "io/npy_header.h"
#include "io/query_format.h"
#include "io/zip_writer.h"
#include "prohull/error.h"

namespace prohull {
namespace {

/// The number of the query of each answer, as `offsets` of a batch have them.
std::vector<std::size_t> queries_of(const std::vector<std::size_t>& offsets) {
  std::vector<std::size_t> queries;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) queries.resize(offsets[i + 1], i);
  return queries;
}

void append_point(std::string& out, const Vec3& p) {
  append_number(out, p.x);
  append_number(out += ',', p.y);
  append_number(out += ',', p.z);
}

std::string_view query_name(HitsOf of) { return of == HitsOf::Segments ? "segment" : "ray"; }

std::string csv_content(const HitBatch& batch, HitsOf of) {
  std::string out = fmt::format("{},t,face,x,y,z,entering\n", query_name(of));
  const std::vector<std::size_t> queries = queries_of(batch.offsets);
  for (std::size_t i = 0; i < batch.hits.size(); ++i) {
    const Hit& hit = batch.hits[i];
    append_number(out, queries[i]);
    append_number(out += ',', hit.t);
    append_number(out += ',', index(hit.face));
    append_point(out += ',', hit.position);
    out += hit.entering ? ",1\n" : ",0\n";
  }
  return out;
}

std::string csv_content(const FaceBatch& batch) {
  std::string out = "triangle,face\n";
  const std::vector<std::size_t> queries = queries_of(batch.offsets);
  for (std::size_t i = 0; i < batch.faces.size(); ++i) {
    append_number(out, queries[i]);
    append_number(out += ',', index(batch.faces[i]));
    out += '\n';
  }
  return out;
}

std::string csv_content(const FacePairBatch& batch) {
  std::string out = "pose,face_a,face_b\n";
  const std::vector<std::size_t> poses = queries_of(batch.offsets);
  for (std::size_t i = 0; i < batch.pairs.size(); ++i) {
    append_number(out, poses[i]);
    append_number(out += ',', index(batch.pairs[i].a));
    append_number(out += ',', index(batch.pairs[i].b));
    out += '\n';
  }
  return out;
}

/// One array for each name; each takes a value of every item.
class NpzContent {
 public:
  template <class Items, class ValueOf>
  void add(std::string_view name, std::string_view type, const Items& items, ValueOf value_of) {
    std::string array = npy_header(type, {items.size()});
    for (const auto& item : items) append_bytes(array, value_of(item));
    zip_.add(std::string(name) + ".npy", array);
  }
  std::string finish() { return zip_.finish(); }

 private:
  ZipWriter zip_;
};

constexpr std::string_view kInt64 = "<i8", kFloat64 = "<f8", kBool = "|b1";

std::string npz_content(const HitBatch& batch, HitsOf of) {
  NpzContent out;
  out.add(query_name(of), kInt64, queries_of(batch.offsets), [](std::size_t i) { return std::int64_t(i); });
  out.add("t", kFloat64, batch.hits, [](const Hit& hit) { return hit.t; });
  out.add("face", kInt64, batch.hits, [](const Hit& hit) { return std::int64_t{index(hit.face)}; });
  out.add("x", kFloat64, batch.hits, [](const Hit& hit) { return hit.position.x; });
  out.add("y", kFloat64, batch.hits, [](const Hit& hit) { return hit.position.y; });
  out.add("z", kFloat64, batch.hits, [](const Hit& hit) { return hit.position.z; });
  out.add("entering", kBool, batch.hits, [](const Hit& hit) { return std::uint8_t{hit.entering}; });
  return out.finish();
}

std::string npz_content(const FaceBatch& batch) {
  NpzContent out;
  out.add("triangle", kInt64, queries_of(batch.offsets), [](std::size_t i) { return std::int64_t(i); });
  out.add("face", kInt64, batch.faces, [](FaceId face) { return std::int64_t{index(face)}; });
  return out.finish();
}

std::string npz_content(const FacePairBatch& batch) {
  NpzContent out;
  out.add("pose", kInt64, queries_of(batch.offsets), [](std::size_t i) { return std::int64_t(i); });
  out.add("face_a", kInt64, batch.pairs, [](const FacePair& pair) { return std::int64_t{index(pair.a)}; });
  out.add("face_b", kInt64, batch.pairs, [](const FacePair& pair) { return std::int64_t{index(pair.b)}; });
  return out.finish();
}

std::string csv_content(const std::vector<bool>& inside) {
  std::string out = "point,inside\n";
  for (std::size_t i = 0; i < inside.size(); ++i) {
    append_number(out, i);
    out += inside[i] ? ",1\n" : ",0\n";
  }
  return out;
}

std::string csv_content(std::span<const ClosestPoint> distances) {
  std::string out = "point,distance,lower,upper,face,x,y,z\n";
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const ClosestPoint& d = distances[i];
    append_number(out, i);
    for (const double value : {d.distance, d.lower, d.upper}) append_number(out += ',', value);
    append_number(out += ',', index(d.face));
    append_point(out += ',', d.position);
    out += '\n';
  }
  return out;
}

/// 0, 1, 2, ...: each point has a row.
std::vector<std::size_t> all_of(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

std::string npz_content(const std::vector<bool>& inside) {
  NpzContent out;
  out.add("point", kInt64, all_of(inside.size()), [](std::size_t i) { return std::int64_t(i); });
  out.add("inside", kBool, inside, [](bool is_inside) { return std::uint8_t{is_inside}; });
  return out.finish();
}

std::string npz_content(std::span<const ClosestPoint> distances) {
  NpzContent out;
  out.add("point", kInt64, all_of(distances.size()), [](std::size_t i) { return std::int64_t(i); });
  out.add("distance", kFloat64, distances, [](const ClosestPoint& d) { return d.distance; });
  out.add("lower", kFloat64, distances, [](const ClosestPoint& d) { return d.lower; });
  out.add("upper", kFloat64, distances, [](const ClosestPoint& d) { return d.upper; });
  out.add("face", kInt64, distances, [](const ClosestPoint& d) { return std::int64_t{index(d.face)}; });
  out.add("x", kFloat64, distances, [](const ClosestPoint& d) { return d.position.x; });
  out.add("y", kFloat64, distances, [](const ClosestPoint& d) { return d.position.y; });
  out.add("z", kFloat64, distances, [](const ClosestPoint& d) { return d.position.z; });
  return out.finish();
}

std::string csv_content(std::span<const Vec3> points) {
  std::string out = "x,y,z\n";
  for (const Vec3& p : points) {
    append_point(out, p);
    out += '\n';
  }
  return out;
}

std::string npy_content(std::span<const Vec3> points) {
  std::string out = npy_header(kFloat64, {points.size(), 3});
  for (const Vec3& p : points)
    for (const double value : {p.x, p.y, p.z}) append_bytes(out, value);
  return out;
}

std::string csv_content(std::span<const Segment> segments) {
  std::string out = "x0,y0,z0,x1,y1,z1\n";
  for (const Segment& s : segments) {
    append_point(out, s.a);
    append_point(out += ',', s.b);
    out += '\n';
  }
  return out;
}

std::string npy_content(std::span<const Segment> segments) {
  std::string out = npy_header(kFloat64, {segments.size(), 6});
  for (const Segment& s : segments)
    for (const Vec3& p : {s.a, s.b})
      for (const double value : {p.x, p.y, p.z}) append_bytes(out, value);
  return out;
}

/// Of the name of a file of `what`, which is written in this format or as csv.
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

void write_hits(const std::filesystem::path& path, const HitBatch& batch, HitsOf of) {
  write_file(path, hits_format(path) == QueryFormat::Csv ? csv_content(batch, of) : npz_content(batch, of));
}

void write_faces_met(const std::filesystem::path& path, const FaceBatch& batch) {
  write_file(path, hits_format(path) == QueryFormat::Csv ? csv_content(batch) : npz_content(batch));
}

void write_face_pairs(const std::filesystem::path& path, const FacePairBatch& batch) {
  write_file(path, hits_format(path) == QueryFormat::Csv ? csv_content(batch) : npz_content(batch));
}

void write_segments(const std::filesystem::path& path, std::span<const Segment> segments) {
  write_file(path, segments_format(path) == QueryFormat::Csv ? csv_content(segments) : npy_content(segments));
}

void write_points(const std::filesystem::path& path, std::span<const Vec3> points) {
  const QueryFormat format = format_for("points", path, QueryFormat::Npy);
  write_file(path, format == QueryFormat::Csv ? csv_content(points) : npy_content(points));
}

void write_inside(const std::filesystem::path& path, const std::vector<bool>& inside) {
  write_file(path, hits_format(path) == QueryFormat::Csv ? csv_content(inside) : npz_content(inside));
}

void write_distances(const std::filesystem::path& path, std::span<const ClosestPoint> distances) {
  write_file(path, hits_format(path) == QueryFormat::Csv ? csv_content(distances) : npz_content(distances));
}

}  // namespace prohull
