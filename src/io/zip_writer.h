#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/zip_file.h"

namespace prohull {

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
