#include "robot/hulls/cache.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace prohull::robot {
namespace {

using nlohmann::json;
using std::filesystem::path;

json json_of(const Vec3& p) { return {p.x, p.y, p.z}; }
Vec3 point_of(const json& p) { return {p.at(0), p.at(1), p.at(2)}; }

json json_of(const TriangleMesh& mesh) {
  json positions = json::array(), triangles = json::array();
  for (const Vec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) positions.push_back(p[axis]);
  for (const auto& corners : mesh.triangles)
    for (const VertexId v : corners) triangles.push_back(index(v));
  return {{"positions", positions}, {"triangles", triangles}};
}

TriangleMesh mesh_of(const json& mesh) {
  TriangleMesh result;
  const json &positions = mesh.at("positions"), &triangles = mesh.at("triangles");
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
    result.positions.push_back({positions[i], positions[i + 1], positions[i + 2]});
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    result.triangles.push_back({VertexId{triangles[i]}, VertexId{triangles[i + 1]}, VertexId{triangles[i + 2]}});
  return result;
}

/// The mesh of pieces and balls is made of them.
json json_of(const LinkHull& hull) {
  json pieces = json::array(), balls = json::array();
  for (const TriangleMesh& piece : hull.pieces) pieces.push_back(json_of(piece));
  for (const Ball& ball : hull.balls) balls.push_back({json_of(ball.center), ball.radius});
  const bool is_cover = !pieces.empty() || !balls.empty();
  return {{"target_faces", hull.target_faces},
          {"mesh", is_cover ? json() : json_of(hull.mesh)},
          {"pieces", pieces},
          {"balls", balls},
          {"certified", hull.certified},
          {"proof", hull.proof},
          {"target_reached", hull.target_reached},
          {"within_bounds", hull.within_bounds},
          {"source", hull.source},
          {"volume", hull.volume},
          {"distance", {hull.distance.lower, hull.distance.upper, json_of(hull.distance.farthest)}},
          {"padding", hull.padding},
          {"self_intersections", hull.self_intersections},
          {"notes", hull.notes}};
}

LinkHull hull_of(const json& hull) {
  LinkHull result;
  hull.at("target_faces").get_to(result.target_faces);
  for (const json& piece : hull.at("pieces")) result.pieces.push_back(mesh_of(piece));
  for (const json& ball : hull.at("balls")) result.balls.push_back({point_of(ball.at(0)), ball.at(1)});
  const json& mesh = hull.at("mesh");
  result.mesh = mesh.is_null() ? robot::mesh_of(result.pieces, result.balls) : mesh_of(mesh);
  hull.at("certified").get_to(result.certified);
  hull.at("proof").get_to(result.proof);
  hull.at("target_reached").get_to(result.target_reached);
  hull.at("within_bounds").get_to(result.within_bounds);
  hull.at("source").get_to(result.source);
  hull.at("volume").get_to(result.volume);
  const json& distance = hull.at("distance");
  result.distance = {distance.at(0), distance.at(1), point_of(distance.at(2))};
  hull.at("padding").get_to(result.padding);
  hull.at("self_intersections").get_to(result.self_intersections);
  hull.at("notes").get_to(result.notes);
  return result;
}

json json_of(const LinkHulls& hulls) {
  json list = json::array();
  for (const LinkHull& hull : hulls.hulls) list.push_back(json_of(hull));
  return {{"hulls", list},
          {"sealed_volume", hulls.sealed_volume},
          {"convex_volume", hulls.convex_volume},
          {"repairs", hulls.repairs}};
}

LinkHulls hulls_of(const json& hulls) {
  LinkHulls result;
  result.status = LinkStatus::Hulled;
  for (const json& hull : hulls.at("hulls")) result.hulls.push_back(hull_of(hull));
  hulls.at("sealed_volume").get_to(result.sealed_volume);
  hulls.at("convex_volume").get_to(result.convex_volume);
  hulls.at("repairs").get_to(result.repairs);
  result.from_cache = true;
  return result;
}

std::string fingerprint_of(std::string_view bytes) {
  Fingerprint fingerprint;
  fingerprint.add(bytes);
  return fingerprint.text();
}

/// A glTF file has its coordinates in other files.
bool names_other_files(const path& mesh) { return mesh.extension() == ".gltf" || mesh.extension() == ".GLTF"; }

constexpr std::size_t kTextSize = 32;  // of Fingerprint::text

bool is_shared_library(const path& file) {
  const std::string name = file.filename().string();
  return name.ends_with(".so") || name.find(".so.") != std::string::npos;
}

/// How long a file of the cache stays that nobody uses; nullopt for a file that is not the cache's own.
std::optional<std::chrono::hours> lifetime(const path& file) {
  const std::string name = file.filename().string();
  if (name.find_first_not_of("0123456789abcdef") != kTextSize) return std::nullopt;
  if (name.substr(kTextSize) == ".cbor") return std::chrono::hours(24 * 90);
  if (name.ends_with(".unfinished")) return std::chrono::hours(1);
  return std::nullopt;
}

void remove_unused(const path& folder) {
  const auto now = std::filesystem::file_time_type::clock::now();
  std::error_code error;
  for (std::filesystem::directory_iterator file(folder, error), end; !error && file != end; file.increment(error)) {
    std::error_code gone;  // another run may have removed it
    const auto used = file->last_write_time(gone);
    const auto longest = lifetime(file->path());
    if (!gone && longest && now - used > *longest) std::filesystem::remove(file->path(), gone);
  }
}

}  // namespace

Fingerprint::Fingerprint() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }

void Fingerprint::add(std::string_view bytes) {
  const std::uint64_t size = bytes.size();
  XXH3_128bits_update(state_.get(), &size, sizeof size);
  XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

void Fingerprint::add(double number) { add(std::string_view(reinterpret_cast<const char*>(&number), sizeof number)); }
void Fingerprint::add(std::size_t number) { XXH3_128bits_update(state_.get(), &number, sizeof number); }

void Fingerprint::add(const Pose& pose) {
  for (const Vec3& row : pose.rotation)
    for (int axis = 0; axis < 3; ++axis) add(row[axis]);
  for (int axis = 0; axis < 3; ++axis) add(pose.translation[axis]);
}

void Fingerprint::add(const TriangleMesh& mesh) {
  const auto add_bytes = [this](const auto& values) {
    add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof *values.data()));
  };
  add_bytes(mesh.positions), add_bytes(mesh.triangles);
}

void Fingerprint::add_file(const path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 1 << 16> bytes;
  std::size_t all = 0;
  while (in.read(bytes.data(), bytes.size()), in.gcount() > 0) {
    const auto count = static_cast<std::size_t>(in.gcount());
    XXH3_128bits_update(state_.get(), bytes.data(), count), all += count;
  }
  add(all), add(std::size_t(in.eof()));
}

std::string Fingerprint::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

const std::string& program_fingerprint() {
  static const std::string text = [] {
    Dl_info info{};
    const bool known = dladdr(reinterpret_cast<const void*>(&program_fingerprint), &info) != 0 && info.dli_fname;
    const path object = known ? info.dli_fname : "";
    Fingerprint fingerprint;
    fingerprint.add_file(is_shared_library(object) ? object : "/proc/self/exe");
    return fingerprint.text();
  }();
  return text;
}

std::string key_of(const Link& link, const Budget& budget, const LinkHullOptions& options) {
  Fingerprint key;
  key.add(program_fingerprint());
  key.add(std::size_t(budget.collision)), key.add(budget.pieces), key.add(budget.vertices), key.add(budget.spheres);
  for (const std::size_t faces : budget.faces) key.add(faces);
  key.add(budget.max_distance), key.add(budget.padding);
  key.add(std::size_t(options.tight)), key.add(options.format);
  for (const Shape& shape : shapes(link, options.from)) {
    key.add(shape.origin);
    key.add(shape.form.index());
    if (const MeshFile* const mesh = shape.mesh()) {
      for (int axis = 0; axis < 3; ++axis) key.add(mesh->scale[axis]);
      if (names_other_files(mesh->path))
        key.add(mesh_triangles(*mesh));
      else
        key.add_file(mesh->path);
      key.add(mesh->path.extension().string());
    } else if (!std::holds_alternative<OtherForm>(shape.form)) {
      key.add(form_mesh(shape.form, Curved::Around));
    }
  }
  return key.text();
}

std::optional<LinkHulls> HullCache::find(std::string_view key) const {
  if (folder_.empty()) return std::nullopt;
  const path file = folder_ / fmt::format("{}.cbor", key);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (bytes.size() < kTextSize) return std::nullopt;
  const std::string_view content = std::string_view(bytes).substr(kTextSize);
  if (fingerprint_of(content) != bytes.substr(0, kTextSize)) return std::nullopt;
  std::error_code error;  // the time is not worth a failure
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
  return hulls_of(json::from_cbor(content));
}

void HullCache::keep(std::string_view key, const LinkHulls& hulls) const {
  if (folder_.empty()) return;
  static std::atomic<int> count = 0;
  const std::vector<std::uint8_t> content = json::to_cbor(json_of(hulls));
  const std::string_view bytes(reinterpret_cast<const char*>(content.data()), content.size());
  const path beside = folder_ / fmt::format("{}.{}.{}.unfinished", key, getpid(), count++);
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  remove_unused(folder_);
  std::ofstream out(beside, std::ios::binary);
  out << fingerprint_of(bytes) << bytes;
  out.close();
  if (out) std::filesystem::rename(beside, folder_ / fmt::format("{}.cbor", key), error);
  if (!out || error) std::filesystem::remove(beside, error);
}

}  // namespace prohull::robot
