#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "robot/check/check.h"
#include "robot/check/disabled_pairs.h"
#include "robot/files/robot_file.h"
#include "robot/hulls/certificates.h"
#include "robot/hulls/link_hulls.h"
#include "robot/motion/motion.h"

namespace prohull::robot {

struct HashedFile {
  std::filesystem::path path;
  std::string hash;  ///< hash_of_file
};

/// All that is known about a robot, as far as it was asked for. The vectors are empty, or have an entry for each link.
struct ReportInput {
  const RobotFile& file;
  std::vector<LinkHulls> hulls;
  std::vector<LinkCheck> shipped;  ///< what the file shipped with, against its visual geometry
  std::optional<MotionResult> motion;
  double allow = 0;                  ///< as of `passes`
  double seconds = 0;                ///< of the whole run
  std::string version;               ///< of the program
  Geometry from = Geometry::Visual;  ///< LinkHullOptions::from
  std::vector<LinkCertificate> certificates = {};
  struct {
    std::filesystem::path file = {};  ///< relative to the folder of the robot; empty: there is none
    std::size_t pairs = 0;            ///< that never meet
  } motion_certificate = {};
  std::vector<DisabledCheck> disabled = {};       ///< the rows of an SRDF file
  std::vector<std::string> srdf_notes = {};       ///< as of Srdf
  std::vector<std::string> without_spheres = {};  ///< links to which planners that read the spheres are blind
  std::string date = {};                          ///< UTC, as "2026-11-27T14:05:00Z"
  std::vector<HashedFile> sources = {}, written = {};
};

/// Sets the date, that of the environment variable SOURCE_DATE_EPOCH if there is one, and the sources: the file of the
/// robot and those that it includes, the mesh files of its links with the buffers of glTF, and the others that have a
/// path.
void sign(ReportInput& input, std::initializer_list<std::filesystem::path> others = {});

/// Facts as numbers, texts and lists; docs/guides/robots.md lists the keys. Lengths are in metres. What is not known is
/// null. Texts are UTF-8: bytes of the robot's file that are not become U+FFFD.
nlohmann::json report_json(const ReportInput& input);

/// The hulls and the checks as JUnit XML, for the test reports of a CI: one test case for each link. A hull that is not
/// certified is a failure, and so is a check that does not pass with `allow`; one that was not made is an error. Rows
/// of an SRDF are test cases, too: a refuted one is a failure, and one that stays open, or names no pair, is skipped.
std::string report_junit(const ReportInput& input);

struct PageOptions {
  bool pictures = true;
  std::string view = {};  ///< URL of a page that shows the robot in three dimensions; empty: there is none
  unsigned threads = 0;
  Progress progress = {};            ///< stage "draw"
  std::filesystem::path cache = {};  ///< of HullCache; empty: all pictures are drawn
};

/// One page of HTML without any other file: pictures, tables, marks on what needs a look. Texts of the robot's file are
/// shown, never interpreted. Throws Cancelled.
std::string report_html(const ReportInput& input, const PageOptions& options = {});

}  // namespace prohull::robot
