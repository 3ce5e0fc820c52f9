#include "robot/files/link_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "prohull/convex_hull.h"
#include "prohull/detail/rounded.h"
#include "prohull/error.h"
#include "robot/link_triangles.h"

namespace prohull::robot {
namespace {

class PieceReader {
 public:
  explicit PieceReader(const RobotFile& file) : file_(file) {}

  LinkPieces read(const Link& link) {
    for (const Shape& shape : link.collision) add(shape);
    if (smaller_boxes_ > 0)
      pieces_.notes.push_back(
          fmt::format("{}: boxes whose corners have no exact coordinates: {}; they count as "
                      "smaller by up to {:.2g}",
                      file_.path.string(), smaller_boxes_, rounded_up(largest_margin_, 2)));
    return std::move(pieces_);
  }

 private:
  [[noreturn]] void refuse(const Shape& shape, const std::string& why) const {
    throw InputError(Defect::InvalidOption, fmt::format("{}: line {}: {}", file_.path.string(), shape.line, why));
  }

  void add(const Shape& shape) {
    if (const auto* const other = std::get_if<OtherForm>(&shape.form))
      refuse(shape, fmt::format("a {} is not read, so that nothing tells what it covers", other->what));
    if (std::holds_alternative<CylinderForm>(shape.form) || std::holds_alternative<CapsuleForm>(shape.form))
      refuse(shape,
             "cylinders and capsules are not decided exactly; make the pieces with --shape polytope, box or "
             "sphere, or ask `prohull urdf ROBOT --check` about the robot");
    if (const auto* const sphere = std::get_if<SphereForm>(&shape.form))
      pieces_.balls.push_back({shape.origin.translation, sphere->radius});
    else if (const auto* const box = std::get_if<BoxForm>(&shape.form))
      pieces_.meshes.push_back(box_of(*box, shape));
    else
      pieces_.meshes.push_back(mesh_of(shape));
  }

  TriangleMesh mesh_of(const Shape& shape) const {
    TriangleMesh mesh = mesh_triangles(*shape.mesh());
    if (mesh.face_count() == 0) refuse(shape, fmt::format("{} has no triangles", shape.mesh()->uri));
    if (!is_exact(mesh, shape.origin))
      refuse(shape, fmt::format("the origin of {} rounds its coordinates, so that nothing exact can be said; move the "
                                "mesh itself, or ask `prohull urdf ROBOT --check` about the robot",
                                shape.mesh()->uri));
    return placed(shape.origin, std::move(mesh));
  }

  static bool is_exact(const TriangleMesh& mesh, const Pose& pose) {
    if (pose == Pose{}) return true;
    if (pose.rotation != Pose{}.rotation) return false;
    const Vec3& t = pose.translation;
    return std::ranges::all_of(mesh.positions, [&](const Vec3& p) {
      return is_exact_sum(p.x, t.x) && is_exact_sum(p.y, t.y) && is_exact_sum(p.z, t.z);
    });
  }

  /// Within the box. Entries of the rotation are wrong by less than 2^-49, sums and products add as much, so that a
  /// corner is wrong by less than the margin; seen from the box too, where each of its coordinates is smaller by that.
  TriangleMesh box_of(const BoxForm& box, const Shape& shape) {
    const Pose& pose = shape.origin;
    const TriangleMesh exact = form_mesh(box, Curved::Around);
    if (is_exact(exact, pose)) return placed(pose, exact);
    const double margin = 0x1p-44 * (norm(box.size) + norm(pose.translation));
    const Vec3 size = box.size - Vec3{2 * margin, 2 * margin, 2 * margin};
    ++smaller_boxes_, largest_margin_ = std::max(largest_margin_, margin);
    if (!(size.x > 0 && size.y > 0 && size.z > 0))
      refuse(shape, "this box is thinner than the rounding of its coordinates");
    return convex_hull(placed(pose, form_mesh(BoxForm{size}, Curved::Around)));
  }

  const RobotFile& file_;
  LinkPieces pieces_;
  std::size_t smaller_boxes_ = 0;
  double largest_margin_ = 0;
};

}  // namespace

LinkPieces link_pieces(const RobotFile& file, const Link& link) { return PieceReader(file).read(link); }

}  // namespace prohull::robot
