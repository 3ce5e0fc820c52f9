#pragma once

#include <minizip/ioapi.h>

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

}  // namespace prohull
