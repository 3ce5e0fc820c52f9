#include <cstring>
#include <nlohmann/json.hpp>

#include "compressing.h"
#include "io_testing.h"
#include "prohull/detail/base64.h"

namespace prohull {
namespace {

using Json = nlohmann::json;

/// Four float positions, and twelve indices of 16 bits behind them.
std::string tetrahedron_bytes() {
  const TriangleMesh mesh = tetrahedron();
  std::string bytes;
  for (const Vec3& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) bytes += bytes_of(static_cast<float>(p[axis]));
  for (const auto& t : mesh.triangles)
    for (const VertexId v : t) bytes += bytes_of(static_cast<std::uint16_t>(index(v)));
  return bytes;
}

std::string data_uri(std::string_view bytes) { return "data:application/octet-stream;base64," + to_base64(bytes); }

/// One tetrahedron, in a buffer that is embedded.
Json tetrahedron_json() {
  Json json = Json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
    "buffers": [{"byteLength": 72}]})");
  json["buffers"][0]["uri"] = data_uri(tetrahedron_bytes());
  return json;
}

/// Four bytes each for two positions and more; a strip, a fan or a list of `indices` of 8 bits.
Json small_json(int mode, const std::vector<std::uint8_t>& indices) {
  Json json = tetrahedron_json();
  const std::string bytes = tetrahedron_bytes().substr(0, 48) + std::string(indices.begin(), indices.end());
  json["buffers"][0]["uri"] = data_uri(bytes);
  json["bufferViews"][1]["byteLength"] = indices.size();
  json["accessors"][1]["componentType"] = 5121;
  json["accessors"][1]["count"] = indices.size();
  json["meshes"][0]["primitives"][0]["mode"] = mode;
  return json;
}

TriangleMesh read(const Json& json) { return read_mesh(json.dump(), "a.gltf"); }

void expect_document_refused(const Json& json, std::string_view message) {
  expect_refused(json.dump(), "a.gltf", std::string("a.gltf: ") + std::string(message));
}

std::string glb(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

TEST(Gltf, IsReadFromEmbeddedExternalAndBinaryBuffers) {
  const TemporaryFolder folder;
  Json json = tetrahedron_json();
  EXPECT_EQ(read(json), tetrahedron());
  EXPECT_EQ(read_mesh(gzipped(json.dump()), "a.gltf.gz"), tetrahedron());
  json["buffers"][0]["uri"] = "with%20blank.bin";
  write_bytes(folder / "a.gltf", json.dump());
  write_bytes(folder / "with blank.bin", tetrahedron_bytes());
  EXPECT_EQ(read_mesh(folder / "a.gltf"), tetrahedron());
  json["buffers"][0].erase("uri");
  const std::string binary = glb(json.dump(), tetrahedron_bytes());
  EXPECT_EQ(read_mesh(binary, "a.glb"), tetrahedron());
  EXPECT_EQ(read_mesh(binary, "a"), tetrahedron());
  EXPECT_EQ(read_mesh(zipped({{"a.glb", binary}, {"texture.png", "x"}}), "a.zip"), tetrahedron());
}

TEST(Gltf, StandsAloneIfItHasTo) {
  const TemporaryFolder folder;
  Json json = tetrahedron_json();
  EXPECT_EQ(read_mesh(json.dump(), "a.gltf", {.alone = true}), tetrahedron());
  const std::filesystem::path other = folder / "other.bin";
  write_bytes(other, tetrahedron_bytes());
  json["buffers"][0]["uri"] = other.string();
  for (const auto& [content, name] : {std::pair{json.dump(), "a.gltf"},
                                      {glb(json.dump(), ""), "a.glb"},
                                      {zipped({{"a.gltf", json.dump()}}), "a.obj"}}) {
    EXPECT_EQ(read_mesh(content, name), tetrahedron()) << name;
    try {
      read_mesh(content, name, {.alone = true});
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.defect(), Defect::CannotRead) << name;
      EXPECT_NE(std::string(error.what()).find("other.bin', which --no-outside-files refuses"), std::string::npos)
          << error.what();
    }
  }
}

TEST(Gltf, PlacesEachInstance) {
  Json json = tetrahedron_json();
  json["scenes"][0]["nodes"] = {0, 2};
  json["nodes"] = Json::parse(R"([
    {"translation": [10, 20, 30], "rotation": [0, 0, 1, 0], "scale": [2, 4, 8], "children": [1]},
    {"mesh": 0, "translation": [1, 1, 1]},
    {"mesh": 0, "matrix": [0, 1, 0, 0,  -1, 0, 0, 0,  0, 0, 1, 0,  5, 6, 7, 1]}])");
  const TriangleMesh mesh = read(json);
  const PerVertex<Vec3> expected = {{8, 16, 38}, {6, 16, 38}, {8, 12, 38}, {8, 16, 46},  // half a turn around z
                                    {5, 6, 7},   {5, 7, 7},   {4, 6, 7},   {5, 6, 8}};   // a quarter
  EXPECT_EQ(mesh.positions, expected);
  ASSERT_EQ(mesh.face_count(), 8u);
  EXPECT_EQ(mesh.triangles[FaceId(4)], corners(4, 6, 5));
}

TEST(Gltf, TurnsMirroredInstances) {
  Json json = tetrahedron_json();
  json["nodes"][0]["scale"] = {1, -1, 1};
  const TriangleMesh mesh = read(json);
  EXPECT_EQ(mesh.positions[VertexId(2)], (Vec3{0, -1, 0}));
  EXPECT_EQ(signed_volume(mesh), signed_volume(tetrahedron()));
  json["nodes"][0]["scale"] = {-1, -1, 1};
  EXPECT_EQ(read(json).triangles, tetrahedron().triangles);
  json["nodes"][0]["scale"] = {-1e-120, 1e-120, 1e-120};
  EXPECT_NE(read(json).triangles, tetrahedron().triangles);
}

TEST(Gltf, KeepsEveryBitWhereNothingIsPlacedElsewhere) {
  Json json = tetrahedron_json();
  std::string bytes = tetrahedron_bytes();
  bytes.replace(0, 4, bytes_of(-0.0f));
  json["buffers"][0]["uri"] = data_uri(bytes);
  json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_TRUE(std::signbit(read(json).positions[VertexId(0)].x));
}

TEST(Gltf, ReadsListsStripsAndFansAndSkipsLines) {
  EXPECT_EQ(read(small_json(4, {0, 1, 2, 2, 1, 3})).triangles.size(), 2u);
  const TriangleMesh strip = read(small_json(5, {0, 1, 2, 3, 3, 1}));
  EXPECT_EQ(strip.triangles, (PerFace<std::array<VertexId, 3>>{corners(0, 1, 2), corners(1, 3, 2)}));
  const TriangleMesh fan = read(small_json(6, {0, 1, 2, 3}));
  EXPECT_EQ(fan.triangles, (PerFace<std::array<VertexId, 3>>{corners(0, 1, 2), corners(0, 2, 3)}));
  for (const int mode : {0, 1, 2, 3}) EXPECT_EQ(read(small_json(mode, {0, 1, 2})), TriangleMesh());
  Json no_indices = small_json(5, {});
  no_indices["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_EQ(read(no_indices).triangles, (PerFace<std::array<VertexId, 3>>{corners(0, 1, 2), corners(1, 3, 2)}));
}

TEST(Gltf, PrimitivesOfAMeshMayShareTheirPositions) {
  Json json = tetrahedron_json();
  json["meshes"][0]["primitives"].push_back(json["meshes"][0]["primitives"][0]);
  const TriangleMesh mesh = read(json);
  EXPECT_EQ(mesh.vertex_count(), 4u);
  EXPECT_EQ(mesh.face_count(), 8u);
}

TEST(Gltf, PositionsWithSparseValuesAloneAreZeroElsewhere) {
  Json json = tetrahedron_json();
  json["accessors"][0].erase("bufferView");
  expect_document_refused(json, "accessors 0: it has no bufferView, that is, no data");
  std::string bytes = tetrahedron_bytes();
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", 1}});
  bytes += '\2';
  json["buffers"][0] = {{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}};
  json["accessors"][0]["sparse"] =
      Json::parse(R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5121}, "values": {"bufferView": 0}})");
  const TriangleMesh mesh = read(json);
  for (const VertexId v : mesh.positions.ids())
    EXPECT_EQ(mesh.positions[v], index(v) == 2 ? tetrahedron().positions[VertexId(0)] : Vec3{}) << index(v);
}

TEST(Gltf, ReadsQuantizedInterleavedAndSparsePositions) {
  Json json = tetrahedron_json();
  json["extensionsRequired"] = {"KHR_mesh_quantization"};
  std::string bytes;
  for (const std::int16_t c : {0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0})
    bytes += bytes_of(c);  // the fourth of each vertex is none of its coordinates
  bytes += std::string(16, '\0') + tetrahedron_bytes().substr(48);
  json["buffers"][0]["uri"] = data_uri(bytes);
  json["bufferViews"][0]["byteStride"] = 8;
  json["accessors"][0]["componentType"] = 5122;
  json["accessors"][0]["normalized"] = true;
  EXPECT_EQ(read(json).positions, (PerVertex<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}));
  json["accessors"][0]["normalized"] = false;
  EXPECT_EQ(read(json).positions[VertexId(3)], (Vec3{0, 0, -32768}));

  json = tetrahedron_json();
  bytes = tetrahedron_bytes() + bytes_of(std::uint32_t{3});
  for (const float c : {7.f, 8.f, 9.f}) bytes += bytes_of(c);
  json["buffers"][0]["uri"] = data_uri(bytes);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 16}});
  json["accessors"][0]["sparse"] = Json::parse(
      R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5125}, "values": {"bufferView": 2, "byteOffset": 4}})");
  EXPECT_EQ(read(json).positions[VertexId(3)], (Vec3{7, 8, 9}));
  json["accessors"][0]["sparse"]["count"] = 2;
  expect_document_refused(
      json,
      "accessors 0, sparse: 2 elements of 12 bytes, 12 apart from byte 4, are not in bufferViews 2, which "
      "has 16 bytes");
}

TEST(Gltf, HasTheNodesOfItsSceneOnly) {
  Json json = tetrahedron_json();
  json["nodes"] = Json::parse(R"([{"mesh": 0}, {"children": [0]}, {"mesh": 0}])");
  json["scenes"] = Json::parse(R"([{"nodes": [1]}, {}, {"nodes": [1, 2]}])");
  EXPECT_EQ(read(json).face_count(), 4u);
  json["scene"] = 1;
  EXPECT_EQ(read(json), TriangleMesh());
  json["scene"] = 2;
  EXPECT_EQ(read(json).face_count(), 8u);
  json.erase("scene");
  json.erase("scenes");
  EXPECT_EQ(read(json).face_count(), 8u);
}

TEST(Gltf, ThatPointsElsewhereIsAnError) {
  const auto changed = [](const char* pointer, const Json& value) {
    Json json = tetrahedron_json();
    json[Json::json_pointer(pointer)] = value;
    return json;
  };
  expect_document_refused(
      changed("/accessors/0/count", 5),
      "accessors 0: 5 elements of 12 bytes, 12 apart from byte 0, are not in bufferViews 0, which has 48 "
      "bytes");
  expect_document_refused(
      changed("/accessors/0/count", 4000000000u),
      "accessors 0: 4000000000 elements of 12 bytes, 12 apart from byte 0, are not in bufferViews 0, which "
      "has 48 bytes");
  expect_document_refused(changed("/accessors/0/count", -1),
                          "meshes 0, primitive 0: count is not a whole number of 0 or more");
  expect_document_refused(changed("/accessors/0/byteOffset", 1e300),
                          "accessors 0: byteOffset is not a whole number of 0 or more");
  expect_document_refused(
      changed("/accessors/0/byteOffset", 49),
      "accessors 0: 4 elements of 12 bytes, 12 apart from byte 49, are not in bufferViews 0, which has 48 "
      "bytes");
  expect_document_refused(changed("/accessors/0/bufferView", 2),
                          "accessors 0: there is no number 2 in bufferViews, which has 2");
  expect_document_refused(changed("/accessors/0/type", "VEC2"), "accessors 0: its type is not VEC3");
  expect_document_refused(changed("/accessors/1/componentType", 5124), "accessors 1: componentType 5124 is unknown");
  expect_document_refused(changed("/accessors/1/componentType", 5122),
                          "accessors 1: indices are unsigned integers of 8, 16 or 32 bits");
  expect_document_refused(changed("/accessors/1/count", 11),
                          "meshes 0, primitive 0: 11 corners, which is no multiple of 3");
  expect_document_refused(changed("/accessors/1/bufferView", 0),
                          "meshes 0, primitive 0: its index 7 is 16256, but it has 4 vertices, counted from 0");
  expect_document_refused(changed("/bufferViews/0/byteLength", 80),
                          "bufferViews 0: bytes 0 to 80 of a buffer that has 72");
  expect_document_refused(
      changed("/bufferViews/0/byteStride", 4),
      "accessors 0: 4 elements of 12 bytes, 4 apart from byte 0, are not in bufferViews 0, which has 48 "
      "bytes");
  expect_document_refused(changed("/buffers/0/uri", "data:;base64,A?"), "buffers 0: its data is not base64");
  expect_document_refused(
      changed("/buffers/0/uri", "https://example.org/a.bin"),
      "buffers 0: 'https://example.org/a.bin' is not a file beside this one; download it, or export as GLB");
  expect_document_refused(changed("/nodes/0/mesh", 1), "mesh of a node: there is no number 1 in meshes, which has 1");
  expect_document_refused(changed("/nodes/0/children", {0}),
                          "nodes 0: it has two parents or is below itself; the nodes of a scene must be a tree");
  expect_document_refused(changed("/nodes/0/scale", {1, 2}), "nodes 0: scale must have 3 numbers");
  expect_document_refused(changed("/nodes", 7), "the document: nodes is not an array");
  expect_document_refused(changed("/asset/version", "1.0"),
                          "asset: it has version '1.0' of glTF, and only 2 is read; export as glTF 2.0");
  expect_document_refused(
      changed("/extensionsRequired", {"KHR_draco_mesh_compression"}),
      "extensionsRequired: 'KHR_draco_mesh_compression' is not read; export without it, that is without "
      "compression");
}

TEST(Gltf, WithAPlaceThatContradictsItselfIsAnError) {
  const auto with = [](const char* place) {
    Json json = tetrahedron_json();
    json["nodes"][0].update(Json::parse(place));
    return json;
  };
  expect_document_refused(with(R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "scale": [1,1,1]})"),
                          "nodes 0: it has a matrix and a scale; keep the matrix alone, or what it is made of");
  expect_document_refused(with(R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0.5, 0,0,0,1]})"),
                          "nodes 0: the last row of its matrix is 0, 0, 0.5, 1; it must be 0, 0, 0, 1");
  expect_document_refused(with(R"({"rotation": [0,0,0,0]})"),
                          "nodes 0: its rotation is 0, 0, 0, 0, which is none; 0, 0, 0, 1 turns nothing");
}

TEST(Gltf, OpensRegularFilesOnly) {
  const TemporaryFolder folder;
  Json json = tetrahedron_json();
  for (const char* uri : {"none.bin", "/dev/zero"}) {
    json["buffers"][0]["uri"] = uri;
    write_bytes(folder / "a.gltf", json.dump());
    const std::string file = (folder / "a.gltf").string();
    expect_input_error([&] { read_mesh(folder / "a.gltf"); }, Defect::CannotRead,
                       file + ": buffers 0: there is no regular file " + (folder / uri).string() +
                           ", which holds its data; put it there, or export as GLB");
  }
}

TEST(Gltf, ThatGrowsWithoutBoundIsAnError) {
  Json json = tetrahedron_json();
  std::string bytes(48000, '\0');
  json["buffers"][0]["uri"] = data_uri(bytes);
  json["bufferViews"][0]["byteLength"] = bytes.size();
  json["accessors"][0]["count"] = 4000;
  json["nodes"] = Json(2000, {{"mesh", 0}});
  std::vector<int> all(2000);
  for (int i = 0; i < 2000; ++i) all[static_cast<std::size_t>(i)] = i;
  json["scenes"][0]["nodes"] = all;
  try {
    read(json);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string_view(error.what()).find("its instances hold more than"), std::string_view::npos);
  }
}

TEST(Gltf, MayBeNestedDeeply) {
  constexpr std::size_t kDepth = 100000;
  Json json = tetrahedron_json();
  json["nodes"] = Json::array();
  for (std::size_t i = 0; i < kDepth; ++i) json["nodes"].push_back({{"children", {i + 1}}});
  json["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(read(json), tetrahedron());
  const std::string brackets(kDepth, '[');
  EXPECT_THROW(read_mesh(brackets, "a.gltf"), InputError);
}

TEST(Gltf, MayHaveDeeplyNestedValuesOfTheWrongKind) {
  constexpr std::size_t kDepth = 200000;
  const std::string nested = std::string(kDepth, '[') + std::string(kDepth, ']');
  const auto with = [&](const std::string& value) {
    std::string text = tetrahedron_json().dump();
    return text.replace(text.find(value), value.size(), nested);
  };
  expect_refused(with("\"VEC3\""), "a.gltf", "a.gltf: accessors 0: its type is not VEC3");
  expect_refused(with("\"2.0\""), "a.gltf", "a.gltf: asset: it has no version; the file is no glTF 2.0");
}

TEST(Gltf, NumberBeyondADoubleIsAnError) {
  const std::string text = R"({"asset":{"version":"2.0"},"x":1e999})";
  constexpr const char* kMessage = ": the JSON: it has a number beyond the range of a double (1.8e308)";
  expect_refused(text, "a.gltf", std::string("a.gltf") + kMessage);
  expect_refused(glb(text, ""), "a.glb", std::string("a.glb") + kMessage);
}

TEST(Glb, ThatIsDamagedIsAnError) {
  expect_refused("hello", "a.gltf", "a.gltf: byte 0: what should be JSON is not; the file is truncated or no glTF");
  expect_refused("[]", "a.gltf", "a.gltf: the JSON: not an object; the file is no glTF");
  std::string bytes = glb("{}", "");
  bytes[4] = 1;
  expect_refused(bytes, "a.glb", "a.glb: byte 4: it has version 1 of GLB, and only 2 is read; export as glTF 2.0");
  bytes = glb("{}", "");
  expect_refused(bytes.substr(0, 22), "a.glb", "a.glb: byte 22: the file ends within the JSON chunk; it is truncated");
  expect_refused(glb("{]", ""), "a.glb",
                 "a.glb: byte 21: what should be JSON is not; the file is truncated or no glTF");
}

TEST(Glb, IsWrittenAsTheSpecificationWants) {
  const TemporaryFolder folder;
  write_mesh(folder / "a.glb", tetrahedron());
  const std::string content = read_file(folder / "a.glb");
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, content.data() + at, 4);
    return value;
  };
  EXPECT_EQ(word(8), content.size());
  const std::uint32_t json_size = word(12);
  EXPECT_EQ(json_size % 4, 0u);
  const Json json = Json::parse(content.substr(20, json_size));
  EXPECT_EQ(json["accessors"][0]["min"], Json({0, 0, 0}));
  EXPECT_EQ(json["accessors"][0]["max"], Json({1, 1, 1}));
  EXPECT_EQ(json["accessors"][0]["count"], 4);
  EXPECT_EQ(json["accessors"][1]["count"], 12);
  EXPECT_EQ(json["buffers"][0]["byteLength"], word(20 + json_size));
  EXPECT_EQ(content.size(), 28 + json_size + 4 * 12 + 12 * 4);
  EXPECT_FALSE(json["meshes"][0]["primitives"][0]["attributes"].contains("NORMAL"));
  write_mesh(folder / "empty.glb", {});
  EXPECT_EQ(read_mesh(folder / "empty.glb"), TriangleMesh());
}

}  // namespace
}  // namespace prohull
