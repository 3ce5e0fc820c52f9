#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <vector>

#include "io/affine.h"
#include "io/byte_cursor.h"
#include "io/file.h"
#include "io/file_content.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/number_type.h"
#include "prohull/detail/base64.h"
#include "prohull/detail/percents.h"

// Sections are those of the glTF 2.0 specification (Khronos, 2021).

namespace prohull {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kGlbMagic = "glTF";
constexpr std::size_t kGlbHeader = 12, kChunkHeader = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// Of a normalized integer (3.11): f = max(c / 127, -1) and its like.
double normalized(double value, NumberType type) {
  const int bits = static_cast<int>(8 * size_of(type));
  const bool has_sign = type == NumberType::Int8 || type == NumberType::Int16;
  return std::max(value / (std::ldexp(1, has_sign ? bits - 1 : bits) - 1), -1.0);
}

/// Numbers in a buffer: `count` elements of `components` each.
struct Elements {
  std::string_view bytes;
  std::size_t count, stride, components;
  NumberType type;
  bool normalize;

  double operator()(std::size_t element, std::size_t component) const {
    ByteCursor cursor(bytes, element * stride + component * size_of(type));
    const double value = read_number(cursor, type);
    return normalize ? normalized(value, type) : value;
  }
};

/// What of a file the reader looks at: JSON, and the binary chunk of a GLB (4.4).
struct Chunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

class GltfReader {
 public:
  GltfReader(std::string_view content, const std::string& file, const ReadOptions& options)
      : file_(file), alone_(options.alone), content_size_(content.size()), builder_(file, 0, content, options) {
    const Chunks chunks = content.starts_with(kGlbMagic) ? chunks_of(content) : Chunks{content, {}};
    binary_ = chunks.binary;
    parse(chunks.json);
  }

  TriangleMesh read() {
    check_version();
    check_extensions();
    visited_.resize(items("nodes").size());
    buffers_.resize(items("buffers").size());
    for (const std::size_t node : root_nodes()) add_tree(node);
    return builder_.finish();
  }

 private:
  struct PlacedNode {
    std::size_t number;
    Affine place;  ///< of the parent
  };

  [[noreturn]] void fail_in(std::string_view where, std::string_view message) const {
    fail(file_, kNowhere, fmt::format("{}: {}", where, message));
  }

  // --- JSON ---

  Chunks chunks_of(std::string_view content) const {
    const auto fail_at_end = [&](std::string_view what) {
      fail(file_, {Place::Unit::Byte, content.size()}, fmt::format("the file ends within {}; it is truncated", what));
    };
    if (content.size() < kGlbHeader + kChunkHeader) fail_at_end("the header of a GLB");
    ByteCursor cursor(content, kGlbMagic.size());
    if (const auto version = cursor.read<std::uint32_t>(); version != 2)
      fail(file_, {Place::Unit::Byte, 4},
           fmt::format("it has version {} of GLB, and only 2 is read; export as glTF 2.0", version));
    cursor.skip(sizeof(std::uint32_t));  // the length of all, which chunks tell better
    Chunks chunks;
    for (std::size_t i = 0; i < 2 && cursor.has(1, kChunkHeader); ++i) {
      const std::size_t length = cursor.read<std::uint32_t>();
      const auto type = cursor.read<std::uint32_t>();
      if (i == 0 && type != kJsonChunk)
        fail(file_, {Place::Unit::Byte, kGlbHeader}, "the first chunk of the GLB is not JSON");
      if (!cursor.has(length, 1)) fail_at_end(i == 0 ? "the JSON chunk" : "the binary chunk");
      const std::string_view bytes = content.substr(cursor.place().number, length);
      if (type == kJsonChunk) chunks.json = bytes.substr(0, bytes.find_last_not_of('\0') + 1);
      if (type == kBinaryChunk) chunks.binary = bytes;
      cursor.skip(length);
    }
    return chunks;
  }

  void parse(std::string_view text) {
    try {
      json_ = Json::parse(text);
    } catch (const Json::parse_error& error) {
      const std::size_t offset = binary_ || text.size() != content_size_ ? kGlbHeader + kChunkHeader : 0;
      fail(file_, {Place::Unit::Byte, offset + std::max<std::size_t>(error.byte, 1) - 1},
           "what should be JSON is not; the file is truncated or no glTF");
    } catch (const Json::out_of_range&) {
      fail_in("the JSON", "it has a number beyond the range of a double (1.8e308)");
    }
    if (!json_.is_object()) fail_in("the JSON", "not an object; the file is no glTF");
  }

  /// A value of an object, null if it has none of that name. Not a copy, as Json::value would make, which overflows the
  /// stack where values are nested a hundred thousand deep.
  static const Json& value(const Json& object, const char* name) {
    static const Json null;
    const auto found = object.find(name);
    return found == object.end() ? null : *found;
  }

  /// The array of the document with that name, empty if there is none.
  const Json& items(const char* name) const { return array(json_, name, "the document"); }

  const Json& array(const Json& object, const char* name, std::string_view where) const {
    static const Json none = Json::array();
    const auto found = object.find(name);
    if (found == object.end()) return none;
    if (!found->is_array()) fail_in(where, fmt::format("{} is not an array", name));
    return *found;
  }

  const Json& item(const char* name, std::size_t number, std::string_view where) const {
    const Json& all = items(name);
    if (number >= all.size())
      fail_in(where, fmt::format("there is no number {} in {}, which has {}", number, name, all.size()));
    return checked_object(all[number], fmt::format("{} {}", name, number));
  }

  const Json& checked_object(const Json& value, std::string_view where) const {
    if (!value.is_object()) fail_in(where, "not an object");
    return value;
  }

  std::optional<std::size_t> optional_count(const Json& object, const char* name, std::string_view where) const {
    const auto found = object.find(name);
    if (found == object.end()) return {};
    return count(*found, name, where);
  }

  std::size_t count(const Json& value, const char* name, std::string_view where) const {
    constexpr double kMost = 9007199254740992;  // 2^53: all that JSON's numbers keep
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number <= kMost) || number != std::floor(number))
      fail_in(where, fmt::format("{} is not a whole number of 0 or more", name));
    return static_cast<std::size_t>(number);
  }

  std::size_t required_count(const Json& object, const char* name, std::string_view where) const {
    if (const auto number = optional_count(object, name, where)) return *number;
    fail_in(where, fmt::format("{} is missing", name));
  }

  // --- document ---

  void check_version() const {
    const Json& asset = value(json_, "asset");
    const bool has = asset.is_object() && value(asset, "version").is_string();
    const std::string version = has ? value(asset, "version").get<std::string>() : "";
    if (!version.starts_with("2."))
      fail_in("asset",
              has ? fmt::format("it has version {} of glTF, and only 2 is read; export as glTF 2.0", in_quotes(version))
                  : "it has no version; the file is no glTF 2.0");
  }

  /// An extension that a file requires may change what its geometry means: those that cannot are let pass.
  void check_extensions() const {
    for (const Json& name : array(json_, "extensionsRequired", "the document")) {
      const std::string extension = name.is_string() ? name.get<std::string>() : "";
      const auto starts = [&](std::string_view prefix) { return extension.starts_with(prefix); };
      if (extension == "KHR_mesh_quantization" || starts("KHR_materials_") || starts("KHR_texture_") ||
          starts("EXT_texture_") || starts("KHR_lights_"))
        continue;
      fail_in("extensionsRequired",
              fmt::format("{} is not read; export without it{}", in_quotes(extension),
                          extension.find("compression") != std::string::npos ? ", that is without compression" : ""));
    }
  }

  /// Of the scene to be shown (3.5.1); without scenes, those that are no children.
  std::vector<std::size_t> root_nodes() const {
    if (!items("scenes").empty()) {
      const std::size_t number = optional_count(json_, "scene", "the document").value_or(0);
      const std::string where = fmt::format("scenes {}", number);
      return node_numbers(item("scenes", number, "scene"), "nodes", where);
    }
    std::vector<bool> is_child(items("nodes").size());
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      const std::string where = fmt::format("nodes {}", i);
      for (const std::size_t child : node_numbers(item("nodes", i, where), "children", where))
        if (child < is_child.size()) is_child[child] = true;
    }
    std::vector<std::size_t> roots(is_child.size());
    std::iota(roots.begin(), roots.end(), std::size_t{0});
    std::erase_if(roots, [&](std::size_t node) { return is_child[node]; });
    return roots;
  }

  std::vector<std::size_t> node_numbers(const Json& object, const char* name, std::string_view where) const {
    std::vector<std::size_t> numbers;
    for (const Json& number : array(object, name, where)) numbers.push_back(count(number, name, where));
    return numbers;
  }

  /// Depth first, in the order of the file.
  void add_tree(std::size_t root) {
    std::vector<PlacedNode> left = {{root, {}}};
    while (!left.empty()) {
      const PlacedNode placed = left.back();
      left.pop_back();
      const std::string where = fmt::format("nodes {}", placed.number);
      const Json& node = item("nodes", placed.number, "the tree of nodes");
      if (visited_[placed.number])
        fail_in(where, "it has two parents or is below itself; the nodes of a scene must be a tree");
      visited_[placed.number] = true;
      if (node.contains("extensions") && node["extensions"].contains("EXT_mesh_gpu_instancing"))
        fail_in(where, "instances by EXT_mesh_gpu_instancing are not read; export them as nodes");
      const Affine place = placed.place * local_place(node, where);
      if (const auto mesh = optional_count(node, "mesh", where)) add_mesh(*mesh, place);
      const std::vector<std::size_t> children = node_numbers(node, "children", where);
      for (auto child = children.rbegin(); child != children.rend(); ++child) left.push_back({*child, place});
    }
  }

  // --- nodes (3.5.3) ---

  template <std::size_t N>
  std::optional<std::array<double, N>> numbers(const Json& object, const char* name, std::string_view where) const {
    const auto found = object.find(name);
    if (found == object.end()) return {};
    std::array<double, N> values;
    if (!found->is_array() || found->size() != N) fail_in(where, fmt::format("{} must have {} numbers", name, N));
    for (std::size_t i = 0; i < N; ++i) {
      if (!(*found)[i].is_number()) fail_in(where, fmt::format("{} must have {} numbers", name, N));
      values[i] = (*found)[i].template get<double>();
    }
    return values;
  }

  Affine local_place(const Json& node, std::string_view where) const {
    if (const auto m = numbers<16>(node, "matrix", where)) {
      for (const char* other : {"translation", "rotation", "scale"})
        if (node.contains(other))
          fail_in(where, fmt::format("it has a matrix and a {}; keep the matrix alone, or what it is made of", other));
      if ((*m)[3] != 0 || (*m)[7] != 0 || (*m)[11] != 0 || (*m)[15] != 1)
        fail_in(where, fmt::format("the last row of its matrix is {}, {}, {}, {}; it must be 0, 0, 0, 1", (*m)[3],
                                   (*m)[7], (*m)[11], (*m)[15]));
      return {{(*m)[0], (*m)[1], (*m)[2]},
              {(*m)[4], (*m)[5], (*m)[6]},
              {(*m)[8], (*m)[9], (*m)[10]},
              {(*m)[12], (*m)[13], (*m)[14]}};
    }
    const auto t = numbers<3>(node, "translation", where).value_or(std::array{0.0, 0.0, 0.0});
    const auto q = numbers<4>(node, "rotation", where).value_or(std::array{0.0, 0.0, 0.0, 1.0});
    const auto s = numbers<3>(node, "scale", where).value_or(std::array{1.0, 1.0, 1.0});
    const auto [x, y, z, w] = q;
    if (q == std::array{0.0, 0.0, 0.0, 0.0})
      fail_in(where, "its rotation is 0, 0, 0, 0, which is none; 0, 0, 0, 1 turns nothing");
    return {s[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            s[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            s[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
            {t[0], t[1], t[2]}};
  }

  // --- meshes (3.7) ---

  void add_mesh(std::size_t number, const Affine& place) {
    const Json& mesh = item("meshes", number, "mesh of a node");
    std::map<std::size_t, std::size_t> first_vertex_of;  // of accessors: primitives may share their positions
    const Json& primitives = array(mesh, "primitives", fmt::format("meshes {}", number));
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const std::string where = fmt::format("meshes {}, primitive {}", number, i);
      const Json& primitive = checked_object(primitives[i], where);
      check_growth(sizeof(Json));  // so that many nodes with a mesh of many empty primitives end soon
      constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;
      const std::size_t mode = optional_count(primitive, "mode", where).value_or(kTriangles);
      if (mode > kFan) fail_in(where, fmt::format("mode {}; 0 to 6 are known", mode));
      if (mode < kTriangles) continue;  // points and lines
      const std::size_t accessor = position_accessor(primitive, where);
      const std::size_t vertices = required_count(item("accessors", accessor, where), "count", where);
      const auto [known, is_new] = first_vertex_of.try_emplace(accessor, builder_.vertex_count());
      if (is_new) add_vertices(accessor, place);
      std::vector<std::int64_t> corners = corners_of(primitive, vertices, where);
      for (std::int64_t& corner : corners) corner += static_cast<std::int64_t>(known->second);
      check_growth(corners.size() * sizeof(std::uint32_t));
      add_triangles(corners, mode == kStrip, mode == kFan, place.mirrors(), where);
    }
  }

  std::size_t position_accessor(const Json& primitive, std::string_view where) const {
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object()) fail_in(where, "it has no attributes");
    return required_count(*attributes, "POSITION", where);
  }

  void add_vertices(std::size_t accessor, const Affine& place) {
    const std::string where = fmt::format("accessors {}", accessor);
    const Elements positions = elements(accessor, "VEC3", where);
    if (positions.type == NumberType::UInt32) fail_in(where, "positions are floats, or integers of 8 or 16 bits");
    check_growth(positions.count * sizeof(Vec3));
    std::vector<Vec3> points(positions.count);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {positions(i, 0), positions(i, 1), positions(i, 2)};
    replace_sparse(accessor, points, where);
    for (const Vec3& point : points) builder_.add_vertex(place(point), kNowhere);
  }

  /// 3.6.2.3: a few elements that are not where the others are.
  void replace_sparse(std::size_t accessor, std::vector<Vec3>& points, const std::string& accessor_name) const {
    const Json& whole = item("accessors", accessor, accessor_name);
    const auto found = whole.find("sparse");
    if (found == whole.end()) return;
    const std::string where = accessor_name + ", sparse";
    const Json& sparse = checked_object(*found, where);
    const std::size_t count = required_count(sparse, "count", where);
    const auto part = [&](const char* name, NumberType type, std::size_t components, bool normalize) {
      const auto values = sparse.find(name);
      if (values == sparse.end()) fail_in(where, fmt::format("{} is missing", name));
      return elements_in(checked_object(*values, where), type, components, count, normalize, where);
    };
    if (!sparse.contains("indices") || !sparse["indices"].is_object()) fail_in(where, "indices is missing");
    const Elements places = part("indices", component_type(sparse["indices"], where), 1, false);
    const Elements values = part("values", component_type(whole, where), 3, is_normalized(whole));
    for (std::size_t i = 0; i < count; ++i) {
      const double index = places(i, 0);
      if (!(index >= 0 && index < static_cast<double>(points.size())))
        fail_in(where, fmt::format("index {} of {} elements", index, points.size()));
      points[static_cast<std::size_t>(index)] = {values(i, 0), values(i, 1), values(i, 2)};
    }
  }

  std::vector<std::int64_t> corners_of(const Json& primitive, std::size_t vertices, const std::string& where) const {
    const auto accessor = optional_count(primitive, "indices", where);
    if (!accessor) {
      std::vector<std::int64_t> corners(vertices);
      std::iota(corners.begin(), corners.end(), 0);
      return corners;
    }
    const std::string name = fmt::format("accessors {}", *accessor);
    const Elements indices = elements(*accessor, "SCALAR", name);
    if (indices.type != NumberType::UInt8 && indices.type != NumberType::UInt16 && indices.type != NumberType::UInt32)
      fail_in(name, "indices are unsigned integers of 8, 16 or 32 bits");
    if (item("accessors", *accessor, where).contains("sparse")) fail_in(name, "sparse indices are not read");
    std::vector<std::int64_t> corners(indices.count);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      corners[i] = static_cast<std::int64_t>(indices(i, 0));
      if (corners[i] >= static_cast<std::int64_t>(vertices))
        fail_in(where,
                fmt::format("its index {} is {}, but it has {} vertices, counted from 0", i, corners[i], vertices));
    }
    return corners;
  }

  /// 3.7.2.1: triangles p0 p1 p2 | p3 p4 p5; strips, of which every other triangle is turned; fans.
  void add_triangles(const std::vector<std::int64_t>& corners, bool strip, bool fan, bool reversed,
                     std::string_view where) {
    if (!strip && !fan && corners.size() % 3 != 0)
      fail_in(where, fmt::format("{} corners, which is no multiple of 3", corners.size()));
    for (std::size_t i = 0; i + 2 < corners.size(); i += strip || fan ? 1 : 3) {
      std::array<std::int64_t, 3> triangle = {corners[fan ? 0 : i], corners[i + 1], corners[i + 2]};
      if ((strip && i % 2 == 1) != reversed) std::swap(triangle[1], triangle[2]);
      const auto [a, b, c] = triangle;
      if (strip && (a == b || b == c || c == a)) continue;  // leads from one part of a strip to the next
      builder_.add_polygon(triangle, kNowhere);
    }
  }

  // --- accessors, views, buffers (3.6) ---

  /// 3.6.2.2
  NumberType component_type(const Json& object, std::string_view where) const {
    const std::size_t type = required_count(object, "componentType", where);
    if (type < 5120 || type > 5126 || type == 5124) fail_in(where, fmt::format("componentType {} is unknown", type));
    constexpr std::array kTypes{NumberType::Int8,   NumberType::UInt8,  NumberType::Int16,  NumberType::UInt16,
                                NumberType::UInt32, NumberType::UInt32, NumberType::Float32};
    return kTypes[type - 5120];
  }

  static bool is_normalized(const Json& accessor) { return value(accessor, "normalized") == true; }

  Elements elements(std::size_t number, const char* type, const std::string& where) const {
    const Json& accessor = item("accessors", number, where);
    if (value(accessor, "type") != type) fail_in(where, fmt::format("its type is not {}", type));
    const NumberType component = component_type(accessor, where);
    const std::size_t components = std::string_view(type) == "VEC3" ? 3 : 1;
    const std::size_t count_of_all = required_count(accessor, "count", where);
    if (accessor.contains("bufferView"))
      return elements_in(accessor, component, components, count_of_all, is_normalized(accessor), where);
    if (!accessor.contains("sparse")) fail_in(where, "it has no bufferView, that is, no data");
    static constexpr std::array<char, 3 * sizeof(float)> kZero{};  // 3.6.2.3: each element is this one
    return {{kZero.data(), kZero.size()}, count_of_all, 0, components, component, false};
  }

  /// What `object`, an accessor or a part of a sparse one, points to, which is checked to be there.
  Elements elements_in(const Json& object, NumberType type, std::size_t components, std::size_t count, bool normalize,
                       const std::string& where) const {
    const std::size_t view_number = required_count(object, "bufferView", where);
    const Json& view = item("bufferViews", view_number, where);
    const std::string view_name = fmt::format("bufferViews {}", view_number);
    const std::size_t size = components * size_of(type);
    const std::size_t stride = optional_count(view, "byteStride", view_name).value_or(size);
    const std::size_t offset = optional_count(object, "byteOffset", where).value_or(0);
    std::string_view bytes = view_bytes(view, view_name);
    const bool fits =
        offset <= bytes.size() &&
        (count == 0 || (bytes.size() - offset >= size &&
                        (count == 1 || (stride >= size && (count - 1) <= (bytes.size() - offset - size) / stride))));
    if (!fits)
      fail_in(where, fmt::format("{} elements of {} bytes, {} apart from byte {}, are not in {}, which has {} bytes",
                                 count, size, stride, offset, view_name, bytes.size()));
    return {bytes.substr(offset), count, stride, components, type, normalize};
  }

  std::string_view view_bytes(const Json& view, const std::string& where) const {
    const std::string_view buffer = buffer_bytes(required_count(view, "buffer", where), where);
    const std::size_t offset = optional_count(view, "byteOffset", where).value_or(0);
    const std::size_t length = required_count(view, "byteLength", where);
    if (offset > buffer.size() || length > buffer.size() - offset)
      fail_in(where, fmt::format("bytes {} to {} of a buffer that has {}", offset, offset + length, buffer.size()));
    return buffer.substr(offset, length);
  }

  std::string_view buffer_bytes(std::size_t number, std::string_view where) const {
    const Json& buffer = item("buffers", number, where);
    const std::string name = fmt::format("buffers {}", number);
    const auto uri = buffer.find("uri");
    if (uri == buffer.end()) {
      if (number != 0 || !binary_) fail_in(name, "it has no data: neither a uri nor the binary chunk of a GLB");
      return *binary_;
    }
    if (!uri->is_string()) fail_in(name, "its uri is not a string");
    std::optional<std::string>& bytes = buffers_[number];
    if (!bytes) bytes = bytes_of(uri->get_ref<const std::string&>(), name);
    return *bytes;
  }

  std::string bytes_of(const std::string& uri, const std::string& where) const {
    if (uri.starts_with("data:")) {
      const std::size_t comma = uri.find(";base64,");
      auto bytes = comma == uri.npos ? std::nullopt : from_base64(std::string_view(uri).substr(comma + 8));
      if (!bytes) fail_in(where, "its data is not base64");
      return std::move(*bytes);
    }
    if (uri.find("://") != uri.npos)
      fail_in(where, fmt::format("{} is not a file beside this one; download it, or export as GLB", in_quotes(uri)));
    if (alone_)
      throw InputError(Defect::CannotRead,
                       fmt::format("{}: {}: its data is in {}, which --no-outside-files refuses; export as GLB", file_,
                                   where, in_quotes(uri)));
    const std::filesystem::path path = std::filesystem::path(file_).parent_path() / without_percents(uri);
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))  // a pipe or a device may have no end
      throw InputError(
          Defect::CannotRead,
          fmt::format("{}: {}: {}, or export as GLB", file_, where,
                      is_in_archive() ? fmt::format("{} holds its data, and of an archive only one file is "
                                                    "read; extract all of it",
                                                    in_quotes(uri))
                                      : fmt::format("there is no regular file {}, which holds its data; "
                                                    "put it there",
                                                    path.string())));
    std::string bytes = read_file(path);
    content_size_ += bytes.size();
    return bytes;
  }

  /// The name is then "archive.zip/part.gltf".
  bool is_in_archive() const {
    std::error_code error;
    std::filesystem::path folder = std::filesystem::path(file_).parent_path();
    while (folder.has_relative_path() && !std::filesystem::exists(folder, error)) folder = folder.parent_path();
    return std::filesystem::is_regular_file(folder, error);
  }

  /// Few bytes can place a mesh many times: what comes out is limited like what comes out of compressed files.
  void check_growth(std::size_t bytes) {
    grown_ += bytes;
    if (const std::size_t limit = decompression_limit(content_size_); grown_ > limit)
      fail(file_, kNowhere,
           fmt::format("its instances hold more than {} bytes, though the file has only {}; export as PLY if that is "
                       "right",
                       limit, content_size_));
  }

  const std::string& file_;
  const bool alone_;
  mutable std::size_t content_size_;  ///< with the buffers in other files
  std::size_t grown_ = 0;
  MeshBuilder builder_;
  Json json_;
  std::optional<std::string_view> binary_;
  mutable std::vector<std::optional<std::string>> buffers_;  ///< read when first asked for
  std::vector<bool> visited_;
};

}  // namespace

bool is_glb(std::string_view content) { return content.starts_with(kGlbMagic); }

TriangleMesh read_gltf(std::string_view content, const std::string& file, const ReadOptions& options) {
  return GltfReader(content, file, options).read();
}

}  // namespace prohull
