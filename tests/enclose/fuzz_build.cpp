// Whatever triangles there are and whatever is asked for, enclosing_hull returns a certified hull, which verify_hull
// confirms, or throws InputError. The first bytes choose the options, the scale and the number of vertices; then come
// the vertices, a byte for each coordinate, and the triangles, a byte for each corner.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "prohull/enclosing_hull.h"
#include "prohull/error.h"
#include "prohull/verification.h"

namespace {

using namespace prohull;

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  unsigned byte() { return at_ < end_ ? *at_++ : 0; }
  bool has(std::ptrdiff_t count) const { return end_ - at_ >= count; }

 private:
  const std::uint8_t *at_, *end_;
};

/// Most coordinates are on a coarse grid, where contacts of every kind are frequent.
double coordinate(unsigned byte) { return byte < 224 ? byte % 8 : std::ldexp(byte % 2 ? 1 : -1, byte % 16 - 8); }

TriangleMesh mesh_of(Bytes& bytes, double scale, double place) {
  constexpr std::size_t kMostFaces = 60;
  TriangleMesh mesh;
  const unsigned vertices = 3 + bytes.byte() % 30;
  for (unsigned i = 0; i < vertices; ++i) {
    const double x = coordinate(bytes.byte()), y = coordinate(bytes.byte()), z = coordinate(bytes.byte());
    mesh.positions.push_back(Vec3{x + place, y + place, z + place} * scale);
  }
  const auto corner = [&] { return VertexId(bytes.byte() % vertices); };
  while (bytes.has(3) && mesh.face_count() < kMostFaces) {
    const VertexId a = corner(), b = corner(), c = corner();
    // Four corners make a tetrahedron: few sequences of triangles are closed.
    if (const unsigned kind = bytes.byte(); kind % 4 != 0) {
      const VertexId d = VertexId(kind / 4 % vertices);
      for (const auto& t : {std::array{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}}) mesh.triangles.push_back(t);
    } else {
      mesh.triangles.push_back({a, b, c});
    }
  }
  return mesh;
}

EnclosingOptions options_of(Bytes& bytes) {
  const unsigned first = bytes.byte(), second = bytes.byte();
  EnclosingOptions options;
  options.hull.relax_guards = first & 1;
  options.hull.side = first & 2 ? HullSide::Inner : HullSide::Outer;
  options.tight = first & 4;
  options.hull.float32_coordinates = first & 8;
  options.keep_cavities = first & 16;
  options.levels = (first & 32) && !options.tight;
  if (!options.tight) options.hull.strategy = first & 64 ? Strategy::Paper1 : Strategy::Lazy;
  options.hull.threads = 1;
  if (second % 4 == 1) options.bounds.max_distance = std::ldexp(1.0, static_cast<int>(second / 4 % 8) - 4);
  if (second % 4 == 2) options.bounds.max_void_ratio = std::ldexp(1.0, static_cast<int>(second / 4 % 8) - 4);
  return options;
}

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const EnclosingOptions options = options_of(bytes);
  const std::size_t faces = 4 + bytes.byte() % 32;
  const unsigned scale = bytes.byte(), place = bytes.byte();
  const TriangleMesh mesh = mesh_of(bytes, scale % 2 ? std::ldexp(1.0, static_cast<int>(scale) - 128) : 1,
                                    place % 4 ? 0 : std::ldexp(1.0, static_cast<int>(place / 8)));
  try {
    const EnclosingHull hull = enclosing_hull(mesh, faces, options);
    require(hull.certified, "not certified");
    require(verify_hull(hull.mesh, mesh, options.hull.side).encloses, "verify_hull says no");
  } catch (const InputError& error) {
    require(std::string_view(error.what()).find("report") == std::string_view::npos, error.what());
  }
  return 0;
}
