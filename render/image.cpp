#include "render/image.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <new>

namespace prohull::render {
namespace {

std::uint8_t quantized(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.f, 1.f)));
}

constexpr std::size_t kMostColors = 256;

struct CountedColor {
  Pixel color;
  double count;
};

/// A range of colours that become one.
struct Group {
  explicit Group(std::vector<CountedColor>::iterator from, std::vector<CountedColor>::iterator to)
      : begin(from), end(to) {
    for (auto c = begin; c != end; ++c) count += c->count;
    for (std::size_t k = 0; k < mean.size(); ++k) {
      for (auto c = begin; c != end; ++c) mean[k] += c->count * c->color[k] / count;
      const double difference = summed_squares(k);
      if (difference > most_different) most_different = difference, channel = k;
    }
  }

  double summed_squares(std::size_t k) const {
    double sum = 0;
    for (auto c = begin; c != end; ++c) sum += c->count * (c->color[k] - mean[k]) * (c->color[k] - mean[k]);
    return sum;
  }

  std::vector<CountedColor>::iterator begin, end;
  double count = 0;
  std::array<double, 4> mean{};
  std::size_t channel = 0;    // in which the colours differ most
  double most_different = 0;  // sum of the squared differences from the mean there
};

std::vector<CountedColor> counted_colors(const Image& image) {
  std::vector<Pixel> sorted = image.pixels();
  std::ranges::sort(sorted);
  std::vector<CountedColor> colors;
  for (const Pixel& pixel : sorted) {
    if (colors.empty() || colors.back().color != pixel) colors.push_back({pixel, 0});
    ++colors.back().count;
  }
  return colors;
}

/// The colours above the mean, which leave the group. Neither part is empty, for the colours differ.
Group part(Group& group) {
  const std::size_t k = group.channel;
  const auto middle =
      std::stable_partition(group.begin, group.end, [&](const CountedColor& c) { return c.color[k] <= group.mean[k]; });
  const Group above(middle, group.end);
  group = Group(group.begin, middle);
  return above;
}

std::vector<Group> groups_of(std::vector<CountedColor>& colors) {
  std::vector<Group> groups{Group(colors.begin(), colors.end())};
  while (groups.size() < kMostColors) {
    const auto widest = std::ranges::max_element(groups, {}, &Group::most_different);
    if (widest->most_different == 0) break;
    const Group above = part(*widest);
    groups.push_back(above);
  }
  // Neighbours in brightness get neighbouring numbers, which compresses better.
  std::ranges::stable_sort(groups, {}, [](const Group& g) { return g.mean[0] + g.mean[1] + g.mean[2] + g.mean[3]; });
  return groups;
}

Pixel rounded(const std::array<double, 4>& mean) {
  Pixel pixel;
  for (std::size_t k = 0; k < mean.size(); ++k) pixel[k] = static_cast<std::uint8_t>(mean[k] + 0.5);
  return pixel;
}

struct Palette {
  std::vector<Pixel> colors;          ///< at most 256
  std::vector<std::uint8_t> indices;  ///< of each pixel its colour
};

/// The colours of an image, reduced by median cut (Heckbert 1982): the group of colours that differ most, counted by
/// pixels, is parted at its mean until there are 256 groups, and each is replaced by its mean. Keeps all colours if
/// there are no more.
Palette palette_of(const Image& image) {
  std::vector<CountedColor> colors = counted_colors(image);
  Palette palette;
  std::map<Pixel, std::uint8_t> index_of;
  for (const Group& group : groups_of(colors)) {
    for (auto c = group.begin; c != group.end; ++c)
      index_of[c->color] = static_cast<std::uint8_t>(palette.colors.size());
    palette.colors.push_back(rounded(group.mean));
  }
  palette.indices.reserve(image.pixels().size());
  for (const Pixel& pixel : image.pixels()) palette.indices.push_back(index_of.at(pixel));
  return palette;
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
