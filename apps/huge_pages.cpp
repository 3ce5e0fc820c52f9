#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>
#include <unordered_map>
#include <vector>

#include <malloc.h>
#include <sys/mman.h>

// How a program with this source allocates. Meshes of millions of faces are a few dozens of arrays that come and go. In
// pages of 4 KiB, handing them out and taking them back took the system a fifth of the time. Here large blocks are made
// of huge pages, and the pages of a block that is freed are moved into the next one, wherever that lies and however
// large it is. So the system hands out each page once, and the program never has more of them than its largest need.

namespace {

constexpr std::size_t kPage = std::size_t{1} << 21, kLarge = 2 * kPage;

template <class T>
struct Malloc {
  using value_type = T;
  Malloc() = default;
  template <class U>
  explicit Malloc(const Malloc<U>&) {}
  T* allocate(std::size_t count) {
    if (void* const block = std::malloc(count * sizeof(T))) return static_cast<T*>(block);
    throw std::bad_alloc();
  }
  void deallocate(T* block, std::size_t) { std::free(block); }
  bool operator==(const Malloc&) const = default;
};

class LargeBlocks {
 public:
  /// Null if there is no room.
  void* allocate(std::size_t size) {
    const std::lock_guard lock(mutex_);
    const std::size_t pages = (size + kPage - 1) / kPage;
    char* const block = reserve(pages * kPage);
    if (!block) return nullptr;
    try {
      pages_of_[block] = pages;
    } catch (const std::bad_alloc&) {
      munmap(block, pages * kPage);
      return nullptr;
    }
    for (std::size_t i = 0; i < pages && !free_pages_.empty(); ++i) {
      char* const page = free_pages_.back();
      free_pages_.pop_back();
      if (mremap(page, kPage, kPage, MREMAP_MAYMOVE | MREMAP_FIXED, block + i * kPage) == MAP_FAILED)
        munmap(page, kPage);  // the block has a new page there
    }
    return block;
  }

  /// False if it is none of these blocks.
  bool free(void* pointer) {
    char* const block = static_cast<char*>(pointer);
    if (reinterpret_cast<std::uintptr_t>(block) % kPage != 0) return false;
    const std::lock_guard lock(mutex_);
    const auto found = pages_of_.find(block);
    if (found == pages_of_.end()) return false;
    const std::size_t pages = found->second;
    pages_of_.erase(found);
    try {
      free_pages_.reserve(std::max(free_pages_.size() + pages, free_pages_.capacity()));
      for (std::size_t i = pages; i-- > 0;) free_pages_.push_back(block + i * kPage);
    } catch (const std::bad_alloc&) {
      munmap(block, pages * kPage);
    }
    return true;
  }

 private:
  /// Addresses that begin at a huge page.
  static char* reserve(std::size_t size) {
    if (size > SIZE_MAX / 2) return nullptr;
    void* const found =
        mmap(nullptr, size + kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (found == MAP_FAILED) return nullptr;
    char* const begin = static_cast<char*>(found);
    const std::size_t before = (kPage - reinterpret_cast<std::uintptr_t>(begin) % kPage) % kPage;
    if (before > 0) munmap(begin, before);
    if (before < kPage) munmap(begin + before + size, kPage - before);
    madvise(begin + before, size, MADV_HUGEPAGE);  // a wish: nothing depends on it
    return begin + before;
  }

  std::mutex mutex_;
  std::unordered_map<char*, std::size_t, std::hash<char*>, std::equal_to<>, Malloc<std::pair<char* const, std::size_t>>>
      pages_of_;
  std::vector<char*, Malloc<char*>> free_pages_;
};

/// Lives as long as there is anything that was allocated.
LargeBlocks& large_blocks() {
  alignas(LargeBlocks) static char room[sizeof(LargeBlocks)];
  static LargeBlocks* const blocks = [] {
    mallopt(M_MMAP_THRESHOLD, kLarge);      // blocks below stay with malloc,
    mallopt(M_TRIM_THRESHOLD, 16 * kPage);  // which keeps some of what is freed
    return new (room) LargeBlocks;
  }();
  return *blocks;
}

void* allocated(std::size_t size) {
  return size < kLarge ? std::malloc(std::max(size, std::size_t{1})) : large_blocks().allocate(size);
}

}  // namespace

// The other forms of new and delete call these.
void* operator new(std::size_t size) {
  while (true) {
    if (void* const block = allocated(size)) return block;
    if (const std::new_handler handler = std::get_new_handler())
      handler();
    else
      throw std::bad_alloc();
  }
}

void operator delete(void* block) noexcept {
  if (!large_blocks().free(block)) std::free(block);
}

void operator delete(void* block, std::size_t) noexcept { operator delete(block); }
