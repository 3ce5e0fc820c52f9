#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <map>

#include "io/file.h"
#include "robot/robot_testing.h"

namespace prohull::robot {
namespace {

namespace fs = std::filesystem;

// Of docs/guides/robots.md, in which the number of files stands beside each: what the message says, the words there.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kReasons{{
    {"the program xacro is not installed", "xacro, where its program is not installed"},
    {"no robot: its root is", "other XML: parts that others include, packages, SRDF"},
    {"the model has no <body>", "MJCF without a body: scenes, floors, flexible bodies"},
    {"the robot has no links", "URDF without a rigid link: soft bodies, macros alone"},
    {"coordinate='global'", "MJCF of before 2.3.3, with global coordinates"},
    {"expected three numbers", "four numbers where three belong"},
    {"where a number was expected", "text in the place of a number"},
    {"unknown type", "a type of joint that MJCF does not have"},
    {"", "text that is no XML, a link that does not exist"},
}};

/// Descriptions that developers have, without their meshes; a file is refused only for what its author would accept.
TEST(Descriptions, OpenOrAreRefusedForTheReasonsInTheDocs) {
  const fs::path archive = fs::path(PROHULL_SHARED_ROBOTS) / "descriptions.tar.xz";
  if (!fs::exists(archive)) GTEST_SKIP() << archive << " does not exist";
  const TemporaryFolder folder;
  const std::string unpack = fmt::format("tar -xf '{}' -C '{}'", archive.string(), folder.path().string());
  ASSERT_EQ(std::system(unpack.c_str()), 0) << unpack;
  const Variable no_xacro("PATH", "/nonexistent");
  std::size_t opened = 0;
  std::map<std::string_view, std::size_t> refused;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path())) {
    if (!entry.is_regular_file()) continue;
    try {
      read_robot(entry.path());
      ++opened;
    } catch (const InputError& error) {
      const auto reason =
          std::ranges::find_if(kReasons, [&](const auto& each) { return has(error.what(), each.first); });
      ++refused[reason->second];
    }
  }
  const std::string docs = read_file(PROHULL_ROBOTS_GUIDE);
  EXPECT_TRUE(has(docs, fmt::format("| opened | {},{:03} |", opened / 1000, opened % 1000))) << opened;
  for (const auto& [words, count] : refused)
    EXPECT_TRUE(has(docs, fmt::format("| {} | {} |", words, count))) << words << ": " << count;
}

}  // namespace
}  // namespace prohull::robot
