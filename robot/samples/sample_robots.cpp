#include "robot/samples/sample_robots.h"

#include <array>

#include "prohull/detail/refuse.h"
#include "robot/samples/sample_parts.h"

namespace prohull::robot {
namespace {

struct Maker {
  SampleRobotInfo info;
  const char* const* urdf;
  NamedMeshes (*meshes)();
};

constexpr std::array<Maker, 3> kMakers{{
    {{"arm", "a robot arm of seven joints"}, &kArmUrdf, sample_arm_meshes},
    {{"gripper", "a gripper of two fingers on linkages, one joint and five that mimic it"},
     &kGripperUrdf,
     sample_gripper_meshes},
    {{"mobile-base", "a mobile base: two driven wheels, two casters, a lidar and a camera on a mast"},
     &kMobileBaseUrdf,
     sample_mobile_base_meshes},
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
      SampleRobot robot{*maker.urdf, maker.meshes()};
      for (auto& [path, mesh] : robot.meshes) mesh = rounded_to_float32(std::move(mesh));
      return robot;
    }
    known += (known.empty() ? "" : ", ") + std::string(maker.info.name);
  }
  refuse("no sample robot is called " + std::string(name) + "; there are: " + known);
}

}  // namespace prohull::robot
