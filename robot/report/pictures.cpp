#include "robot/report/pictures.h"

#include <memory>
#include <numbers>

#include "prohull/detail/finite.h"
#include "prohull/error.h"
#include "render/draw.h"
#include "render/marks.h"
#include "robot/hulls/cache.h"

namespace prohull::robot {
namespace {

using render::Rgb;

constexpr double kDegree = std::numbers::pi / 180;

/// Where all pictures of a thing are drawn: its box, the side from which it is seen, and the camera.
class Stage {
 public:
  Stage(std::span<const Picture> pictures, const PictureOptions& options)
      : placed_(box_of(pictures)), camera_(camera(pictures, options)) {}

  const render::Placement& placed() const { return placed_; }
  const render::Camera& camera() const { return camera_; }

 private:
  static Box box_of(std::span<const Picture> pictures) {
    Box box;
    for (const Picture& picture : pictures)
      for (const TriangleMesh* mesh : {&picture.inside, &picture.around}) box.extend(bounding_box(*mesh));
    return box;
  }

  /// A quarter turn at a time, so that parts stand to the viewer as they do in other pictures.
  render::View view(std::span<const Picture> pictures) const {
    render::View best;
    const auto marked = std::ranges::find_if(pictures, [](const Picture& p) { return p.marked.has_value(); });
    if (marked == pictures.end()) return best;
    const Vec3 target = placed_(*marked->marked);
    for (const double turn : {90., 180., 270.}) {
      render::View view;
      view.azimuth += turn * kDegree;
      if (dot(target, render::ViewAxes(view).back) > dot(target, render::ViewAxes(best).back)) best = view;
    }
    return best;
  }

  render::Camera camera(std::span<const Picture> pictures, const PictureOptions& options) const {
    std::vector<Vec3> points;
    for (const Picture& picture : pictures)
      for (const TriangleMesh* mesh : {&picture.inside, &picture.around})
        for (const Vec3& p : mesh->positions) points.push_back(placed_(p));
    return {view(pictures), points, options.width, options.height};
  }

  render::Placement placed_;
  render::Camera camera_;
};

void add(render::Scene& scene, TriangleMesh mesh, double crease_angle, const render::Material& material) {
  if (mesh.face_count() > 0)
    scene.surfaces.push_back({std::make_shared<const render::Body>(std::move(mesh), crease_angle), material});
}

render::Scene scene_of(const Picture& picture, const render::Placement& placed, bool lines) {
  constexpr double kSmooth = 40 * kDegree, kFlat = 0, kBallRadius = 0.018;
  const Rgb grey = *render::parse_color("grey"), red = *render::parse_color("red");
  const Rgb shell = *render::parse_color(picture.shell == Shell::Hull ? "blue" : "orange");
  render::Scene scene;
  add(scene, placed(picture.inside), kSmooth, {.color = grey});
  add(scene, placed(picture.around), kFlat, {.color = shell, .opacity = 0.3, .line_width = lines ? 0.6 : 0});
  if (picture.marked)
    add(scene, render::ball(placed(*picture.marked), kBallRadius), kSmooth, {.color = red, .through = 0.4});
  return scene;
}

std::string drawn(const Picture& picture, const Stage& stage, const PictureOptions& options, const Progress& progress) {
  if (picture.inside.face_count() + picture.around.face_count() == 0) return {};
  constexpr int kSamples = 2;
  const std::vector<render::Panel> panels{
      {scene_of(picture, stage.placed(), options.lines), stage.camera(), {0, 0, options.width, options.height}}};
  return encode_small_png(render::draw(
      options.width, options.height, panels,
      {.samples = kSamples, .background = {}, .threads = static_cast<int>(options.threads), .progress = progress}));
}

std::vector<Picture> drawable(std::span<const Picture> pictures) {
  std::vector<Picture> result;
  for (const Picture& p : pictures) {
    result.push_back({finite_part(p.inside), finite_part(p.around), p.shell, p.marked});
    if (p.marked && !is_finite(*p.marked)) result.back().marked.reset();
  }
  return result;
}

/// The progress of one of several pictures.
Progress part_of(const Progress& progress, std::size_t picture, std::size_t count) {
  if (!progress) return {};
  return [&progress, picture, count](std::string_view, double fraction) {
    return progress("draw", (static_cast<double>(picture) + fraction) / static_cast<double>(count));
  };
}

/// What all of them look like; which of them is asked for is to be added.
Fingerprint fingerprint_of(std::span<const Picture> pictures, const PictureOptions& options) {
  Fingerprint key;
  key.add(program_fingerprint());
  for (const int size : {options.width, options.height}) key.add(std::size_t(size));
  key.add(std::size_t(options.lines));
  for (const Picture& picture : pictures) {
    key.add(picture.inside), key.add(picture.around), key.add(std::size_t(picture.shell));
    key.add(std::size_t(picture.marked.has_value()));
    for (int axis = 0; picture.marked && axis < 3; ++axis) key.add((*picture.marked)[axis]);
  }
  return key;
}

}  // namespace

std::vector<std::string> draw_pictures(std::span<const Picture> pictures, const PictureOptions& options) {
  const std::vector<Picture> shown = drawable(pictures);
  std::vector<std::string> files(shown.size());
  try {
    const HullCache cache(options.cache);
    Fingerprint key = fingerprint_of(shown, options);
    std::optional<Stage> stage;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      key.add(i);
      const std::string own = key.text();
      if (auto known = cache.find_picture(own)) {
        files[i] = std::move(*known);
        continue;
      }
      if (!stage) stage.emplace(shown, options);
      files[i] = drawn(shown[i], *stage, options, part_of(options.progress, i, shown.size()));
      if (!files[i].empty()) cache.keep_picture(own, files[i]);
    }
  } catch (const InputError&) {
    // Nothing of any extent. What could not be drawn is missing, which is no reason to lose a report.
  }
  return files;
}

}  // namespace prohull::robot
