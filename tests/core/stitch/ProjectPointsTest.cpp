// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/ProjectPoints.h"

#include "tests/support/FunctionField.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <numeric>

namespace hybridtree::test
{
namespace
{

/// What stays off the surface must be told: a patch would take it for a point on it.
TEST(ProjectPoints, TellsWhatStaysOffTheSurface)
{
  constexpr double kReach = 0.1;
  const FunctionField ball([](const Vec3& p) { return kThreshold + 1.0 - p.norm(); }, 1.0);
  Random random(11);
  TriangleMesh mesh;
  for (int k = 0; k < 300; ++k)
  {
    const Vec3 up = random.direction();
    mesh.points.push_back(random.uniform(0.6, 1.4) * up);
    mesh.normals.push_back(up);
  }
  const TriangleMesh before = mesh;
  std::vector<std::size_t> all(mesh.points.size());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<char> found = projectPoints(ball, all, kReach, mesh);
  ASSERT_EQ(found.size(), all.size());
  std::ptrdiff_t stayed = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    const double off = std::abs(before.points[k].norm() - 1.0);
    if (found[k])
    {
      EXPECT_NEAR(mesh.points[k].norm(), 1.0, 1e-4 * kReach);
      EXPECT_LT(off, 2.01 * kReach);
    }
    else
    {
      EXPECT_EQ(mesh.points[k], before.points[k]);
      EXPECT_GT(off, 1.7 * kReach);
      ++stayed;
    }
  }
  EXPECT_GT(stayed, 100);
  EXPECT_LT(stayed, 200);
}

} // namespace
} // namespace hybridtree::test
