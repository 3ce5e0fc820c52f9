#include "io/zip_writer.h"

#include <archive.h>
#include <archive_entry.h>

#include <new>
#include <utility>

namespace prohull {
namespace {

la_ssize_t append(archive*, void* bytes, const void* data, std::size_t size) {
  try {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), size);
    return static_cast<la_ssize_t>(size);
  } catch (const std::bad_alloc&) {
    return -1;
  }
}

}  // namespace

ZipWriter::ZipWriter() : archive_(archive_write_new(), archive_write_free) {
  check(archive_write_set_format_zip(archive_.get()));
  check(archive_write_zip_set_compression_store(archive_.get()));
  check(archive_write_set_bytes_in_last_block(archive_.get(), 1));
  check(archive_write_open(archive_.get(), &bytes_, nullptr, append, nullptr));
}

void ZipWriter::add(const std::string& name, std::string_view content) {
  const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(), archive_entry_free);
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  check(archive_write_header(archive_.get(), entry.get()));
  if (!content.empty()) check(archive_write_data(archive_.get(), content.data(), content.size()));
}

std::string ZipWriter::finish() {
  check(archive_write_close(archive_.get()));
  return std::move(bytes_);
}

void ZipWriter::check(long status) const {
  if (status < ARCHIVE_OK) throw std::bad_alloc();  // in memory, nothing else can fail
}

}  // namespace prohull
