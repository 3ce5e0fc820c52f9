#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "geometry/interval.h"

namespace prohull {

/// Sums, differences and products of finite doubles, without rounding: a whole number times a power of 2^64. Numbers
/// of a few words need no allocation.
class ExactNumber {
 public:
  ExactNumber() = default;  ///< 0
  ExactNumber(double x);    ///< finite

  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) { return sum(a, b, b.is_negative_); }
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) { return sum(a, b, !b.is_negative_); }
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b);
  ExactNumber operator-() const&;
  ExactNumber operator-() &&;
  ExactNumber& operator+=(const ExactNumber& x) { return *this = *this + x; }

  friend bool operator==(const ExactNumber& a, const ExactNumber& b);
  friend std::strong_ordering operator<=>(const ExactNumber& a, const ExactNumber& b);
  friend int sign(const ExactNumber& x) { return x.words_.size() == 0 ? 0 : x.is_negative_ ? -1 : 1; }

 private:
  friend class Rational;
  using Word = std::uint64_t;

  /// An array of words whose values are not set; short ones are in place.
  class Words {
   public:
    Words() = default;
    explicit Words(std::size_t size);
    /// Without a word that is 0, of at most one.
    void set(Word low, Word high) {
      size_ = low != 0 && high != 0 ? 2 : 1;
      short_[0] = low != 0 ? low : high;
      short_[1] = high;
    }
    Words(const Words& other);
    Words(Words&& other) noexcept;
    Words& operator=(const Words& other);
    Words& operator=(Words&& other) noexcept;

    std::size_t size() const { return size_; }
    Word* data() { return long_ ? long_.get() : short_.data(); }
    const Word* data() const { return long_ ? long_.get() : short_.data(); }
    Word operator[](std::size_t i) const { return data()[i]; }
    /// Leaves out words at both ends.
    void keep(std::size_t begin, std::size_t end);

   private:
    static constexpr std::size_t kShort = 8;
    std::size_t size_ = 0;
    std::unique_ptr<Word[]> long_;
    std::array<Word, kShort> short_;
  };

  /// x = 2^exponent * fraction, with a fraction in [1, 2^64), rounded down; for a number that is not 0.
  struct Rough {
    double fraction;
    std::int64_t exponent;
  };

  ExactNumber(std::size_t size, std::int64_t exponent, bool is_negative)
      : words_(size), exponent_(exponent), is_negative_(is_negative) {}
  static ExactNumber sum(const ExactNumber& a, const ExactNumber& b, bool is_b_negative);
  static std::strong_ordering compare_sizes(const ExactNumber& a, const ExactNumber& b);
  std::int64_t end() const { return exponent_ + static_cast<std::int64_t>(words_.size()); }
  void trim();
  Rough rough() const;

  Words words_;  // from the lowest; the first and the last are not 0
  std::int64_t exponent_ = 0;
  bool is_negative_ = false;
};

/// A quotient of exact numbers, which is not reduced.
class Rational {
 public:
  Rational() : Rational(0.0) {}
  Rational(double x) : Rational(ExactNumber(x)) {}  ///< finite
  Rational(ExactNumber x) : above_(std::move(x)), below_(1.0) {}

  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);  ///< b is not 0

  /// a / (a - b), which are not equal, in smaller parts.
  friend Rational zero_between(const Rational& a, const Rational& b);

  friend bool operator==(const Rational& a, const Rational& b) { return (a <=> b) == std::strong_ordering::equal; }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);
  friend int sign(const Rational& x) { return sign(x.above_); }

  /// The nearest double, the even one of two; infinite from half a unit beyond the largest one on.
  double rounded() const;
  Interval interval() const;

 private:
  Rational(ExactNumber above, ExactNumber below);
  bool is_whole() const;

  ExactNumber above_, below_;  // below_ is positive; its lowest word has the exponent 0
};

}  // namespace prohull
