// read_or_refuse for zip archives that are nearly sound, so that mutations get past their checksums. The first byte
// says how many members there are and how they are packed, the second how many bytes of the archive are changed, three
// bytes for each. The rest are the members: a byte for the name, one for the size, the content; the last has all that
// is left.
#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "fuzzing.h"

namespace {

// No formats that other programs read.
constexpr std::array<const char*, 10> kNames = {
    "a.ply", "a.obj", "a.off", "b/a.stl", "a.glb", "a.zip", "/a.off", "../../a.off", "a.txt", "",
};

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : rest_(reinterpret_cast<const char*>(data), size) {}

  unsigned byte() { return rest_.empty() ? 0u : static_cast<unsigned char>(take(1)[0]); }
  std::string_view take(std::size_t size) {
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

la_ssize_t append(archive*, void* bytes, const void* data, std::size_t size) {
  static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), size);
  return static_cast<la_ssize_t>(size);
}

void add_member(archive* zip, const char* name, std::string_view content) {
  const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(), archive_entry_free);
  archive_entry_set_pathname(entry.get(), name);
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_write_header(zip, entry.get());
  archive_write_data(zip, content.data(), content.size());
}

std::string zip_of(unsigned packing, unsigned members, Bytes& bytes) {
  std::string content;
  const std::unique_ptr<archive, decltype(&archive_write_free)> zip(archive_write_new(), archive_write_free);
  archive_write_set_format_zip(zip.get());
  archive_write_set_options(zip.get(), packing % 2 ? "zip:compression=store" : "zip:compression=deflate");
  archive_write_set_bytes_in_last_block(zip.get(), 1);
  archive_write_open(zip.get(), &content, nullptr, append, nullptr);
  for (unsigned i = 0; i < members; ++i) {
    const char* const name = kNames[bytes.byte() % kNames.size()];
    const unsigned size = bytes.byte();
    add_member(zip.get(), name, bytes.take(i + 1 < members ? size : bytes.left()));
  }
  archive_write_close(zip.get());
  return content;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const unsigned first = bytes.byte();
  const std::string_view changes = bytes.take(3 * (bytes.byte() % 8));
  std::string zip = zip_of(first / 4, first % 4, bytes);
  for (std::size_t i = 0; i + 3 <= changes.size() && !zip.empty(); i += 3) {
    // Near either end, where the headers are.
    const std::size_t at = std::min(zip.size() - 1, std::size_t(static_cast<unsigned char>(changes[i + 1])));
    char& changed = changes[i] % 2 ? zip[at] : zip[zip.size() - 1 - at];
    changed = changes[i + 2];
  }
  prohull::read_or_refuse(zip, "fuzz.zip");
  return 0;
}
