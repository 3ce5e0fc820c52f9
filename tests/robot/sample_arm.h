#pragma once

#include <vector>

#include "prohull/convex_hull.h"
#include "prohull/hull_builder.h"
#include "robot/files/robot_file.h"
#include "robot/samples/sample_robots.h"

namespace prohull::robot {

/// Coarse hulls around the convex hulls of the sample arm's visual meshes.
struct Arm {
  Arm() {
    const SampleRobot sample = make_sample_robot("arm");
    robot = read_robot(sample.urdf, "arm.urdf").robot;
    for (const Link& link : robot.links) {
      TriangleMesh all;
      for (const Shape& shape : link.visual)
        for (const auto& [path, mesh] : sample.meshes)
          if (shape.mesh() && shape.mesh()->uri.ends_with(path)) append(all, placed(shape.origin, mesh));
      links.push_back(build_hull(convex_hull(all), {.target_faces = 60}).hull.base());
    }
  }

  Robot robot;
  std::vector<TriangleMesh> links;
};

}  // namespace prohull::robot
