#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "prohull/enclosure.h"
#include "prohull/error.h"
#include "random.h"
#include "robot/link_triangles.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Point = std::array<Rational, 3>;

Point exact(const Vec3& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Whether the plane of a face leaves a ball wholly behind it, touching allowed.
bool keeps_off(const Triangle& face, const Point& center, double radius) {
  const Point a = exact(face.a), normal = cross(minus(exact(face.b), a), minus(exact(face.c), a));
  const Rational height = dot(normal, minus(a, center));
  return height >= 0 && height * height >= Rational(radius) * Rational(radius) * dot(normal, normal);
}

/// Whether the plane of a face leaves a disk wholly behind it that is parallel to the xy plane.
bool keeps_off_disk(const Triangle& face, double z, double radius) {
  const Point a = exact(face.a), normal = cross(minus(exact(face.b), a), minus(exact(face.c), a));
  const Rational height = dot(normal, minus(a, {Rational(0), Rational(0), Rational(z)}));
  return height >= 0 &&
         height * height >= Rational(radius) * Rational(radius) * (normal[0] * normal[0] + normal[1] * normal[1]);
}

template <class Test>
void expect_of_faces(const TriangleMesh& mesh, Test test) {
  for (const FaceId f : mesh.triangles.ids()) EXPECT_TRUE(test(mesh.triangle(f))) << "face " << index(f);
}

constexpr std::array<std::size_t, 4> kSegments{8, 9, 13, 32};
const std::vector<Form> kForms{SphereForm{1},           SphereForm{0.1},         CylinderForm{0.3, 2},
                               CylinderForm{1e-3, 1e3}, CylinderForm{1e3, 1e-3}, CapsuleForm{0.1, 0.7},
                               CapsuleForm{1e-4, 5e2},  CapsuleForm{0.33, 1e-9}, CapsuleForm{1.0 / 3, 0}};

TEST(FormMesh, OfABoxIsTheBox) {
  const TriangleMesh box = form_mesh(BoxForm{{0.1, 0.2, 0.3}}, Curved::Around);
  EXPECT_EQ(box.face_count(), 12U);
  EXPECT_EQ(bounding_box(box).max, (Vec3{0.05, 0.1, 0.15}));
  EXPECT_EQ(bounding_box(box).min, (Vec3{-0.05, -0.1, -0.15}));
  EXPECT_NEAR(signed_volume(box), 0.006, 1e-15);
  EXPECT_EQ(form_mesh(BoxForm{{0.1, 0.2, 0.3}}, Curved::Within), box);
}

TEST(FormMesh, IsClosedOutwardsAndFreeOfSelfIntersection) {
  for (const Form& form : kForms)
    for (const Curved curved : {Curved::Around, Curved::Within})
      for (const std::size_t segments : kSegments) {
        const TriangleMesh mesh = form_mesh(form, curved, segments);
        EXPECT_TRUE(is_closed(mesh));
        EXPECT_GT(signed_volume(mesh), 0);
        EXPECT_EQ(count_self_intersections(mesh), 0U) << "form " << form.index() << ", " << segments;
      }
}

TEST(FormMesh, AroundLeavesTheFormBehindEveryFace) {
  for (const std::size_t segments : kSegments)
    for (const Form& form : kForms) {
      const TriangleMesh mesh = form_mesh(form, Curved::Around, segments);
      expect_of_faces(mesh, [&](const Triangle& face) {
        if (const auto* sphere = std::get_if<SphereForm>(&form)) return keeps_off(face, exact({}), sphere->radius);
        if (const auto* capsule = std::get_if<CapsuleForm>(&form))
          return keeps_off(face, exact({0, 0, capsule->length / 2}), capsule->radius) &&
                 keeps_off(face, exact({0, 0, -capsule->length / 2}), capsule->radius);
        const auto& cylinder = std::get<CylinderForm>(form);
        return keeps_off_disk(face, cylinder.length / 2, cylinder.radius) &&
               keeps_off_disk(face, -cylinder.length / 2, cylinder.radius);
      });
    }
}

TEST(FormMesh, WithinHasAllVerticesInTheForm) {
  for (const std::size_t segments : kSegments)
    for (const Form& form : kForms)
      for (const Vec3& p : form_mesh(form, Curved::Within, segments).positions) {
        const Rational x(p.x), y(p.y), z(p.z);
        if (const auto* cylinder = std::get_if<CylinderForm>(&form)) {
          EXPECT_LE(x * x + y * y, Rational(cylinder->radius) * Rational(cylinder->radius));
          EXPECT_LE(abs(z) * 2, Rational(cylinder->length));
          continue;
        }
        const auto* capsule = std::get_if<CapsuleForm>(&form);
        const Rational radius(capsule ? capsule->radius : std::get<SphereForm>(form).radius),
            above = abs(z) - Rational(capsule ? capsule->length / 2 : 0);
        EXPECT_LE(x * x + y * y + (above > 0 ? above * above : Rational(0)), radius * radius);
      }
}

TEST(FormMesh, HasTheVolumeOfTheForm) {
  const auto ball = [](double r) { return 4 * std::numbers::pi / 3 * r * r * r; };
  const auto tube = [](double r, double length) { return std::numbers::pi * r * r * length; };
  const std::vector<std::pair<Form, double>> kVolumes{{SphereForm{0.5}, ball(0.5)},
                                                      {CylinderForm{0.75, 1}, tube(0.75, 1)},
                                                      {CylinderForm{1e-3, 1e3}, tube(1e-3, 1e3)},
                                                      {CapsuleForm{0.1, 0.7}, ball(0.1) + tube(0.1, 0.7)}};
  for (const auto& [form, volume] : kVolumes)
    for (const std::size_t segments : kSegments)
      EXPECT_NEAR(signed_volume(form_mesh(form, Curved::SameVolume, segments)), volume, 1e-12 * volume);
  EXPECT_EQ(signed_volume(form_mesh(SphereForm{0}, Curved::SameVolume)), 0);
}

TEST(FormMesh, ComesCloserWithMoreSegments) {
  for (const Form& form : kForms) {
    const double coarse = signed_volume(form_mesh(form, Curved::Around, 16)) -
                          signed_volume(form_mesh(form, Curved::Within, 16)),
                 fine = signed_volume(form_mesh(form, Curved::Around, 64)) -
                        signed_volume(form_mesh(form, Curved::Within, 64));
    EXPECT_GT(fine, 0);
    EXPECT_LT(fine, coarse / 8);
  }
}

TEST(FormMesh, NeedsEightSegmentsAndAForm) {
  EXPECT_THROW(form_mesh(SphereForm{1}, Curved::Around, 7), InputError);
  EXPECT_THROW(form_mesh(MeshFile{}, Curved::Around), InputError);
}

Pose any_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-3, 3);
  return pose_of_rpy({any(random), any(random), any(random)}, {any(random), any(random), any(random)});
}

// The exact test agrees with meshes on both sides of the surface, wherever a pose puts them.
TEST(CurvedForm, LiesBetweenItsMeshesInEveryPose) {
  std::mt19937 random(test_seed());
  for (const Form& form : kForms)
    for (int i = 0; i < 4; ++i) {
      const Pose pose = any_pose(random);
      const CurvedForm curved = *curved_form(form, pose);
      for (const Vec3& p : curved.mesh(Curved::Within, 16).positions) EXPECT_TRUE(curved.contains(p));
      // The corners on the axis of a cylinder are outside by the margin alone, and so are those in the middle of faces.
      const TriangleMesh around = curved.mesh(Curved::Around, 16);
      for (const Vec3& p : around.positions) EXPECT_FALSE(curved.contains(p));
      for (const FaceId f : around.triangles.ids()) {
        const Triangle t = around.triangle(f);
        EXPECT_FALSE(curved.contains(t.a / 3 + t.b / 3 + t.c / 3)) << "face " << index(f);
      }
    }
}

TEST(CurvedForm, IsExactOnItsSurface) {
  const CurvedForm sphere = *curved_form(SphereForm{5}), cylinder = *curved_form(CylinderForm{5, 2}),
                   capsule = *curved_form(CapsuleForm{5, 2});
  const double beyond = std::nextafter(4.0, 5.0);
  EXPECT_TRUE(sphere.contains({3, 4, 0}));
  EXPECT_FALSE(sphere.contains({3, beyond, 0}));
  EXPECT_FALSE(sphere.contains({3, 4, 1e-300})) << "its square is less than any double";
  EXPECT_TRUE(cylinder.contains({3, 4, 1}));
  EXPECT_FALSE(cylinder.contains({3, 4, std::nextafter(1.0, 2.0)}));
  EXPECT_FALSE(cylinder.contains({3, beyond, 0}));
  EXPECT_TRUE(capsule.contains({3, 0, 5}));
  EXPECT_TRUE(capsule.contains({3, 0, -5}));
  EXPECT_FALSE(capsule.contains({3, 0, std::nextafter(5.0, 6.0)}));
  EXPECT_TRUE(capsule.contains({3, 4, 1}));
  EXPECT_FALSE(capsule.contains({3, beyond, 0}));
}

TEST(CurvedForm, TellsItsDistance) {
  const Pose pose = pose_of_rpy({1, 2, 3}, {4, 5, 6});
  const auto at = [&](const Form& form, const Vec3& p) { return curved_form(form, pose)->distance(placed(pose, p)); };
  const std::vector<std::tuple<Form, Vec3, double>> cases{{SphereForm{1}, {0, 3, 4}, 4},
                                                          {CapsuleForm{1, 2}, {0, 3, 5}, 4},
                                                          {CylinderForm{1, 2}, {4, 0, 5}, 5},
                                                          {CylinderForm{1, 2}, {4, 0, 1}, 3},
                                                          {CylinderForm{1, 2}, {0, 0, 0.5}, 0}};
  for (const auto& [form, p, distance] : cases) {
    EXPECT_LE(at(form, p).lower, distance);
    EXPECT_GE(at(form, p).upper, distance);
    EXPECT_NEAR(at(form, p).lower, at(form, p).upper, 1e-10);
  }
}

}  // namespace
}  // namespace prohull::robot
