#include "io/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

#include "prohull/error.h"

namespace prohull {
namespace {

std::string_view advice(int error, const std::filesystem::path& file) {
  std::error_code ignored;
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return std::filesystem::is_directory(file.parent_path(), ignored) ? "; this folder takes no files, choose another"
                                                                        : "; create the folder first";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose a folder that you may write to";
    case ENOSPC:
    case EDQUOT:
      return "; make room, or choose another disk";
    case EISDIR:
      return "; name a file in it";
    default:
      return "";
  }
}

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code error;
  auto target = std::filesystem::canonical(path, error);
  return error ? path : target;
}

std::filesystem::path unique_name_beside(std::filesystem::path path) {
  constexpr std::size_t kLongest = 200;  // what is added has room in the 255 bytes that systems take
  std::random_device random;
  return path.replace_filename(
      fmt::format("{}.{:08x}{:08x}.tmp", path.filename().string().substr(0, kLongest), random(), random()));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), target_(resolved(path_)) {
  std::error_code error;
  const auto status = std::filesystem::status(target_, error);
  const bool replaced = !exists(status) || is_regular_file(status);
  if (replaced) temporary_ = unique_name_beside(target_);
  file_ = replaced ? std::fopen(temporary_.c_str(), "wbx") : std::fopen(target_.c_str(), "wb");
  if (!file_) fail();
  if (is_regular_file(status)) std::filesystem::permissions(temporary_, status.permissions(), error);
}

AtomicFile::~AtomicFile() {
  if (file_) std::fclose(file_);
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail();
}

void AtomicFile::commit() {
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
  temporary_.clear();
}

void AtomicFile::fail() const {
  const int error = errno;
  throw InputError(Defect::CannotWrite, fmt::format("{}: cannot write: {}{}", path_.string(),
                                                    std::generic_category().message(error), advice(error, target_)));
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace prohull
