#include "render/palette.h"

#include <algorithm>
#include <map>

namespace prohull::render {
namespace {

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

}  // namespace

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

}  // namespace prohull::render
