// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/VolumeSum.h"

#include "core/boolean/Expansion.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

using namespace test;

// The determinant of three points as columns.
Expansion determinant(const Vec3& p, const Vec3& q, const Vec3& r)
{
  const auto minor = [&](int i, int j)
  { return Expansion(q[i]) * Expansion(r[j]) - Expansion(q[j]) * Expansion(r[i]); };
  return Expansion(p[0]) * minor(1, 2) + Expansion(p[1]) * minor(2, 0) +
    Expansion(p[2]) * minor(0, 1);
}

// Moved and squeezed, down to nothing but what rounding of the points leaves.
TEST(VolumeSum, IsOffByNoMoreThanItsBound)
{
  Random random(41);
  for (int round = 0; round < 60; ++round)
  {
    const double height = round % 3 == 0 ? 0.0 : std::pow(10.0, random.uniform(-18.0, 0.0));
    const Vec3 shift = random.uniform(0.0, 4.0) * random.direction();
    const Mat3 turn = random.rotation();
    TriangleMesh mesh = bumpySphere(1.0, 2);
    for (Vec3& p : mesh.points)
    {
      p = shift + turn * Vec3(p.x(), p.y(), height * p.z());
    }
    VolumeSum sum;
    Expansion exact;
    for (const Triangle& c : mesh.triangles)
    {
      const Vec3& p = mesh.points[std::size_t(c[0])];
      const Vec3& q = mesh.points[std::size_t(c[1])];
      const Vec3& r = mesh.points[std::size_t(c[2])];
      sum.add(mesh.points[0], p, q, r);
      exact += determinant(p, q, r);
    }
    const double volume = exact.value() / 6.0;
    EXPECT_LE(std::abs(sum.value() - volume), sum.rounding() + 0x1p-50 * std::abs(volume))
      << "round " << round << ", height " << height;
    EXPECT_LE(sum.rounding(), 0x1p-88);
  }
}

} // namespace
} // namespace hybridtree
