#include "prohull/hull_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zstd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "effort.h"
#include "hull/parts.h"
#include "io/file.h"
#include "meshes.h"
#include "prohull/error.h"
#include "prohull/hull_builder.h"
#include "prohull/mesh_report.h"
#include "prohull/sample.h"
#include "random.h"

namespace prohull {
namespace {

using namespace meshes;

constexpr std::size_t kHeaderSize = 12;

ProgressiveHull hull_of_16_faces() { return build_hull(sphere(1), {.target_faces = 16}).hull; }

class TemporaryFile {
 public:
  TemporaryFile() {
    std::string name = (std::filesystem::temp_directory_path() / "prohull_test_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~TemporaryFile() { std::filesystem::remove_all(folder_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::filesystem::path path() const { return folder_ / "test.phull"; }

 private:
  std::filesystem::path folder_;
};

std::string file_of(const ProgressiveHull& hull) {
  const TemporaryFile file;
  save_hull(file.path(), hull);
  return read_file(file.path());
}

std::string little_endian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  return text;
}

std::string compressed(const std::string& payload, int window_log = 0) {
  ZSTD_CCtx* context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, window_log == 0);
  if (window_log > 0) ZSTD_CCtx_setParameter(context, ZSTD_c_windowLog, window_log);
  std::string frame(ZSTD_compressBound(payload.size()), '\0');
  ZSTD_inBuffer in{payload.data(), payload.size(), 0};
  ZSTD_outBuffer out{frame.data(), frame.size(), 0};
  // In two calls, so that the frame keeps its window however short it is.
  if (window_log > 0) ZSTD_compressStream2(context, &out, &in, ZSTD_e_flush);
  while (ZSTD_compressStream2(context, &out, &in, ZSTD_e_end) != 0) {
  }
  ZSTD_freeCCtx(context);
  frame.resize(out.pos);
  return frame;
}

std::string decompressed(const std::string& frame) {
  std::string payload(1 << 22, '\0');
  payload.resize(ZSTD_decompress(payload.data(), payload.size(), frame.data(), frame.size()));
  return payload;
}

std::string header() { return std::string("\x89PHULL\r\n", 8) + little_endian(1, 4); }

/// Of a hull file with a payload of our own, whose checksum is right.
std::string with_payload(const std::string& payload) { return header() + compressed(payload); }

std::string counts(std::uint64_t side, std::uint64_t vertices, std::uint64_t faces, std::uint64_t splits) {
  return little_endian(side, 4) + little_endian(vertices, 8) + little_endian(faces, 8) + little_endian(splits, 8);
}

std::optional<Defect> defect_of(const std::string& content) {
  try {
    load_hull(content, "test.phull");
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("test.phull: ")) << error.what();
    return error.defect();
  }
  return std::nullopt;
}

TEST(HullFile, BringsBackEveryBit) {
  for (const HullSide side : {HullSide::Outer, HullSide::Inner})
    for (const TriangleMesh& mesh : {make_sample("asteroid", 500), torus(12, 9), together(sphere(2), octahedron())}) {
      const ProgressiveHull hull = build_hull(mesh, {.target_faces = 60, .side = side}).hull;
      const TemporaryFile file;
      save_hull(file.path(), hull);
      EXPECT_TRUE(is_hull_file(file.path()));
      EXPECT_EQ(load_hull(file.path()), hull);
      EXPECT_EQ(load_hull(read_file(file.path()), "x"), hull);
    }
}

TEST(HullFile, KeepsMinusZeroAndExtremeCoordinatesAndUnusedVertices) {
  TriangleMesh mesh = octahedron();
  for (Vec3& p : mesh.positions)
    for (int i = 0; i < 3; ++i)
      if (p[i] == 0) p[i] = -0.0;
  mesh.positions[VertexId{0}].x = 0x1p1023;
  mesh.positions.push_back({std::numeric_limits<double>::denorm_min(), 0, 0});
  const ProgressiveHull back = load_hull(file_of(parts_of(mesh).joined()), "x");
  EXPECT_EQ(back.original(), mesh);
  EXPECT_TRUE(std::signbit(back.positions()[VertexId{0}].y));
}

TEST(HullFile, IsTheSameEveryTime) { EXPECT_EQ(file_of(hull_of_16_faces()), file_of(hull_of_16_faces())); }

TEST(HullFile, IsKnownByItsStart) {
  const TemporaryFile file;
  const auto is_one = [&](const std::string& content) {
    std::ofstream(file.path(), std::ios::binary) << content;
    return is_hull_file(file.path());
  };
  EXPECT_TRUE(is_one(header()));
  EXPECT_FALSE(is_one("ply\n"));
  EXPECT_FALSE(is_one(header().substr(0, 7)));
  EXPECT_FALSE(is_one(""));
  EXPECT_FALSE(is_hull_file(file.path().string() + ".missing"));
}

TEST(HullFile, OtherFilesAndNewerVersionsAreRefused) {
  std::string content = file_of(hull_of_16_faces());
  EXPECT_EQ(defect_of(""), Defect::UnknownFormat);
  EXPECT_EQ(defect_of("solid cube"), Defect::UnknownFormat);
  EXPECT_EQ(defect_of(header()), Defect::Malformed);
  content[8] = 2;
  EXPECT_EQ(defect_of(content), Defect::UnknownFormat);
  content[8] = 0;
  EXPECT_EQ(defect_of(content), Defect::UnknownFormat);
  EXPECT_THROW(load_hull("/nonexistent/test.phull"), InputError);
  EXPECT_THROW(save_hull("/nonexistent/test.phull", hull_of_16_faces()), InputError);
}

TEST(HullFile, SaysWhatItsFinestLevelIs) {
  const ProgressiveHull hull = hull_of_16_faces();
  EXPECT_EQ(load_hull(file_of(hull), "x").finest_level(), FinestLevel::Input);
  for (const auto& [name, finest_level] : finest_level_names()) {
    const ProgressiveHull back = load_hull(file_of(hull.with_finest_level(finest_level)), "x");
    EXPECT_EQ(back.finest_level(), finest_level) << name;
    EXPECT_EQ(back.with_base(20).finest_level(), finest_level) << name;
    EXPECT_EQ(back.with_finest_level(FinestLevel::Input), hull) << name;
  }
}

TEST(HullFile, EveryTruncationIsRefused) {
  const std::string content = file_of(hull_of_16_faces());
  constexpr std::size_t kMagicSize = 8;  // less than that may be any file
  for (std::size_t size = 0; size < content.size(); ++size)
    ASSERT_EQ(defect_of(content.substr(0, size)), size < kMagicSize ? Defect::UnknownFormat : Defect::Malformed)
        << size << " of " << content.size() << " bytes";
  EXPECT_EQ(defect_of(content + '\0'), Defect::Malformed) << "a byte too many";
  EXPECT_EQ(defect_of(content + content.substr(kHeaderSize)), Defect::Malformed) << "two frames";
}

TEST(HullFile, EveryCorruptedByteIsRefusedOrChangesNothing) {
  const ProgressiveHull hull = hull_of_16_faces();
  const std::string content = file_of(hull);
  const int stride = rounds(10) > 9 ? 1 : 11;
  std::size_t harmless = 0;
  for (std::size_t i = 0; i < content.size(); i += stride)
    for (const int flip : {0x01, 0x10, 0x80, 0xff}) {
      std::string corrupted = content;
      corrupted[i] = static_cast<char>(corrupted[i] ^ flip);
      try {
        ASSERT_EQ(load_hull(corrupted, "x"), hull) << "byte " << i << ", flipped " << flip;
        ++harmless;  // bits that zstd does not use
      } catch (const InputError&) {
      }
    }
  EXPECT_LT(harmless, content.size() / 10);
}

TEST(HullFile, APayloadThatItsChecksumVouchesForIsCheckedToo) {
  const ProgressiveHull hull = hull_of_16_faces();
  const std::string payload = decompressed(file_of(hull).substr(kHeaderSize));
  ASSERT_EQ(load_hull(with_payload(payload), "x"), hull);
  std::mt19937 random(test_seed());
  constexpr std::size_t kCounts = 28;
  const std::size_t numbers = kCounts + 24 * hull.positions().size();
  int refused = 0, sound = 0;
  for (int i = 0; i < rounds(3000); ++i) {
    std::string changed = payload;
    // Counts, positions, or corners and splits, which are words of four bytes; a few of them, or two that change
    // places.
    for (auto count = random() % 3 + 1; count > 0; --count) {
      const std::size_t end = payload.size() - 3, at = random() % 8 == 0 ? random() % kCounts
                                                       : random() % 8 == 0
                                                           ? kCounts + random() % (numbers - kCounts)
                                                           : numbers + random() % (end - numbers) / 4 * 4;
      const std::size_t other = numbers + random() % (end - numbers) / 4 * 4;
      if (random() % 2 == 0 && at >= numbers)
        std::swap_ranges(&changed[at], &changed[at] + 4, &changed[other]);
      else
        changed[at] = static_cast<char>(random());
    }
    if (random() % 8 == 0) changed.resize(random() % changed.size());
    try {
      const ProgressiveHull other = load_hull(with_payload(changed), "x");
      ++sound;
      ASSERT_EQ(first_defect(other), std::nullopt);
      ASSERT_EQ(other.original().face_count(), other.original_face_count());
      ASSERT_TRUE(inspect(other.base()).is_closed_manifold());
      ASSERT_TRUE(inspect(other.original()).is_closed_manifold());
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, rounds(1000));
  EXPECT_GT(sound, rounds(50));
}

TEST(HullFile, HostileCountsAreRefused) {
  constexpr std::uint64_t kMost = 0xffffffffffffffff;
  for (const std::uint64_t huge :
       {std::uint64_t{0xfffffffe}, std::uint64_t{0xffffffff}, kMost / 24, kMost / 12, kMost / 2 + 1, kMost})
    for (const std::string& some : {counts(0, huge, 0, 0), counts(0, 0, huge, 0), counts(0, 0, 0, huge),
                                    counts(0, huge, huge, huge), counts(0, huge, 0, 1), counts(0, 1, 0, huge)})
      EXPECT_EQ(defect_of(with_payload(some)), Defect::Malformed) << huge;
  EXPECT_EQ(defect_of(with_payload(counts(2, 0, 0, 0))), Defect::Malformed) << "there are two sides";
  EXPECT_EQ(defect_of(with_payload(counts(4 << 16, 0, 0, 0))), Defect::Malformed) << "there are four finest levels";
  EXPECT_EQ(defect_of(with_payload(counts(0xffffffff, 0, 0, 0))), Defect::Malformed);
  EXPECT_EQ(defect_of(with_payload("")), Defect::Malformed);
  // 2^64 bytes, modulo 2^64: 24 * 2^61 is 0.
  EXPECT_EQ(defect_of(with_payload(counts(0, std::uint64_t{1} << 61, 0, 0))), Defect::Malformed);
}

#ifndef PROHULL_TESTS_ARE_SLOW  // sanitizers take address space of their own

/// Ends the process, with 0 if the content is refused for what it is, with 64 MB of memory beyond what is in use.
[[noreturn]] void refuse_in_little_memory(const std::string& content) {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  const rlim_t bytes = pages * 4096 + (rlim_t{64} << 20);
  const rlimit limit{bytes, bytes};
  if (setrlimit(RLIMIT_AS, &limit) != 0) std::_Exit(1);
  try {
    load_hull(content, "x");
    std::_Exit(2);
  } catch (const InputError& error) {
    std::_Exit(std::string_view(error.what()).find("llocation") == std::string_view::npos ? 0 : 3);
  } catch (const std::bad_alloc&) {
    std::_Exit(4);
  }
}

TEST(HullFileDeathTest, BombsAreRefusedInLittleMemory) {
  std::string bomb = with_payload(std::string(200 << 20, '\0'));
  bomb.shrink_to_fit();
  EXPECT_EXIT(refuse_in_little_memory(bomb), testing::ExitedWithCode(0), "");
}

TEST(HullFileDeathTest, AHugeWindowIsRefusedInLittleMemory) {
  const std::string small(counts(0, 0, 0, 0));
  const std::string content = header() + compressed(small, 27);
  ASSERT_LT(content.size(), 100u);
  EXPECT_EXIT(refuse_in_little_memory(content), testing::ExitedWithCode(0), "");
}

#endif

}  // namespace
}  // namespace prohull
