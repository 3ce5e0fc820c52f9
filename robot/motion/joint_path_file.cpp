#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "prohull/error.h"
#include "robot/json.h"
#include "robot/motion/joint_path.h"

namespace prohull::robot {
namespace {

using Json = nlohmann::json;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\"";
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Outside of quotes.
std::size_t find_outside(std::string_view line, char separator) {
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') is_quoted = !is_quoted;
    if (line[i] == separator && !is_quoted) return i;
  }
  return line.npos;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t end = find_outside(line, separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == line.npos) return cells;
    line.remove_prefix(end + 1);
  }
}

using Table = std::vector<std::vector<double>> PathRows::*;

/// What a column of a file holds: an entry of each row of the table; nullptr: times.
struct Column {
  Table table = nullptr;
  std::size_t joint = 0;
};

class CsvReader {
 public:
  explicit CsvReader(const std::string& file) { rows_.file = file, rows_.row = "line"; }

  PathRows read(std::string_view text) {
    for (std::size_t line = 1; !text.empty(); ++line) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view row = text.substr(0, end);
      const bool is_comment = columns_.empty() && trimmed(row).starts_with('#');
      if (!trimmed(row).empty() && !is_comment) take(row, line);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return std::move(rows_);
  }

 private:
  [[noreturn]] void refuse(std::size_t line, const std::string& why) const {
    throw InputError(Defect::Malformed, fmt::format("{}: line {}: {}", rows_.file, line, why));
  }

  void take(std::string_view row, std::size_t line) {
    if (columns_.empty())
      take_names(row, line);
    else
      take_numbers(row, line);
  }

  void take_names(std::string_view row, std::size_t line) {
    for (const char separator : {',', ';', '\t'})
      if (find_outside(row, separator) != row.npos) {
        separator_ = separator;
        break;
      }
    const std::vector<std::string_view> names = split(row, separator_);
    for (const std::string_view name : names)
      if (is_number(name)) refuse(line, fmt::format("the number '{}' where the name of a joint is expected", name));
    for (const std::string_view name : names) {
      columns_.push_back(column_of(name));
      if (columns_.back().table && !is_derivative(name, names))
        rows_.joints.emplace_back(name), columns_.back().joint = rows_.joints.size() - 1;
    }
    for (std::size_t i = 0; i < names.size(); ++i)
      if (is_derivative(names[i], names)) columns_[i] = derivative(names[i], line);
    check_complete(line);
  }

  static constexpr std::pair<std::string_view, Table> kEndings[] = {{".velocity", &PathRows::velocities},
                                                                    {".acceleration", &PathRows::accelerations}};
  static Column column_of(std::string_view name) { return {name == "time" ? nullptr : &PathRows::positions, 0}; }

  /// Whether there is a column of the name before ".velocity" or ".acceleration".
  static bool is_derivative(std::string_view name, const std::vector<std::string_view>& names) {
    return std::ranges::any_of(kEndings, [&](const auto& ending) {
      return name.ends_with(ending.first) &&
             std::ranges::find(names, name.substr(0, name.size() - ending.first.size())) != names.end();
    });
  }

  Column derivative(std::string_view name, std::size_t line) const {
    for (const auto& [ending, table] : kEndings) {
      if (!name.ends_with(ending)) continue;
      const auto joint = std::ranges::find(rows_.joints, name.substr(0, name.size() - ending.size()));
      if (joint != rows_.joints.end()) return {table, static_cast<std::size_t>(joint - rows_.joints.begin())};
    }
    refuse(line, fmt::format("'{}' is of no joint", name));
  }

  /// Velocities and accelerations are of all joints, or of none.
  void check_complete(std::size_t line) {
    for (const auto& [ending, table] : kEndings) {
      const Table kind = table;
      if (std::ranges::find(columns_, kind, &Column::table) == columns_.end()) continue;
      tables_.push_back(kind);
      for (std::size_t joint = 0; joint < rows_.joints.size(); ++joint) {
        const auto count =
            std::ranges::count_if(columns_, [&](const Column& c) { return c.table == kind && c.joint == joint; });
        if (count != 1)
          refuse(line, fmt::format("{} columns '{}{}', expected one", count, rows_.joints[joint], ending));
      }
    }
    if (std::ranges::count(columns_, Table(), &Column::table) > 1) refuse(line, "two columns 'time'");
  }

  void take_numbers(std::string_view row, std::size_t line) {
    const std::vector<std::string_view> cells = split(row, separator_);
    if (cells.size() != columns_.size())
      refuse(line, fmt::format("{} columns, expected {} as in the line of names", cells.size(), columns_.size()));
    rows_.numbers.push_back(line);
    for (const Table table : tables_) (rows_.*table).emplace_back(rows_.joints.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto& [table, joint] = columns_[i];
      (table ? (rows_.*table).back()[joint] : rows_.times.emplace_back()) = number(cells[i], line);
    }
  }

  static bool is_number(std::string_view cell) {
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return !cell.empty() && end == cell.data() + cell.size();
  }

  double number(std::string_view cell, std::size_t line) const {
    if (cell.starts_with('+')) cell.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
      refuse(line, fmt::format("'{}' is no finite number", cell));
    return value;
  }

  PathRows rows_;
  std::vector<Column> columns_;
  std::vector<Table> tables_{&PathRows::positions};  // that have columns
  char separator_ = ',';
};

class JsonReader {
 public:
  explicit JsonReader(const std::string& file) { rows_.file = file; }

  PathRows read(std::string_view text) {
    Json file = parsed_json(text, rows_.file);
    for (const char* const name : {"trajectory", "joint_trajectory"})
      if (file.is_object() && file.contains(name)) {
        refuse_others(file);
        Json inner = std::move(file[name]);  // a copy of what is nested deeply would overflow the stack
        file = std::move(inner);
      }
    if (!file.is_object()) refuse("expected an object");
    const char* const names = file.contains("joint_names") ? "joint_names" : "joints";
    for (const Json& name : list(member(file, names), names)) {
      if (!name.is_string()) refuse(fmt::format("{}: expected names of joints", names));
      rows_.joints.push_back(name);
    }
    if (file.contains("points"))
      take_points(list(file["points"], "points"));
    else
      take_tables(file);
    return std::move(rows_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(Defect::Malformed, fmt::format("{}: {}", rows_.file, why));
  }

  /// A RobotTrajectory of MoveIt may move planar and floating joints, too.
  void refuse_others(const Json& file) const {
    constexpr const char* kOthers = "multi_dof_joint_trajectory";
    if (!file.contains(kOthers) || !file[kOthers].is_object()) return;
    const Json& others = file[kOthers];
    if (others.contains("points") && !others["points"].empty())
      refuse(fmt::format("{}: planar and floating joints stay at rest here, and it moves them", kOthers));
  }

  const Json& member(const Json& object, const std::string& name) const {
    if (!object.is_object() || !object.contains(name)) refuse(fmt::format("there is no \"{}\"", name));
    return object[name];
  }

  const Json& list(const Json& value, const std::string& what) const {
    if (!value.is_array()) refuse(fmt::format("{}: expected a list", what));
    return value;
  }

  double number(const Json& value, const std::string& what) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      refuse(fmt::format("{}: expected a finite number", what));
    return value;
  }

  std::vector<double> numbers(const Json& value, const std::string& what) const {
    std::vector<double> all;
    for (const Json& entry : list(value, what)) all.push_back(number(entry, what));
    return all;
  }

  std::vector<std::vector<double>> table(const Json& value, const std::string& what) const {
    std::vector<std::vector<double>> rows;
    for (const Json& row : list(value, what)) rows.push_back(numbers(row, fmt::format("{}[{}]", what, rows.size())));
    return rows;
  }

  void take_tables(const Json& file) {
    rows_.positions = table(member(file, "positions"), "positions");
    if (file.contains("velocities")) rows_.velocities = table(file["velocities"], "velocities");
    if (file.contains("accelerations")) rows_.accelerations = table(file["accelerations"], "accelerations");
    if (file.contains("times")) rows_.times = numbers(file["times"], "times");
  }

  void take_points(const Json& points) {
    rows_.row = "point";
    std::size_t with_time = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::string point = fmt::format("point {}: ", i);
      const auto row = [&](const char* name) {
        return points[i].contains(name) ? numbers(points[i][name], point + name) : std::vector<double>();
      };
      if (!points[i].is_object() || !points[i].contains("positions")) refuse(point + "there are no \"positions\"");
      rows_.positions.push_back(row("positions"));
      rows_.velocities.push_back(row("velocities"));
      rows_.accelerations.push_back(row("accelerations"));
      if (!points[i].contains("time_from_start")) continue;
      if (++with_time <= i) refuse(point + "time_from_start is not in all points");
      rows_.times.push_back(time(points[i]["time_from_start"], point + "time_from_start"));
    }
    if (with_time != 0 && with_time != points.size()) refuse("time_from_start is not in all points");
  }

  /// A number, or as ROS 2 and ROS 1 write it.
  double time(const Json& value, const std::string& what) const {
    if (!value.is_object()) return number(value, what);
    for (const auto& [seconds, nanoseconds] : {std::pair("sec", "nanosec"), std::pair("secs", "nsecs")})
      if (value.contains(seconds))
        return number(value[seconds], what) +
               (value.contains(nanoseconds) ? number(value[nanoseconds], what) * 1e-9 : 0);
    refuse(what + ": expected a number, or {\"sec\": ..., \"nanosec\": ...}");
  }

  PathRows rows_;
};

}  // namespace

PathRows read_path_rows(std::string_view text, const std::string& file) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::string_view content = trimmed(text.substr(0, std::min<std::size_t>(text.size(), 4096)));
  if (content.starts_with('{') || content.starts_with('[')) return JsonReader(file).read(text);
  PathRows rows = CsvReader(file).read(text);
  if (rows.joints.empty())
    throw InputError(Defect::Malformed, file + ": expected a line with the names of joints, and rows of positions");
  return rows;
}

}  // namespace prohull::robot
