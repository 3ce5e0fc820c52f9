#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <random>

#include "effort.h"
#include "io/file.h"
#include "meshes.h"
#include "random.h"
#include "readers.h"
#include "robot_folder.h"

namespace prohull::robot {
namespace {

/// A text with some bytes changed, lost or repeated, or with words put in that readers may stumble over.
std::string mutant(std::string text, std::mt19937& random) {
  static constexpr const char* kWords[] = {"-1",  "0",       "1e999", "nan", "4294967296", "18446744073709551616",
                                           "\"",  "null",    "[]",    "{}",  "[[[[",       "]]]]",
                                           "<a>", "</a>",    ">",     "&",   "\n",         ": ",
                                           "- ",  "\xff\xfe"};
  const auto below = [&](std::size_t count) { return random() % count; };
  for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(text.size()), length = 1 + below(std::min<std::size_t>(40, text.size() - at));
    switch (below(4)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.replace(at, below(length), kWords[below(std::size(kWords))]);
    }
  }
  return text;
}

/// The law: mutants are taken or refused, without a crash.
void take_mutants(const std::string& text, const std::function<void(const std::string&)>& take) {
  std::mt19937 random(test_seed());
  take(text);
  for (int round = 0; round < rounds(400); ++round) take(mutant(text, random));
}

TEST(Mutants, OfUrdf) {
  take_mutants(
      "<robot name='r'><material name='m'><texture filename='t.png'/></material><link name='a'><visual>"
      "<origin xyz='0 0 1' rpy='0 1 0'/><geometry><mesh filename='package://p/a.stl' scale='1 1 "
      "1'/></geometry></visual>"
      "<collision><geometry><cylinder radius='1' length='2'/></geometry></collision></link><link name='b'/>"
      "<joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>"
      "<limit lower='0' upper='1'/><mimic joint='j' multiplier='2'/></joint></robot>",
      take_robot);
}

TEST(Mutants, OfSdf) {
  take_mutants(
      "<sdf version='1.9'><model name='m'><frame name='f' attached_to='a'/><link name='a'><pose relative_to='f'>0 0 1 "
      "0 0 "
      "0</pose><visual name='v'><geometry><mesh><uri>model://m/a.stl</uri><scale>1 1 "
      "1</scale></mesh></geometry></visual>"
      "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link><link name='b'/>"
      "<joint name='j' type='prismatic'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz><limit><lower>0</lower>"
      "<upper>1</upper></limit></axis></joint></model></sdf>",
      take_robot);
}

TEST(Mutants, OfMjcf) {
  take_mutants(
      "<mujoco model='m'><compiler angle='radian' meshdir='assets'/><default><default class='v'><geom type='mesh' "
      "contype='0'/></default></default><asset><mesh name='a' file='a.stl' scale='1 1 1'/></asset><worldbody>"
      "<body name='a' pos='0 0 1' euler='0 1 0'><geom class='v' mesh='a'/><geom type='capsule' size='.1 .2'/>"
      "<joint name='j' type='hinge' axis='0 0 1' range='0 1'/><body name='b'><geom type='sphere' size='1'/></body>"
      "</body></worldbody></mujoco>",
      take_robot);
}

TEST(Mutants, OfBudgetsAndSpheres) {
  take_mutants("default: {faces: [500, 100], gap: 2mm}\nlinks:\n  base: {collision: convex, pieces: 12}\n  arm:\n",
               take_yaml);
  take_mutants(sphere_file(std::vector<LinkBalls>{{"base", {{{1, 2, 3}, 0.5}, {{0, 0, 0}, 1}}}, {"arm", {}}}),
               take_yaml);
  take_mutants(sphere_json({"base", {{{1, 2, 3}, 0.5}}}), take_yaml);
}

TEST(Mutants, OfRegions) {
  take_mutants(
      "regions:\n  - {name: lid, box: [[0, 0, 0], [10, 20, 5]], keep: true}\n  - {group: flange, max_distance: 2mm}\n"
      "  - {color: \"#ff8000\", spread: 8, max_distance: 0.5%}\n  - {faces: [0-99, 120], max_distance: 1}\n",
      take_regions);
}

TEST(Mutants, OfKeptHulls) {
  const RobotFolder folder;
  const std::vector<LinkHull> hulls{
      {.target_faces = 8, .mesh = meshes::octahedron(), .source = "mesh", .notes = {"a note"}},
      {.pieces = {meshes::octahedron()}},
      {.balls = {{{0, 0, 0}, 1}}}};
  const std::string key(32, '1');
  HullCache(folder.path()).keep(key, hulls);
  ASSERT_TRUE(HullCache(folder.path()).find(key));
  const std::string bytes = read_file(folder.path() / (key + ".hulls"));
  take_mutants(bytes.substr(32), [&](const std::string& text) { take_kept_hulls(text, folder.path()); });
}

}  // namespace
}  // namespace prohull::robot
