// read_or_refuse for GLB files that are nearly sound: bytes rarely make JSON. The first byte is a number of edits of a
// sound document, three bytes each: which value, what becomes of it, and a number. The rest is the binary chunk.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fuzzing.h"

namespace {

using Json = nlohmann::json;

// Two instances of a mesh of a list with indices, a strip with sparse positions and a fan of quantized ones.
constexpr const char* kDocument = R"({
  "asset": {"version": "2.0"}, "extensionsRequired": ["KHR_mesh_quantization"],
  "scene": 0, "scenes": [{"nodes": [0, 2]}],
  "nodes": [
    {"children": [1], "translation": [1, 2, 3], "rotation": [0, 0, 1, 0], "scale": [1, -1, 2]},
    {"mesh": 0},
    {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1]}],
  "meshes": [{"primitives": [
    {"attributes": {"POSITION": 0}, "indices": 1, "mode": 4},
    {"attributes": {"POSITION": 2}, "mode": 5},
    {"attributes": {"POSITION": 3}, "indices": 4, "mode": 6}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 1, "byteOffset": 0, "componentType": 5123, "count": 12, "type": "SCALAR"},
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 1,
      "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0, "byteOffset": 12}}},
    {"bufferView": 2, "componentType": 5122, "normalized": true, "count": 4, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5125, "count": 4, "type": "SCALAR"}],
  "bufferViews": [
    {"buffer": 0, "byteLength": 48},
    {"buffer": 0, "byteOffset": 48, "byteLength": 24},
    {"buffer": 0, "byteOffset": 0, "byteLength": 32, "byteStride": 8}],
  "buffers": [{"byteLength": 72}]})";

constexpr std::array<const char*, 7> kTexts = {"VEC3", "SCALAR", "2.1", "data:;base64,AAAA", "none.bin", "mesh", ""};

void collect(Json& value, std::vector<Json*>& all) {
  all.push_back(&value);
  if (value.is_structured())
    for (Json& child : value) collect(child, all);
}

void edit(Json& document, std::uint8_t which, std::uint8_t how, std::uint8_t number) {
  std::vector<Json*> all;
  collect(document, all);
  Json& value = *all[which % all.size()];
  switch (how % 10) {
    case 0:
      value = number;
      break;
    case 1:
      value = -number;
      break;
    case 2:
      value = std::ldexp(1.0 + number, number % 64);
      break;
    case 3:
      value = std::ldexp(1.5, 8 * number - 1024);
      break;
    case 4:
      value = kTexts[number % kTexts.size()];
      break;
    case 5:
      value = number % 2 ? Json() : Json(true);
      break;
    case 6:
      value = number % 2 ? Json::array() : Json::object();
      break;
    case 7:
      if (value.is_structured() && !value.empty()) value.erase(std::next(value.begin(), number % int(value.size())));
      break;
    case 8:
      if (value.is_array() && !value.empty()) value.push_back(Json(value[number % value.size()]));
      break;
    default:
      value = Json(*all[number % all.size()]);
  }
}

std::string word(std::size_t number) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> 8 * i & 0xFF);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  Json document = Json::parse(kDocument);
  std::size_t at = 1;
  for (int edits = data[0] % 16; edits > 0 && at + 3 <= size; --edits, at += 3)
    edit(document, data[at], data[at + 1], data[at + 2]);
  const std::string json = document.dump(), binary(reinterpret_cast<const char*>(data) + at, size - at);
  prohull::read_or_refuse("glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" +
                              json + word(binary.size()) + std::string("BIN\0", 4) + binary,
                          "fuzz.glb");
  return 0;
}
