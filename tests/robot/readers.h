#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "prohull/error.h"
#include "robot/files/robot_file.h"
#include "robot/files/sphere_file.h"
#include "robot/hulls/budgets.h"
#include "robot/hulls/cache.h"

namespace prohull::robot {

/// Each of these reads text of a stranger: it takes it, or refuses it by an InputError.
template <class Read>
void take_or_refuse(Read read) {
  try {
    read();
  } catch (const InputError&) {
  }
}

inline void take_robot(const std::string& text) {
  take_or_refuse([&] { read_robot(text, "/nowhere/robot.xml", {.package_paths = {}, .no_outside_files = true}); });
}

inline void take_yaml(const std::string& text) {
  take_or_refuse([&] { read_sphere_file(text, "spheres.yaml"); });
  take_or_refuse([&] { read_sphere_json(text, "spheres.json"); });
  Robot robot{.name = "robot", .links = {{.name = "base"}, {.name = "arm"}}};
  LinkHullOptions options;
  take_or_refuse([&] { read_budgets(text, "budgets.yaml", robot, options); });
}

/// As the content of a file in `folder`, with a right checksum.
inline void take_kept_hulls(const std::string& text, const std::filesystem::path& folder) {
  const std::string key(32, '0');
  Fingerprint checksum;
  checksum.add(text);
  std::ofstream(folder / (key + ".hulls"), std::ios::binary) << checksum.text() << text;
  HullCache(folder).find(key);
}

}  // namespace prohull::robot
