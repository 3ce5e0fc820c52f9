#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "robot/motion/path_proof.h"
#include "view/page.h"

namespace prohull::view {

/// A path, and what prove_paths found of it with PathProofOptions::distances: all but the verdict. `bodies` are those
/// that were asked for.
ShownMotion shown_motion(const robot::JointPath& path, const robot::PathProof& proof,
                         std::span<const robot::PathBody> bodies);

/// The motion as web/src/act/motion.js reads it.
nlohmann::json motion_facts(const ShownMotion& motion);

}  // namespace prohull::view
