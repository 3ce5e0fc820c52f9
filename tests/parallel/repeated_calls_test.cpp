// Apart from the other tests of parallel/: it has to choose the processors before any thread is made.
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>
#include <vector>

#include "meshes.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_query.h"
#include "prohull/verification.h"

namespace prohull {
namespace {

/// Two processors of those that the process may use, and on them processes that only spin, for as long as this lives.
class BusyMachine {
 public:
  BusyMachine() {
    use_two_processors();
    for (int i = 0; i < kSpinning; ++i) {
      const pid_t child = fork();
      if (child == 0) spin();
      if (child > 0) children_.push_back(child);
    }
  }
  BusyMachine(const BusyMachine&) = delete;
  BusyMachine& operator=(const BusyMachine&) = delete;
  ~BusyMachine() {
    for (const pid_t child : children_) kill(child, SIGKILL), waitpid(child, nullptr, 0);
  }

  bool is_busy() const { return children_.size() == kSpinning; }

 private:
  static constexpr int kSpinning = 16;

  static void use_two_processors() {
    cpu_set_t all, two;
    CPU_ZERO(&all);
    CPU_ZERO(&two);
    sched_getaffinity(0, sizeof all, &all);
    for (unsigned i = 0; i < CPU_SETSIZE && CPU_COUNT(&two) < 2; ++i)
      if (CPU_ISSET(i, &all)) CPU_SET(i, &two);
    sched_setaffinity(0, sizeof two, &two);
  }

  [[noreturn]] static void spin() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    alarm(300);  // at the latest
    for (volatile unsigned turns = 0;;) turns = turns + 1;
  }

  std::vector<pid_t> children_;
};

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t size = 0, resident = 0;
  statm >> size >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(RepeatedCalls, DoNotGrowTheProcessOnABusyMachine) {
  const BusyMachine machine;
  ASSERT_TRUE(machine.is_busy());
  const TriangleMesh mesh = meshes::subdivided(meshes::octahedron());
  const std::vector<Segment> segments(600, Segment{{-2, 0.1, 0.2}, {2, 0.2, 0.1}});
  const auto build_ask_and_verify = [&] {
    const HullResult result = build_hull(mesh, {.target_faces = 30});
    ASSERT_EQ(find_hits(QueryIndex(mesh), segments, HitMode::First).hits.size(), segments.size());
    ASSERT_TRUE(verify_hull(result.hull, mesh).encloses);
  };
  for (int i = 0; i < 50; ++i) build_ask_and_verify();
  const std::size_t before = resident_bytes();
  for (int i = 0; i < 2000; ++i) build_ask_and_verify();
  const std::size_t after = resident_bytes();
  RecordProperty("bytes_more", static_cast<int>(after - before));
  EXPECT_LT(after, before + (std::size_t{2} << 20)) << "of which each call may have 1 KB";
}

}  // namespace
}  // namespace prohull
