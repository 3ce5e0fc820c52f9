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
/// such a folder, or one that is empty or not there, is written to.
class RobotFolder {
 public:
  /// Throws InputError(InvalidOption) for a folder with other files, and for what is no folder.
  explicit RobotFolder(std::filesystem::path folder);

  const std::filesystem::path& get() const { return folder_; }

  /// "run" of the report of an earlier run with this key, if all of its files are as it has left them.
  std::optional<nlohmann::json> earlier_run(const std::string& key) const;

  /// Lets `write` fill a file, which has this name within the folder. Throws InputError(InvalidOption) if there is such
  /// a file that no earlier run has written.
  void add(const std::filesystem::path& name, const std::function<void(const std::filesystem::path&)>& write);
  void add(const std::filesystem::path& name, const std::string& text);

  /// Writes report.json, lets all files appear, and removes those of the earlier run that are not written again, unless
  /// they have changed.
  void commit(nlohmann::json report, const std::string& key, const std::string& summary, int exit_code);

 private:
  using Fingerprints = std::map<std::string, std::string>;  // of files by their names

  void remove_old() const;

  std::filesystem::path folder_;
  nlohmann::json earlier_;  // "run" of the report that is there; null if there is none
  Fingerprints old_, new_;
  Outputs outputs_;
};

}  // namespace prohull::cli
