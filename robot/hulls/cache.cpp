#include "robot/hulls/cache.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "prohull/detail/text.h"

namespace prohull::robot {
namespace {

using nlohmann::json;
using std::filesystem::path;

json json_of(const TriangleMesh& mesh) {
  json positions = json::array(), triangles = json::array();
  for (const Vec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) positions.push_back(p[axis]);
  for (const auto& corners : mesh.triangles)
    for (const VertexId v : corners) triangles.push_back(index(v));
  return {{"positions", positions}, {"triangles", triangles}};
}

/// The mesh of pieces and balls is made of them.
json json_of(const LinkHull& hull) {
  json pieces = json::array(), balls = json::array();
  for (const TriangleMesh& piece : hull.pieces) pieces.push_back(json_of(piece));
  for (const Ball& ball : hull.balls) balls.push_back({ball.center.x, ball.center.y, ball.center.z, ball.radius});
  const bool is_cover = !pieces.empty() || !balls.empty();
  return {{"target_faces", hull.target_faces},
          {"mesh", is_cover ? json() : json_of(hull.mesh)},
          {"pieces", pieces},
          {"balls", balls},
          {"target_reached", hull.target_reached},
          {"within_bounds", hull.within_bounds},
          {"source", hull.source},
          {"padding", hull.padding},
          {"notes", hull.notes.size()}};
}

json json_of(std::span<const LinkHull> hulls) {
  json list = json::array();
  for (const LinkHull& hull : hulls) list.push_back(json_of(hull));
  return {{"hulls", list}};
}

/// What a file of the cache says that is not as keep() writes it. Other such files make nlohmann's accessors throw.
struct Unusable : std::exception {};

const json& list_of(const json& value) { return value.is_array() ? value : throw Unusable(); }

double number_of(const json& value) {
  const auto number = value.get<double>();
  return std::isfinite(number) ? number : throw Unusable();
}

std::size_t count_of(const json& value) {
  return value.is_number_unsigned() ? value.get<std::size_t>() : throw Unusable();
}

/// Empty of pieces and balls.
std::string source_of(const json& value) {
  const auto name = value.get<std::string>();
  return name.empty() || value_of(source_names(), name) ? name : throw Unusable();
}

TriangleMesh mesh_of(const json& mesh) {
  TriangleMesh result;
  const json &positions = list_of(mesh.at("positions")), &triangles = list_of(mesh.at("triangles"));
  if (positions.size() % 3 != 0 || triangles.size() % 3 != 0 || triangles.empty()) throw Unusable();
  for (std::size_t i = 0; i < positions.size(); i += 3)
    result.positions.push_back({number_of(positions[i]), number_of(positions[i + 1]), number_of(positions[i + 2])});
  const auto corner = [&](const json& number) {
    const std::size_t v = count_of(number);
    return v < result.vertex_count() ? VertexId{static_cast<std::uint32_t>(v)} : throw Unusable();
  };
  for (std::size_t i = 0; i < triangles.size(); i += 3)
    result.triangles.push_back({corner(triangles[i]), corner(triangles[i + 1]), corner(triangles[i + 2])});
  return result;
}

Ball ball_of(const json& numbers) {
  if (list_of(numbers).size() != 4) throw Unusable();
  return {{number_of(numbers[0]), number_of(numbers[1]), number_of(numbers[2])}, number_of(numbers[3])};
}

LinkHull hull_of(const json& hull) {
  LinkHull result;
  result.target_faces = count_of(hull.at("target_faces"));
  for (const json& piece : list_of(hull.at("pieces"))) result.pieces.push_back(mesh_of(piece));
  for (const json& ball : list_of(hull.at("balls"))) result.balls.push_back(ball_of(ball));
  const json& mesh = hull.at("mesh");
  if (!mesh.is_null()) result.mesh = mesh_of(mesh);
  result.target_reached = hull.at("target_reached").get<bool>();
  result.within_bounds = hull.at("within_bounds").get<bool>();
  result.source = source_of(hull.at("source"));
  result.padding = number_of(hull.at("padding"));
  if (const std::size_t notes = count_of(hull.at("notes")); notes > 0)
    result.notes.push_back(fmt::format("it is from the cache: {} told only when it is built anew",
                                       counted(notes, "note on its construction is", "notes on its construction are")));
  return result;
}

std::vector<LinkHull> hulls_of(const json& hulls) {
  std::vector<LinkHull> result;
  for (const json& hull : list_of(hulls.at("hulls"))) result.push_back(hull_of(hull));
  return result;
}

std::string fingerprint_of(std::string_view bytes) {
  Fingerprint fingerprint;
  fingerprint.add(bytes);
  return fingerprint.text();
}

constexpr std::size_t kTextSize = 32;  // of Fingerprint::text
constexpr std::string_view kOldSuffix = ".cbor";

bool is_shared_library(const path& file) {
  const std::string name = file.filename().string();
  return name.ends_with(".so") || name.find(".so.") != std::string::npos;
}

/// How long a file of the cache stays that nobody uses; nullopt for a file that is not the cache's own.
std::optional<std::chrono::hours> lifetime(const path& file) {
  const std::string name = file.filename().string();
  if (name.find_first_not_of("0123456789abcdef") != kTextSize) return std::nullopt;
  for (const std::string_view suffix : {HullCache::kHullsSuffix, HullCache::kPictureSuffix, kOldSuffix})
    if (name.substr(kTextSize) == suffix) return std::chrono::hours(24 * 90);
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

std::string text_of(const XXH3_state_t& state) {
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
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

void Fingerprint::add(const TriangleMesh& mesh) {
  const auto add_bytes = [this](const auto& values) {
    add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof *values.data()));
  };
  add_bytes(mesh.positions), add_bytes(mesh.triangles);
}

std::string Fingerprint::text() const { return text_of(*state_); }

std::string hash_of_file(const path& file) {
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::ifstream in(file, std::ios::binary);
  std::array<char, 1 << 16> bytes;
  while (in.read(bytes.data(), bytes.size()), in.gcount() > 0)
    XXH3_128bits_update(state.get(), bytes.data(), static_cast<std::size_t>(in.gcount()));
  return in.eof() ? text_of(*state) : "";
}

bool have_same_bytes(const path& a, const path& b) {
  std::error_code error;
  if (std::filesystem::file_size(a, error) != std::filesystem::file_size(b, error)) return false;
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return first && second && std::equal(Bytes(first), Bytes(), Bytes(second), Bytes());
}

const std::string& program_fingerprint() {
  static const std::string text = [] {
    Dl_info info{};
    const bool known = dladdr(reinterpret_cast<const void*>(&program_fingerprint), &info) != 0 && info.dli_fname;
    const path object = known ? info.dli_fname : "";
    Fingerprint fingerprint;
    fingerprint.add(hash_of_file(is_shared_library(object) ? object : "/proc/self/exe"));
    return fingerprint.text();
  }();
  return text;
}

std::string key_of(const TriangleMesh& triangles, const Budget& budget, const LinkHullOptions& options) {
  Fingerprint key;
  key.add(program_fingerprint());
  key.add(std::size_t(budget.collision)), key.add(budget.pieces), key.add(budget.vertices), key.add(budget.spheres);
  for (const std::size_t faces : budget.faces) key.add(faces);
  key.add(budget.max_distance), key.add(budget.padding);
  key.add(std::size_t(options.tight));
  key.add(triangles);
  return key.text();
}

std::optional<std::string> HullCache::find_content(std::string_view key, std::string_view suffix) const {
  if (folder_.empty()) return std::nullopt;
  const path file = folder_ / fmt::format("{}{}", key, suffix);
  std::ifstream in(file, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (bytes.size() < kTextSize) return std::nullopt;
  if (fingerprint_of(std::string_view(bytes).substr(kTextSize)) != bytes.substr(0, kTextSize)) return std::nullopt;
  std::error_code error;  // the time is not worth a failure
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
  return bytes.erase(0, kTextSize);
}

void HullCache::keep_content(std::string_view key, std::string_view suffix, const std::string& content) const {
  if (folder_.empty()) return;
  static std::atomic<int> count = 0;
  const path beside = folder_ / fmt::format("{}.{}.{}.unfinished", key, getpid(), count++);
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  remove_unused(folder_);
  std::ofstream out(beside, std::ios::binary);
  out << fingerprint_of(content) << content;
  out.close();
  if (out) std::filesystem::rename(beside, folder_ / fmt::format("{}{}", key, suffix), error);
  if (!out || error) std::filesystem::remove(beside, error);
}

std::optional<std::vector<LinkHull>> HullCache::find(std::string_view key) const {
  const std::optional<std::string> content = find_content(key, kHullsSuffix);
  if (!content) return std::nullopt;
  try {
    return hulls_of(json::parse(*content, nullptr, false));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void HullCache::keep(std::string_view key, std::span<const LinkHull> hulls) const {
  keep_content(key, kHullsSuffix, json_of(hulls).dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace prohull::robot
