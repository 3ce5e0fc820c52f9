#include "robot/files/packages.h"

#include "robot/robot_testing.h"

namespace prohull::robot {
namespace {

namespace fs = std::filesystem;

std::string package_xml(const std::string& name) {
  return "<?xml version='1.0'?>\n<package><name> " + name + "\n</name></package>";
}

/// A workspace in a folder that vanishes. Nothing of the environment is seen.
class PackagesTest : public testing::Test {
 protected:
  MeshFile find(const std::string& uri, const FileOptions& options = {}, const fs::path& folder = {}) const {
    return Packages(robot_, options).find(uri, {1, 1, 1}, folder);
  }
  void expect_found(const std::string& uri, const fs::path& path, const FileOptions& options = {}) const {
    const MeshFile mesh = find(uri, options);
    EXPECT_EQ(mesh.path, path) << uri << ": " << mesh.why_not;
    EXPECT_EQ(mesh.uri, uri);
    EXPECT_EQ(mesh.why_not, "");
  }
  void expect_not_found(const std::string& uri, std::string_view why, const FileOptions& options = {}) const {
    const MeshFile mesh = find(uri, options);
    EXPECT_EQ(mesh.path, "") << uri;
    EXPECT_TRUE(has(mesh.why_not, why)) << uri << ": " << mesh.why_not;
  }
  fs::path file(const std::string& path, std::string_view bytes = "x") const {
    write_file(folder_.path() / path, bytes);
    return folder_.path() / path;
  }

  TemporaryFolder folder_;
  fs::path robot_ = folder_.path() / "ws/src/arm_description/urdf/arm.urdf";
  Variable ros_{"ROS_PACKAGE_PATH", ""}, ament_{"AMENT_PREFIX_PATH", ""}, gz_{"GZ_SIM_RESOURCE_PATH", ""},
      gazebo_{"GAZEBO_MODEL_PATH", ""};
};

TEST_F(PackagesTest, FindsPathsBesideTheRobot) {
  const fs::path beside = file("ws/src/arm_description/urdf/a.stl"), above = file("ws/src/arm_description/b.stl");
  expect_found("a.stl", beside);
  expect_found("./a.stl", beside);
  expect_found("../b.stl", above);
  expect_found(above.string(), above);
  EXPECT_EQ(find("a.stl", {}, "../urdf").path, beside);
  EXPECT_EQ(find("b.stl", {}, folder_.path() / "ws/src/arm_description").path, above);
  expect_not_found("c.stl", "there is no file " + (robot_.parent_path() / "c.stl").string());
  expect_not_found("..", "is a folder");
}

TEST_F(PackagesTest, GoesUpFromWhereASymbolicLinkLeads) {
  const fs::path there = file("far/away/a.stl");
  fs::create_directories(folder_.path() / "far/away/deep");
  fs::create_directories(robot_.parent_path());
  fs::create_directory_symlink(folder_.path() / "far/away/deep", robot_.parent_path() / "link");
  file("ws/src/arm_description/urdf/b.stl");
  expect_found("link/../a.stl", fs::canonical(there));
  expect_not_found("link/../b.stl", "there is no file");
}

TEST_F(PackagesTest, DecodesPercentSigns) {
  const fs::path blank = file("ws/src/arm_description/urdf/a b.stl"),
                 literal = file("ws/src/arm_description/urdf/a%41");
  expect_found("file://" + folder_.path().string() + "/ws/src/arm_description/urdf/a%20b.stl", blank);
  expect_found("file://localhost" + blank.string(), blank);
  expect_found("file:///" + blank.string(), blank);
  expect_found("package://arm_description/urdf/a%20b.stl", blank);
  expect_found("a%41", literal);
  expect_not_found("file:///none/a%2", "there is no file /none/a%2");
  expect_not_found("a%00b.stl", "there is no file");
}

TEST_F(PackagesTest, FindsPackagesAboveTheRobotAndTheirNeighbours) {
  const fs::path own = file("ws/src/arm_description/meshes/a.stl");
  expect_found("package://arm_description/meshes/a.stl", own);
  expect_found("package://arm_description//meshes/./a.stl", own);
  const fs::path neighbour = file("ws/src/gripper_description/b.stl"), higher = file("tools/c.stl");
  expect_found("package://gripper_description/b.stl", neighbour);
  expect_found("model://tools/c.stl", higher);
}

TEST_F(PackagesTest, ReadsThePackageXml) {
  file("ws/src/arm_description/package.xml", package_xml("arm_support"));
  const fs::path own = file("ws/src/arm_description/meshes/a.stl");
  expect_found("package://arm_support/meshes/a.stl", own);
  file("ws/src/Vendor_Repository/package.xml", package_xml("vendor_description"));
  expect_found("package://vendor_description/b.stl", file("ws/src/Vendor_Repository/b.stl"));
  file("ws/src/broken/package.xml", "<package><name>vendor_description</package>");
  file("ws/src/empty/package.xml", "<package><name> </name></package>");
  expect_found("package://vendor_description/b.stl", folder_.path() / "ws/src/Vendor_Repository/b.stl");
}

TEST_F(PackagesTest, LooksAtPackagePathsFirst) {
  file("ws/src/arm_description/a.stl");
  const FileOptions itself{{folder_.path() / "other/arm_description"}}, above{{folder_.path() / "other"}};
  const fs::path other = file("other/arm_description/a.stl");
  expect_found("package://arm_description/a.stl", other, itself);
  expect_found("package://arm_description/a.stl", other, above);
  expect_found("package://arm_description/a.stl", other, {{folder_.path() / "other/arm_description/"}});
  expect_found("package://arm_description/a.stl", other, {{folder_.path()}});  // one level deeper
  file("repository/checkout/package.xml", package_xml("tool"));
  const fs::path tool = file("repository/checkout/t.stl");
  expect_found("package://tool/t.stl", tool, {{folder_.path() / "repository/checkout"}});
  expect_found("package://tool/t.stl", tool, {{folder_.path() / "repository"}});
  expect_not_found("package://tool/t.stl", "(which is no folder)", {{folder_.path() / "none"}});
}

TEST_F(PackagesTest, TakesTheFirstFolderThatHasTheFile) {
  const fs::path own = file("ws/src/arm_description/a.stl");
  fs::create_directories(folder_.path() / "other/arm_description");
  expect_found("package://arm_description/a.stl", own, {{folder_.path() / "other"}});
}

TEST_F(PackagesTest, ReadsTheEnvironment) {
  const fs::path ros = file("ros/repository/r/r.stl"), ament = file("install/share/m/m.stl"),
                 gazebo = file("models/g/g.stl");
  expect_not_found("package://r/r.stl", "--package-path");
  const Variable ros_path("ROS_PACKAGE_PATH", "/none::" + (folder_.path() / "ros").string());
  const Variable ament_path("AMENT_PREFIX_PATH", (folder_.path() / "install").string() + ":");
  const Variable gazebo_path("GAZEBO_MODEL_PATH", (folder_.path() / "models/").string());
  expect_found("package://r/r.stl", ros);
  expect_found("package://m/m.stl", ament);
  expect_found("model://g/g.stl", gazebo);
}

TEST_F(PackagesTest, StaysInThePackage) {
  file("ws/src/arm_description/a.stl");
  file("ws/src/secret.stl");
  expect_not_found("package://arm_description/../secret.stl", "leads out of the package arm_description");
  expect_not_found("package://arm_description/x/../../secret.stl", "leads out");
  expect_not_found("package://arm_description/%2e%2E/secret.stl", "leads out");
  expect_not_found("package://arm_description/%2F" + (folder_.path() / "ws/src/secret.stl").string(), "leads out");
  expect_not_found("package://../secret.stl", "expected package://PACKAGE/FILE");
  expect_not_found("package://%2e%2e/secret.stl", "expected package://PACKAGE/FILE");
  expect_found("package://arm_description/x/../a.stl", folder_.path() / "ws/src/arm_description/a.stl");
}

TEST_F(PackagesTest, SaysWhyNot) {
  fs::create_directories(robot_.parent_path());
  expect_not_found("package://", "expected package://PACKAGE/FILE");
  expect_not_found("model://arm_description", "expected model://PACKAGE/FILE");
  expect_not_found("package://arm_description/a.stl", "arm_description/a.stl; name another folder");
  expect_not_found("package://none/a.stl", "there is no package none in " + robot_.parent_path().string());
  expect_not_found("https://example.org/a.stl", "not fetched");
  expect_not_found("ftp://a.stl", "ftp:// is not known");
  expect_not_found("file://meshes/a.stl", "three slashes");
  expect_not_found(std::string(10'000, 'a'), "there is no file");
  FileOptions many;
  for (int i = 0; i < 9; ++i) many.package_paths.emplace_back("/none/" + std::to_string(i));
  const std::string why = find("package://none/a.stl", many).why_not;
  EXPECT_TRUE(has(why, "/none/5") && !has(why, "/none/6") && has(why, "and 4 more") && has(why, "--package-path"))
      << why;
}

TEST_F(PackagesTest, MayBeTheOnlyFilesThatAreRead) {
  const FileOptions only_inside{.package_paths = {}, .no_outside_files = true};
  const auto refused = [&](const std::string& uri, const FileOptions& options) {
    return refusal_of([&] { find(uri, options); }, Defect::CannotRead);
  };
  const fs::path beside = file("ws/src/arm_description/urdf/a.stl"), above = file("ws/src/arm_description/b.stl"),
                 elsewhere = file("ws/src/other/c.stl");
  expect_found("a.stl", beside, only_inside);
  EXPECT_TRUE(has(refused("../b.stl", only_inside), "--no-outside-files")) << "the robot is in no package";
  file("ws/src/arm_description/package.xml", package_xml("arm_description"));
  expect_found("../b.stl", above, only_inside);
  for (const std::string& uri : {std::string("../../other/c.stl"), elsewhere.string(), "file://" + elsewhere.string(),
                                 std::string("package://other/c.stl")}) {
    expect_found(uri, elsewhere);
    EXPECT_TRUE(has(refused(uri, only_inside), "c.stl is outside of " + (robot_.parent_path().parent_path()).string()))
        << uri;
  }
  FileOptions with_other = only_inside;
  with_other.package_paths = {folder_.path() / "ws/src/other"};
  expect_found("package://other/c.stl", elsewhere, with_other);
  fs::create_symlink(elsewhere, robot_.parent_path() / "link.stl");
  EXPECT_TRUE(has(refused("link.stl", only_inside), "is outside of"));
  FileOptions with_loop = only_inside;
  fs::create_symlink("loop", folder_.path() / "loop");
  with_loop.package_paths = {folder_.path() / "loop"};
  EXPECT_TRUE(has(refused("../../other/c.stl", with_loop), "is outside of")) << "a folder that leads nowhere";
  EXPECT_TRUE(find("a.stl", only_inside).alone) << "it may have no data in other files";
  EXPECT_FALSE(find("a.stl", {}).alone);
}

TEST_F(PackagesTest, RelatesPathsToAnotherFolder) {
  file("ws/src/arm_description/urdf/meshes/a.stl");
  const Packages packages(robot_, {});
  const fs::path out = folder_.path() / "ws/src/arm_description/out";
  const auto uri_from = [&](const fs::path& folder, const std::string& uri) {
    return packages.uri_from(folder, packages.find(uri, {1, 1, 1}));
  };
  EXPECT_EQ(uri_from(out, "meshes/a.stl"), "../urdf/meshes/a.stl");
  EXPECT_EQ(uri_from(robot_.parent_path(), "./meshes//a.stl"), "./meshes//a.stl");
  EXPECT_EQ(uri_from(out, "../urdf/meshes/a.stl"), "../urdf/meshes/a.stl");
  EXPECT_EQ(uri_from(out, "package://arm_description/urdf/meshes/a.stl"),
            "package://arm_description/urdf/meshes/a.stl");
  EXPECT_EQ(uri_from(out, "model://arm_description/urdf/meshes/a.stl"), "model://arm_description/urdf/meshes/a.stl");
  EXPECT_EQ(uri_from(folder_.path() / "out", "model://arm_description/urdf/meshes/a.stl"),
            "../ws/src/arm_description/urdf/meshes/a.stl");
  EXPECT_EQ(uri_from(folder_.path() / "out", "package://arm_description/urdf/meshes/a.stl"),
            "package://arm_description/urdf/meshes/a.stl");
  EXPECT_EQ(uri_from(out, robot_.parent_path() / "meshes/a.stl"), robot_.parent_path() / "meshes/a.stl");
  EXPECT_EQ(uri_from(out, "meshes/none.stl"), "meshes/none.stl");
  EXPECT_EQ(uri_from(out, "file:meshes/a.stl"), "../urdf/meshes/a.stl");
  EXPECT_EQ(uri_from(robot_.parent_path(), "file:meshes/a.stl"), "file:meshes/a.stl");
  const fs::path before = fs::current_path();
  fs::current_path(robot_.parent_path().parent_path());
  EXPECT_EQ(uri_from("", "meshes/a.stl"), "urdf/meshes/a.stl") << "the folder of a file that is named without one";
  fs::current_path(before);
  file("ws/src/arm_description/out/meshes/a.stl");  // another file of this name
  EXPECT_EQ(uri_from(out, "meshes/a.stl"), "../urdf/meshes/a.stl");
}

}  // namespace
}  // namespace prohull::robot
