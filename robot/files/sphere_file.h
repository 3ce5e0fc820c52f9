#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "prohull/detail/shapes.h"

namespace prohull::robot {

/// The spheres of a link, in the frame of the link; metres.
struct LinkBalls {
  std::string link;
  std::vector<Ball> balls;
  std::size_t switched_off = 0;  ///< spheres of a radius of 0 or less in a file that was read; they are left out
};

// Texts of YAML. A number reads back as the same double, in Python too; `yaml_quoted` throws InputError(InvalidOption)
// for names that are not UTF-8.
std::string yaml_decimal(double number);
std::string yaml_quoted(const std::string& name);
std::string yaml_ball(const Ball& ball);  ///< {center: [x, y, z], radius: r}

/// The YAML file of collision spheres that cuRobo reads: collision_spheres: {LINK: [{center: [x, y, z], radius: r}]}.
/// Numbers read back as the same doubles, in Python too. Throws InputError(InvalidOption) for names that are not UTF-8.
std::string sphere_file(std::span<const LinkBalls> links);

/// Reads the same, and what curobo_file has of it; other keys beside collision_spheres are ignored. Spheres of a radius
/// of 0 or less, which switch a sphere off in cuRobo, are left out. Throws InputError with `path` and the line for
/// anything else.
std::vector<LinkBalls> read_sphere_file(const std::string& text, const std::filesystem::path& path);

/// The JSON file of the spheres of one link: {"link": LINK, "spheres": [{"center": [x, y, z], "radius": r}]}. Numbers
/// read back as the same doubles. Throws InputError(InvalidOption) for names that are not UTF-8.
std::string sphere_json(const LinkBalls& link);

/// Reads the same; other keys are ignored, and spheres of a radius of 0 or less are left out. Throws InputError with
/// `path` for anything else.
LinkBalls read_sphere_json(const std::string& text, const std::filesystem::path& path);

}  // namespace prohull::robot
