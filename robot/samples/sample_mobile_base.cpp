#include <fmt/format.h>

#include <numbers>

#include "robot/samples/sample_parts.h"

// x is forwards. Two driven wheels stand in the middle, a caster before and one behind them.

namespace prohull::robot {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr double kWheelRadius = 0.1, kWheelWidth = 0.044, kWheelY = 0.215;
constexpr double kCasterRadius = 0.032;

/// A loop in x and z at this y, as a pipe.
TriangleMesh arch(double half_length, double height, double y, double radius, const Detail& detail) {
  return swept({{{-half_length, y, 0}},
                {{-half_length, y, height}, 0.07},
                {{half_length, y, height}, 0.07},
                {{half_length, y, 0}}},
               radius, radius, detail);
}

TriangleMesh chassis(const Detail& detail) {
  const Detail thin{.segments = detail.segments / 2, .is_around = detail.is_around, .is_export = detail.is_export};
  std::vector<TriangleMesh> parts{
      at({0, 0, -0.05}, {}, rounded_box({0.56, 0.36, 0.17}, 0.07, 0.02, detail)),
      at({0, 0, 0.135}, {}, rounded_box({0.5, 0.32, 0.012}, 0.05, 0.003, detail)),
      swept({{{0.15, -0.175, 0}}, {{0.305, -0.175, 0}, 0.08}, {{0.305, 0.175, 0}, 0.08}, {{0.15, 0.175, 0}}}, 0.016,
            0.016, thin),
      at({-0.275, 0, 0.04}, {0, -kQuarterTurn, 0}, inside_out(rounded_box({0.07, 0.18, 0.012}, 0.01, 0.003, detail)))};
  for (const double y : {-1., 1.}) {
    parts.push_back(arch(0.13, 0.125, y * 0.187, 0.010, thin));
    parts.push_back(
        at({0, y * 0.17, 0}, {-y * kQuarterTurn, 0, 0}, disk(0.035, 0.03, 0, 0.003, detail, Ends::OpenBottom)));
    for (const double x : {-0.2, 0., 0.2}) {
      parts.push_back(at({x, y * 0.12, 0.115}, {}, disk(0.012, 0.025, 0, 0, thin, Ends::Open)));
      if (detail.is_export) parts.push_back(at({x, y * 0.12, 0.147}, {}, bolt(0.006, 0.003, {.segments = 24})));
    }
  }
  return together(parts);
}

/// About z, from z = 0 on.
TriangleMesh wheel(const Detail& detail) {
  std::vector<TriangleMesh> parts{
      turned({{{0.060, 0, 0.004}},
              {{0.070, 0, 0}, 0.003},
              {{0.096, 0, 0}, 0.010},
              {{0.096, 0, kWheelWidth}, 0.010},
              {{0.070, 0, kWheelWidth}, 0.003},
              {{0.060, 0, kWheelWidth - 0.004}}},
             detail, Ends::Open),
      turned({{{0.020, 0, 0.012}},
              {{0.062, 0, 0.006}},
              {{0.062, 0, kWheelWidth - 0.006}},
              {{0.020, 0, kWheelWidth - 0.012}}},
             detail),
      at({0, 0, kWheelWidth - 0.014}, {}, disk(0.022, 0.014, 0, 0.003, detail, Ends::OpenBottom))};
  const Detail block{.segments = 24};
  const double row = kWheelWidth / 2;
  if (!detail.is_export) return together(parts);
  const TriangleMesh tread = at({0, 0, 0.25 * kWheelWidth}, {0, kQuarterTurn, 0},
                                at({0, 0, -0.006}, {}, rounded_box({0.8 * row, 0.009, 0.010}, 0.001, 0.001, block)));
  parts.push_back(in_circle(tread, 32, kWheelRadius - 0.004));
  parts.push_back(at({0, 0, row}, {}, in_circle(tread, 32, kWheelRadius - 0.004, std::numbers::pi / 32)));
  const TriangleMesh spoke = rounded_box({0.044, 0.014, 0.008}, 0.003, 0.002, {.segments = 36});
  parts.push_back(at({0, 0, kWheelWidth - 0.016}, {}, inside_out(in_circle(spoke, 5, 0.040))));
  parts.push_back(at({0, 0, kWheelWidth}, {}, in_circle(bolt(0.003, 0.002, {.segments = 24}), 5, 0.014)));
  return together(parts);
}

TriangleMesh caster_fork(const Detail& detail) {
  std::vector<TriangleMesh> parts{disk(0.026, 0.012, 0.002, 0.002, detail),
                                  at({0, 0, -0.008}, {}, disk(0.020, 0.012, 0, 0, detail))};
  const std::vector<Corner> side{{{-0.012, -0.022, 0}, 0.008},
                                 {{0.012, -0.022, 0}, 0.008},
                                 {{0.020, 0.022, 0}, 0.002},
                                 {{-0.020, 0.022, 0}, 0.002}};
  for (const double y : {-0.018, 0.018})
    parts.push_back(at({-0.012, y + 0.002, -0.026}, {kQuarterTurn, 0.25, 0}, plate(side, 0.004, 0.001, detail)));
  parts.push_back(at({-0.008, 0, -0.008}, {}, rounded_box({0.044, 0.04, 0.004}, 0.004, 0.001, detail)));
  parts.push_back(at({-0.018, 0.022, -0.038}, {kQuarterTurn, 0, 0}, disk(0.005, 0.044, 0.001, 0.001, detail)));
  return together(parts);
}

TriangleMesh caster_wheel(const Detail& detail) {
  return together({disk(kCasterRadius, 0.022, 0.006, 0.006, detail),
                   at({0, 0, -0.003}, {}, disk(0.012, 0.028, 0.001, 0.001, detail))});
}

TriangleMesh mast(const Detail& detail) {
  std::vector<TriangleMesh> parts{
      swept({{{0, -0.12, 0}}, {{0, -0.12, 0.42}, 0.08}, {{0, 0.12, 0.42}, 0.08}, {{0, 0.12, 0}}}, 0.013, 0.013, detail,
            Ends::OpenBottom)};
  for (const double y : {-0.12, 0.12}) {
    parts.push_back(at({0, y, 0}, {}, disk(0.030, 0.006, 0, 0.002, detail)));
    if (detail.is_export)
      parts.push_back(at({0, y, 0.006}, {}, in_circle(bolt(0.004, 0.0018, {.segments = 24}), 4, 0.022, 0.4)));
  }
  return together(parts);
}

std::vector<std::pair<std::string, TriangleMesh>> meshes() {
  const Detail fine, small{.segments = 64}, coarse{.segments = 12, .is_export = false};
  return {{"meshes/visual/chassis.stl", chassis(fine)},
          {"meshes/visual/wheel.stl", wheel(fine)},
          {"meshes/visual/caster_fork.stl", caster_fork(small)},
          {"meshes/visual/caster_wheel.stl", caster_wheel(small)},
          {"meshes/visual/mast.stl", mast(small)},
          {"meshes/collision/chassis.stl", chassis(coarse)},
          {"meshes/collision/caster_fork.stl", loose_convex_hull(caster_fork(small))},
          {"meshes/collision/mast.stl", mast(coarse)}};
}

constexpr const char* kHead = R"(<?xml version="1.0"?>
<!-- A mobile base: two driven wheels and two casters. Its frame is on the floor, between the driven wheels. -->
<robot name="sample_mobile_base">
)";

constexpr const char* kBase = R"(
  <link name="base_footprint"/>
  <link name="base_link">
    <visual>
      <geometry>
        <mesh filename="meshes/visual/chassis.stl"/>
      </geometry>
      <material name="orange"/>
    </visual>
    <!-- emergency stop -->
    <visual name="stop">
      <origin xyz="-0.2 0 0.157" rpy="0 0 0"/>
      <geometry>
        <cylinder radius="0.02" length="0.03"/>
      </geometry>
    </visual>
    <collision>
      <geometry>
        <mesh filename="meshes/collision/chassis.stl"/>
      </geometry>
    </collision>
    <collision name="stop">
      <origin xyz="-0.2 0 0.157" rpy="0 0 0"/>
      <geometry>
        <cylinder radius="0.02" length="0.03"/>
      </geometry>
    </collision>
)";

constexpr const char* kMiddle = R"(  </link>
  <joint name="footprint_joint" type="fixed">
    <parent link="base_footprint"/>
    <child link="base_link"/>
    <origin xyz="0 0 0.1" rpy="0 0 0"/>
  </joint>

)";

constexpr const char* kCameraAndAntenna = R"(  <link name="camera">
    <visual>
      <geometry>
        <box size="0.03 0.12 0.03"/>
      </geometry>
      <material name="black"/>
    </visual>
    <visual>
      <origin xyz="0.015 0.04 0" rpy="0 1.5707963268 0"/>
      <geometry>
        <cylinder radius="0.01" length="0.016"/>
      </geometry>
    </visual>
    <collision>
      <geometry>
        <box size="0.05 0.12 0.03"/>
      </geometry>
    </collision>
  </link>
  <joint name="camera_joint" type="revolute">
    <parent link="mast"/>
    <child link="camera"/>
    <origin xyz="0.03 0 0.42" rpy="0 0 0"/>
    <axis xyz="0 1 0"/>
    <limit lower="-0.7" upper="0.9" effort="2" velocity="1"/>
  </joint>

  <!-- It has nothing to collide with: it bends. -->
  <link name="antenna">
    <visual>
      <origin xyz="0 0 0.07" rpy="0 0 0"/>
      <geometry>
        <cylinder radius="0.004" length="0.14"/>
      </geometry>
      <material name="black"/>
    </visual>
  </link>
  <joint name="antenna_joint" type="fixed">
    <parent link="base_link"/>
    <child link="antenna"/>
    <origin xyz="-0.22 0.1 0.147" rpy="0 0 0"/>
  </joint>

)";

constexpr const char* kLidar = R"(<cylinder radius="0.04" length="0.05"/>)";

constexpr const char* kTail = R"(
  <gazebo reference="caster_front_wheel">
    <mu1>0.1</mu1>
  </gazebo>
</robot>
)";

/// A link on top of the base.
std::string mounted(const std::string& name, const std::string& visual, const std::string& collision,
                    const std::string& xyz) {
  return fmt::format(R"(  <link name="{0}">
    <visual>
      <geometry>
        {1}
      </geometry>
      <material name="black"/>
    </visual>
    <collision>
      <geometry>
        {2}
      </geometry>
    </collision>
  </link>
  <joint name="{0}_joint" type="fixed">
    <parent link="base_link"/>
    <child link="{0}"/>
    <origin xyz="{3}" rpy="0 0 0"/>
  </joint>

)",
                     name, visual, collision, xyz);
}

/// The wheel stands on the left; turned about x, also on the right.
std::string driven_wheel(const char* side, double direction) {
  return fmt::format(R"(  <link name="wheel_{0}">
    <visual>
      <origin xyz="0 {1} 0" rpy="{2:.10g} 0 0"/>
      <geometry>
        <mesh filename="meshes/visual/wheel.stl"/>
      </geometry>
      <material name="black"/>
    </visual>
    <collision>
      <origin xyz="0 0 0" rpy="{2:.10g} 0 0"/>
      <geometry>
        <cylinder radius="{3}" length="{4}"/>
      </geometry>
    </collision>
{5}  </link>
  <joint name="wheel_{0}_joint" type="continuous">
    <parent link="base_link"/>
    <child link="wheel_{0}"/>
    <origin xyz="0 {6} 0" rpy="0 0 0"/>
    <axis xyz="0 1 0"/>
  </joint>
)",
                     side, -direction * kWheelWidth / 2, -direction * kQuarterTurn, kWheelRadius + 0.0015,
                     kWheelWidth + 0.006, inertial(1.1, {}, {0.2, 0.044, 0.2}), direction * kWheelY);
}

std::string caster(const char* where, double x) {
  return fmt::format(R"(  <link name="caster_{0}">
    <visual>
      <geometry>
        <mesh filename="meshes/visual/caster_fork.stl"/>
      </geometry>
    </visual>
    <collision>
      <geometry>
        <mesh filename="meshes/collision/caster_fork.stl"/>
      </geometry>
    </collision>
{1}  </link>
  <joint name="caster_{0}_joint" type="continuous">
    <parent link="base_link"/>
    <child link="caster_{0}"/>
    <origin xyz="{2} 0 -0.06" rpy="0 0 0"/>
    <axis xyz="0 0 1"/>
  </joint>
  <link name="caster_{0}_wheel">
    <visual>
      <origin xyz="0 0.011 0" rpy="{3:.10g} 0 0"/>
      <geometry>
        <mesh filename="meshes/visual/caster_wheel.stl"/>
      </geometry>
      <material name="black"/>
    </visual>
    <collision>
      <geometry>
        <sphere radius="{4}"/>
      </geometry>
    </collision>
{5}  </link>
  <joint name="caster_{0}_wheel_joint" type="continuous">
    <parent link="caster_{0}"/>
    <child link="caster_{0}_wheel"/>
    <origin xyz="-0.018 0 -0.038" rpy="0 0 0"/>
    <axis xyz="0 1 0"/>
  </joint>
)",
                     where, inertial(0.15, {0, 0, -0.02}, {0.05, 0.05, 0.05}), x, kQuarterTurn, kCasterRadius,
                     inertial(0.1, {}, {0.064, 0.022, 0.064}));
}

}  // namespace

SampleRobot make_sample_mobile_base() {
  return {kHead + material("orange", "0.93 0.46 0.13 1") + material("black", "0.12 0.12 0.13 1") + kBase +
              inertial(14, {0, 0, 0.03}, {0.56, 0.36, 0.18}) + kMiddle +
              mounted("lidar", kLidar, kLidar, "0.16 0 0.172") +
              mounted("mast", R"(<mesh filename="meshes/visual/mast.stl"/>)",
                      R"(<mesh filename="meshes/collision/mast.stl"/>)", "-0.1 0 0.147") +
              kCameraAndAntenna + driven_wheel("left", 1) + driven_wheel("right", -1) + caster("front", 0.21) +
              caster("rear", -0.21) + kTail,
          meshes()};
}

}  // namespace prohull::robot
