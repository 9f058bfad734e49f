// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/WindingNumber.h"

#include "tests/support/SolidAngles.h"

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

class Soup
{
public:
  explicit Soup(std::uint64_t seed) : random_(seed) {}

  Vec3 anywhere() { return { unit_(random_), unit_(random_), unit_(random_) }; }

  // Their corners are as far as `reach` from their middles.
  TriangleMesh triangles(std::int32_t count, double reach)
  {
    TriangleMesh mesh;
    for (std::int32_t k = 0; k < count; ++k)
    {
      const Vec3 middle = this->anywhere();
      for (int corner = 0; corner < 3; ++corner)
      {
        mesh.points.push_back(middle + reach * (this->anywhere() - Vec3::Constant(0.5)));
      }
      mesh.triangles.push_back({ 3 * k, 3 * k + 1, 3 * k + 2 });
    }
    return mesh;
  }

private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{ 0.0, 1.0 };
};

// In a soup of large triangles nothing is far away: all angles are summed one by one. Of models of
// any size, also where products of lengths overflow or underflow.
TEST(WindingNumber, OfASoupIsTheSumOfItsSolidAngles)
{
  Soup soup(12);
  for (const double size : { 1.0, 1e-30, 1e-92, 1e30, 1e90 })
  {
    for (const std::int32_t count : { 1, 3, 60, 300 })
    {
      TriangleMesh mesh = soup.triangles(count, 3.0);
      for (Vec3& point : mesh.points)
      {
        point *= size;
      }
      const MeshBvh bvh(mesh);
      const WindingNumber winding(mesh, bvh);
      for (int k = 0; k < 100; ++k)
      {
        const Vec3 p = size * soup.anywhere();
        EXPECT_NEAR(winding.at(p), test::sumOfSolidAngles(mesh, p), 1e-9) << count << ", " << size;
      }
    }
  }
}

// Small triangles far away count as dipoles, to a hundredth. Corners of many are not kept.
TEST(WindingNumber, OfManySmallTrianglesIsNearlyTheSumOfTheirSolidAngles)
{
  Soup soup(13);
  for (const std::int32_t count : { 2'000, 150'000 })
  {
    const TriangleMesh mesh = soup.triangles(count, 2.0 / std::sqrt(double(count)));
    const MeshBvh bvh(mesh);
    const WindingNumber winding(mesh, bvh);
    for (int k = 0; k < 50; ++k)
    {
      const Vec3 p = soup.anywhere();
      EXPECT_NEAR(winding.at(p), test::sumOfSolidAngles(mesh, p), 0.01) << count;
    }
  }
}

} // namespace
} // namespace hybridtree
