#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

#include "io/file.h"

namespace prohull {

/// A file that appears whole or not at all: written beside its path under another name, then renamed by `commit`;
/// without that, it vanishes. A file that is replaced keeps its mode. A path that exists and is no regular file (a
/// pipe, /dev/stdout) is written as it is. Throws InputError(CannotWrite) with the system's reason and what to do.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  void write(std::string_view bytes);
  void commit();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::filesystem::path target_;     ///< where links lead
  std::filesystem::path temporary_;  ///< empty if the target is written as it is
  std::FILE* file_ = nullptr;
};

}  // namespace prohull
