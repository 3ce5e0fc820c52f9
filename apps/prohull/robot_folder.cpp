#include "robot_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>
#include <utility>

#include "prohull/error.h"
#include "robot/hulls/cache.h"

namespace prohull::cli {
namespace {

using std::filesystem::path;

constexpr const char* kReport = "report.json";

std::string fingerprint_of(const path& file) {
  robot::Fingerprint fingerprint;
  fingerprint.add_file(file);
  return fingerprint.text();
}

/// "run" of a report, if it is one that commit() has written; otherwise null.
nlohmann::json run_of(const path& report) {
  std::ifstream in(report);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("run") || !json["run"].is_object()) return {};
  const nlohmann::json& run = json["run"];
  const auto is_text = [](const nlohmann::json& value) { return value.is_string(); };
  const bool is_ours = run.contains("made_from") && is_text(run["made_from"]) && run.contains("summary") &&
                       is_text(run["summary"]) && run.contains("exit_code") && run["exit_code"].is_number_integer() &&
                       run.contains("files") && run["files"].is_object() && std::ranges::all_of(run["files"], is_text);
  return is_ours ? run : nlohmann::json();
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

RobotFolder::RobotFolder(path folder) : folder_(std::move(folder)), earlier_(run_of(folder_ / kReport)) {
  if (earlier_.is_null()) {
    require_free(folder_);
    return;
  }
  for (const auto& [name, fingerprint] : earlier_["files"].items()) old_[name] = fingerprint;
}

std::optional<nlohmann::json> RobotFolder::earlier_run(const std::string& key) const {
  if (earlier_.is_null() || earlier_["made_from"] != key) return std::nullopt;
  for (const auto& [name, fingerprint] : old_)
    if (fingerprint_of(folder_ / name) != fingerprint) return std::nullopt;
  return earlier_;
}

void RobotFolder::add(const path& name, const std::function<void(const path&)>& write) {
  const path target = folder_ / name;
  std::error_code error;
  if (std::filesystem::exists(target, error) && !old_.contains(name.generic_string()))
    refuse(fmt::format("{}: no earlier run has written this file, which would be overwritten; choose another folder",
                       target.string()));
  outputs_.add_folder(target.parent_path());
  outputs_.add(target, name.extension().string(), [&](const path& file) {
    write(file);
    new_[name.generic_string()] = fingerprint_of(file);
    return true;
  });
}

void RobotFolder::add(const path& name, const std::string& text) {
  add(name, [&](const path& file) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw InputError(Defect::CannotWrite, fmt::format("{}: cannot write", file.string()));
  });
}

void RobotFolder::commit(nlohmann::json report, const std::string& key, const std::string& summary, int exit_code) {
  report["run"] = {{"made_from", key}, {"files", new_}, {"summary", summary}, {"exit_code", exit_code}};
  outputs_.add_folder(folder_);
  outputs_.add_report(folder_ / kReport, std::move(report));
  outputs_.commit();
  remove_old();
}

void RobotFolder::remove_old() const {
  std::error_code ignored;
  for (const auto& [name, fingerprint] : old_) {
    const path file = folder_ / name;
    if (new_.contains(name) || fingerprint_of(file) != fingerprint) continue;
    std::filesystem::remove(file, ignored);
    std::filesystem::remove(file.parent_path(), ignored);  // if it is empty now
  }
}

}  // namespace prohull::cli
