#include "prohull/hull_file.h"

#include <fmt/format.h>
#include <zstd.h>

#include <cstdint>
#include <fstream>
#include <memory>

#include "io/append.h"
#include "io/byte_cursor.h"
#include "io/file.h"
#include "io/file_content.h"
#include "prohull/error.h"

// Layout (docs/phull.md): 8 bytes of magic, u32 version, then one zstd frame with its checksum. All numbers are
// little-endian. The frame holds u16 side, u16 finest level, u64 original vertices, u64 original faces, u64 splits,
// then arrays: positions (3 doubles each), base corners (u32), and one array each of the splits' o, d, l, r, od, do
// (u32).

namespace prohull {
namespace {

constexpr std::string_view kHullMagic("\x89PHULL\r\n", 8);
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHullHeaderSize = 12;
constexpr int kCompressionLevel = 3;
constexpr int kMostWindowLog = 23;  ///< that level uses 21; a frame may ask for 128 MB, however short it is

constexpr std::uint32_t VertexSplit::*kCornerFields[] = {&VertexSplit::od, &VertexSplit::do_};
constexpr VertexId VertexSplit::*kVertexFields[] = {&VertexSplit::o, &VertexSplit::d, &VertexSplit::l, &VertexSplit::r};
constexpr std::size_t kPayloadHeaderSize = 4 + 3 * 8;

std::string encoded(const ProgressiveHull& hull) {
  std::string out;
  out.reserve(kPayloadHeaderSize + 24 * hull.positions().size() + 4 * hull.base_corners().size() +
              24 * hull.splits().size());
  append_bytes(out, static_cast<std::uint16_t>(hull.side()));
  append_bytes(out, static_cast<std::uint16_t>(hull.finest_level()));
  append_bytes(out, std::uint64_t{hull.original_vertex_count()});
  append_bytes(out, std::uint64_t{hull.original_face_count()});
  append_bytes(out, std::uint64_t{hull.splits().size()});
  for (const Vec3& p : hull.positions())
    for (int axis = 0; axis < 3; ++axis) append_bytes(out, p[axis]);
  for (const VertexId v : hull.base_corners()) append_bytes(out, index(v));
  for (const auto field : kVertexFields)
    for (const VertexSplit& split : hull.splits()) append_bytes(out, index(split.*field));
  for (const auto field : kCornerFields)
    for (const VertexSplit& split : hull.splits()) append_bytes(out, split.*field);
  return out;
}

[[noreturn]] void malformed(const std::filesystem::path& name, std::string_view what) {
  throw InputError(Defect::Malformed,
                   fmt::format("{}: {}; build the hull again, or fetch the file again", name.string(), what));
}

ProgressiveHull decoded(std::string_view payload, const std::filesystem::path& name) {
  if (payload.size() < kPayloadHeaderSize) malformed(name, "the hull's header is incomplete");
  ByteCursor in(payload, 0);
  const auto side = in.read<std::uint16_t>(), finest_level = in.read<std::uint16_t>();
  const auto vertices = in.read<std::uint64_t>(), faces = in.read<std::uint64_t>(), splits = in.read<std::uint64_t>();
  constexpr std::uint64_t kMost = 0xfffffffe;
  if (side > 1 || finest_level > 3 || vertices > kMost || splits > kMost || vertices + splits > kMost ||
      faces > kMost / 3)
    malformed(name, "the hull's header is impossible");
  if (in.remaining() != 24 * (vertices + splits) + 12 * faces + 24 * splits)
    malformed(name, fmt::format("it has {} bytes for {} vertices, {} faces and {} splits, which do not agree",
                                in.remaining(), vertices, faces, splits));

  PerVertex<Vec3> positions(vertices + splits);
  for (Vec3& p : positions)
    for (int axis = 0; axis < 3; ++axis) p[axis] = in.read<double>();
  std::vector<VertexId> corners(3 * faces);
  for (VertexId& v : corners) v = VertexId(in.read<std::uint32_t>());
  std::vector<VertexSplit> records(splits);
  for (const auto field : kVertexFields)
    for (VertexSplit& split : records) split.*field = VertexId(in.read<std::uint32_t>());
  for (const auto field : kCornerFields)
    for (VertexSplit& split : records) split.*field = in.read<std::uint32_t>();

  ProgressiveHull hull(HullSide(side), vertices, std::move(positions), std::move(corners), std::move(records));
  if (const auto defect = first_defect(hull)) malformed(name, *defect);
  return hull.with_finest_level(FinestLevel(finest_level));
}

// Real hulls shrink to a half or a third; whatever grows a thousandfold is made to exhaust memory.
std::string unpacked(std::string_view frame, const std::filesystem::path& name) {
  const std::size_t limit = 1000 * frame.size() + (1 << 20);
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(), &ZSTD_freeDStream);
  ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, kMostWindowLog);
  std::string payload;
  ZSTD_inBuffer in{frame.data(), frame.size(), 0};
  std::size_t state = 1;
  while (state != 0) {
    const std::size_t before = payload.size();
    payload.resize(before + ZSTD_DStreamOutSize());
    ZSTD_outBuffer out{payload.data() + before, payload.size() - before, 0};
    state = ZSTD_decompressStream(stream.get(), &out, &in);
    payload.resize(before + out.pos);
    if (ZSTD_isError(state)) malformed(name, fmt::format("it is damaged ({})", ZSTD_getErrorName(state)));
    if (payload.size() > limit) malformed(name, "it is damaged (decompressed, it grows a thousand times)");
    if (state != 0 && in.pos == in.size && out.pos < out.size)
      malformed(name, fmt::format("it is truncated after {} bytes", frame.size() + kHullHeaderSize));
  }
  if (in.pos != in.size) malformed(name, fmt::format("{} bytes too many follow at its end", in.size - in.pos));
  return payload;
}

}  // namespace

std::string hull_content(const ProgressiveHull& hull) {
  const std::string payload = encoded(hull);
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kCompressionLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string frame(ZSTD_compressBound(payload.size()), '\0');
  frame.resize(ZSTD_compress2(context.get(), frame.data(), frame.size(), payload.data(), payload.size()));

  std::string content(kHullMagic);
  append_bytes(content, kVersion);
  content += frame;
  return content;
}

void save_hull(const std::filesystem::path& path, const ProgressiveHull& hull) { write_file(path, hull_content(hull)); }

ProgressiveHull load_hull(const std::filesystem::path& path) { return load_hull(read_file(path), path); }

bool is_hull_content(std::string_view content) { return content.starts_with(kHullMagic); }

bool is_hull_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string start(kHullMagic.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return in && is_hull_content(start);
}

ProgressiveHull load_hull(std::string_view content, const std::filesystem::path& name) {
  if (is_gzip(content))
    throw InputError(Defect::UnknownFormat,
                     fmt::format("{}: it is gzipped, and a .phull file is read as it is: gunzip it", name.string()));
  if (!is_hull_content(content))
    throw InputError(Defect::UnknownFormat,
                     fmt::format("{}: this is not a .phull file, which holds all levels of a hull; `prohull build MESH "
                                 "-o HULL --hierarchy H.phull` makes one from a mesh",
                                 name.string()));
  if (content.size() < kHullHeaderSize) malformed(name, fmt::format("it is truncated after {} bytes", content.size()));
  const auto version = ByteCursor(content, kHullMagic.size()).read<std::uint32_t>();
  if (version != kVersion)
    throw InputError(Defect::UnknownFormat,
                     fmt::format("{}: version {} of the .phull format; this program reads version {}: use the one that "
                                 "wrote it, or a newer one",
                                 name.string(), version, kVersion));
  return decoded(unpacked(content.substr(kHullHeaderSize), name), name);
}

}  // namespace prohull
