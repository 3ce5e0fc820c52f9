#include "io/atomic_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include "io_testing.h"

namespace prohull {
namespace {

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  const auto path = folder / "a.txt";
  write_bytes(path, "old");
  {
    AtomicFile file(path);
    file.write("new");
    EXPECT_EQ(read_file(path), "old");
    file.commit();
  }
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, VanishesWhenNotCommitted) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.txt", "old");
  { AtomicFile(folder / "a.txt").write("new"); }
  EXPECT_EQ(read_file(folder / "a.txt"), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, MayHaveTheLongestName) {
  const TemporaryFolder folder;
  const std::string name(255, 'a');
  write_file(folder.path() / name, "new");
  EXPECT_EQ(read_file(folder.path() / name), "new");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, KeepsTheModeOfWhatItReplaces) {
  using std::filesystem::perms;
  const TemporaryFolder folder;
  write_bytes(folder / "a.txt", "old");
  const perms mode = perms::owner_read | perms::owner_write | perms::others_exec;
  std::filesystem::permissions(folder / "a.txt", mode);
  write_file(folder / "a.txt", "new");
  EXPECT_EQ(std::filesystem::status(folder / "a.txt").permissions(), mode);
}

TEST(AtomicFile, WritesWhereALinkLeads) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.txt", "old");
  std::filesystem::create_symlink(folder / "a.txt", folder / "link");
  write_file(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "a.txt"), "new");
}

TEST(AtomicFile, SaysWhyAndWhatToDo) {
  const TemporaryFolder folder;
  const auto expect = [](const std::filesystem::path& path, std::string_view reason) {
    expect_input_error([&] { write_file(path, "x"); }, Defect::CannotWrite,
                       path.string() + ": cannot write: " + std::string(reason));
  };
  expect(folder / "none/a.txt", "No such file or directory; create the folder first");
  expect(folder.path(), "Is a directory; name a file in it");
  if (std::filesystem::is_directory("/proc/self"))
    expect("/proc/self/a.txt", "No such file or directory; this folder takes no files, choose another");
  if (std::filesystem::exists("/dev/full"))
    expect("/dev/full", "No space left on device; make room, or choose another disk");
  if (geteuid() != 0) {
    std::filesystem::permissions(folder.path(),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    expect(folder / "a.txt", "Permission denied; choose a folder that you may write to");
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
  }
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace prohull
