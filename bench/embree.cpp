#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "geometry/closest_point.h"
#include "query_peers.h"

namespace prohull::bench {
namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

constexpr unsigned kAllRays = std::numeric_limits<unsigned>::max();

/// Its filter keeps every hit, and none ends the search.
struct Collecting : RTCIntersectContext {
  Collecting() : RTCIntersectContext{} {
    rtcInitIntersectContext(this);
    filter = &keep;
  }

  static void keep(const RTCFilterFunctionNArguments* arguments) {
    auto& hits = static_cast<Collecting*>(arguments->context)->hits;
    const float t = RTCRayN_tfar(arguments->ray, arguments->N, 0);
    hits.push_back({FaceId(RTCHitN_primID(arguments->hit, arguments->N, 0)), t});
    arguments->valid[0] = 0;
  }

  std::vector<PeerHit> hits;
};

template <std::size_t width>
struct Packet;

template <>
struct Packet<8> {
  using Rays = RTCRay8;
  using RayHits = RTCRayHit8;
  static constexpr auto intersect = &rtcIntersect8;
  static constexpr auto occluded = &rtcOccluded8;
};

template <>
struct Packet<16> {
  using Rays = RTCRay16;
  using RayHits = RTCRayHit16;
  static constexpr auto intersect = &rtcIntersect16;
  static constexpr auto occluded = &rtcOccluded16;
};

template <std::size_t width>
class Packets final : public PeerPackets {
 public:
  Packets(RTCScene scene, std::span<const Segment> segments, bool coherent) : scene_(scene) {
    rtcInitIntersectContext(&context_);
    context_.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (std::size_t first = 0; first < segments.size(); first += width)
      add(segments.subspan(first, std::min(width, segments.size() - first)));
  }

  std::size_t first_hits() override {
    std::size_t count = 0;
    for (const Prepared& p : packets_) {
      typename Packet<width>::RayHits query;
      query.ray = p.rays;
      std::ranges::fill(query.hit.geomID, RTC_INVALID_GEOMETRY_ID);
      Packet<width>::intersect(p.valid, scene_, &context_, &query);
      for (const unsigned geometry : query.hit.geomID) count += geometry != RTC_INVALID_GEOMETRY_ID;
    }
    return count;
  }

  std::size_t any_hits() override {
    std::size_t count = 0;
    for (const Prepared& p : packets_) {
      typename Packet<width>::Rays rays = p.rays;
      Packet<width>::occluded(p.valid, scene_, &context_, &rays);
      for (const float tfar : rays.tfar) count += tfar < 0;
    }
    return count;
  }

 private:
  struct Prepared {
    alignas(64) int valid[width];
    typename Packet<width>::Rays rays;
  };

  void add(std::span<const Segment> segments) {
    Prepared& p = packets_.emplace_back();
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Vec3 &from = segments[i].a, along = segments[i].b - segments[i].a;
      p.valid[i] = -1;
      p.rays.org_x[i] = static_cast<float>(from.x), p.rays.dir_x[i] = static_cast<float>(along.x);
      p.rays.org_y[i] = static_cast<float>(from.y), p.rays.dir_y[i] = static_cast<float>(along.y);
      p.rays.org_z[i] = static_cast<float>(from.z), p.rays.dir_z[i] = static_cast<float>(along.z);
      p.rays.tfar[i] = 1;
      p.rays.mask[i] = kAllRays;
    }
  }

  RTCScene scene_;
  RTCIntersectContext context_;
  std::vector<Prepared> packets_;
};

/// What Embree calls for each face whose box is near enough: the radius shrinks, as in its tutorial closest_point.
struct Nearest {
  const TriangleMesh* mesh;
  Vec3 point;

  static bool see(RTCPointQueryFunctionArguments* arguments) {
    const Nearest& me = *static_cast<const Nearest*>(arguments->userPtr);
    const auto found =
        static_cast<float>(norm(closest_point(me.point, me.mesh->triangle(FaceId(arguments->primID))) - me.point));
    if (!(found < arguments->query->radius)) return false;
    arguments->query->radius = found;
    return true;
  }
};

class Embree final : public QueryPeer {
 public:
  Embree(const TriangleMesh& mesh, bool robust, unsigned threads)
      : mesh_(mesh), robust_(robust), device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())) {
    if (!device_) throw std::runtime_error("Embree does not start");
    rtcSetDeviceMemoryMonitorFunction(device_.get(), &Embree::count_bytes, &bytes_);
    geometry_ = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<std::array<float, 3>*>(rtcSetNewGeometryBuffer(
        geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertex_count()));
    for (const Vec3& p : mesh.positions)
      *corners++ = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    auto* faces = static_cast<std::array<unsigned, 3>*>(rtcSetNewGeometryBuffer(
        geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.face_count()));
    for (const auto& t : mesh.triangles) *faces++ = {index(t[0]), index(t[1]), index(t[2])};
    rtcCommitGeometry(geometry_);
    const std::ptrdiff_t mesh_bytes = bytes_;
    scene_ = scene(RTC_SCENE_FLAG_NONE);
    tree_bytes_ = static_cast<std::size_t>(bytes_ - mesh_bytes);
    rtcInitIntersectContext(&context_);
  }
  ~Embree() override { rtcReleaseGeometry(geometry_); }

  std::optional<PeerHit> first_hit(const Segment& segment) override {
    RTCRayHit query{};
    query.ray = ray(segment.a, segment.b - segment.a, 1);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &context_, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return PeerHit{FaceId(query.hit.primID), query.ray.tfar};
  }

  bool any_hit(const Segment& segment) override {
    RTCRay query = ray(segment.a, segment.b - segment.a, 1);
    rtcOccluded1(scene_.get(), &context_, &query);
    return query.tfar < 0;
  }

  std::span<const PeerHit> all_hits(const Segment& segment) override {
    return all_hits(ray(segment.a, segment.b - segment.a, 1));
  }

  std::optional<bool> contains(const Vec3& point) override {
    return all_hits(ray(point, {1, 0, 0}, std::numeric_limits<float>::infinity())).size() % 2 == 1;
  }

  std::optional<double> distance(const Vec3& point) override {
    RTCPointQuery query{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z), 0,
                        std::numeric_limits<float>::infinity()};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Nearest nearest{&mesh_, point};
    rtcPointQuery(scene_.get(), &query, &context, &Nearest::see, &nearest);
    return query.radius;
  }

  std::unique_ptr<PeerPackets> packets(std::span<const Segment> segments, std::size_t width, bool coherent) override {
    if (width == 8) return std::make_unique<Packets<8>>(scene_.get(), segments, coherent);
    return std::make_unique<Packets<16>>(scene_.get(), segments, coherent);
  }

  std::size_t memory_bytes() const override { return tree_bytes_; }

 private:
  static bool count_bytes(void* sum, ssize_t bytes, bool) {
    *static_cast<std::atomic<std::ptrdiff_t>*>(sum) += bytes;
    return true;
  }

  Owned<RTCScene> scene(RTCSceneFlags flags) {
    Owned<RTCScene> scene(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(flags | (robust_ ? RTC_SCENE_FLAG_ROBUST : 0)));
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    rtcAttachGeometry(scene.get(), geometry_);
    rtcCommitScene(scene.get());
    return scene;
  }

  static RTCRay ray(const Vec3& from, const Vec3& along, float end) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x), ray.dir_x = static_cast<float>(along.x);
    ray.org_y = static_cast<float>(from.y), ray.dir_y = static_cast<float>(along.y);
    ray.org_z = static_cast<float>(from.z), ray.dir_z = static_cast<float>(along.z);
    ray.tfar = end;
    ray.mask = kAllRays;
    return ray;
  }

  // The scene that calls filters is another, so that the first hit does not pay for them. A tree that splits triangles
  // may find one twice.
  std::span<const PeerHit> all_hits(const RTCRay& ray) {
    if (!filtering_scene_) filtering_scene_ = scene(RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    RTCRayHit query{};
    query.ray = ray;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    auto& hits = collecting_.hits;
    hits.clear();
    rtcIntersect1(filtering_scene_.get(), &collecting_, &query);
    std::ranges::sort(hits,
                      [](const PeerHit& a, const PeerHit& b) { return std::tie(a.t, a.face) < std::tie(b.t, b.face); });
    const auto same_face = [](const PeerHit& a, const PeerHit& b) { return a.face == b.face; };
    hits.erase(std::unique(hits.begin(), hits.end(), same_face), hits.end());
    return hits;
  }

  const TriangleMesh& mesh_;
  bool robust_;
  std::atomic<std::ptrdiff_t> bytes_ = 0;
  Owned<RTCDevice> device_;
  RTCGeometry geometry_;
  Owned<RTCScene> scene_, filtering_scene_;
  std::size_t tree_bytes_ = 0;
  RTCIntersectContext context_;
  Collecting collecting_;
};

}  // namespace

std::unique_ptr<QueryPeer> make_embree(const TriangleMesh& mesh, bool robust, unsigned threads) {
  return std::make_unique<Embree>(mesh, robust, threads);
}

}  // namespace prohull::bench
