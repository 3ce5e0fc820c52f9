#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "prohull/progress.h"
#include "robot/hulls/write_robot.h"

namespace prohull::robot {

/// A certificate of a hull, of convex pieces or of spheres (docs/certificate.md). Paths are relative to the folder of
/// the robot.
struct LinkCertificate {
  std::size_t link = 0, set = 0;  ///< as HullFiles
  std::filesystem::path file = {};
  std::vector<std::filesystem::path> hull = {};
  std::filesystem::path original = {};
  bool is_of_robot = false;  ///< the original is the mesh file that the robot names, and no copy
  std::vector<std::string> claims = {};
};

struct LinkCertificates {
  std::vector<LinkCertificate> certificates;  ///< one for each of RobotFiles::hulls
  std::vector<OutputFile> files;              ///< the certificates, and what they are about beside hulls
};

/// Throws InputError(InvalidOption) if the hulls are to be files that a checker does not read.
void check_certified_format(const std::string& format);

/// Certificates of the hulls of output_files. Each is about the mesh file of its link, or its copy in the package, if
/// that is a single one that a checker reads, is scaled by the same positive number along all axes, and has the frame
/// of the hull. All others are about meshes/original/LINK.ply, which is among the files: the finite triangles of the
/// link, as they were read, scaled and moved. Nothing but this program says that these are those of the robot. Spheres
/// become meshes/collision/LINK.yaml, with the numbers that the robot has.
///
/// `links` must outlive the result. Throws Cancelled.
LinkCertificates link_certificates(const Robot& robot, std::span<const LinkHulls> links, const RobotFiles& written,
                                   const std::filesystem::path& folder, const LinkHullOptions& options);

}  // namespace prohull::robot
