// Whatever bytes a file has, read_segments and its like return queries that can be asked, or throw InputError. The
// first byte chooses the name of the file and the kind of query, the rest is its content.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "prohull/detail/query_io.h"
#include "prohull/error.h"

namespace {

using namespace prohull;

constexpr std::array<const char*, 4> kNames = {"fuzz.npy", "fuzz.npz", "fuzz.csv", "fuzz"};

void require(bool condition) {
  if (!condition) std::abort();
}

void read(unsigned kind, std::string_view content, const char* name) {
  if (kind == 0)
    for (const Segment& s : read_segments(content, name)) require(is_finite(s.a) && is_finite(s.b) && s.a != s.b);
  else if (kind == 1)
    for (const Ray& r : read_rays(content, name))
      require(is_finite(r.origin) && is_finite(r.direction) && r.direction != Vec3{});
  else if (kind == 2)
    for (const Pose& pose : read_poses(content, name)) require_rigid(pose);
  else if (kind == 3)
    for (const Vec3& p : read_points(content, name)) require(is_finite(p));
  else
    for (const Triangle& t : read_triangles(content, name)) require(is_finite(t.a) && is_finite(t.b) && is_finite(t.c));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr unsigned kKinds = 5;
  try {
    read(data[0] % kKinds, content, kNames[data[0] / kKinds % kNames.size()]);
  } catch (const InputError&) {
  }
  return 0;
}
