#include "prohull/detail/memory.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "io/available_memory.h"
#include "io_testing.h"
#include "prohull/sample.h"

namespace prohull {
namespace {

/// A folder with files as the system has them.
class System {
 public:
  System& has(const char* file, const std::string& content) {
    std::filesystem::create_directories(path(file).parent_path());
    std::ofstream(path(file)) << content;
    return *this;
  }
  std::optional<std::size_t> available() const { return available_memory(folder_ / ""); }
  std::filesystem::path path(const char* file) const { return folder_ / file; }

 private:
  TemporaryFolder folder_;
};

const std::string kMemory = "MemTotal:       1000 kB\nMemFree:  1 kB\nMemAvailable:    800 kB\n";

TEST(AvailableMemory, IsUnknownWhereTheSystemSaysNothing) {
  EXPECT_EQ(System().has("proc/version", "").available(), std::nullopt);
}

TEST(AvailableMemory, IsWhatTheMachineHas) {
  EXPECT_EQ(System().has("proc/meminfo", kMemory).available(), 800u * 1024);
}

TEST(AvailableMemory, IsWhatTheControlGroupAndThoseAroundItLeave) {
  System system;
  system.has("proc/meminfo", kMemory).has("proc/self/cgroup", "0::/outer/inner\n");
  EXPECT_EQ(system.available(), 800u * 1024);
  system.has("sys/fs/cgroup/outer/inner/memory.max", "max\n").has("sys/fs/cgroup/outer/inner/memory.current", "5\n");
  EXPECT_EQ(system.available(), 800u * 1024);
  system.has("sys/fs/cgroup/outer/memory.max", "70000\n").has("sys/fs/cgroup/outer/memory.current", "50000\n");
  EXPECT_EQ(system.available(), 20000u);
  system.has("sys/fs/cgroup/outer/memory.stat", "anon 1\ninactive_file 30000\n");
  EXPECT_EQ(system.available(), 50000u);
  system.has("sys/fs/cgroup/memory.max", "100\n").has("sys/fs/cgroup/memory.current", "300\n");
  EXPECT_EQ(system.available(), 0u);
}

TEST(AvailableMemory, KnowsControlGroupsOfTheFirstVersion) {
  System system;
  system.has("proc/meminfo", kMemory).has("proc/self/cgroup", "9:cpu:/a\n4:memory:/a\n");
  system.has("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "9000")
      .has("sys/fs/cgroup/memory/a/memory.usage_in_bytes", "2000");
  EXPECT_EQ(system.available(), 7000u);
}

TEST(MemoryNeed, IsKnownFromTheBeginningOfTheFile) {
  const System folder;
  const TriangleMesh mesh = make_sample("sphere", 3000);
  for (const char* const name : {"a.ply", "a.stl"}) {
    const std::filesystem::path file = folder.path(name);
    TriangleMesh rounded = mesh;
    for (Vec3& p : rounded.positions) p = {float(p.x), float(p.y), float(p.z)};
    write_mesh(file, rounded);
    const MemoryNeed need = memory_need(file, 100);
    EXPECT_EQ(need.faces, mesh.face_count()) << name;
    EXPECT_EQ(need.file, std::filesystem::file_size(file)) << name;
    EXPECT_NEAR(double(need.mesh), double(24 * mesh.vertex_count() + 12 * mesh.face_count()), 100) << name;
    EXPECT_EQ(need.work, 100 * mesh.face_count()) << name;
    EXPECT_EQ(need.sum(), need.mesh + std::max(need.file, need.work)) << name;
    EXPECT_NO_THROW(require_memory(file, 100)) << name;
  }
}

TEST(MemoryNeed, IsAtMostWhatTextHasRoomFor) {
  System folder;
  folder.has("claims.ply",
             "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n");
  EXPECT_LT(memory_need(folder.path("claims.ply")).sum(), 10'000u);
  const TriangleMesh mesh = make_sample("sphere", 3000);
  write_mesh(folder.path("a.obj"), mesh);
  EXPECT_LE(memory_need(folder.path("a.obj")).faces, mesh.face_count());
}

TEST(MemoryNeed, IsRefusedWithTheSumBeforeTheFileIsRead) {
  System folder;
  folder.has("scan.stl", std::string(84, ' '));
  std::filesystem::resize_file(folder.path("scan.stl"), std::uintmax_t{84} + 50 * std::uintmax_t{1'000'000'000});
  if (!available_memory() || *available_memory() > 200e9) GTEST_SKIP() << "this computer has room for it";
  try {
    read_mesh(folder.path("scan.stl"));
    FAIL() << "it was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.defect(), Defect::CannotRead);
    EXPECT_NE(std::string(error.what())
                  .find("scan.stl: a mesh of 1,000,000,000 faces needs 74.0 GB of memory (50.0 GB "
                        "for the file, 24.0 GB for the mesh), but "),
              std::string::npos)
        << error.what();
  }
}

TEST(MemoryNeed, OfWhatIsAskedForIsRefusedBeforeItIsMade) {
  EXPECT_NO_THROW(require_available(1000, "faces", 1));
  if (!available_memory()) GTEST_SKIP() << "the system does not say what memory there is";
  try {
    require_available(1'000'000'000, "faces", 48e6);  // more than any computer has
    FAIL() << "it would be made";
  } catch (const InputError& error) {
    EXPECT_EQ(error.defect(), Defect::InvalidOption);
    EXPECT_TRUE(
        std::string_view(error.what()).starts_with("1,000,000,000 faces need about 48000000.0 GB of memory, but "))
        << error.what();
  }
}

TEST(MemoryNeed, OfWhatIsNoFileIsLeftToTheReader) { EXPECT_NO_THROW(require_memory("/no/such/mesh.ply")); }

}  // namespace
}  // namespace prohull
