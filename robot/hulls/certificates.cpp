#include "robot/hulls/certificates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string_view>

#include "prohull/certificate.h"
#include "prohull/detail/extension.h"
#include "prohull/detail/refuse.h"
#include "prohull/mesh_io.h"
#include "robot/files/sphere_file.h"
#include "robot/link_triangles.h"
#include "robot/side_by_side.h"

namespace prohull::robot {
namespace {

using std::filesystem::path;

bool is_read_by_checkers(const path& file) {
  constexpr std::array<std::string_view, 4> kSuffixes{".stl", ".obj", ".ply", ".off"};
  return std::ranges::find(kSuffixes, lower_case_extension(file)) != kSuffixes.end();
}

/// The mesh file that has the triangles of a link but for its scale; nullptr if there is none.
const MeshFile* original_file(const Link& link, const LinkHulls& made, const LinkHullOptions& options) {
  const Shape* only = nullptr;
  for (const Shape& shape : shapes(link, options.from)) {
    if (!is_covered(shape, options.budget_of(link.name))) continue;
    if (only) return nullptr;
    only = &shape;
  }
  const MeshFile* const mesh = only ? only->mesh() : nullptr;
  if (!mesh || !is_read_by_checkers(mesh->path) || only->origin != made.frame.in_link) return nullptr;
  const Vec3& scale = mesh->scale;
  return scale.x > 0 && scale.x == scale.y && scale.y == scale.z ? mesh : nullptr;
}

Certificate certificate_of(const LinkHull& hull, const CertifiedOriginal& original, const Budget& budget) {
  if (!hull.pieces.empty()) return pieces_certificate(hull.pieces, original);
  if (!hull.balls.empty()) return balls_certificate(hull.balls, original);
  const double asked = budget.max_distance > 0 ? budget.max_distance : std::numeric_limits<double>::infinity();
  return hull_certificate(hull.mesh, original,
                          {.gap = claimed_gap(budget.padding, hull.padding),
                           .distance = claimed_distance(asked, hull.verdict.distance().upper)});
}

/// Where the robot has a mesh file that it names, from its folder.
path named_file(const path& source, const RobotFiles& files, const path& folder) {
  const auto copy = files.copies.find(source);
  return copy != files.copies.end() ? copy->second : std::filesystem::proximate(source, folder);
}

path with_suffix(const path& stem, const char* suffix) { return stem.generic_string() + suffix; }

}  // namespace

void check_certified_format(const std::string& format) {
  if (!is_read_by_checkers("hull." + format))
    refuse(fmt::format("--certificate: prohull_check reads no .{} files; choose stl or obj", format));
}

LinkCertificates link_certificates(const Robot& robot, std::span<const LinkHulls> links, const RobotFiles& written,
                                   const path& folder, const LinkHullOptions& options) {
  const std::vector<HullFiles>& hulls = written.hulls;
  std::vector<std::string> names, bytes(hulls.size());
  LinkCertificates made;
  made.certificates.resize(hulls.size());
  for (const HullFiles& files : hulls) names.push_back(robot.links[files.link].name);
  side_by_side(names, options.threads, options.progress, [&](std::size_t i, const Progress&) {
    const Link& link = robot.links[hulls[i].link];
    const LinkHulls& of_link = *std::ranges::find(links, hulls[i].link, &LinkHulls::link);
    const MeshFile* const file = original_file(link, of_link, options);
    LinkCertificate& certificate = made.certificates[i];
    certificate = {.link = hulls[i].link, .set = hulls[i].set, .hull = hulls[i].meshes};
    certificate.is_of_robot = file;
    certificate.original = file ? named_file(file->path, written, folder)
                                : path("meshes") / "original" / with_suffix(hulls[i].stem.filename(), ".ply");
    CertifiedOriginal original{of_link.triangles, file ? file->scale.x : 1};
    if (file)
      read_mesh(file->path, {.non_finite = NonFinite::Keep, .divided = &original.divided, .alone = file->alone});
    Certificate proof = certificate_of(of_link.hulls[hulls[i].set], {of_link.triangles, file ? file->scale.x : 1},
                                       options.budget_of(link.name));
    certificate.file = with_suffix(hulls[i].stem, ".phcert");
    certificate.claims = std::move(proof.claims);
    bytes[i] = std::move(proof.bytes);
  });
  std::set<path> copies;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    LinkCertificate& certificate = made.certificates[i];
    made.files.push_back(text_file(certificate.file, std::move(bytes[i])));
    const LinkHulls& of_link = *std::ranges::find(links, certificate.link, &LinkHulls::link);
    if (const std::vector<Ball>& balls = of_link.hulls[certificate.set].balls; !balls.empty()) {
      certificate.hull = {with_suffix(hulls[i].stem, ".yaml")};
      made.files.push_back(
          text_file(certificate.hull[0], sphere_file(std::array{LinkBalls{hulls[i].stem.filename().string(), balls}})));
    }
    if (!certificate.is_of_robot && copies.insert(certificate.original).second)
      made.files.push_back({certificate.original, [&mesh = of_link.triangles](const path& target) {
                              write_certified(target, finite_triangles(mesh));
                            }});
  }
  return made;
}

}  // namespace prohull::robot
