#pragma once

#include <optional>
#include <vector>

#include "render/tile.h"

namespace prohull::render {

/// How meshes are drawn, whichever they are.
struct Look {
  View view;                           ///< but for zoom and centre
  double opacity = 0.25;               ///< of a mesh around another one
  std::optional<double> crease_angle;  ///< radians; faces that meet at less look smooth, flat at 0. None: chosen by
                                       ///< whether there are so many faces that none can be seen by itself
  bool ground = false;
};

/// A segment, and where it crosses a mesh: fractions of its way.
struct MarkedSegment {
  Segment segment;
  std::vector<double> found, missed;
};

/// What a panel shows; meshes by their place in a list.
struct PanelPlan {
  std::size_t shown = 0;
  std::optional<std::size_t> inside;  ///< then `shown` is translucent
  std::optional<std::size_t> right;   ///< takes the place of the others in the right half
  Rgb color;                          ///< of `shown`
  PerFace<Rgb> face_colors;           ///< of `shown`; empty: all faces have `color`
  std::optional<Rgb> inside_color;    ///< of `inside`; none: that of clay
  double line_width = 0;              ///< of the edges of `shown`, in pixels; 0: not drawn
  std::optional<MarkedSegment> segment;
  double zoom = 1;             ///< as in View
  std::optional<Vec3> center;  ///< as in View, but in the meshes' unit
};

/// The panels side by side, the meshes as large in each as they are in the others.
std::vector<Panel> compose(const std::vector<PanelPlan>& plans, const std::vector<TriangleMesh>& meshes,
                           const Look& look, int width, int height);

}  // namespace prohull::render
