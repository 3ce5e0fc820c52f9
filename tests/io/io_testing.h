#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "input_error.h"
#include "io/file.h"
#include "prohull/error.h"
#include "prohull/mesh_io.h"

namespace prohull {

/// Vanishes with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = std::filesystem::temp_directory_path() / "prohull_test_XXXXXX";
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  std::filesystem::path operator/(const char* name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

inline void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Appends the bytes of a value as this machine has them.
template <class T>
std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

inline TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{VertexId(0), VertexId(2), VertexId(1)},
           {VertexId(0), VertexId(1), VertexId(3)},
           {VertexId(1), VertexId(2), VertexId(3)},
           {VertexId(0), VertexId(3), VertexId(2)}}};
}

inline std::array<VertexId, 3> corners(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return {VertexId(a), VertexId(b), VertexId(c)};
}

template <class Action>
void expect_input_error(Action action, Defect defect, std::string_view message) {
  const InputError error = error_of(action);
  EXPECT_EQ(std::string_view(error.what()), message);
  EXPECT_EQ(error.defect(), defect) << error.what();
}

inline void expect_refused(std::string_view content, const char* name, std::string_view message,
                           Defect defect = Defect::Malformed) {
  expect_input_error([&] { read_mesh(content, name); }, defect, message);
}

}  // namespace prohull
