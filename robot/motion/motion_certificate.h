#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "robot/motion/pair_proof.h"
#include "robot/motion/path_bodies.h"
#include "robot/motion/path_proof.h"

namespace prohull::robot {

/// What a certificate of motion says of a body: docs/certificate.md.
struct CertifiedBody {
  std::string name;
  std::optional<std::size_t> link;  ///< that moves it; none: of the world
  Pose in_link = {};                ///< where the frame of its triangles is in that of the link
  /// A binary STL file that holds all of its triangles, as seen from the certificate; empty: `triangles` are written.
  std::filesystem::path stl = {};
  TriangleMesh triangles = {};
};

struct MotionCertificate {
  std::string text;
  std::size_t pairs = 0;  ///< that it is about
};

/// About those of the pairs that are proven never to meet, and have trees. `bodies` has one of each link of these.
MotionCertificate pairs_certificate(const Robot& robot, std::span<const std::optional<CertifiedBody>> bodies,
                                    std::span<const PairProof> proofs);

/// Bodies of a path, for a certificate in this folder. Mesh files are named where they have all triangles as they are.
std::vector<CertifiedBody> certified_bodies(std::span<const PathBody> bodies, const std::filesystem::path& folder);

/// About those of the pairs that are proven to be apart by more than the gap all along the path, and have trees.
/// `bodies` are those of the path.
MotionCertificate path_certificate(const Robot& robot, const JointPath& path, double gap,
                                   std::span<const CertifiedBody> bodies, const PathProof& proof);

}  // namespace prohull::robot
