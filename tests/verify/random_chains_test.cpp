#include <gtest/gtest.h>

#include "effort.h"
#include "prohull/enclosure.h"
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

    const bool truth = oracle::encloses(inner, outer, random);
    ASSERT_EQ(verify_enclosure(inner, outer).encloses, truth) << "chain " << enclosed + rejected;
    ASSERT_TRUE(truth || !grows);
    const bool reverse = oracle::encloses(outer, inner, random);
    ASSERT_EQ(verify_enclosure(outer, inner).encloses, reverse) << "reverse of chain " << enclosed + rejected;
    ++(truth ? enclosed : rejected);
  }
  std::printf("%d enclosed, %d not\n", enclosed, rejected);
  EXPECT_GT(enclosed, 0);
}

}  // namespace
}  // namespace prohull
