#include "prohull/sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "prohull/detail/memory.h"
#include "prohull/detail/refuse.h"
#include "sample/generators.h"

namespace prohull {
namespace {

struct Sample {
  SampleInfo info;
  TriangleMesh (*make)(std::size_t faces);
  double bytes_per_face = 48;  ///< of memory that it takes, measured
};

constexpr std::array kSamples{
    Sample{{"sphere", "geodesic sphere", 0}, make_sphere},
    Sample{{"torus", "torus of revolution", 1}, make_torus},
    Sample{{"knot", "tube along a trefoil knot", 1}, make_knot},
    Sample{{"asteroid", "rough, cratered rock", 0}, make_asteroid},
    Sample{{"box", "box with a square through-hole: planar faces only", 1}, make_box},
    Sample{{"bracket", "machined angle bracket: sharp edges, counterbored holes, a slot", 5}, make_bracket},
    Sample{{"gyroid", "ball of gyroid walls: high genus, hollow all through", 26}, make_gyroid, 130},
    Sample{{"pony", "toy horse: smooth body, thin limbs", 0}, make_pony, 130},
};

constexpr auto kInfos = [] {
  std::array<SampleInfo, kSamples.size()> infos{};
  std::transform(kSamples.begin(), kSamples.end(), infos.begin(), [](const Sample& s) { return s.info; });
  return infos;
}();

constexpr std::size_t kFewestFaces = 4, kMostFaces = std::size_t(1) << 30;

std::string known_names() {
  std::string names;
  for (const SampleInfo& info : kInfos) names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

}  // namespace

std::span<const SampleInfo> samples() { return kInfos; }

TriangleMesh make_sample(std::string_view name, std::size_t faces) {
  const auto sample =
      std::find_if(kSamples.begin(), kSamples.end(), [&](const Sample& s) { return s.info.name == name; });
  if (sample == kSamples.end()) refuse(fmt::format("no sample is called '{}'; there are: {}", name, known_names()));
  if (faces < kFewestFaces || faces > kMostFaces)
    refuse(fmt::format("sample {}: {} faces asked for, expected {} to {}", name, faces, kFewestFaces, kMostFaces));
  require_available(faces, "faces", sample->bytes_per_face);
  return sample->make(faces);
}

}  // namespace prohull
