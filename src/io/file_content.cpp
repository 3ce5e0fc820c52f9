#include "io/file_content.h"

#define ZLIB_CONST  // inputs are const
#include <fmt/format.h>
#include <minizip/unzip.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include "io/file.h"
#include "io/mesh_readers.h"
#include "io/zip_file.h"
#include "prohull/detail/missing_file.h"
#include "prohull/error.h"

namespace prohull {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 18;
constexpr std::string_view kEndOfZip = "PK\x05\x06";

[[noreturn]] void fail_to_decompress(const std::filesystem::path& name, std::string_view reason) {
  throw InputError(Defect::Malformed, fmt::format("{}: cannot decompress: {}", name.string(), reason));
}

void check_limit(std::size_t size, std::size_t compressed, const std::filesystem::path& name) {
  const std::size_t limit = decompression_limit(compressed);
  if (size > limit)
    fail_to_decompress(name, fmt::format("more than {} bytes come out of {}, which neither meshes nor queries do; if "
                                         "it is right, decompress it first",
                                         limit, compressed));
}

/// Makes room for the next chunk behind the first `size` bytes.
char* grow(std::string& bytes, std::size_t size) {
  if (bytes.size() < size + kChunk) bytes.resize(std::max(size + kChunk, std::min(2 * size, bytes.capacity())));
  return bytes.data() + size;
}

class Inflater {
 public:
  explicit Inflater(std::string_view compressed) {
    constexpr int kGzip = 16;
    if (inflateInit2(&stream_, MAX_WBITS + kGzip) != Z_OK) throw std::bad_alloc();
    stream_.next_in = reinterpret_cast<const Bytef*>(compressed.data());
    left_ = compressed.size();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  int step(char* output, std::size_t& written) {
    refill();
    stream_.next_out = reinterpret_cast<Bytef*>(output);
    stream_.avail_out = kChunk;
    const int status = inflate(&stream_, Z_NO_FLUSH);
    written += kChunk - stream_.avail_out;
    return status;
  }
  /// gzip files may be joined one after the other; whatever else follows is ignored.
  bool next_member() {
    refill();
    return stream_.avail_in > 0 && *stream_.next_in == 0x1F && inflateReset(&stream_) == Z_OK;
  }
  std::string_view message() const { return stream_.msg ? stream_.msg : "the data is damaged"; }

 private:
  void refill() {
    if (stream_.avail_in > 0) return;
    stream_.avail_in = static_cast<uInt>(std::min(left_, kChunk));
    left_ -= stream_.avail_in;
  }

  z_stream stream_{};
  std::size_t left_ = 0;
};

class ZipReader {
 public:
  ZipReader(std::string_view compressed, const std::filesystem::path& name) : file_{compressed}, name_(name) {
    if (compressed.starts_with(kEndOfZip)) return;  // it has no members
    zlib_filefunc64_def functions = file_.functions();
    zip_.reset(unzOpen2_64("", &functions));
    if (!zip_) fail_to_decompress(name, "the archive is damaged or truncated");
    unz_global_info64 info;
    check(unzGetGlobalInfo64(zip_.get(), &info));
    left_ = info.number_entry;
  }

  /// Goes on to the next member; empty at the end.
  std::optional<std::string> next() {
    if (left_ == 0) return {};
    --left_;
    check(std::exchange(begun_, true) ? unzGoToNextFile(zip_.get()) : unzGoToFirstFile(zip_.get()));
    std::string path(std::size_t{1} << 16, '\0');  // longer names cannot be
    check(unzGetCurrentFileInfo64(zip_.get(), nullptr, path.data(), path.size(), nullptr, 0, nullptr, 0));
    return path.c_str();
  }

  /// Of the member that `next` has named.
  std::string data() {
    std::string bytes;
    std::size_t size = 0;
    require_readable();
    check(unzOpenCurrentFile(zip_.get()));
    while (const int read = unzReadCurrentFile(zip_.get(), grow(bytes, size), kChunk)) {
      if (read < 0) check(read);
      size += static_cast<std::size_t>(read);
      check_limit(size, file_.archive.size(), name_);
    }
    check(unzCloseCurrentFile(zip_.get()));
    bytes.resize(size);
    return bytes;
  }

 private:
  void check(int status) const {
    if (status == UNZ_CRCERROR) fail_to_decompress(name_, "a checksum is wrong; the archive is damaged");
    if (status != UNZ_OK) fail_to_decompress(name_, "the archive is damaged");
  }

  /// minizip returns other members as they are packed.
  void require_readable() const {
    constexpr uLong kEncrypted = 1, kStored = 0;
    unz_file_info64 info;
    check(unzGetCurrentFileInfo64(zip_.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0));
    if (info.flag & kEncrypted) fail_to_decompress(name_, "it is encrypted; extract the mesh first");
    if (info.compression_method != kStored && info.compression_method != Z_DEFLATED)
      fail_to_decompress(name_, "it is not packed by deflate, as zip files are by default; extract the mesh first");
  }

  ZipFile file_;
  const std::filesystem::path& name_;
  std::unique_ptr<void, int (*)(void*)> zip_{nullptr, unzClose};
  ZPOS64_T left_ = 0;
  bool begun_ = false;
};

/// Not the files "__MACOSX/._part.ply" with which macOS accompanies each file.
bool is_mesh(const std::filesystem::path& member) {
  return is_mesh_name(member) && !member.filename().string().starts_with("._");
}

FileContent only_mesh(std::string_view bytes, const std::filesystem::path& name) {
  std::vector<std::string> meshes = zip_members(bytes, name);
  std::erase_if(meshes, [](const std::string& member) { return !is_mesh(member); });
  if (meshes.empty())
    fail_to_decompress(name,
                       "it has no .ply, .obj, .off, .stl or .glb file, nor another mesh; name a 3MF "
                       "file .3mf");
  if (meshes.size() > 1)
    fail_to_decompress(
        name, fmt::format("it has more than one mesh, {} and {}; extract the one you mean", meshes[0], meshes[1]));
  return zip_member(bytes, name, meshes[0]);
}

}  // namespace

void fail_to_read(const std::string& name, int error) {
  const std::string what = name + ": cannot read: ";
  if (error == ENOENT || error == ENOTDIR)
    throw MissingFile(what + "there is no such file; look at its name and its folder");
  throw InputError(Defect::CannotRead, what + (error == EISDIR   ? "it is a folder; name a file in it"
                                               : error == EACCES ? "you may not read it; ask its owner, or copy it"
                                                                 : std::generic_category().message(error)));
}

std::string read_file(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, decltype(&std::fclose)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail_to_read(path.string(), errno);
  std::error_code unknown;  // the size of a pipe
  const std::uintmax_t expected = std::filesystem::file_size(path, unknown);
  std::string bytes;
  if (!unknown) bytes.reserve(expected + kChunk);
  std::size_t size = 0;
  while (const std::size_t read = std::fread(grow(bytes, size), 1, kChunk, file.get())) size += read;
  if (std::ferror(file.get())) fail_to_read(path.string(), errno);
  bytes.resize(size);
  return bytes;
}

std::size_t decompression_limit(std::size_t compressed) { return (std::size_t{64} << 20) + 200 * compressed; }

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04") || bytes.starts_with(kEndOfZip); }

std::string gunzip(std::string_view compressed, const std::filesystem::path& name) {
  Inflater inflater(compressed);
  std::string bytes;
  std::size_t size = 0;
  while (true) {
    const int status = inflater.step(grow(bytes, size), size);
    check_limit(size, compressed.size(), name);
    if (status == Z_STREAM_END && !inflater.next_member()) break;
    if (status == Z_BUF_ERROR) fail_to_decompress(name, "the file is truncated");
    if (status != Z_OK && status != Z_STREAM_END) fail_to_decompress(name, inflater.message());
  }
  bytes.resize(size);
  return bytes;
}

std::vector<std::string> zip_members(std::string_view bytes, const std::filesystem::path& name) {
  std::vector<std::string> members;
  ZipReader zip(bytes, name);
  while (auto member = zip.next()) members.push_back(std::move(*member));
  return members;
}

FileContent zip_member(std::string_view bytes, const std::filesystem::path& name, const std::string& member) {
  ZipReader zip(bytes, name);
  while (const auto next = zip.next())
    if (*next == member) return {zip.data(), name / std::filesystem::path(member).relative_path()};
  fail_to_decompress(name, fmt::format("it contains no {}", member));
}

std::optional<FileContent> decompressed(std::string_view bytes, const std::filesystem::path& name) {
  if (is_gzip(bytes)) return FileContent{gunzip(bytes, name), name};
  if (is_zip(bytes)) return only_mesh(bytes, name);
  return {};
}

}  // namespace prohull
