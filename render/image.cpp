#include "render/image.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "render/palette.h"

namespace prohull::render {
namespace {

std::uint8_t quantized(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.f, 1.f)));
}

bool is_opaque(const Image& image) {
  return std::ranges::all_of(image.pixels(), [](const Pixel& p) { return p[3] == 255; });
}

std::vector<std::uint8_t> channels(const std::vector<Pixel>& pixels, std::size_t count) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(count * pixels.size());
  for (const Pixel& pixel : pixels) bytes.insert(bytes.end(), pixel.begin(), pixel.begin() + count);
  return bytes;
}

/// libpng's simplified interface; `colors` are of the format's palette, if it has one.
std::string encode(png_image header, const std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& colors) {
  const void* const palette = colors.empty() ? nullptr : colors.data();
  std::string png(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = png.size();
  // The bound above holds, and the pixels are ours: there is nothing left to fail but memory.
  if (!png_image_write_to_memory(&header, png.data(), &size, false, bytes.data(), 0, palette)) throw std::bad_alloc();
  png.resize(size);
  return png;
}

png_image header_of(const Image& image, png_uint_32 format) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = format;
  return header;
}

}  // namespace

void Image::set(int x, int y, const Rgba& color) {
  const float scale = color.alpha > 0 ? 1 / color.alpha : 0;
  pixels_[offset(x, y)] = {quantized(srgb_of_linear(color.color.r * scale)),
                           quantized(srgb_of_linear(color.color.g * scale)),
                           quantized(srgb_of_linear(color.color.b * scale)), quantized(color.alpha)};
}

std::string encode_png(const Image& image) {
  const bool opaque = is_opaque(image);
  return encode(header_of(image, opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA), channels(image.pixels(), opaque ? 3 : 4),
                {});
}

std::string encode_small_png(const Image& image) {
  const bool opaque = is_opaque(image);
  const Palette palette = palette_of(image);
  png_image header = header_of(image, opaque ? PNG_FORMAT_RGB_COLORMAP : PNG_FORMAT_RGBA_COLORMAP);
  header.colormap_entries = static_cast<png_uint_32>(palette.colors.size());
  return encode(header, palette.indices, channels(palette.colors, opaque ? 3 : 4));
}

}  // namespace prohull::render
