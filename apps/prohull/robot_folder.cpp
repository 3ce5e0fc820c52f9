#include "robot_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "command.h"
#include "prohull/error.h"
#include "robot/files/packages.h"
#include "robot/hulls/cache.h"
#include "robot/hulls/write_robot.h"
#include "robot/report/report_facts.h"

namespace prohull::cli {
namespace {

using std::filesystem::path;

constexpr const char* kReport = "report.json";

/// Whether a name is that of a file in the folder, whatever links there are on the way.
bool stays_within(const path& folder, const path& name) {
  const path normal = name.lexically_normal();
  if (normal.empty() || !normal.has_filename() || normal.is_absolute() || *normal.begin() == "..") return false;
  return robot::is_in(folder / normal, folder);
}

/// The report, if it is one that commit() may have written to this folder; otherwise null.
nlohmann::json earlier_report(const path& folder) {
  std::ifstream in(folder / kReport);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("run") || !json["run"].is_object() || !json.contains("robot") ||
      !json["robot"].is_string())
    return {};
  const nlohmann::json& run = json["run"];
  const auto is_text = [](const nlohmann::json& value) { return value.is_string(); };
  const bool is_ours =
      run.contains("made_from") && is_text(run["made_from"]) && run.contains("exit_code") &&
      (run["exit_code"] == kDone || run["exit_code"] == kAnswerIsNo) && run.contains("files") &&
      run["files"].is_object() && std::ranges::all_of(run["files"], is_text) &&
      std::ranges::all_of(run["files"].items(), [&](const auto& file) { return stays_within(folder, file.key()); });
  return is_ours ? json : nlohmann::json();
}

void require_free(const path& folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (!std::filesystem::exists(status)) return;
  if (!std::filesystem::is_directory(status)) refuse(fmt::format("{}: it is no folder; name one", folder.string()));
  const bool is_empty = std::filesystem::is_empty(folder, error);
  if (error) throw InputError(Defect::CannotRead, fmt::format("{}: {}", folder.string(), error.message()));
  if (!is_empty)
    refuse(
        fmt::format("{}: it has files that no earlier run has written, which could be overwritten; choose a new "
                    "folder",
                    folder.string()));
}

}  // namespace

RobotFolder::RobotFolder(const path& folder, const std::string& robot_name)
    : folder_(folder.has_filename() ? folder : folder.parent_path()) {  // without a slash at the end
  const nlohmann::json report = earlier_report(folder_);
  if (report.is_null()) {
    require_free(folder_);
    return;
  }
  if (const std::string other = report["robot"]; other != robot::clean_text(robot_name))
    refuse(
        fmt::format("{}: an earlier run has written the robot '{}' to it, whose files would be removed; choose another "
                    "folder, or remove this one",
                    folder_.string(), other));
  earlier_ = report["run"];
  for (const auto& [name, hash] : earlier_["files"].items()) old_[name] = hash;
}

std::optional<int> RobotFolder::earlier_run(const std::string& key) const {
  if (earlier_.is_null() || earlier_["made_from"] != key || has_changes_) return std::nullopt;
  for (const auto& [name, hash] : old_)
    if (robot::hash_of_file(folder_ / name) != hash) return std::nullopt;
  return earlier_["exit_code"].get<int>();
}

void RobotFolder::add(const path& name, const std::function<void(const path&)>& write) {
  const path target = folder_ / name;
  std::error_code error;
  if (!stays_within(folder_, name))
    refuse(
        fmt::format("{}: a symbolic link leads this file out of the folder; remove the link, or choose another folder",
                    target.string()));
  if (std::filesystem::exists(target, error) && !old_.contains(name.generic_string()))
    refuse(fmt::format("{}: no earlier run has written this file, which would be overwritten; choose another folder",
                       target.string()));
  outputs_.add_folder(target.parent_path());
  outputs_.add(target, name.extension().string(), [&](const path& file) {
    write(file);
    new_[name.generic_string()] = robot::hash_of_file(file);
    has_changes_ = has_changes_ || !robot::have_same_bytes(file, target);
    return true;
  });
}

void RobotFolder::add(const path& name, const std::string& text) {
  add(name, [&](const path& file) { robot::write_text(file, text); });
}

void RobotFolder::commit(nlohmann::json report, const std::string& key, int exit_code) {
  report["run"] = {{"made_from", key}, {"files", new_}, {"exit_code", exit_code}};
  outputs_.add_folder(folder_);
  outputs_.add_report(folder_ / kReport, std::move(report));
  outputs_.put_last_first();  // where a run is killed meanwhile, the next one knows by the report whose files there are
  outputs_.commit();
  remove_old();
}

void RobotFolder::remove_old() const {
  std::error_code ignored;
  for (const auto& [name, hash] : old_) {
    const path file = folder_ / name;
    if (new_.contains(name) || robot::hash_of_file(file) != hash) continue;
    std::filesystem::remove(file, ignored);
    std::filesystem::remove(file.parent_path(), ignored);  // if it is empty now
  }
}

}  // namespace prohull::cli
