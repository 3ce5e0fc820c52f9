#pragma once

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/io_testing.h"
#include "prohull/error.h"
#include "prohull/geometry.h"
#include "robot/files/robot_file.h"
#include "robot/transform.h"

namespace prohull::robot {

/// Writes a file, and the folders above it.
inline void write_file(const std::filesystem::path& path, std::string_view bytes = "x") {
  std::filesystem::create_directories(path.parent_path());
  write_bytes(path, bytes);
}

/// What an environment variable has while the object lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* const old = std::getenv(name)) was_set_ = true, old_ = old;
    setenv(name, value.c_str(), 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { was_set_ ? setenv(name_, old_.c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  bool was_set_ = false;
  std::string old_;
};

/// The message of the InputError that a call throws; "" if it throws none.
template <class Call>
std::string refusal_of(Call call, Defect expected = Defect::Malformed) {
  try {
    call();
  } catch (const InputError& error) {
    EXPECT_EQ(error.defect(), expected) << error.what();
    return error.what();
  }
  return "";
}

/// A collision element with this mesh, and others of these shapes.
inline NewCollision hull_of(const std::string& hull, std::size_t link, std::optional<std::size_t> same_origin_as = {},
                            std::vector<std::size_t> kept = {}) {
  NewCollision collision;
  collision.link = link, collision.hulls = {hull}, collision.same_origin_as = same_origin_as;
  collision.kept = std::move(kept);
  return collision;
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_LT(norm(a - b), tolerance) << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}
inline void expect_near(const Pose& a, const Pose& b, double tolerance = 1e-12) {
  for (std::size_t row = 0; row < 3; ++row) expect_near(a.rotation[row], b.rotation[row], tolerance);
  expect_near(a.translation, b.translation, tolerance);
}

inline bool has(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

}  // namespace prohull::robot
