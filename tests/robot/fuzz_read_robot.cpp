// Whatever text a robot, its budgets and spheres, regions of a mesh, or a file of the cache has, it is read, or refused
// by an InputError. The first byte chooses the reader.
#include <unistd.h>

#include <cstddef>
#include <cstdint>

#include "readers.h"

using namespace prohull::robot;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path folder = [] {
    std::filesystem::path own = std::filesystem::temp_directory_path() / ("prohull_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(own);
    return own;
  }();
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      take_robot(text);
      break;
    case 1:
      take_yaml(text);
      break;
    case 2:
      take_regions(text);
      break;
    default:
      take_kept_hulls(text, folder);
  }
  return 0;
}
