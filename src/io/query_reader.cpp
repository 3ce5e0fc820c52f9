#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "io/file_content.h"
#include "io/npy_header.h"
#include "io/number_table.h"
#include "io/query_format.h"
#include "io/text_scanner.h"
#include "prohull/detail/extension.h"
#include "prohull/detail/query_io.h"

namespace prohull {
namespace {

std::optional<QueryFormat> format_of_name(const std::filesystem::path& name) {
  if (lower_case_extension(name) == ".gz") return format_of_name(name.stem());
  return query_format(name);
}

QueryFormat query_format_of(std::string_view content, const std::filesystem::path& name) {
  std::optional<QueryFormat> found;
  if (content.starts_with(kNpyMagic)) found = QueryFormat::Npy;
  if (is_zip(content)) found = QueryFormat::Npz;
  const auto named = format_of_name(name);
  if (!named && !found && !name.has_extension()) return QueryFormat::Csv;
  if (!named && !found)
    throw InputError(Defect::UnknownFormat,
                     fmt::format("{}: unknown format; name it .npy, .npz or .csv", name.string()));
  if (named && found && named != found)
    throw InputError(Defect::Malformed, fmt::format("{}: its content is that of a {} file; rename it", name.string(),
                                                    extension_of(*found)));
  return named ? *named : *found;
}

FileContent array_of_archive(std::string_view bytes, const std::filesystem::path& name, std::string_view array) {
  std::vector<std::string> members = zip_members(bytes, name);
  std::erase_if(members, [](const std::string& member) { return !member.ends_with(".npy"); });
  const std::string wanted = std::string(array) + ".npy";
  if (std::find(members.begin(), members.end(), wanted) != members.end()) return zip_member(bytes, name, wanted);
  if (members.size() == 1) return zip_member(bytes, name, members[0]);
  throw InputError(Defect::Malformed, fmt::format("{}: none of its {} arrays is called {}; save the one you mean alone",
                                                  name.string(), members.size(), array));
}

void read_uncompressed(std::string_view content, const std::filesystem::path& name, const Columns& columns,
                       const RowSink& sink) {
  switch (query_format_of(content, name)) {
    case QueryFormat::Npy:
      return read_npy(content, name.string(), columns, sink);
    case QueryFormat::Csv:
      return read_csv(content, name.string(), columns, sink);
    case QueryFormat::Npz: {
      const FileContent array = array_of_archive(content, name, columns.array);
      return read_npy(array.bytes, array.name.string(), columns, sink);
    }
  }
}

Vec3 point(std::span<const double> row, std::size_t first) { return {row[first], row[first + 1], row[first + 2]}; }

/// The numbers of a pose, in one of three forms.
struct PoseRow {
  std::vector<std::string_view> names;
  std::size_t per_point;
  Pose (*pose)(std::span<const double> row);
};

Pose pose_of_matrix(std::span<const double> m) {
  return {{Vec3{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, {m[3], m[7], m[11]}};
}

/// Of a first row with so many numbers; of no row, any.
const PoseRow& pose_row(std::size_t numbers, const std::string& name) {
  static const std::vector<std::string_view> affine{"r00", "r01", "r02", "x",   "r10", "r11",
                                                    "r12", "y",   "r20", "r21", "r22", "z"};
  static const std::vector<std::string_view> square = [] {
    std::vector<std::string_view> names = affine;
    names.insert(names.end(), {"0", "0", "0", "1"});
    return names;
  }();
  static const PoseRow kQuaternion{{"x", "y", "z", "qw", "qx", "qy", "qz"}, 7, [](std::span<const double> n) {
                                     return pose_of_quaternion(n[3], n[4], n[5], n[6], {n[0], n[1], n[2]});
                                   }};
  static const PoseRow kAffine{affine, 4, pose_of_matrix}, kSquare{square, 4, pose_of_matrix};
  for (const PoseRow* const form : {&kQuaternion, &kAffine, &kSquare})
    if (numbers == 0 || numbers == form->names.size()) return *form;
  fail(name, {Place::Unit::None},
       fmt::format(
           "a pose has 7 numbers, {}; or 12, the upper three rows of a matrix of 4 x 4; or all 16; this one has {}",
           joined(kQuaternion.names), numbers));
}

/// How many numbers the first row has, as far as that can be seen without reading it.
std::size_t numbers_per_row(std::string_view content, const std::filesystem::path& name) {
  switch (query_format_of(content, name)) {
    case QueryFormat::Npz:
      return numbers_per_row(array_of_archive(content, name, "poses").bytes, "poses.npy");
    case QueryFormat::Npy: {
      std::size_t numbers = 1;
      const std::vector<std::size_t> shape = read_npy_header(content, name.string()).shape;
      for (std::size_t i = 1; i < shape.size(); ++i) numbers *= shape[i];
      return numbers;
    }
    case QueryFormat::Csv:
      return numbers_per_line(content, name.string());
  }
  return 0;
}

/// `of_matrix`, if there is one, makes another pose of what a matrix is.
RowSink poses_into(std::vector<Pose>& poses, const PoseRow& form, const std::string& name,
                   const std::function<Pose(const Pose&)>& of_matrix = {}) {
  return [&poses, &form, &name, of_matrix](std::span<const double> row, Place place) {
    try {
      const bool is_affine = row.size() != 16 || (row[12] == 0 && row[13] == 0 && row[14] == 0 && row[15] == 1);
      if (!is_affine) throw InputError(Defect::Malformed, "the last row of the matrix is not 0,0,0,1");
      poses.push_back(form.pose(row));
      require_rigid(poses.back());
      if (of_matrix && row.size() > 7) poses.back() = of_matrix(poses.back());
    } catch (const InputError& error) {
      fail(name, place, error.what(), Defect::Malformed);
    }
  };
}

/// Whether the w of a quaternion is the last of the names in a line, behind a z. In a comment, names have at most two
/// letters: "row" is none.
bool names_w_last(std::string_view line) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  const std::size_t longest = line.starts_with('#') ? 2 : line.size();
  std::string ends;  // the last letters of those that end in w or z
  for (std::size_t begin = 0, end = 0; begin < line.size(); begin = end + 1) {
    end = std::min(line.find_first_not_of(kLetters, begin), line.size());
    if (end > begin && end - begin <= longest && std::string_view("wzWZ").find(line[end - 1]) < 4)
      ends += line[end - 1];
  }
  return ends.ends_with("zw") || ends.ends_with("ZW");
}

/// Refuses names of columns that put the w of the quaternion last, whether they stand in comments or not.
void check_order(std::string_view content, const std::filesystem::path& name) {
  TextScanner scanner(content, name.string());
  for (bool is_comment = true; is_comment && scanner.next_line();) {
    const std::string_view line = scanner.rest_of_line();
    if (names_w_last(line)) scanner.fail("the w of the quaternion comes last; expected x, y, z, w, x, y, z");
    is_comment = line.starts_with('#');
  }
}

std::vector<Pose> read_uncompressed_poses(std::string_view content, const std::filesystem::path& name,
                                          const std::function<Pose(const Pose&)>& of_matrix) {
  const std::string file = name.string();
  const PoseRow& form = pose_row(numbers_per_row(content, name), file);
  if (form.per_point == 7 && query_format_of(content, name) == QueryFormat::Csv) check_order(content, name);
  std::vector<Pose> poses;
  read_uncompressed(content, name, {"poses", form.names, form.per_point}, poses_into(poses, form, file, of_matrix));
  return poses;
}

/// why_not(query) says what to do about a query without length; it is empty for others.
template <class Query>
std::vector<Query> read_queries(std::string_view content, const std::filesystem::path& name, const Columns& columns,
                                const std::function<Query(std::span<const double> row)>& query_of,
                                const std::function<std::string_view(const Query&)>& why_not = {}) {
  const std::string file = name.string();
  std::vector<Query> queries;
  const RowSink add = [&](std::span<const double> row, Place place) {
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!std::isfinite(row[i]))
        fail(file, place, fmt::format("{} is {}; expected finite numbers", columns.names[i], row[i]),
             Defect::NonFiniteCoordinate);
    queries.push_back(query_of(row));
    if (const std::string_view why = why_not ? why_not(queries.back()) : ""; !why.empty())
      fail(file, place, why, Defect::NoLength);
  };
  if (is_gzip(content))
    read_uncompressed(gunzip(content, name), name, columns, add);
  else
    read_uncompressed(content, name, columns, add);
  return queries;
}

}  // namespace

std::vector<Segment> read_segments(std::string_view content, const std::filesystem::path& name) {
  return read_queries<Segment>(
      content, name, {"segments", {"x0", "y0", "z0", "x1", "y1", "z1"}},
      [](std::span<const double> row) {
        return Segment{point(row, 0), point(row, 3)};
      },
      [](const Segment& s) { return s.a == s.b ? "the segment's ends are equal; leave it out" : ""; });
}

std::vector<Ray> read_rays(std::string_view content, const std::filesystem::path& name) {
  return read_queries<Ray>(
      content, name, {"rays", {"x", "y", "z", "dx", "dy", "dz"}},
      [](std::span<const double> row) {
        return Ray{point(row, 0), point(row, 3)};
      },
      [](const Ray& r) { return r.direction == Vec3{} ? "the ray's direction is zero; leave it out" : ""; });
}

std::vector<Triangle> read_triangles(std::string_view content, const std::filesystem::path& name) {
  return read_queries<Triangle>(content, name, {"triangles", {"x0", "y0", "z0", "x1", "y1", "z1", "x2", "y2", "z2"}},
                                [](std::span<const double> row) {
                                  return Triangle{point(row, 0), point(row, 3), point(row, 6)};
                                });
}

std::vector<Vec3> read_points(std::string_view content, const std::filesystem::path& name) {
  return read_queries<Vec3>(content, name, {"points", {"x", "y", "z"}},
                            [](std::span<const double> row) { return point(row, 0); });
}

std::vector<Pose> read_poses(std::string_view content, const std::filesystem::path& name,
                             const std::function<Pose(const Pose&)>& of_matrix) {
  return is_gzip(content) ? read_uncompressed_poses(gunzip(content, name), name, of_matrix)
                          : read_uncompressed_poses(content, name, of_matrix);
}

Pose read_pose(std::string_view text, const std::string& option) {
  const PoseRow& form = pose_row(numbers_per_line(text, option), option);
  std::vector<Pose> poses;
  read_csv(text, option, {"poses", form.names, form.per_point, false}, poses_into(poses, form, option));
  if (poses.size() != 1)
    fail(option, {Place::Unit::None}, poses.empty() ? "there are no numbers" : "there is more than one pose");
  return poses.front();
}

}  // namespace prohull
