// Whatever bytes a .phull file has, load_hull returns a sound hull, or throws InputError. The first byte chooses: the
// rest is the file, or the payload within it, which is compressed here so that mutations get past its checksum.
#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "prohull/error.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_report.h"
#include "prohull/replay.h"

namespace {

std::string as_file(const std::uint8_t* data, std::size_t size) {
  std::string content("\x89PHULL\r\n\x01\0\0\0", 12);
  std::string frame(ZSTD_compressBound(size), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), data, size, 1));
  return content + frame;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const bool is_file = data[0] % 8 == 0;
  const std::string content =
      is_file ? std::string(reinterpret_cast<const char*>(data) + 1, size - 1) : as_file(data + 1, size - 1);
  try {
    const prohull::ProgressiveHull hull = prohull::load_hull(content, "fuzz.phull");
    if (first_defect(hull)) std::abort();
    for (const std::size_t faces :
         {hull.base_face_count(), hull.original_face_count() / 2, hull.original_face_count()}) {
      const prohull::TriangleMesh level = hull.level(faces);
      if (level.face_count() > 0 && !inspect(level).is_closed_manifold()) std::abort();
    }
    verify_replay(hull, hull.original());
  } catch (const prohull::InputError&) {
  }
  return 0;
}
