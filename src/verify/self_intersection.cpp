#include "verify/self_intersection.h"

#include <algorithm>

#include "geometry/triangle_intersection.h"

namespace prohull::verify {

std::vector<std::pair<FaceIndex, FaceIndex>> self_intersections(const Surface& surface) {
  std::vector<std::pair<FaceIndex, FaceIndex>> pairs;
  for (FaceIndex f = 0; f < surface.faces.size(); ++f) {
    const Box box = box_of(surface.faces[f]);
    surface.bvh.visit([&](const Box& other) { return box.overlaps(other); },
                      [&](FaceIndex g) {
                        if (f < g && triangles_intersect(surface.faces[f], surface.faces[g])) pairs.emplace_back(f, g);
                      });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace prohull::verify
