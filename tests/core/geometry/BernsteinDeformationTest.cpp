// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/BernsteinDeformation.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

using test::Random;
using Folding = BernsteinDeformation::Folding;

const Box3 kUnit(Vec3(0, 0, 0), Vec3(1, 1, 1));

// Displacements up to `share` of a cell along each axis; those of the faces are 0 when they rest.
BernsteinDeformation jittered(
  Random& random, const std::array<int, 3>& n, double share, bool restingFaces)
{
  std::vector<Vec3> displacements;
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const bool face =
          i == 0 || j == 0 || k == 0 || i + 1 == n[0] || j + 1 == n[1] || k + 1 == n[2];
        Vec3 d = random.inBox(Box3(Vec3::Constant(-share), Vec3::Constant(share)));
        d = d.cwiseQuotient(Vec3(n[0] - 1, n[1] - 1, n[2] - 1));
        displacements.push_back(face && restingFaces ? Vec3::Zero() : d);
      }
    }
  }
  return { n, displacements };
}

TEST(BernsteinDeformation, AtRestIsTheIdentityBitForBit)
{
  Random random(1);
  const BernsteinDeformation rest({ 3, 4, 2 }, std::vector<Vec3>(24, Vec3::Zero()));
  EXPECT_TRUE(rest.isIdentity());
  EXPECT_EQ(rest.folding(), Folding::None);
  for (int k = 0; k < 100; ++k)
  {
    const Vec3 x = random.inBox(Box3(Vec3(-1, -1, -1), Vec3(2, 2, 2)));
    EXPECT_EQ(rest.forward(x), x);
    EXPECT_EQ(rest.inverse(x).value(), x);
  }
}

TEST(BernsteinDeformation, AffineDisplacementsAreTheAffineMap)
{
  Random random(2);
  const std::array<int, 3> n{ 3, 5, 4 };
  Mat3 linear = 0.3 * Mat3::Random();
  linear << 0.2, -0.1, 0.05, 0.3, -0.2, 0.1, 0.0, 0.25, 0.1;
  const Vec3 shift(0.1, -0.3, 0.2);
  std::vector<Vec3> displacements;
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        displacements.push_back(linear * Vec3(i / 2.0, j / 4.0, k / 3.0) + shift);
      }
    }
  }
  const BernsteinDeformation affine(n, displacements);
  EXPECT_EQ(affine.folding(), Folding::None);
  for (int k = 0; k < 200; ++k)
  {
    const Vec3 x = random.inBox(kUnit);
    EXPECT_LT((affine.forward(x) - (x + linear * x + shift)).norm(), 1e-14);
    EXPECT_LT((affine.jacobian(x) - Mat3::Identity() - linear).norm(), 1e-13);
    const std::optional<Vec3> back = affine.inverse(affine.forward(x));
    ASSERT_TRUE(back.has_value());
    EXPECT_LT((*back - x).norm(), 1e-13);
  }
}

TEST(BernsteinDeformation, InverseUndoesForward)
{
  Random random(3);
  for (const std::array<int, 3>& n : { std::array<int, 3>{ 4, 4, 4 }, { 2, 3, 5 }, { 8, 6, 4 } })
  {
    for (const bool resting : { true, false })
    {
      const BernsteinDeformation deformation = jittered(random, n, 0.3, resting);
      EXPECT_EQ(deformation.folding(), Folding::None);
      for (int k = 0; k < 500; ++k)
      {
        const Vec3 x = random.inBox(kUnit);
        const std::optional<Vec3> back = deformation.inverse(deformation.forward(x));
        ASSERT_TRUE(back.has_value());
        EXPECT_LT((*back - x).norm(), 1e-12) << "at " << x.transpose();
      }
    }
  }
}

TEST(BernsteinDeformation, WhatHasNoPreimageIsKnown)
{
  // Everything moves by 0.5 along x: the first half of the cube is left empty, and beyond the cube
  // the deformed part covers what is at rest.
  Random random(4);
  const BernsteinDeformation shift({ 2, 2, 2 }, std::vector<Vec3>(8, Vec3(0.5, 0, 0)));
  EXPECT_FALSE(shift.hasRestingFaces());
  for (int k = 0; k < 200; ++k)
  {
    const Vec3 y = random.inBox(Box3(Vec3(-1, -0.5, -0.5), Vec3(2.5, 1.5, 1.5)));
    const bool across = y[1] > 0 && y[1] < 1 && y[2] > 0 && y[2] < 1;
    const std::optional<Vec3> x = shift.inverse(y);
    if (across && y[0] > 0.5 && y[0] < 1.5)
    {
      ASSERT_TRUE(x.has_value());
      EXPECT_LT((*x - (y - Vec3(0.5, 0, 0))).norm(), 1e-13);
    }
    else if (across && y[0] > 0.0 && y[0] < 0.5)
    {
      EXPECT_FALSE(x.has_value());
    }
    else
    {
      EXPECT_EQ(x.value(), y);
    }
  }
}

TEST(BernsteinDeformation, FoldsAreFoundAndTheirAbsenceProved)
{
  Random random(5);
  int folded = 0;
  int proved = 0;
  for (int round = 0; round < 60; ++round)
  {
    const BernsteinDeformation deformation =
      jittered(random, { 4, 3, 4 }, 0.2 + 0.03 * round, round % 2 == 0);
    double least = 1e300;
    for (int k = 0; k < 4000; ++k)
    {
      least = std::min(least, deformation.jacobian(random.inBox(kUnit)).determinant());
    }
    const Folding folding = deformation.folding();
    folded += folding == Folding::Certain;
    proved += folding == Folding::None;
    if (least < 0.0)
    {
      EXPECT_EQ(folding, Folding::Certain) << "round " << round;
    }
    else if (least > 0.02)
    {
      EXPECT_EQ(folding, Folding::None) << "round " << round << ", least " << least;
    }
  }
  EXPECT_GT(folded, 10);
  EXPECT_GT(proved, 10);
}

TEST(BernsteinDeformation, JacobianBoundsHoldIt)
{
  Random random(6);
  const BernsteinDeformation deformation = jittered(random, { 5, 4, 3 }, 0.4, false);
  for (int round = 0; round < 100; ++round)
  {
    Box3 part;
    part.extend(random.inBox(kUnit));
    part.extend(random.inBox(kUnit));
    const MatrixInterval over = deformation.jacobianOver(part);
    for (int k = 0; k < 20; ++k)
    {
      const Mat3 j = deformation.jacobian(random.inBox(part));
      EXPECT_LE(((j - over.center).cwiseAbs() - over.radius).maxCoeff(), 1e-12);
    }
  }
}

TEST(BernsteinDeformation, PreimageOfABoxHoldsAllAndShrinks)
{
  Random random(7);
  for (const bool resting : { true, false })
  {
    const BernsteinDeformation deformation = jittered(random, { 4, 4, 4 }, 0.3, resting);
    for (int round = 0; round < 200; ++round)
    {
      const double size = 0.3 * std::pow(10.0, -(round % 6));
      const Vec3 center = deformation.forward(random.inBox(kUnit));
      const Box3 box(Vec3(center.array() - size), Vec3(center.array() + size));
      const BernsteinDeformation::Preimage preimage = deformation.preimageOf(box);
      Box3 sampled;
      for (int k = 0; k < 300; ++k)
      {
        const Vec3 y = random.inBox(box);
        const std::optional<Vec3> x = deformation.inverse(y);
        if (x && BernsteinDeformation::isInside(*x) && (deformation.forward(*x) - y).norm() < 1e-11)
        {
          EXPECT_LT(preimage.box.exteriorDistance(*x), 1e-11) << "size " << size;
          sampled.extend(*x);
        }
      }
      if (size < 1e-3)
      {
        EXPECT_LT(preimage.box.diagonal().norm(), 20.0 * size);
      }
    }
  }
}

TEST(BernsteinDeformation, LargestLatticeStaysUsable)
{
  Random random(8);
  const BernsteinDeformation deformation = jittered(random, { 64, 64, 64 }, 0.05, true);
  EXPECT_NE(deformation.folding(), Folding::Certain);
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 x = random.inBox(kUnit);
    EXPECT_LT((deformation.inverse(deformation.forward(x)).value() - x).norm(), 1e-12);
  }
}

} // namespace
} // namespace hybridtree
