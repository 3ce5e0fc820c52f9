#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "outputs.h"

namespace prohull::cli {

/// The folder that `prohull urdf` writes a robot to. Its report.json tells what a run has made, and from what: only
/// such a folder of the same robot, or one that is empty or not there, is written to.
class RobotFolder {
 public:
  /// For the robot of this name. Throws InputError(InvalidOption) for a folder with other files, or with the run of a
  /// robot of another name, and for what is no folder. A report.json that names a file outside of the folder is no
  /// report of an earlier run.
  RobotFolder(const std::filesystem::path& folder, const std::string& robot_name);

  const std::filesystem::path& get() const { return folder_; }

  /// The exit code of an earlier run with this key, if all of its files are as it has left them, and those that were
  /// added until now have the same bytes. What the run has proven is not taken from its report.
  std::optional<int> earlier_run(const std::string& key) const;

  /// Lets `write` fill a file, which has this name within the folder. Throws InputError(InvalidOption) if there is such
  /// a file that no earlier run has written, and if a symbolic link leads it out of the folder.
  void add(const std::filesystem::path& name, const std::function<void(const std::filesystem::path&)>& write);
  void add(const std::filesystem::path& name, const std::string& text);

  /// The files that were added until now, by their names, with robot::hash_of_file.
  const std::map<std::string, std::string>& added() const { return new_; }

  /// Writes report.json, lets all files appear, and removes those of the earlier run that are not written again, unless
  /// they have changed.
  void commit(nlohmann::json report, const std::string& key, int exit_code);

 private:
  using Hashes = std::map<std::string, std::string>;  // robot::hash_of_file by names

  void remove_old() const;

  std::filesystem::path folder_;
  nlohmann::json earlier_;  // "run" of the report that is there; null if there is none
  Hashes old_, new_;
  bool has_changes_ = false;  // a file that was added is not as it was
  Outputs outputs_;
};

}  // namespace prohull::cli
