// Whatever bytes a .phull file has, load_hull returns a sound hull, or throws InputError. The first byte chooses: the
// rest is the file, or the payload within it, or what is changed in the payload of a small hull. A payload is
// compressed here, so that it gets past the checksum.
#include <unistd.h>
#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "meshes.h"
#include "prohull/detail/replay.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/hull_file.h"
#include "prohull/mesh_report.h"

namespace {

constexpr std::string_view kHeader("\x89PHULL\r\n\x01\0\0\0", 12);

std::string as_file(std::string_view payload) {
  std::string frame(ZSTD_compressBound(payload.size()), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), payload.data(), payload.size(), 1));
  return std::string(kHeader) + frame;
}

/// Of an outer hull of 12 faces of the sphere of 32.
std::string small_payload() {
  const std::string name = (std::filesystem::temp_directory_path() / ("fuzz." + std::to_string(getpid()))).string();
  save_hull(name, prohull::build_hull(prohull::meshes::sphere(1), {.target_faces = 12}).hull);
  std::ifstream in(name, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(name);
  std::string payload(1 << 16, '\0');
  payload.resize(ZSTD_decompress(payload.data(), payload.size(), content.data() + kHeader.size(),
                                 content.size() - kHeader.size()));
  return payload;
}

/// Each three bytes of the changes are the place of a byte, and what it becomes.
std::string changed(std::string payload, std::string_view changes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(changes[i]); };
  for (std::size_t i = 0; i + 2 < changes.size(); i += 3)
    payload[(byte(i) * 256u + byte(i + 1)) % payload.size()] = changes[i + 2];
  return payload;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string small = small_payload();
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string content = data[0] % 8 == 0   ? std::string(rest)
                              : data[0] % 8 <= 2 ? as_file(rest)
                                                 : as_file(changed(small, rest));
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
