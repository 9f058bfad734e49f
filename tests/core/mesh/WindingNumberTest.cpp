// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/WindingNumber.h"

#include "core/mesh/SolidAngle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hybridtree
{
namespace
{

// Angles come as sine and cosine times any number; sums of them go around many times, both ways.
TEST(WindingNumber, SumsOfAnglesAreThoseOfTheirArcTangents)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::uniform_real_distribution<double> exponent(-330.0, 300.0);
  for (const double mean : { -3.0, -1.0, 0.0, 1.0, 3.0 })
  {
    for (int trial = 0; trial < 50; ++trial)
    {
      AngleSum angles;
      double expected = 0.0;
      for (int k = 0; k < 300; ++k)
      {
        // Every third trial near the ends, where turns are counted.
        const double a =
          trial % 3 == 0 ? std::copysign(M_PI - 1e-7 * std::abs(mean), mean) : angle(random);
        const double b = std::min(std::max(0.5 * (a + mean), -M_PI), M_PI);
        const double size = trial % 3 == 1 ? std::pow(10.0, exponent(random)) : 1.0;
        const double sine = size * std::sin(b);
        const double cosine = size * std::cos(b);
        angles.add(sine, cosine);
        expected += sine == 0.0 ? 0.0 : std::atan2(sine, cosine);
      }
      EXPECT_NEAR(angles.sum(), expected, 1e-9) << mean << ", trial " << trial;
    }
  }
}

// A soup of large triangles has nothing that is far away: all angles are summed one by one.
TEST(WindingNumber, OfASoupIsTheSumOfItsSolidAngles)
{
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto anywhere = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  TriangleMesh mesh;
  for (std::int32_t k = 0; k < 60; ++k)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      mesh.points.push_back(anywhere());
    }
    mesh.triangles.push_back({ 3 * k, 3 * k + 1, 3 * k + 2 });
  }
  const MeshBvh bvh(mesh);
  const WindingNumber winding(mesh, bvh);
  for (int k = 0; k < 500; ++k)
  {
    const Vec3 p = anywhere();
    double angle = 0.0;
    for (const Triangle& c : mesh.triangles)
    {
      angle += solidAngle(mesh.points[std::size_t(c[0])], mesh.points[std::size_t(c[1])],
        mesh.points[std::size_t(c[2])], p);
    }
    // Small triangles far away count as dipoles, to a hundredth.
    EXPECT_NEAR(winding.at(p), angle / kFullSolidAngle, 0.01);
  }
}

} // namespace
} // namespace hybridtree
