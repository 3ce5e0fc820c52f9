#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <array>
#include <fstream>
#include <memory>

#include "prohull/mesh_io.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"
#include "random.h"
#include "robot/files/robot_file.h"
#include "robot/motion/kinematics.h"
#include "robot/robot_testing.h"

namespace prohull::robot {
namespace {

namespace fs = std::filesystem;

// MuJoCo itself reads what the command writes for it.

using Model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using Data = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

Model load(const fs::path& path) {
  std::array<char, 1000> error{};
  Model model(mj_loadXML(path.c_str(), nullptr, error.data(), int(error.size())), mj_deleteModel);
  EXPECT_TRUE(model) << path << ": " << error.data();
  return model;
}

class InMujoco : public testing::Test {
 protected:
  /// In the folder of the test.
  void prohull(const std::string& arguments) const {
    const std::string command =
        fmt::format("cd '{}' && '{}' {} >out 2>&1", folder_.path().string(), PROHULL_PROGRAM, arguments);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
  std::string text_of(const char* name) const {
    std::ifstream stream(folder_ / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  TemporaryFolder folder_;
};

constexpr int kBalls = 200;
constexpr double kRadius = 0.05;

// Contacts of MuJoCo are soft: balls fall slowly, on contacts that are stiff, so that they do not sink in by their
// radius.

/// How many of the balls that fall on a part come to have their centre inside of it.
int balls_inside(const fs::path& scene, const TriangleMesh& part) {
  const Model model = load(scene);
  if (!model) return -1;
  const Data data(mj_makeData(model.get()), mj_deleteData);
  const QueryIndex index(part);
  MeshQuery query(index);
  const Box box = bounding_box(part);
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> at(0, 1);
  int count = 0;
  for (int ball = 0; ball < kBalls; ++ball) {
    mj_resetData(model.get(), data.get());
    data->qpos[0] = box.min.x + at(random) * (box.max.x - box.min.x);
    data->qpos[1] = box.min.y + at(random) * (box.max.y - box.min.y);
    data->qpos[2] = box.max.z + 2 * kRadius;
    bool is_inside = false;
    while (!is_inside && data->qpos[2] > box.min.z && data->time < 4) {
      mj_step(model.get(), data.get());
      is_inside = query.contains({data->qpos[0], data->qpos[1], data->qpos[2]});
    }
    count += is_inside;
  }
  return count;
}

TEST_F(InMujoco, NoBallPassesThroughConvexPieces) {
  const TriangleMesh part = make_sample("bracket", 3000);
  write_mesh(folder_ / "part.stl", part);
  prohull("convex part.stl --pieces 8 -o pieces.xml");
  const auto scene = [&](const char* name, const std::string& what) {
    std::ofstream(folder_ / name) << fmt::format(
        "<mujoco><option timestep='0.001' gravity='0 0 -1'/>{}<worldbody><body><freejoint/>"
        "<geom type='sphere' size='{}' solref='0.002 1'/></body>"
        "</worldbody></mujoco>",
        what, kRadius);
    return folder_ / name;
  };
  EXPECT_EQ(balls_inside(scene("pieces_scene.xml", "<include file='pieces.xml'/>"), part), 0);
  EXPECT_GT(balls_inside(scene("free.xml", ""), part), kBalls / 2) << "nothing stops them";
}

// As its URDF allows, the compiler is told that paths of meshes are meant.
TEST_F(InMujoco, RobotsLoadWithWhateverCoversTheirLinks) {
  prohull("sample gripper -o gripper");
  std::string text = text_of("gripper/gripper.urdf");
  const auto robot = text.find("<robot"), at = text.find('>', robot) + 1;
  text.insert(at, "<mujoco><compiler strippath=\"false\"/></mujoco>");
  std::ofstream(folder_ / "gripper/gripper.urdf") << text;
  const std::string options = " --configurations 0 --prove 0 --no-pictures -o ";
  prohull("urdf gripper/gripper.urdf --faces 60" + options + "hulls");
  if (const Model model = load(folder_ / "hulls/gripper.urdf")) {
    EXPECT_EQ(model->nmesh, 9);
  }
  prohull("urdf gripper/gripper.urdf --collision spheres --spheres 16" + options + "spheres");
  if (const Model model = load(folder_ / "spheres/gripper.urdf")) {
    EXPECT_EQ(model->nmesh, 0);
    EXPECT_GE(model->ngeom, 9 * 8);
  }
}

/// A picture of one pixel, in MuJoCo's own format.
void write_texture(const fs::path& path) {
  const std::array<int, 2> size{1, 1};
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(size.data()), sizeof size).write("\xff\xff\xff", 3);
}

TEST_F(InMujoco, ModelsWithFoldersOfAssetsLoad) {
  fs::create_directories(folder_ / "in/as s");
  write_mesh(folder_ / "in/as s/part.stl", make_sample("bracket", 300));
  write_texture(folder_ / "in/as s/skin.bin");
  for (const std::string compiler :
       {"meshdir='as s' texturedir='as s'", "strippath='true' meshdir='as s' texturedir='as s'"}) {
    std::ofstream(folder_ / "in/arm.xml")
        << "<mujoco><compiler " << compiler << "/><asset><mesh name='part' file='part.stl'/>"
        << "<texture name='skin' type='2d' file='skin.bin'/></asset><worldbody><body name='a'><inertial pos='0 0 0' "
           "mass='1' "
        << "diaginertia='1 1 1'/><freejoint/><geom type='mesh' mesh='part' contype='0' conaffinity='0'/>"
        << "<geom type='box' size='.1 .1 .1'/></body></worldbody></mujoco>";
    EXPECT_TRUE(load(folder_ / "in/arm.xml"));
    for (const std::string out : {"new", "in/new"}) {
      prohull("urdf in/arm.xml --faces 60 --configurations 0 --prove 0 --no-pictures -o " + out);
      if (const Model model = load(folder_.path() / out / "arm.xml")) {
        EXPECT_EQ(model->nmesh, 2);
        EXPECT_EQ(model->ntex, 1);
      }
    }
  }
}

TEST_F(InMujoco, MshFilesAreReadAsMujocoReadsThem) {
  const TriangleMesh part = make_sample("bracket", 200);
  std::string bytes;
  const auto add = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  for (const std::size_t count : {part.vertex_count(), std::size_t{0}, std::size_t{0}, part.face_count()})
    add(std::int32_t(count));
  for (const Vec3& p : part.positions)
    for (int axis = 0; axis < 3; ++axis) add(float(p[axis]));
  for (const auto& corners : part.triangles)
    for (const VertexId corner : corners) add(std::int32_t(corner));
  write_bytes(folder_ / "part.msh", bytes);
  write_bytes(folder_ / "arm.xml",
              "<mujoco><asset><mesh name='m' file='part.msh'/></asset><worldbody><body name='b'>"
              "<geom type='mesh' mesh='m'/></body></worldbody></mujoco>");
  prohull("urdf arm.xml -o made --faces 50 --no-pictures");
  const Model model = load(folder_ / "made/arm.xml");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->mesh_facenum[0], int(part.face_count()));
  EXPECT_EQ(read_mesh(folder_ / "part.msh").face_count(), part.face_count());
}

/// The largest distance between where MuJoCo has the frames of the bodies, and where link_poses has them.
double largest_deviation(const mjModel& model, mjData& data, const Robot& robot) {
  std::vector<double> positions;
  for (const Joint& joint : robot.joints) {
    const int id = mj_name2id(&model, mjOBJ_JOINT, joint.name.c_str());
    positions.push_back(id < 0 ? 0 : data.qpos[model.jnt_qposadr[id]]);
  }
  mj_kinematics(&model, &data);
  const std::vector<Pose> poses = link_poses(robot, positions);
  double largest = 0;
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    const int id = mj_name2id(&model, mjOBJ_BODY, robot.links[link].name.c_str());
    EXPECT_GE(id, 0) << robot.links[link].name;
    const mjtNum *const at = data.xpos + 3 * id, *const turn = data.xmat + 9 * id;
    for (int row = 0; row < 3; ++row) {
      largest = std::max(largest, std::abs(at[row] - poses[link].translation[row]));
      for (int column = 0; column < 3; ++column)
        largest = std::max(largest, std::abs(turn[3 * row + column] - poses[link].rotation[row][column]));
    }
  }
  return largest;
}

TEST_F(InMujoco, BodiesStandWhereMujocoHasThem) {
  const std::string turned = "pos='.1 .2 .3' euler='20 30 40'", geom = "<geom size='.1'/>";
  write_bytes(folder_ / "arm.xml",
              "<mujoco><compiler autolimits='true'/><default><default class='d'><joint ref='30' "
              "springref='50'/></default></default><worldbody>"
              "<body name='a'>" +
                  geom + "<body name='b' " + turned + ">" + geom +
                  "<joint name='j' pos='.1 .2 0' axis='1 2 3' class='d' range='-90 180'/>"
                  "<joint name='k' type='slide' axis='1 1 0' ref='.5' range='-1 2'/>"
                  "<joint name='l' ref='-70' pos='0 0 .4' axis='0 1 1'/>"
                  "<body name='c' " +
                  turned + ">" + geom +
                  "<joint name='m' ref='10' axis='1 0 1'/></body></body>"
                  "</body></worldbody></mujoco>");
  const Model model = load(folder_ / "arm.xml");
  ASSERT_TRUE(model);
  const Robot robot = read_robot(folder_ / "arm.xml").robot;
  const Data data(mj_makeData(model.get()), mj_deleteData);
  EXPECT_LT(largest_deviation(*model, *data, robot), 1e-12) << "as it is drawn";
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> at(-2, 2);
  for (int k = 0; k < 20; ++k) {
    std::for_each(data->qpos, data->qpos + model->nq, [&](mjtNum& position) { position = at(random); });
    EXPECT_LT(largest_deviation(*model, *data, robot), 1e-12);
  }
  for (int j = 0; j < 2; ++j) {
    EXPECT_NEAR(robot.joints[j].lower, model->jnt_range[2 * j], 1e-12);
    EXPECT_NEAR(robot.joints[j].upper, model->jnt_range[2 * j + 1], 1e-12);
  }
}

}  // namespace
}  // namespace prohull::robot
