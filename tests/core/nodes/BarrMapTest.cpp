// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FramedWarp.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

using test::Random;

const double kPi = std::acos(-1.0);

Box3 cube(double half)
{
  return Box3(Vec3::Constant(-half), Vec3::Constant(half));
}

// Maps of one kind with amounts from small to the limit, and the points they are tried at: local
// coordinates across the three zones of the range [-1, 2].
template <typename Map>
struct Cases;

template <>
struct Cases<TwistMap>
{
  static std::vector<double> amounts() { return { 0.0, 1e-9, 0.3, -2.0, 7.0 }; }
  static Vec3 point(Random& random, const TwistMap&) { return random.inBox(cube(4.0)); }
};

template <>
struct Cases<TaperMap>
{
  static std::vector<double> amounts() { return { 1.0, 1.0 + 1e-9, 0.2, 3.0 }; }
  static Vec3 point(Random& random, const TaperMap&) { return random.inBox(cube(4.0)); }
};

template <>
struct Cases<BendMap>
{
  static std::vector<double> amounts()
  {
    return { 0.0, 1e-12, 1e-7, -1e-3, 0.5, -1.5, 3.0, 4.4, -4.4 };
  }
  // Within 9/10 of the radius of the bend, and with ends too short to meet.
  static Vec3 point(Random& random, const BendMap& map)
  {
    const double radius = 3.0 / std::max(std::abs(map.angle), 1.0);
    return { random.uniform(-0.9, 0.9) * radius, random.uniform(-1.0, 1.0),
      0.5 + random.uniform(-1.0, 1.0) * (1.5 + 0.1 * radius) };
  }
};

template <typename Map>
class BarrMaps : public testing::Test
{
public:
  static std::vector<Map> maps()
  {
    std::vector<Map> result;
    for (const double amount : Cases<Map>::amounts())
    {
      result.push_back({ -1.0, 2.0, amount });
    }
    return result;
  }
};

using Kinds = testing::Types<TwistMap, TaperMap, BendMap>;
TYPED_TEST_SUITE(BarrMaps, Kinds);

TYPED_TEST(BarrMaps, InverseUndoesForwardInAllZones)
{
  Random random(1);
  for (const TypeParam& map : TestFixture::maps())
  {
    for (int k = 0; k < 2000; ++k)
    {
      const Vec3 p = Cases<TypeParam>::point(random, map);
      EXPECT_LT((map.inverse(map.forward(p)) - p).norm(), 2e-14 * (1.0 + p.norm()))
        << "at " << p.transpose();
    }
  }
}

TYPED_TEST(BarrMaps, ForwardUndoesInverseEverywhere)
{
  Random random(2);
  for (const TypeParam& map : TestFixture::maps())
  {
    for (int k = 0; k < 2000; ++k)
    {
      const Vec3 p = random.inBox(cube(20.0)); // also past the axis of a bend
      EXPECT_LT((map.forward(map.inverse(p)) - p).norm(), 1e-13 * (1.0 + p.norm()))
        << "at " << p.transpose();
    }
  }
}

TYPED_TEST(BarrMaps, JacobianMatchesDifferencesInAllZones)
{
  Random random(3);
  const double step = 1e-6;
  for (const TypeParam& map : TestFixture::maps())
  {
    for (int k = 0; k < 500; ++k)
    {
      const Vec3 p = Cases<TypeParam>::point(random, map);
      if (std::abs(p[2] + 1.0) < 2.0 * step || std::abs(p[2] - 2.0) < 2.0 * step)
      {
        continue; // the Jacobian jumps between zones
      }
      Mat3 differences;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Vec3 d = step * Vec3::Unit(axis);
        differences.col(axis) = (map.forward(p + d) - map.forward(p - d)) / (2.0 * step);
      }
      EXPECT_LT((map.jacobian(p) - differences).norm(), 1e-7) << "at " << p.transpose();
      EXPECT_LT((map.jacobian(p) * map.jacobianInverse(p) - Mat3::Identity()).norm(), 1e-12);
    }
  }
}

TYPED_TEST(BarrMaps, JacobianBoundsHoldIt)
{
  Random random(4);
  for (const TypeParam& map : TestFixture::maps())
  {
    for (int k = 0; k < 200; ++k)
    {
      const Vec3 center = Cases<TypeParam>::point(random, map);
      const Vec3 half = (k % 2 ? 0.5 : 1e-3) * random.inBox(Box3(Vec3::Zero(), Vec3::Ones()));
      const Box3 box(Vec3(center - half), Vec3(center + half));
      const MatrixInterval over = map.jacobianOver(box);
      const std::optional<MatrixInterval> inverseOver = map.inverseJacobianOver(box);
      for (int sample = 0; sample < 30; ++sample)
      {
        const Vec3 p = random.inBox(box);
        EXPECT_LE(((map.jacobian(p) - over.center).cwiseAbs() - over.radius).maxCoeff(), 1e-12);
        if (inverseOver)
        {
          const Mat3 j = map.jacobianInverse(map.inverse(p));
          EXPECT_LE(((j - inverseOver->center).cwiseAbs() - inverseOver->radius).maxCoeff(),
            1e-9 * (1.0 + j.norm()))
            << "at " << p.transpose();
        }
      }
    }
  }
}

TEST(BarrMap, OutsideTheRangeTheEndCounts)
{
  const TwistMap twist{ 0.0, 1.0, 1.2 };
  EXPECT_EQ(twist.forward(Vec3(1, 2, -5)), Vec3(1, 2, -5));
  const Vec3 turned(std::cos(1.2), std::sin(1.2), 9);
  EXPECT_LT((twist.forward(Vec3(1, 0, 9)) - turned).norm(), 1e-15);
  const TaperMap taper{ 0.0, 1.0, 0.25 };
  EXPECT_EQ(taper.forward(Vec3(1, 2, -5)), Vec3(1, 2, -5));
  EXPECT_EQ(taper.forward(Vec3(1, 2, 5)), Vec3(0.25, 0.5, 5));
  // A quarter turn over length pi/2 has radius 1; beyond, the axis runs along +n.
  const BendMap bend{ 0.0, 0.5 * kPi, 0.5 * kPi };
  EXPECT_LT((bend.forward(Vec3(0.5, 3, -5)) - Vec3(0.5, 3, -5)).norm(), 1e-15);
  EXPECT_LT((bend.forward(Vec3(0, 3, 0.5 * kPi)) - Vec3(1, 3, 1)).norm(), 1e-15);
  EXPECT_LT((bend.forward(Vec3(0, 3, 0.5 * kPi + 2)) - Vec3(3, 3, 1)).norm(), 1e-14);
}

TEST(BarrMap, BendKnowsWhereItOverlaps)
{
  Random random(5);
  int overlaps = 0;
  int free = 0;
  for (int k = 0; k < 400; ++k)
  {
    const BendMap bend{ -1.0, 2.0, random.uniform(-4.5, 4.5) };
    Box3 box;
    box.extend(random.inBox(cube(4.0)));
    box.extend(random.inBox(cube(4.0)));
    bool oneToOne = true;
    for (int sample = 0; sample < 2000 && oneToOne; ++sample)
    {
      const Vec3 p = random.inBox(box);
      oneToOne = (bend.inverse(bend.forward(p)) - p).norm() < 1e-9;
    }
    overlaps += oneToOne ? 0 : 1;
    free += bend.isOneToOneOver(box) ? 1 : 0;
    EXPECT_TRUE(oneToOne || !bend.isOneToOneOver(box)) << "angle " << bend.angle;
  }
  EXPECT_GT(overlaps, 50);
  EXPECT_GT(overlaps + free, 380); // so it is not just cautious
}

Affine3 shearedFrame(Random& random)
{
  Affine3 frame = Affine3::Identity();
  do
  {
    for (int column = 0; column < 3; ++column)
    {
      frame.linear().col(column) = random.inBox(cube(1.0));
    }
  } while (std::abs(frame.linear().determinant()) < 0.3);
  frame.translation() = random.inBox(cube(2.0));
  return frame;
}

Vec3 inverseOf(const SpaceWarp& warp, const Vec3& p)
{
  Vec3 q;
  warp.inverse({ &p[0], &p[1], &p[2], 1 }, { &q[0], &q[1], &q[2] });
  return q;
}

Vec3 forwardOf(const SpaceWarp& warp, const Vec3& p)
{
  Vec3 q;
  warp.forward({ &p[0], &p[1], &p[2], 1 }, { &q[0], &q[1], &q[2] });
  return q;
}

template <typename Map>
class BarrWarps : public BarrMaps<Map>
{
};
TYPED_TEST_SUITE(BarrWarps, Kinds);

TYPED_TEST(BarrWarps, PreimageBoundsHoldAndShrink)
{
  Random random(6);
  for (const TypeParam& map : TestFixture::maps())
  {
    const FramedWarp<TypeParam> warp(map, shearedFrame(random));
    for (int k = 0; k < 200; ++k)
    {
      const double size = std::pow(10.0, -(k % 5));
      const Vec3 center = forwardOf(warp, warp.frame() * Cases<TypeParam>::point(random, map));
      const Vec3 half = size * random.inBox(Box3(Vec3::Constant(0.1), Vec3::Ones()));
      const Box3 box(Vec3(center - half), Vec3(center + half));
      const Box3 preimage = warp.preimageBounds(box);
      Box3 sampled;
      for (int sample = 0; sample < 200; ++sample)
      {
        const Vec3 q = inverseOf(warp, random.inBox(box));
        EXPECT_LT(preimage.exteriorDistance(q), 1e-11);
        sampled.extend(q);
      }
      if (size <= 1e-3)
      {
        EXPECT_LT(preimage.diagonal().norm(), 2.0 * sampled.diagonal().norm());
      }
    }
  }
}

TYPED_TEST(BarrWarps, ImageBoundsHoldAndAreTight)
{
  Random random(7);
  for (const TypeParam& map : TestFixture::maps())
  {
    const FramedWarp<TypeParam> warp(map, shearedFrame(random));
    for (int k = 0; k < 5; ++k)
    {
      Box3 box;
      box.extend(random.inBox(cube(3.0)));
      box.extend(random.inBox(cube(3.0)));
      const Box3 image = warp.imageBounds(box);
      Box3 sampled;
      for (int sample = 0; sample < 20000; ++sample)
      {
        Vec3 p = random.inBox(box); // on a face: there the extremes are
        p[sample % 3] = (sample / 3 % 2 ? box.min() : box.max())[sample % 3];
        sampled.extend(forwardOf(warp, p));
      }
      EXPECT_LT(image.exteriorDistance(sampled.min()), 1e-11);
      EXPECT_LT(image.exteriorDistance(sampled.max()), 1e-11);
      EXPECT_LT(image.diagonal().norm(), 1.2 * sampled.diagonal().norm());
    }
  }
}

TYPED_TEST(BarrWarps, AffineImageIsTheSameMapInTheMappedFrame)
{
  Random random(8);
  for (const TypeParam& map : TestFixture::maps())
  {
    const Affine3 frame = shearedFrame(random);
    const Affine3 affine = shearedFrame(random);
    const FramedWarp<TypeParam> warp(map, frame);
    const FramedWarp<TypeParam> image(map, affine * frame);
    for (int k = 0; k < 100; ++k)
    {
      const Vec3 p = frame * Cases<TypeParam>::point(random, map);
      EXPECT_LT((forwardOf(image, affine * p) - affine * forwardOf(warp, p)).norm(), 1e-11);
    }
  }
}

} // namespace
} // namespace hybridtree
