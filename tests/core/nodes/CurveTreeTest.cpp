// SPDX-License-Identifier: BSD-3-Clause
// Curves as one tree: leaves, radii, memory.
#include "core/nodes/CurveTree.h"

#include "core/base/Error.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <utility>
#include <vector>

// AddressSanitizer has an allocator of its own, which mallinfo2 does not see.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define HYBRIDTREE_SEES_MEMORY
#include <malloc.h>
#endif

namespace hybridtree::test
{
namespace
{

CurveTreeOptions options()
{
  return { Potential::bySurfaceRadius(0.1, 0.25, 2), true, 4 };
}

std::vector<SplineCurve> coil(int curves)
{
  const auto at = [](double k) { return Vec3(std::cos(0.15 * k), std::sin(0.15 * k), 0.01 * k); };
  std::vector<SplineCurve> result;
  for (int k = 0; k < curves; ++k)
  {
    result.push_back({ { at(2 * k), at(2 * k + 1), at(2 * k + 2) }, {}, SplineKind::CatmullRom });
  }
  return result;
}

TEST(CurveTree, EachCurveIsALeaf)
{
  Random random(51);
  std::vector<SplineCurve> curves = coil(20);
  curves.push_back({ { Vec3(3, 0, 0) } });
  curves.push_back({ { Vec3(3, 0, 0), Vec3(3, 1, 0) }, { 0.2, 0.0 }, SplineKind::Polyline });
  for (const bool across : { false, true })
  {
    CurveTreeOptions how = options();
    how.blendAcross = across;
    const NodePtr tree = makeCurveTree(curves, how);
    EXPECT_EQ(tree->leafCount(), int(curves.size()));
    // The curve that tapers to a point: on its surface half way along, and at its tip.
    const double x[4] = { 3.0999, 3.1001, 3.0, 3.0 };
    const double y[4] = { 0.5, 0.5, 0.9999, 1.0001 };
    const double z[4] = { 0.0, 0.0, 0.0, 0.0 };
    std::int8_t side[4];
    const NodePtr cone = makeCurveTree({ curves.back() }, how);
    cone->membership({ x, y, z, 4 }, side);
    EXPECT_EQ(side[2], 1);
    EXPECT_EQ(side[3], -1);
    EXPECT_EQ(side[0], 1); // the ball of half the radius lies across the slope
  }
}

TEST(CurveTree, BadCurvesAreNamed)
{
  std::vector<SplineCurve> curves = coil(3);
  curves[2].radii = { 0.1, -0.1, 0.1 };
  try
  {
    makeCurveTree(curves, options());
    FAIL();
  }
  catch (const InvalidGeometry& error)
  {
    EXPECT_NE(std::string(error.what()).find("Curve 2"), std::string::npos) << error.what();
  }
  EXPECT_THROW(makeCurveTree({}, options()), InvalidParameter);
  curves[2].radii = { 0.0, 0.0, 0.0 };
  EXPECT_THROW(makeCurveTree(curves, options()), InvalidGeometry);
}

// [HT] 6.3 has 64 KiB for the parameters of 250 spline primitives; here they are nodes and
// skeletons.
#ifdef HYBRIDTREE_SEES_MEMORY
TEST(CurveTree, HundredsOfSplinesAreSmall)
{
  const std::vector<SplineCurve> curves = coil(250);
  std::vector<NodePtr> trees{ makeCurveTree(curves, options()) }; // warms what a thread keeps
  std::size_t bytes = std::numeric_limits<std::size_t>::max();
  for (int k = 0; k < 3; ++k) // the least: the allocator also hands out blocks that are too large
  {
    const std::size_t before = mallinfo2().uordblks;
    NodePtr tree = makeCurveTree(curves, options());
    bytes = std::min(bytes, mallinfo2().uordblks - before);
    trees.push_back(std::move(tree));
  }
  EXPECT_GT(bytes, 0u);
  std::cout << "250 spline primitives: " << bytes << " bytes\n";
  EXPECT_LT(bytes, 64u * 1024u);
}
#endif

} // namespace
} // namespace hybridtree::test
