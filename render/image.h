#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "render/color.h"

namespace prohull::render {

/// Red, green, blue and alpha; sRGB, alpha is not multiplied in.
using Pixel = std::array<std::uint8_t, 4>;

/// Rows from the top.
class Image {
 public:
  static constexpr int kMaxSide = 16384;  ///< so that an int can count the bytes of an image

  Image(int width, int height) : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  void set(int x, int y, const Rgba& color);
  const Pixel& at(int x, int y) const { return pixels_[offset(x, y)]; }
  const std::vector<Pixel>& pixels() const { return pixels_; }

 private:
  std::size_t offset(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }

  int width_, height_;
  std::vector<Pixel> pixels_;
};

/// The content of a PNG file: every pixel as it is, without an alpha channel if all are opaque.
std::string encode_png(const Image& image);

/// A PNG file with at most 256 colours, each near to those it stands for. It is less than half as large.
std::string encode_small_png(const Image& image);

}  // namespace prohull::render
