#pragma once

#include "render/image.h"

namespace prohull::render {

struct Palette {
  std::vector<Pixel> colors;          ///< at most 256
  std::vector<std::uint8_t> indices;  ///< of each pixel its colour
};

/// The colours of an image, reduced by median cut (Heckbert 1982): the group of colours that differ most, counted by
/// pixels, is parted at its mean until there are 256 groups, and each is replaced by its mean. Keeps all colours if
/// there are no more.
Palette palette_of(const Image& image);

}  // namespace prohull::render
