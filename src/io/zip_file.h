#pragma once

#include <minizip/ioapi.h>

#include <memory>
#include <string>
#include <string_view>

namespace prohull {

/// An archive in memory, as minizip reads and writes it. `archive` is what it sees; in an archive that is being
/// written, that of `written`.
struct ZipFile {
  std::string_view archive;
  std::string* written = nullptr;
  std::size_t at = 0;

  /// Functions for `unzOpen2_64` and `zipOpen2_64`. They refer to this file, which must not move.
  zlib_filefunc64_def functions();
};

/// Makes a zip archive in memory: members as they are, without compression or dates, so that the same members give the
/// same bytes.
class ZipWriter {
 public:
  ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  void add(const std::string& name, std::string_view content);
  /// Ends the archive.
  std::string finish();

 private:
  std::string bytes_;
  ZipFile file_{{}, &bytes_};
  std::unique_ptr<void, int (*)(void*)> zip_;
};

}  // namespace prohull
