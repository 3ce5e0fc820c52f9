#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace prohull {

enum class VertexId : std::uint32_t {};
enum class FaceId : std::uint32_t {};

template <class Id>
constexpr std::uint32_t index(Id id) {
  return static_cast<std::uint32_t>(id);
}

/// A std::vector that knows what its index means: handing a face to a PerVertex array does not compile.
template <class Id, class T>
class IndexedBy {
 public:
  IndexedBy() = default;
  explicit IndexedBy(std::size_t count, const T& value = T()) : values_(count, value) {}
  IndexedBy(std::initializer_list<T> values) : values_(values) {}
  explicit IndexedBy(std::vector<T> values) : values_(std::move(values)) {}

  T& operator[](Id id) { return values_[index(id)]; }
  const T& operator[](Id id) const { return values_[index(id)]; }

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  T& back() { return values_.back(); }
  const T& back() const { return values_.back(); }

  /// The id that the next push_back will give.
  Id next_id() const { return Id(static_cast<std::uint32_t>(values_.size())); }
  Id push_back(const T& value) {
    values_.push_back(value);
    return Id(static_cast<std::uint32_t>(values_.size() - 1));
  }
  void reserve(std::size_t count) { values_.reserve(count); }
  void resize(std::size_t count, const T& value = T()) { values_.resize(count, value); }
  void assign(std::size_t count, const T& value) { values_.assign(count, value); }
  void pop_back() { values_.pop_back(); }
  void clear() { values_.clear(); }

  /// for (VertexId v : positions.ids())
  class Ids {
   public:
    class Iterator {
     public:
      explicit Iterator(std::uint32_t i) : i_(i) {}
      Id operator*() const { return Id(i_); }
      Iterator& operator++() { return ++i_, *this; }
      bool operator==(const Iterator&) const = default;

     private:
      std::uint32_t i_;
    };
    explicit Ids(std::uint32_t count) : count_(count) {}
    Iterator begin() const { return Iterator(0); }
    Iterator end() const { return Iterator(count_); }

   private:
    std::uint32_t count_;
  };
  Ids ids() const { return Ids(static_cast<std::uint32_t>(values_.size())); }

  bool operator==(const IndexedBy&) const = default;

 private:
  std::vector<T> values_;
};

template <class T>
using PerVertex = IndexedBy<VertexId, T>;
template <class T>
using PerFace = IndexedBy<FaceId, T>;

}  // namespace prohull
