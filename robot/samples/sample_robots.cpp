#include "robot/samples/sample_robots.h"

#include <array>

#include "prohull/error.h"
#include "robot/samples/sample_parts.h"

namespace prohull::robot {
namespace {

struct Maker {
  SampleRobotInfo info;
  SampleRobot (*make)();
};

constexpr std::array<Maker, 3> kMakers{{
    {{"arm", "a robot arm of seven joints"}, make_sample_arm},
    {{"gripper", "a gripper of two fingers on linkages, one joint and five that mimic it"}, make_sample_gripper},
    {{"mobile-base", "a mobile base: two driven wheels, two casters, a lidar and a camera on a mast"},
     make_sample_mobile_base},
}};

constexpr auto kInfos = [] {
  std::array<SampleRobotInfo, kMakers.size()> infos{};
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = kMakers[i].info;
  return infos;
}();

}  // namespace

std::span<const SampleRobotInfo> sample_robots() { return kInfos; }

SampleRobot make_sample_robot(std::string_view name) {
  std::string known;
  for (const Maker& maker : kMakers) {
    if (maker.info.name == name) {
      SampleRobot robot = maker.make();
      for (auto& [path, mesh] : robot.meshes) mesh = rounded_to_float32(std::move(mesh));
      return robot;
    }
    known += (known.empty() ? "" : ", ") + std::string(maker.info.name);
  }
  throw InputError(Defect::InvalidOption, "no sample robot is called " + std::string(name) + "; there are: " + known);
}

}  // namespace prohull::robot
