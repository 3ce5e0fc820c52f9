#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "prohull/mesh_io.h"

namespace prohull::robot {

/// A folder for the files of a test, which vanishes with it.
class RobotFolder {
 public:
  RobotFolder() { std::filesystem::create_directories(path_); }
  RobotFolder(const RobotFolder&) = delete;
  RobotFolder& operator=(const RobotFolder&) = delete;
  ~RobotFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  void add(const std::string& name, const TriangleMesh& mesh) const { write_mesh(path_ / name, mesh); }

 private:
  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) / ("prohull_robot_" + std::to_string(getpid()) + "_" +
                                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace prohull::robot
