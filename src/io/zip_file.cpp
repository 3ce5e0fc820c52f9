#include "io/zip_file.h"

#include <minizip/zip.h>

#include <algorithm>
#include <new>
#include <utility>

namespace prohull {
namespace {

ZipFile& opened(voidpf file) { return *static_cast<ZipFile*>(file); }

voidpf open(voidpf file, const void*, int) { return file; }

uLong read(voidpf, voidpf stream, void* to, uLong size) {
  ZipFile& file = opened(stream);
  const std::size_t read = file.archive.copy(static_cast<char*>(to), size, std::min(file.at, file.archive.size()));
  file.at += read;
  return read;
}

/// Bytes behind the end are appended; others are written over, as the size of a member once it is known.
uLong write(voidpf, voidpf stream, const void* from, uLong size) try {
  ZipFile& file = opened(stream);
  const std::size_t over = std::min<std::size_t>(size, file.written->size() - file.at);
  file.written->replace(file.at, over, static_cast<const char*>(from), size);
  file.archive = *file.written;
  file.at += size;
  return size;
} catch (const std::bad_alloc&) {
  return 0;
}

ZPOS64_T tell(voidpf, voidpf stream) { return opened(stream).at; }

long seek(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  ZipFile& file = opened(stream);
  const std::size_t from = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                           : origin == ZLIB_FILEFUNC_SEEK_CUR ? file.at
                                                              : file.archive.size();
  if (offset > file.archive.size() - from) return -1;
  file.at = from + offset;
  return 0;
}

int close(voidpf, voidpf) { return 0; }

int error(voidpf, voidpf) { return 0; }

}  // namespace

zlib_filefunc64_def ZipFile::functions() { return {open, read, write, tell, seek, close, error, this}; }

namespace {

void check(int status) {
  if (status != ZIP_OK) throw std::bad_alloc();  // in memory, nothing else can fail
}

zipFile created(ZipFile& file) {
  zlib_filefunc64_def functions = file.functions();
  const zipFile zip = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
  if (!zip) throw std::bad_alloc();
  return zip;
}

int close(zipFile zip) { return zipClose(zip, nullptr); }

}  // namespace

ZipWriter::ZipWriter() : zip_(created(file_), close) {}

void ZipWriter::add(const std::string& name, std::string_view content) {
  constexpr std::size_t kLarge = 0xFFFFFFFF, kChunk = std::size_t{1} << 30;  // 32 bits, and `unsigned`
  const int stored = 0;
  check(zipOpenNewFileInZip64(zip_.get(), name.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr, stored, 0,
                              content.size() >= kLarge));
  for (; !content.empty(); content.remove_prefix(std::min(kChunk, content.size())))
    check(zipWriteInFileInZip(zip_.get(), content.data(), static_cast<unsigned>(std::min(kChunk, content.size()))));
  check(zipCloseFileInZip(zip_.get()));
}

std::string ZipWriter::finish() {
  check(close(zip_.release()));
  return std::move(bytes_);
}

}  // namespace prohull
