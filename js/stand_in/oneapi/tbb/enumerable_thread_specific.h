#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace oneapi::tbb {

template <class Value>
class enumerable_thread_specific {
 public:
  enumerable_thread_specific() : make_([] { return Value(); }) {}
  template <class Make>
  explicit enumerable_thread_specific(Make make) : make_(std::move(make)) {}

  Value& local() {
    if (!value_) value_.emplace(make_());
    return *value_;
  }
  auto begin() const { return value_ ? &*value_ : nullptr; }
  auto end() const { return begin() + value_.has_value(); }

 private:
  std::function<Value()> make_;
  std::optional<Value> value_;
};

}  // namespace oneapi::tbb
