// read_or_refuse for files of bytes. The first byte chooses the name of the file, the rest is its content.
#include <array>
#include <cstddef>
#include <cstdint>

#include "fuzzing.h"

constexpr std::array<const char*, 9> kNames = {"fuzz.ply", "fuzz.obj",  "fuzz.off", "fuzz.stl", "fuzz.zip",
                                               "fuzz",     "fuzz.gltf", "fuzz.glb", "fuzz.msh"};

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0)
    prohull::read_or_refuse({reinterpret_cast<const char*>(data) + 1, size - 1}, kNames[data[0] % kNames.size()]);
  return 0;
}
