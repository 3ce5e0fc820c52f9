#include "geometry/exact_number.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace prohull {
namespace {

using Word = std::uint64_t;
__extension__ using TwoWords = unsigned __int128;
constexpr int kBits = 64;

/// The words of a number, shifted to another's; 0 beside them.
struct Shifted {
  Word operator[](std::size_t i) const { return i - begin < size ? words[i - begin] : 0; }
  const Word* words;
  std::size_t size, begin;
};

/// to = a + b
void set_sum(Word* to, std::size_t size, const Shifted& a, const Shifted& b) {
  Word carry = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const TwoWords sum = TwoWords(a[i]) + b[i] + carry;
    to[i] = static_cast<Word>(sum);
    carry = static_cast<Word>(sum >> kBits);
  }
}

/// to = |a - b|; whether a is smaller.
bool set_difference(Word* to, std::size_t size, const Shifted& a, const Shifted& b) {
  Word borrow = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const TwoWords difference = TwoWords(a[i]) - b[i] - borrow;
    to[i] = static_cast<Word>(difference);
    borrow = static_cast<Word>(difference >> kBits) & 1;
  }
  if (borrow == 0) return false;
  Word carry = 1;  // of the complement
  for (std::size_t i = 0; i < size; ++i) {
    to[i] = ~to[i] + carry;
    carry = carry != 0 && to[i] == 0 ? 1 : 0;
  }
  return true;
}

/// to += from * factor, of `size` words; the carry.
Word add_product(Word* to, const Word* from, std::size_t size, Word factor) {
  Word carry = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const TwoWords sum = TwoWords(from[i]) * factor + to[i] + carry;
    to[i] = static_cast<Word>(sum);
    carry = static_cast<Word>(sum >> kBits);
  }
  return carry;
}

/// to = from * factor, of `size` words; the carry.
Word set_product(Word* to, const Word* from, std::size_t size, Word factor) {
  Word carry = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const TwoWords product = TwoWords(from[i]) * factor + carry;
    to[i] = static_cast<Word>(product);
    carry = static_cast<Word>(product >> kBits);
  }
  return carry;
}

}  // namespace

ExactNumber::Words::Words(std::size_t size) : size_(size) {
  if (size > kShort) long_.reset(new Word[size]);
}

ExactNumber::Words::Words(const Words& other) : Words(other.size_) { std::copy_n(other.data(), size_, data()); }

ExactNumber::Words::Words(Words&& other) noexcept : size_(other.size_), long_(std::move(other.long_)) {
  if (!long_) std::copy_n(other.short_.data(), size_, short_.data());
  other.size_ = 0;
}

ExactNumber::Words& ExactNumber::Words::operator=(const Words& other) {
  return this == &other ? *this : *this = Words(other);
}

ExactNumber::Words& ExactNumber::Words::operator=(Words&& other) noexcept {
  if (this == &other) return *this;
  size_ = std::exchange(other.size_, 0);
  long_ = std::move(other.long_);
  if (!long_) std::copy_n(other.short_.data(), size_, short_.data());
  return *this;
}

void ExactNumber::Words::keep(std::size_t begin, std::size_t end) {
  const std::size_t size = end - begin;
  if (long_ && size <= kShort) {
    std::copy_n(long_.get() + begin, size, short_.data());
    long_.reset();
  } else if (begin > 0) {
    std::copy(data() + begin, data() + end, data());
  }
  size_ = size;
}

ExactNumber::ExactNumber(double x) {
  assert(std::isfinite(x));
  if (x == 0) return;
  constexpr int kFraction = 52, kBias = 1075, kOffset = 20;  // an offset in words makes the division round down
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int biased = static_cast<int>(bits >> kFraction & 0x7ff);
  const Word fraction = bits & ((Word(1) << kFraction) - 1);
  const Word whole = biased == 0 ? fraction : fraction | Word(1) << kFraction;
  const int exponent = std::max(biased, 1) - kBias + kOffset * kBits, shift = exponent % kBits;
  words_.set(whole << shift, shift == 0 ? 0 : whole >> (kBits - shift));
  exponent_ = exponent / kBits - kOffset + (whole << shift == 0 ? 1 : 0);
  is_negative_ = x < 0;
}

void ExactNumber::trim() {
  const Word* words = words_.data();
  std::size_t begin = 0, end = words_.size();
  while (end > 0 && words[end - 1] == 0) --end;
  while (begin < end && words[begin] == 0) ++begin;
  if (begin == 0 && end == words_.size()) return;
  words_.keep(begin, end);
  exponent_ = begin == end ? 0 : exponent_ + static_cast<std::int64_t>(begin);
  is_negative_ = is_negative_ && begin < end;
}

ExactNumber ExactNumber::operator-() const& { return -ExactNumber(*this); }

ExactNumber ExactNumber::operator-() && {
  is_negative_ = words_.size() > 0 && !is_negative_;
  return std::move(*this);
}

std::strong_ordering ExactNumber::compare_sizes(const ExactNumber& a, const ExactNumber& b) {
  if (a.words_.size() == 0 || b.words_.size() == 0) return a.words_.size() <=> b.words_.size();
  if (a.end() != b.end()) return a.end() <=> b.end();
  std::size_t i = a.words_.size(), j = b.words_.size();
  while (i > 0 && j > 0)
    if (const Word x = a.words_[--i], y = b.words_[--j]; x != y) return x <=> y;
  return i <=> j;  // the lowest word is not 0
}

ExactNumber ExactNumber::sum(const ExactNumber& a, const ExactNumber& b, bool is_b_negative) {
  if (b.words_.size() == 0) return a;
  if (a.words_.size() == 0) return is_b_negative == b.is_negative_ ? b : -b;
  const bool is_sum = a.is_negative_ == is_b_negative;
  const std::int64_t begin = std::min(a.exponent_, b.exponent_), end = std::max(a.end(), b.end()) + (is_sum ? 1 : 0);
  ExactNumber result(static_cast<std::size_t>(end - begin), begin, a.is_negative_);
  const auto shifted = [begin](const ExactNumber& x) {
    return Shifted{x.words_.data(), x.words_.size(), static_cast<std::size_t>(x.exponent_ - begin)};
  };
  if (is_sum)
    set_sum(result.words_.data(), result.words_.size(), shifted(a), shifted(b));
  else if (set_difference(result.words_.data(), result.words_.size(), shifted(a), shifted(b)))
    result.is_negative_ = is_b_negative;
  result.trim();
  return result;
}

ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
  const std::size_t m = a.words_.size(), n = b.words_.size();
  if (m == 0 || n == 0) return {};
  ExactNumber result(m + n, a.exponent_ + b.exponent_, a.is_negative_ != b.is_negative_);
  Word* words = result.words_.data();
  words[m] = set_product(words, a.words_.data(), m, b.words_[0]);
  for (std::size_t j = 1; j < n; ++j) words[m + j] = add_product(words + j, a.words_.data(), m, b.words_[j]);
  result.trim();
  return result;
}

bool operator==(const ExactNumber& a, const ExactNumber& b) {
  return a.exponent_ == b.exponent_ && a.is_negative_ == b.is_negative_ && a.words_.size() == b.words_.size() &&
         std::equal(a.words_.data(), a.words_.data() + a.words_.size(), b.words_.data());
}

std::strong_ordering operator<=>(const ExactNumber& a, const ExactNumber& b) {
  const int s = sign(a), t = sign(b);
  if (s != t) return s <=> t;
  return s < 0 ? ExactNumber::compare_sizes(b, a) : ExactNumber::compare_sizes(a, b);
}

ExactNumber::Rough ExactNumber::rough() const {
  const std::size_t n = words_.size();
  const Word high = words_[n - 1], low = n > 1 ? words_[n - 2] : 0;
  const int shift = std::countl_zero(high);
  const Word top = shift == 0 ? high : high << shift | low >> (kBits - shift);
  return {static_cast<double>(top >> 11), (end() - 1) * kBits - shift + 11};
}

Rational::Rational(ExactNumber above, ExactNumber below) : above_(std::move(above)), below_(std::move(below)) {
  if (sign(below_) < 0) above_ = -std::move(above_), below_ = -std::move(below_);
  if (below_.words_.size() == 1 && std::has_single_bit(below_.words_[0])) {
    above_ = above_ * ExactNumber(1.0 / static_cast<double>(below_.words_[0]));
    above_.exponent_ -= sign(above_) == 0 ? 0 : below_.exponent_;
    below_ = ExactNumber(1.0);
  }
  if (sign(above_) != 0) above_.exponent_ -= below_.exponent_;
  below_.exponent_ = 0;
}

bool Rational::is_whole() const { return below_.words_.size() == 1 && below_.words_[0] == 1; }

Rational operator+(const Rational& a, const Rational& b) {
  if (a.below_ == b.below_)
    return a.is_whole() ? Rational(a.above_ + b.above_) : Rational(a.above_ + b.above_, a.below_);
  if (a.is_whole()) return {a.above_ * b.below_ + b.above_, b.below_};
  if (b.is_whole()) return {a.above_ + b.above_ * a.below_, a.below_};
  return {a.above_ * b.below_ + b.above_ * a.below_, a.below_ * b.below_};
}

Rational operator-(const Rational& a, const Rational& b) {
  if (a.below_ == b.below_)
    return a.is_whole() ? Rational(a.above_ - b.above_) : Rational(a.above_ - b.above_, a.below_);
  if (a.is_whole()) return {a.above_ * b.below_ - b.above_, b.below_};
  if (b.is_whole()) return {a.above_ - b.above_ * a.below_, a.below_};
  return {a.above_ * b.below_ - b.above_ * a.below_, a.below_ * b.below_};
}

Rational operator*(const Rational& a, const Rational& b) {
  if (a.is_whole() && b.is_whole()) return {a.above_ * b.above_};
  if (a.is_whole()) return {a.above_ * b.above_, b.below_};
  if (b.is_whole()) return {a.above_ * b.above_, a.below_};
  return {a.above_ * b.above_, a.below_ * b.below_};
}

Rational operator/(const Rational& a, const Rational& b) {
  assert(sign(b) != 0);
  if (a.below_ == b.below_) return {a.above_, b.above_};
  return {a.above_ * b.below_, a.below_ * b.above_};
}

Rational zero_between(const Rational& a, const Rational& b) {
  if (a.below_ == b.below_) return {a.above_, a.above_ - b.above_};
  const ExactNumber above = a.above_ * b.below_;
  return {above, above - b.above_ * a.below_};
}

std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  const int s = sign(a), t = sign(b);
  if (s != t) return s <=> t;
  if (a.below_ == b.below_) return a.above_ <=> b.above_;
  return a.above_ * b.below_ <=> b.above_ * a.below_;
}

double Rational::rounded() const {
  constexpr double kMost = std::numeric_limits<double>::max(), kInfinity = std::numeric_limits<double>::infinity();
  if (sign(above_) == 0) return 0;
  if (sign(above_) < 0) return -Rational(-above_, below_).rounded();
  // A first guess is wrong by a few units. The middle between it and a neighbour tells which is nearer.
  const ExactNumber::Rough a = above_.rough(), b = below_.rough();
  const auto exponent = std::clamp<std::int64_t>(a.exponent - b.exponent, -5000, 5000);
  double x = std::min(std::ldexp(a.fraction / b.fraction, static_cast<int>(exponent)), kMost);
  const auto against_middle = [&](double low, double high) {
    const ExactNumber beyond = high == kInfinity ? ExactNumber(0x1p1023) * ExactNumber(2) : ExactNumber(high);
    return above_ * ExactNumber(2) <=> (ExactNumber(low) + beyond) * below_;
  };
  const auto is_odd = [](double d) { return (std::bit_cast<std::uint64_t>(d) & 1) != 0; };
  for (;;) {
    const double above = std::nextafter(x, kInfinity);
    if (const auto o = against_middle(x, above); std::is_gt(o) || (o == std::strong_ordering::equal && is_odd(x))) {
      x = above;
      if (x == kInfinity) return x;
      continue;
    }
    if (x == 0) return x;
    const double below = std::nextafter(x, 0);
    if (const auto o = against_middle(below, x); !(std::is_lt(o) || (o == std::strong_ordering::equal && is_odd(x))))
      return x;
    x = below;
  }
}

Interval Rational::interval() const {
  const double x = rounded();
  if (!std::isfinite(x)) return {-x, x};
  if (*this == Rational(x)) return x;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(x, -kInfinity), std::nextafter(x, kInfinity)};
}

}  // namespace prohull
