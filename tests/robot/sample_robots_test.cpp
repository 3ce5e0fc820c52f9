#include "robot/samples/sample_robots.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "input_error.h"
#include "prohull/enclosure.h"
#include "prohull/error.h"

namespace prohull::robot {
namespace {

class EachRobot : public testing::TestWithParam<std::string> {
 protected:
  const SampleRobot robot_ = make_sample_robot(GetParam());
};

INSTANTIATE_TEST_SUITE_P(SampleRobots, EachRobot, testing::Values("arm", "gripper", "mobile-base"));

TEST_P(EachRobot, IsTheSameEveryTime) {
  const SampleRobot again = make_sample_robot(GetParam());
  EXPECT_EQ(again.urdf, robot_.urdf);
  EXPECT_EQ(again.meshes, robot_.meshes);
}

TEST_P(EachRobot, HasMeshesOfFloat32WithFacesThatHaveArea) {
  for (const auto& [path, mesh] : robot_.meshes) {
    EXPECT_GE(mesh.face_count(), 100U) << path;
    EXPECT_LE(mesh.face_count(), 20'000U) << path;
    for (const Vec3& p : mesh.positions)
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_EQ(p[axis], static_cast<double>(static_cast<float>(p[axis]))) << path;  // false for NaN too
    for (const auto& [a, b, c] : mesh.triangles)
      ASSERT_TRUE(mesh.positions[a] != mesh.positions[b] && mesh.positions[b] != mesh.positions[c] &&
                  mesh.positions[c] != mesh.positions[a])
          << path;
  }
}

TEST_P(EachRobot, NamesAllItsMeshes) {
  for (const auto& [path, mesh] : robot_.meshes)
    EXPECT_NE(robot_.urdf.find("filename=\"" + path + "\""), std::string::npos) << path;
  std::size_t named = 0;
  for (std::size_t at = 0; (at = robot_.urdf.find("filename=\"", at)) != std::string::npos; ++at) {
    const std::size_t begin = at + 10, end = robot_.urdf.find('"', begin);
    const std::string path = robot_.urdf.substr(begin, end - begin);
    EXPECT_TRUE(std::any_of(robot_.meshes.begin(), robot_.meshes.end(), [&](const auto& m) { return m.first == path; }))
        << path;
    ++named;
  }
  EXPECT_GE(named, robot_.meshes.size());
}

TEST_P(EachRobot, NeedsRepairAndShipsClosedCollisionMeshes) {
  bool has_open_mesh = false;
  for (const auto& [path, mesh] : robot_.meshes) {
    if (path.starts_with("meshes/visual/"))
      has_open_mesh |= !is_closed(mesh);
    else
      EXPECT_TRUE(is_closed(mesh)) << path;
  }
  EXPECT_TRUE(has_open_mesh);
}

TEST_P(EachRobot, IsAcceptedByTheParserOfRos) {
  if (std::system("command -v check_urdf >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "check_urdf of liburdfdom-tools is not installed: the URDF file was not read back";
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("prohull-" + GetParam() + std::to_string(getpid()) + ".urdf");
  std::ofstream(file) << robot_.urdf;
  const int status = std::system(("check_urdf '" + file.string() + "' >/dev/null").c_str());
  std::filesystem::remove(file);
  EXPECT_EQ(status, 0) << robot_.urdf;
}

#ifdef PROHULL_TESTS_ARE_SLOW
constexpr std::size_t kEveryFace = 50;
#else
constexpr std::size_t kEveryFace = 3;
#endif

/// How far every so many faces of the visual mesh stick out of the collision mesh of the same name.
double sticks_out(const SampleRobot& robot, const std::string& name) {
  const std::map<std::string, TriangleMesh> meshes(robot.meshes.begin(), robot.meshes.end());
  const TriangleMesh& visual = meshes.at("meshes/visual/" + name + ".stl");
  TriangleMesh some{visual.positions, {}};
  for (const FaceId f : visual.triangles.ids())
    if (index(f) % kEveryFace == 0) some.triangles.push_back(visual.triangles[f]);
  const EnclosureReport report = verify_cover(some, meshes.at("meshes/collision/" + name + ".stl"));
  return report.encloses ? 0 : report.worst.front().distance;
}

TEST(SampleArm, ShipsCollisionMeshesSomeOfWhichLeak) {
  const SampleRobot arm = make_sample_robot("arm");
  for (const char* const leaking : {"base", "link1", "link4", "link5"}) {
    EXPECT_GE(sticks_out(arm, leaking), 0.0002) << leaking;
    EXPECT_LE(sticks_out(arm, leaking), 0.002) << leaking;
  }
  for (const char* const covering : {"link2", "link6"}) EXPECT_EQ(sticks_out(arm, covering), 0) << covering;
}

TEST(SampleRobots, AreListed) {
  ASSERT_EQ(sample_robots().size(), 3U);
  for (const SampleRobotInfo& info : sample_robots()) {
    EXPECT_FALSE(info.description.empty());
    EXPECT_FALSE(make_sample_robot(info.name).urdf.empty());
  }
}

TEST(SampleRobots, RefuseUnknownNames) {
  const InputError error = error_of([] { make_sample_robot("horse"); });
  EXPECT_EQ(error.defect(), Defect::InvalidOption);
  EXPECT_STREQ(error.what(), "no sample robot is called horse; there are: arm, gripper, mobile-base");
}

}  // namespace
}  // namespace prohull::robot
