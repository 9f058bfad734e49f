// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/Bernstein.h"

#include "core/base/Error.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

using test::Random;

const Box3 kUnit(Vec3(0, 0, 0), Vec3(1, 1, 1));
const std::array<int, 3> kSizes[] = { { 2, 2, 2 }, { 4, 4, 4 }, { 1, 3, 5 }, { 7, 2, 4 },
  { 12, 3, 2 } };

BernsteinVolume randomVolume(Random& random, const std::array<int, 3>& sizes)
{
  std::vector<Vec3> coefficients;
  for (int c = 0; c < sizes[0] * sizes[1] * sizes[2]; ++c)
  {
    coefficients.push_back(random.inBox(Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1))));
  }
  return { sizes, coefficients };
}

// From the definition, with binomial coefficients by the gamma function.
Vec3 bruteForce(const BernsteinVolume& volume, const Vec3& at)
{
  const auto basis = [](int size, int i, double t)
  {
    const int degree = size - 1;
    const double binomial =
      std::tgamma(degree + 1.0) / (std::tgamma(i + 1.0) * std::tgamma(degree - i + 1.0));
    return binomial * std::pow(t, i) * std::pow(1.0 - t, degree - i);
  };
  const std::array<int, 3>& n = volume.sizes();
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        sum += basis(n[0], i, at[0]) * basis(n[1], j, at[1]) * basis(n[2], k, at[2]) *
          volume.coefficients()[i + n[0] * (j + n[1] * k)];
      }
    }
  }
  return sum;
}

TEST(Bernstein, ValueIsTheDefinition)
{
  Random random(1);
  for (const auto& sizes : kSizes)
  {
    const BernsteinVolume volume = randomVolume(random, sizes);
    for (int round = 0; round < 50; ++round)
    {
      const Vec3 at = random.inBox(kUnit);
      const Vec3 expected = bruteForce(volume, at);
      EXPECT_LT((volume.evaluate(at) - expected).norm(), 1e-12);
      Mat3 derivative;
      EXPECT_LT((volume.evaluate(at, derivative) - expected).norm(), 1e-12);
    }
  }
}

TEST(Bernstein, DerivativeMatchesDifferencesAndDerivativeVolumes)
{
  Random random(2);
  for (const auto& sizes : kSizes)
  {
    const BernsteinVolume volume = randomVolume(random, sizes);
    for (int round = 0; round < 50; ++round)
    {
      const Vec3 at = random.inBox(kUnit);
      Mat3 derivative;
      volume.evaluate(at, derivative);
      for (int axis = 0; axis < 3; ++axis)
      {
        const Vec3 step = 1e-5 * Vec3::Unit(axis);
        const Vec3 difference = (volume.evaluate(at + step) - volume.evaluate(at - step)) / 2e-5;
        EXPECT_LT((derivative.col(axis) - difference).norm(), 1e-6 * (1.0 + difference.norm()));
        const Vec3 exact = volume.derivative(axis).evaluate(at);
        EXPECT_LT((derivative.col(axis) - exact).norm(), 1e-11 * (1.0 + exact.norm()));
      }
    }
  }
}

TEST(Bernstein, RestrictionIsTheSamePolynomialAndItsBoundsTighten)
{
  Random random(3);
  for (const auto& sizes : kSizes)
  {
    const BernsteinVolume volume = randomVolume(random, sizes);
    for (int round = 0; round < 20; ++round)
    {
      Box3 part;
      part.extend(random.inBox(kUnit));
      part.extend(random.inBox(kUnit));
      const BernsteinVolume inner = volume.restricted(part);
      const Box3 bounds = inner.bounds();
      EXPECT_LE(bounds.diagonal().norm(), volume.bounds().diagonal().norm() + 1e-12);
      for (int k = 0; k < 20; ++k)
      {
        const Vec3 local = random.inBox(kUnit);
        const Vec3 value = volume.evaluate(part.min() + local.cwiseProduct(part.sizes()));
        EXPECT_LT((inner.evaluate(local) - value).norm(), 1e-11);
        EXPECT_LT(bounds.exteriorDistance(value), 1e-11);
      }
    }
  }
}

TEST(Bernstein, RefusesWhatDoesNotFit)
{
  EXPECT_THROW(BernsteinVolume({ 2, 2, 2 }, std::vector<Vec3>(7)), InvalidParameter);
  EXPECT_THROW(BernsteinVolume({ 0, 2, 2 }, {}), InvalidParameter);
  EXPECT_THROW(BernsteinVolume({ 65, 1, 1 }, std::vector<Vec3>(65)), InvalidParameter);
}

} // namespace
} // namespace hybridtree
