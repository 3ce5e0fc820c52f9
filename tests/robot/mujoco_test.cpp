#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <array>
#include <fstream>
#include <memory>

#include "io/file.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"
#include "prohull/mesh_query.h"
#include "prohull/sample.h"
#include "random.h"
#include "robot/files/inertial.h"
#include "robot/files/robot_file.h"
#include "robot/motion/kinematics.h"
#include "robot/robot_testing.h"
#include "robot/transform.h"

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
  std::string text_of(const char* name) const { return read_file(folder_ / name); }

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
double largest_deviation(const mjModel& model, mjData& data, const Robot& robot, const std::vector<double>& positions) {
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

/// Likewise, where the positions are those of MuJoCo.
double largest_deviation(const mjModel& model, mjData& data, const Robot& robot) {
  std::vector<double> positions;
  for (const Joint& joint : robot.joints) {
    const int id = mj_name2id(&model, mjOBJ_JOINT, joint.name.c_str());
    positions.push_back(id < 0 ? 0 : data.qpos[model.jnt_qposadr[id]]);
  }
  return largest_deviation(model, data, robot, positions);
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

// The orientations of an element and of its class may be of two kinds.
TEST_F(InMujoco, GeomsAreTurnedAsMujocoTurnsThem) {
  const std::array<std::string, 6> kinds{
      "", "quat='1 2 3 4'", "axisangle='1 2 3 40'", "xyaxes='1 2 3 3 1 2'", "zaxis='1 2 3'", "euler='10 20 30'"};
  std::size_t refused = 0;
  for (const std::string& of_class : kinds)
    for (const std::string& own : kinds) {
      SCOPED_TRACE(of_class + " and " + own);
      write_bytes(folder_ / "arm.xml", "<mujoco><default><geom size='.1 .2' type='capsule' " + of_class +
                                           "/></default><worldbody><body name='a'><geom " + own +
                                           "/></body></worldbody></mujoco>");
      const Model model = load(folder_ / "arm.xml");
      ASSERT_TRUE(model);
      const mjtNum* const q = model->geom_quat;
      try {
        const Pose read = read_robot(folder_ / "arm.xml").robot.links.at(0).visual.at(0).origin;
        const Pose expected = pose_of_quaternion(q[0], q[1], q[2], q[3]);
        for (int row = 0; row < 3; ++row) EXPECT_LT(norm(read.rotation[row] - expected.rotation[row]), 1e-12);
      } catch (const InputError&) {
        ++refused;
      }
    }
  EXPECT_EQ(refused, 6U) << "one of the last four kinds, and a later one of the class, which MuJoCo 3 reads otherwise";
}

TEST_F(InMujoco, HullsStandWhereTheirPartsDoWhateverTheDefaultsSay) {
  write_mesh(folder_ / "part.stl", make_sample("bracket", 300));
  write_bytes(folder_ / "arm.xml",
              "<mujoco><asset><mesh name='m' file='part.stl'/></asset><default><geom euler='10 20 30' pos='1 2 3'/>"
              "</default><worldbody><body name='a'><geom type='mesh' mesh='m' quat='0 1 0 0'/></body></worldbody>"
              "</mujoco>");
  const Pose part = read_robot(folder_ / "arm.xml").robot.links.at(0).visual.at(0).origin;
  prohull("urdf arm.xml --faces 60 --configurations 0 --prove 0 --no-pictures -o made");
  EXPECT_TRUE(load(folder_ / "made/arm.xml"));
  EXPECT_EQ(read_robot(folder_ / "made/arm.xml").robot.links.at(0).collision.at(0).origin, part);
  prohull("urdf arm.xml --collision spheres --spheres 8 --configurations 0 --prove 0 --no-pictures -o balls");
  EXPECT_TRUE(load(folder_ / "balls/arm.xml"));
}

// URDF that became MJCF

/// At random positions, bodies are where the URDF file has its links, and no mimic pulls.
void expect_same_motion(const mjModel& model, const Robot& robot) {
  const Data data(mj_makeData(&model), mj_deleteData);
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<double> at(-2, 2);
  for (int k = 0; k < 20; ++k) {
    std::vector<double> positions;
    for (const Joint& joint : robot.joints)
      positions.push_back(joint.lower == joint.upper ? joint.lower : moves(joint) ? at(random) : 0);
    follow(robot, positions);
    for (std::size_t j = 0; j < robot.joints.size(); ++j)
      if (const int id = mj_name2id(&model, mjOBJ_JOINT, robot.joints[j].name.c_str());
          moves(robot.joints[j]) && id >= 0)
        data->qpos[model.jnt_qposadr[id]] = positions[j];
    EXPECT_LT(largest_deviation(model, *data, robot, positions), 1e-9);
    mj_fwdPosition(&model, data.get());
    for (int row = 0; row < data->ne; ++row) EXPECT_NEAR(data->efc_pos[row], 0, 1e-9);
  }
}

/// The moments about the axes of the body, and the products.
InertiaTensor tensor_of(const mjModel& model, int body) {
  const mjtNum *const q = model.body_iquat + 4 * body, *const moments = model.body_inertia + 3 * body;
  const Pose turn = pose_of_quaternion(q[0], q[1], q[2], q[3]);
  const Pose diagonal{{Vec3{moments[0], 0, 0}, Vec3{0, moments[1], 0}, Vec3{0, 0, moments[2]}}, {}};
  return composed(composed(turn, diagonal), inverse(turn)).rotation;
}

void expect_same_masses(const mjModel& model, const RobotFile& urdf) {
  const XmlDocument document(urdf.text, "test");
  for (const XmlElement* link : document.root().children_called("link")) {
    const int body = mj_name2id(&model, mjOBJ_BODY, link->attribute("name")->c_str());
    const auto inertial = urdf_inertial(document, *link);
    if (!inertial) {
      EXPECT_EQ(model.body_mass[body] > 0, model.body_dofnum[body] > 0) << "MuJoCo asks for the mass of all that moves";
      continue;
    }
    EXPECT_EQ(model.body_mass[body], inertial->mass);
    const Pose turn{inertial->origin.rotation, {}};
    const InertiaTensor expected = composed(composed(turn, {inertial->tensor, {}}), inverse(turn)).rotation,
                        found = tensor_of(model, body);
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR(model.body_ipos[3 * body + row], inertial->origin.translation[row], 1e-12);
      for (int column = 0; column < 3; ++column)
        EXPECT_NEAR(found[row][column], expected[row][column], 1e-9 * norm(expected[row]) + 1e-12);
    }
  }
}

TEST_F(InMujoco, RobotsBecomeMjcf) {
  for (const char* const name : {"gripper", "mobile-base"}) {
    prohull(fmt::format("sample {0} -o {0}", name));
    prohull(fmt::format("urdf {0}/{0}.urdf --to mjcf --faces 60 --configurations 0 --no-pictures -o {0}_made", name));
    const Model model = load(folder_.path() / fmt::format("{0}_made/{0}.xml", name));
    ASSERT_TRUE(model);
    const RobotFile urdf = read_robot(folder_.path() / fmt::format("{0}/{0}.urdf", name));
    expect_same_motion(*model, urdf.robot);
    expect_same_masses(*model, urdf);
    const RobotFile again = read_robot(folder_.path() / fmt::format("{0}_made/{0}.xml", name));
    const Model same = load(again.path);
    expect_same_motion(*same, again.robot);
  }
}

constexpr const char* kJoints = R"(<robot name="r"><material name="red"><color rgba="1 0 0 1"/></material>
<link name="world"><collision><geometry><box size="9 9 1"/></geometry></collision></link>
<link name="base"><inertial><origin xyz="0 0 1" rpy="1 2 3"/><mass value="5"/>
  <inertia ixx="1" iyy="2" izz="2.5" ixy="0.1" ixz="-0.2" iyz="0.3"/></inertial>
  <visual><origin xyz="1 0 0" rpy="0 1 0"/><geometry><box size="1 2 3"/></geometry><material name="red"/></visual></link>
<link name="turning"><inertial><origin rpy="0 0 1"/><mass value="1"/><inertia ixx="1" iyy="1" izz="2"/></inertial></link>
<link name="sliding"><visual><geometry><sphere radius="1"/></geometry></visual></link>
<link name="tool"><inertial><origin xyz="1 0 0"/><mass value="2"/><inertia ixx="1" iyy="1" izz="1"/></inertial>
  <collision><geometry><capsule radius="1" length="2"/></geometry></collision></link>
<link name="plane"><collision><geometry><cylinder radius="1" length="1"/></geometry></collision></link>
<link name="flying"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="5"/></inertial></link>
<link name="held"/><link name="nothing"/><link name="follower"><inertial><mass value="1"/></inertial></link>
<joint name="f" type="floating"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>
<joint name="t" type="continuous"><parent link="base"/><child link="turning"/><origin xyz="1 2 3" rpy="1 2 3"/>
  <axis xyz="1 2 3"/><dynamics damping="0.5" friction="0.25"/></joint>
<joint name="s" type="prismatic"><parent link="turning"/><child link="sliding"/><origin rpy="1 0 0"/><axis xyz="0 1 1"/>
  <limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
<joint name="x" type="fixed"><parent link="sliding"/><child link="tool"/><origin xyz="1 1 1" rpy="0 0 1"/></joint>
<joint name="p" type="planar"><parent link="tool"/><child link="plane"/><axis xyz="1 0 1"/></joint>
<joint name="n" type="floating"><parent link="plane"/><child link="flying"/><origin xyz="0 1 0"/></joint>
<joint name="h" type="revolute"><parent link="base"/><child link="held"/><axis xyz="0 0 1"/>
  <limit lower="0.5" upper="0.5" effort="1" velocity="1"/></joint>
<joint name="e" type="continuous"><parent link="held"/><child link="nothing"/></joint>
<joint name="m" type="revolute"><parent link="held"/><child link="follower"/><axis xyz="0 1 0"/>
  <limit lower="-9" upper="9" effort="1" velocity="1"/><mimic joint="t" multiplier="-2" offset="0.5"/></joint>
</robot>)";

TEST_F(InMujoco, JointsOfAllTypesBecomeMjcf) {
  write_bytes(folder_ / "r.urdf", kJoints);
  prohull("urdf r.urdf --to mjcf --configurations 0 --no-pictures -o made");
  const std::string said = text_of("out");
  for (const char* const note :
       {"not in it: effort limits, velocity limits", "equal limits are fixed there: h",
        "no mass weigh what MuJoCo computes from their collision geometry: plane",
        "weigh 1 g, as MuJoCo refuses none: nothing", "the mean of their diagonal: flying, follower"})
    EXPECT_NE(said.find(note), std::string::npos) << note << "\n" << said;
  const Model model = load(folder_ / "made/r.xml");
  ASSERT_TRUE(model);
  const RobotFile urdf = read_robot(folder_ / "r.urdf");
  expect_same_motion(*model, urdf.robot);
  const auto body = [&](const char* name) { return mj_name2id(model.get(), mjOBJ_BODY, name); };
  const auto joint = [&](const char* name) { return mj_name2id(model.get(), mjOBJ_JOINT, name); };
  EXPECT_EQ(model->jnt_type[joint("f")], mjJNT_FREE);
  EXPECT_EQ(model->jnt_type[joint("n")], mjJNT_BALL);
  EXPECT_EQ(model->jnt_type[joint("p_TX")], mjJNT_SLIDE);
  EXPECT_EQ(model->jnt_limited[joint("t")], 0);
  EXPECT_EQ(model->jnt_limited[joint("s")], 1);
  EXPECT_EQ(model->jnt_range[2 * joint("s") + 1], 2);
  const int dof = model->jnt_dofadr[joint("t")];
  EXPECT_EQ(model->dof_damping[dof], 0.5);
  EXPECT_EQ(model->dof_frictionloss[dof], 0.25);
  EXPECT_EQ(joint("h"), -1);
  EXPECT_EQ(model->body_mass[body("sliding")], 2) << "that of the tool, which is fixed to it";
  EXPECT_EQ(model->body_mass[body("tool")], 0);
  EXPECT_NEAR(model->body_ipos[3 * body("sliding")], 1 + std::cos(1), 1e-12);
  EXPECT_NEAR(model->body_mass[body("plane")], 1000 * std::acos(-1), 1e-6);
  EXPECT_EQ(model->body_mass[0], 0);
  EXPECT_NEAR(model->body_inertia[3 * body("flying")], 7. / 3, 1e-12);
  const InertiaTensor flat = tensor_of(*model, body("turning"));
  EXPECT_NEAR(flat[2].z, 2, 1e-8) << "moments of a plate are kept";
  const int seen = model->body_geomadr[body("base")];
  EXPECT_EQ(model->geom_group[seen], 2);
  EXPECT_EQ(model->geom_rgba[4 * seen + 1], 0);
  EXPECT_EQ(model->geom_contype[seen], 0);
  EXPECT_EQ(model->geom_size[3 * seen + 2], 1.5);
  EXPECT_EQ(model->geom_group[model->body_geomadr[body("tool")]], 3);
}

}  // namespace
}  // namespace prohull::robot
