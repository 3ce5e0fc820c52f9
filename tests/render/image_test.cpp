#include "render/image.h"

#include <gtest/gtest.h>

#include <png.h>

#include <cstdlib>
#include <random>
#include <set>

#include "random.h"

namespace prohull::render {
namespace {

struct Decoded {
  png_image header{};
  std::vector<Pixel> pixels;
};

Decoded decoded(const std::string& png) {
  Decoded image;
  image.header.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&image.header, png.data(), png.size()));
  const bool has_alpha = image.header.format & PNG_FORMAT_FLAG_ALPHA;
  image.header.format = PNG_FORMAT_RGBA;
  image.pixels.resize(std::size_t{image.header.width} * image.header.height);
  EXPECT_TRUE(png_image_finish_read(&image.header, nullptr, image.pixels.data(), 0, nullptr));
  if (!has_alpha) image.header.format = PNG_FORMAT_RGB;
  return image;
}

/// Noisy pictures compress badly.
Image gradient(int width, int height, bool opaque, float noise = 0) {
  std::mt19937 random(test_seed());
  std::uniform_real_distribution<float> unit(0, 1);
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float u = static_cast<float>(x + 1) / static_cast<float>(width), v = static_cast<float>(y) / 100;
      image.set(x, y, Rgba{{u, v + noise * unit(random), 0.5f}, 1} * (opaque ? 1 : u));
    }
  return image;
}

TEST(Image, PngKeepsEveryPixel) {
  for (const bool opaque : {true, false}) {
    const Image image = gradient(70, 50, opaque);
    const Decoded again = decoded(encode_png(image));
    EXPECT_EQ(again.header.width, 70u);
    EXPECT_EQ(again.header.height, 50u);
    EXPECT_EQ(again.header.format == PNG_FORMAT_RGB, opaque);
    EXPECT_EQ(again.pixels, image.pixels());
  }
}

TEST(Image, SmallPngKeepsFewColorsAsTheyAre) {
  for (const bool opaque : {true, false}) {
    const Image image = gradient(15, 17, opaque);
    EXPECT_EQ(decoded(encode_small_png(image)).pixels, image.pixels());
  }
}

TEST(Image, SmallPngIsSmallAndNear) {
  for (const bool opaque : {true, false}) {
    const Image image = gradient(300, 80, opaque, 0.05f);
    const std::string png = encode_small_png(image);
    EXPECT_LT(png.size(), encode_png(image).size() / 2);
    const Decoded again = decoded(png);
    EXPECT_LE(std::set(again.pixels.begin(), again.pixels.end()).size(), 256u);
    double difference = 0;
    for (std::size_t i = 0; i < again.pixels.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k) difference += std::abs(again.pixels[i][k] - image.pixels()[i][k]);
    EXPECT_LT(difference / static_cast<double>(again.pixels.size()), 16);  // of all channels together
  }
}

TEST(Image, SmallPngOfOneColor) {
  const Image image(3, 2);
  EXPECT_EQ(decoded(encode_small_png(image)).pixels, image.pixels());
}

TEST(Image, SavesLinearLightAsSrgbWithoutAlphaMultipliedIn) {
  Image image(3, 1);
  image.set(0, 0, {{1, 0, 0.2158605f}, 1});   // what sRGB calls 128
  image.set(1, 0, {{0.25f, 0.5f, 2}, 0.5f});  // brighter than white
  image.set(2, 0, {});
  EXPECT_EQ(image.at(0, 0), (Pixel{255, 0, 128, 255}));
  EXPECT_EQ(image.at(1, 0), (Pixel{188, 255, 255, 128}));
  EXPECT_EQ(image.at(2, 0), (Pixel{0, 0, 0, 0}));
}

TEST(Color, EveryCodeIsKept) {
  for (int code = 0; code < 256; ++code)
    EXPECT_NEAR(255 * srgb_of_linear(linear_of_srgb(static_cast<float>(code) / 255)), code, 0.01);
}

TEST(Color, IsParsed) {
  const auto color = parse_color("#ff0080");
  ASSERT_TRUE(color);
  EXPECT_FLOAT_EQ(color->r, 1);
  EXPECT_FLOAT_EQ(color->g, 0);
  EXPECT_NEAR(color->b, 0.2158605f, 1e-6);
  EXPECT_TRUE(parse_color("blue"));
  for (const char* wrong : {"", "#", "#ff008", "#ff00800", "ff0080", "#gg0000", "#-10000", "mauve"})
    EXPECT_FALSE(parse_color(wrong)) << wrong;
}

}  // namespace
}  // namespace prohull::render
