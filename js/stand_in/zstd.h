#pragma once

// What io/hull_file.cpp calls of zstd: frames are written with their checksum (XXH64), but not compressed, and read as
// any program compresses them (unzstd.cpp).

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

struct ZSTD_CCtx {};
struct ZSTD_DStream;
struct ZSTD_inBuffer {
  const void* src;
  std::size_t size, pos;
};
struct ZSTD_outBuffer {
  void* dst;
  std::size_t size, pos;
};
enum { ZSTD_c_compressionLevel, ZSTD_c_checksumFlag, ZSTD_d_windowLogMax };

ZSTD_DStream* ZSTD_createDStream();
std::size_t ZSTD_freeDStream(ZSTD_DStream*);
std::size_t ZSTD_DCtx_setParameter(ZSTD_DStream*, int, int);
std::size_t ZSTD_DStreamOutSize();
std::size_t ZSTD_decompressStream(ZSTD_DStream*, ZSTD_outBuffer*, ZSTD_inBuffer*);
unsigned ZSTD_isError(std::size_t);
const char* ZSTD_getErrorName(std::size_t);

inline ZSTD_CCtx* ZSTD_createCCtx() { return new ZSTD_CCtx; }
inline std::size_t ZSTD_freeCCtx(ZSTD_CCtx* context) { return delete context, 0; }
inline std::size_t ZSTD_CCtx_setParameter(ZSTD_CCtx*, int, int) { return 0; }

namespace prohull_zstd {

constexpr std::size_t kBlock = std::size_t{1} << 17;                          // the most that a block may have
constexpr unsigned char kStart[]{0x28, 0xb5, 0x2f, 0xfd, 4, (17 - 10) << 3};  // magic, with checksum, window of a block

template <class T>
T word(const unsigned char* bytes) {  // WebAssembly is little-endian
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

inline std::uint64_t xxh64(const unsigned char* bytes, std::size_t size) {
  constexpr std::uint64_t kA = 0x9E3779B185EBCA87, kB = 0xC2B2AE3D27D4EB4F, kC = 0x165667B19E3779F9,
                          kD = 0x85EBCA77C2B2AE63, kE = 0x27D4EB2F165667C5;
  const auto round = [](std::uint64_t lane, std::uint64_t input) { return std::rotl(lane + input * kB, 31) * kA; };
  const unsigned char *at = bytes, *const end = bytes + size;
  std::uint64_t hash = kE;
  if (size >= 32) {
    std::uint64_t lanes[]{kA + kB, kB, 0, 0 - kA};
    for (; end - at >= 32;)
      for (std::uint64_t& lane : lanes) lane = round(lane, word<std::uint64_t>(at)), at += 8;
    hash = std::rotl(lanes[0], 1) + std::rotl(lanes[1], 7) + std::rotl(lanes[2], 12) + std::rotl(lanes[3], 18);
    for (const std::uint64_t lane : lanes) hash = (hash ^ round(0, lane)) * kA + kD;
  }
  hash += size;
  for (; end - at >= 8; at += 8) hash = std::rotl(hash ^ round(0, word<std::uint64_t>(at)), 27) * kA + kD;
  if (end - at >= 4) hash = std::rotl(hash ^ word<std::uint32_t>(at) * kA, 23) * kB + kC, at += 4;
  for (; at < end; ++at) hash = std::rotl(hash ^ *at * kE, 11) * kA;
  hash = (hash ^ hash >> 33) * kB;
  hash = (hash ^ hash >> 29) * kC;
  return hash ^ hash >> 32;
}

}  // namespace prohull_zstd

inline std::size_t ZSTD_compressBound(std::size_t size) {
  return sizeof prohull_zstd::kStart + size + 3 * (size / prohull_zstd::kBlock + 1) + 4;
}

inline std::size_t ZSTD_compress2(ZSTD_CCtx*, void* to, std::size_t, const void* from, std::size_t size) {
  using namespace prohull_zstd;
  const auto* const bytes = static_cast<const unsigned char*>(from);
  auto* out = static_cast<unsigned char*>(to);
  const auto put = [&](const void* what, std::size_t count) { std::memcpy(out, what, count), out += count; };
  put(kStart, sizeof kStart);
  std::size_t at = 0;
  do {
    const std::size_t count = size - at < kBlock ? size - at : kBlock;
    const auto header = static_cast<std::uint32_t>(count << 3 | (at + count == size));  // a raw block; the last one?
    put(&header, 3);
    put(bytes + at, count);
    at += count;
  } while (at < size);
  const auto checksum = static_cast<std::uint32_t>(xxh64(bytes, size));
  put(&checksum, 4);
  return static_cast<std::size_t>(out - static_cast<unsigned char*>(to));
}
