#include <embree3/rtcore.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "query_peers.h"

namespace prohull::bench {
namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

class Embree final : public QueryPeer {
 public:
  Embree(const TriangleMesh& mesh, bool robust) : device_(rtcNewDevice("threads=1")) {
    if (!device_) throw std::runtime_error("Embree does not start");
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<std::array<float, 3>*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertex_count()));
    for (const Vec3& p : mesh.positions)
      *corners++ = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    auto* faces = static_cast<std::array<unsigned, 3>*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.face_count()));
    for (const auto& t : mesh.triangles) *faces++ = {index(t[0]), index(t[1]), index(t[2])};
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
    rtcInitIntersectContext(&context_);
  }

  std::optional<PeerHit> first_hit(const Segment& segment) override {
    RTCRayHit query{};
    query.ray = ray(segment);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &context_, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return PeerHit{FaceId(query.hit.primID), query.ray.tfar};
  }

  bool any_hit(const Segment& segment) override {
    RTCRay query = ray(segment);
    rtcOccluded1(scene_.get(), &context_, &query);
    return query.tfar < 0;
  }

  std::optional<std::size_t> all_hits(const Segment&) override { return std::nullopt; }

 private:
  static RTCRay ray(const Segment& s) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(s.a.x), ray.org_y = static_cast<float>(s.a.y), ray.org_z = static_cast<float>(s.a.z);
    ray.dir_x = static_cast<float>(s.b.x - s.a.x), ray.dir_y = static_cast<float>(s.b.y - s.a.y),
    ray.dir_z = static_cast<float>(s.b.z - s.a.z);
    ray.tfar = 1;
    ray.mask = std::numeric_limits<unsigned>::max();
    return ray;
  }

  Owned<RTCDevice> device_;
  Owned<RTCScene> scene_;
  RTCIntersectContext context_;
};

}  // namespace

std::unique_ptr<QueryPeer> make_embree(const TriangleMesh& mesh, bool robust) {
  return std::make_unique<Embree>(mesh, robust);
}

}  // namespace prohull::bench
