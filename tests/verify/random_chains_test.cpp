#include <gtest/gtest.h>

#include "effort.h"
#include "prohull/enclosure.h"
#include "prohull/verification.h"
#include "random.h"
#include "verify/oracle.h"
#include "verify/random_chains.h"

namespace prohull {
namespace {

TEST(Enclosure, AgreesWithBruteForceOnRandomChains) {
  RandomChains chains(test_seed());
  std::mt19937 random(test_seed());
  int enclosed = 0, rejected = 0;
  while (enclosed + rejected < effort(16, 6) || rejected == 0) {  // nine in ten enclose
    TriangleMesh inner, outer;
    for (int n = chains.uniform(1, 2); n > 0; --n) chains.add_tetrahedron(inner);
    if (inner.triangles.empty()) continue;
    if (chains.uniform(0, 2) == 0) chains.split_face(inner, false);
    outer = inner;
    const bool grows = chains.uniform(0, 1);
    if (chains.uniform(0, 2) == 0) chains.add_tetrahedron(outer);
    for (int n = chains.uniform(0, 3); n > 0; --n) chains.split_face(outer, true);
    if (!grows) chains.split_face(outer, false);
    if (signed_volume(inner) < 0.1 || signed_volume(outer) < 0.1) continue;  // would be turned

    const bool truth = oracle::Chain(inner).is_enclosed_by(oracle::Chain(outer), random);
    ASSERT_EQ(verify_enclosure(inner, outer).encloses, truth) << "chain " << enclosed + rejected;
    ASSERT_TRUE(truth || !grows);
    const bool reverse = oracle::Chain(outer).is_enclosed_by(oracle::Chain(inner), random);
    ASSERT_EQ(verify_enclosure(outer, inner).encloses, reverse) << "reverse of chain " << enclosed + rejected;
    ++(truth ? enclosed : rejected);
  }
  std::printf("%d enclosed, %d not\n", enclosed, rejected);
  EXPECT_GT(enclosed, 0);
}

/// verify_hull looks only at triangles beside the solid of the original, after the solid; here all are looked at.
TEST(VerifyHull, SaysWhatTheTwoProofsSayTogether) {
  RandomChains chains(test_seed());
  int yes = 0, solid_only = 0, no = 0;
  for (int i = 0; i < effort(400, 100); ++i) {
    TriangleMesh original, hull;
    for (int n = chains.uniform(1, 3); n > 0; --n) chains.add_tetrahedron(original);
    if (original.triangles.empty()) continue;
    for (int n = chains.uniform(0, 2); n > 0; --n) chains.split_face(original, false);
    hull = original;
    for (int n = chains.uniform(0, 4); n > 0; --n) chains.split_face(hull, chains.uniform(0, 9) > 0);
    if (chains.uniform(0, 1)) hull = meshes::together(hull, meshes::box({0, 0, 0}, {3, 3, 3}));
    if (signed_volume(original) < 0.1 || turned_outwards(original) != original || turned_outwards(hull) != hull)
      continue;
    const bool solid = verify_enclosure(original, hull).encloses, all = verify_cover(original, hull).encloses;
    const Verification found = verify_hull(hull, original);
    ASSERT_EQ(found.encloses, solid && all) << "chain " << i << ": " << found.why_not;
    ASSERT_EQ(found.why_not.empty(), found.encloses);
    ASSERT_EQ(verify_hull(hull, original, HullSide::Outer, {.solid_only = true}).encloses, solid) << "chain " << i;
    const bool reverse = verify_enclosure(hull, original).encloses && verify_cover(hull, original).encloses;
    ASSERT_EQ(verify_hull(hull, original, HullSide::Inner).encloses, reverse) << "chain " << i;
    ++(found.encloses ? yes : solid ? solid_only : no);
  }
  std::printf("%d enclose, %d only the solid, %d not\n", yes, solid_only, no);
  EXPECT_GT(yes, 0);
  EXPECT_GT(solid_only, 0);
  EXPECT_GT(no, 0);
}

}  // namespace
}  // namespace prohull
