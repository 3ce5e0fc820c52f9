#include "io/zip_writer.h"

#include <minizip/zip.h>

#include <algorithm>
#include <new>
#include <utility>

namespace prohull {
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
