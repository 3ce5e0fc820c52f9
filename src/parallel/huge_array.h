#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace prohull {

/// An array of fixed size that is read here and there: if it is large, the system is asked for huge pages, of which the
/// processor knows more by heart. Its elements are zero bytes at first.
template <class T>
class HugeArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  HugeArray() = default;
  HugeArray(HugeArray&& other) noexcept : size_(std::exchange(other.size_, 0)), elements_(std::move(other.elements_)) {}
  HugeArray& operator=(HugeArray&& other) noexcept {
    size_ = std::exchange(other.size_, 0), elements_ = std::move(other.elements_);
    return *this;
  }
  explicit HugeArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    const std::size_t align = bytes() < kHugePage ? std::max(alignof(T), alignof(std::max_align_t)) : kHugePage;
    const std::size_t rounded = (bytes() + align - 1) / align * align;
    elements_.reset(static_cast<T*>(std::aligned_alloc(align, rounded)));
    if (!elements_) throw std::bad_alloc();
#if defined(__linux__)
    if (align == kHugePage) madvise(elements_.get(), rounded, MADV_HUGEPAGE);  // a wish: nothing depends on it
#endif
    std::fill_n(reinterpret_cast<char*>(elements_.get()), bytes(), '\0');
  }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  T& operator[](std::size_t i) { return elements_.get()[i]; }
  const T& operator[](std::size_t i) const { return elements_.get()[i]; }
  T* begin() { return elements_.get(); }
  T* end() { return elements_.get() + size_; }
  const T* begin() const { return elements_.get(); }
  const T* end() const { return elements_.get() + size_; }

 private:
  static constexpr std::size_t kHugePage = std::size_t{1} << 21;
  struct Free {
    void operator()(T* elements) const { std::free(elements); }
  };

  std::size_t size_ = 0;
  std::unique_ptr<T, Free> elements_;
};

}  // namespace prohull
