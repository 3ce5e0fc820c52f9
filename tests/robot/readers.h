#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include "prohull/error.h"
#include "robot/files/region_file.h"
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

/// Of what is taken, each bound is a distance, each box holds a point, and each range a number.
inline void take_regions(const std::string& text) {
  take_or_refuse([&] {
    for (const Region& region : read_region_file(text, "regions.yaml", [](const Length& l) { return l.number; })) {
      if (!(region.max_distance >= 0)) std::abort();
      if (const auto* const box = std::get_if<Box>(&region.faces); box && box->is_empty()) std::abort();
      if (const auto* const color = std::get_if<PaintedColor>(&region.faces); color && color->spread > 255)
        std::abort();
      if (const auto* const faces = std::get_if<NumberedFaces>(&region.faces))
        for (const NumberRange& range : faces->ranges)
          if (range.last < range.first) std::abort();
    }
  });
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
