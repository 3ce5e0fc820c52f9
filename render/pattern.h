#pragma once

#include "render/camera.h"

namespace prohull::render {

/// Where samples go. The same in every block of kBlock x kBlock pixels: so pictures are the same bits every time, and
/// what is averaged over such a block has no noise.
class Pattern {
 public:
  static constexpr int kBlock = 4;

  explicit Pattern(int samples) : samples_(samples) {}
  int samples() const { return samples_; }

  /// The place of sample i in its pixel, in [0, 1) x [0, 1).
  Point2 in_pixel(int i) const { return hammersley(i, samples_); }
  /// The place of sample i of pixel (x, y), in [0, 1) x [0, 1). The samples of a pixel are spread evenly, and those of
  /// a block fill the gaps between them.
  Point2 in_block(int x, int y, int i) const {
    const Point2 coarse = hammersley(i, samples_), fine = hammersley(order(x, y), kBlock * kBlock);
    const double across = coarse.x + (fine.x - 0.5) / samples_, up = coarse.y + (fine.y - 0.5) / samples_;
    return {across, up < 1 ? up : up - 1};
  }

 private:
  /// The ordered dither matrix: any few that follow each other are spread over the block.
  static int order(int x, int y) {
    const int u = x ^ y;
    return (u & 1) << 3 | (y & 1) << 2 | (u & 2) | (y & 2) >> 1;
  }
  static Point2 hammersley(int i, int count) {
    double inverse = 0, digit = 0.5;
    for (int rest = i; rest > 0; rest /= 2, digit /= 2) inverse += digit * (rest % 2);
    return {(i + 0.5) / count, inverse + 0.5 / count};
  }

  int samples_;
};

}  // namespace prohull::render
