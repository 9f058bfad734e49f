// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/skeletons/SkeletonCases.h"

#include "tests/core/skeletons/PlateCases.h"
#include "tests/core/skeletons/RoundCases.h"

namespace hybridtree::test
{
namespace
{

SkeletonCase pointCase(Random& random)
{
  const Vec3 center = 2.0 * random.direction();
  return { "point", std::make_shared<PointSkeleton>(center), { center }, 0.0, nullptr };
}

SkeletonCase segmentCase(const Vec3& a, const Vec3& b)
{
  constexpr int kSamples = 4000;
  SkeletonCase result{ "segment", std::make_shared<SegmentSkeleton>(a, b), {}, 0.0, nullptr };
  for (int k = 0; k <= kSamples; ++k)
  {
    result.samples.push_back(a + (b - a) * (double(k) / kSamples));
  }
  result.cover = 0.5 * (b - a).norm() / kSamples;
  return result;
}

SkeletonCase circleCase(const Vec3& center, const Vec3& normal, double radius)
{
  constexpr int kSamples = 4000;
  SkeletonCase result{ "circle", std::make_shared<CircleSkeleton>(center, normal, radius), {}, 0.0,
    nullptr };
  const Vec3 unit = normal.normalized();
  const Mat3 frame = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), unit).toRotationMatrix();
  for (int k = 0; k < kSamples; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * k / kSamples;
    result.samples.push_back(center + radius * (frame * Vec3(std::cos(turn), std::sin(turn), 0.0)));
  }
  result.cover = radius * EIGEN_PI / kSamples;
  return result;
}

SkeletonCase boxCase(const Vec3& center, const Vec3& lengths, const Mat3& rotation)
{
  constexpr int kSide = 50;
  SkeletonCase result{ "box", std::make_shared<BoxSkeleton>(center, lengths, rotation), {}, 0.0,
    nullptr };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i <= kSide; ++i)
    {
      for (int j = 0; j <= kSide; ++j)
      {
        for (const double side : { -0.5, 0.5 })
        {
          Vec3 local;
          local[axis] = side;
          local[(axis + 1) % 3] = double(i) / kSide - 0.5;
          local[(axis + 2) % 3] = double(j) / kSide - 0.5;
          result.samples.push_back(center + rotation * local.cwiseProduct(lengths));
        }
      }
    }
  }
  result.cover = 0.5 * std::sqrt(2.0) * lengths.maxCoeff() / kSide;
  result.inside = [center, lengths, rotation](const Vec3& p)
  {
    const Vec3 local = rotation.transpose() * (p - center);
    return (local.cwiseAbs().array() < 0.5 * lengths.array()).all();
  };
  return result;
}

} // namespace

std::vector<SkeletonCase> skeletonCases()
{
  Random random(11);
  std::vector<SkeletonCase> cases;
  for (int round = 0; round < 3; ++round)
  {
    cases.push_back(pointCase(random));
    cases.push_back(segmentCase(random.direction(), 2.0 * random.direction()));
    cases.push_back(
      circleCase(random.direction(), 3.0 * random.direction(), random.uniform(0.3, 2.0)));
    const Vec3 lengths(
      random.uniform(0.2, 2.0), random.uniform(0.2, 2.0), random.uniform(0.2, 2.0));
    cases.push_back(boxCase(random.direction(), lengths, random.rotation()));
  }
  const auto named = [&](SkeletonCase item, const char* name)
  {
    item.name = name;
    cases.push_back(std::move(item));
  };
  named(segmentCase(Vec3(1, 2, 3), Vec3(1, 2, 3)), "segment without length");
  named(circleCase(Vec3(1, 0, 0), Vec3(0, 1, 0), 0.0), "circle without radius");
  named(boxCase(Vec3(0, 1, 0), Vec3(1, 2, 0), random.rotation()), "rectangle");
  named(boxCase(Vec3(0, 1, 0), Vec3(1, 0, 0), random.rotation()), "box as segment");
  named(boxCase(Vec3(0, 1, 0), Vec3(0, 0, 0), random.rotation()), "box as point");
  Mat3 mirror = random.rotation();
  mirror.col(1) *= -1.0;
  named(boxCase(Vec3(0, 1, 0), Vec3(1, 2, 0.5), mirror), "mirrored box");
  for (const RoundCase& round : roundCases())
  {
    cases.push_back(withSamples(round));
  }
  for (const PlateCase& plate : plateCases())
  {
    cases.push_back(withSamples(plate));
  }
  for (SkeletonCase& ellipsoid : ellipsoidCases())
  {
    cases.push_back(std::move(ellipsoid));
  }
  return cases;
}

Affine3 randomSimilarity(Random& random, double scale)
{
  Affine3 map = Affine3::Identity();
  map.linear() = scale * random.rotation();
  if (random.chance(0.5))
  {
    map.linear().col(random.integer(0, 2)) *= -1.0;
  }
  map.translation() = 3.0 * random.direction();
  return map;
}

Affine3 randomAffine(Random& random)
{
  Affine3 map = Affine3::Identity();
  Vec3 stretch;
  for (double& value : stretch)
  {
    value = std::exp(random.uniform(std::log(0.3), std::log(3.0))) * (random.chance(0.3) ? -1 : 1);
  }
  map.linear() = random.rotation() * stretch.asDiagonal() * random.rotation();
  map.translation() = 2.0 * random.direction();
  return map;
}

} // namespace hybridtree::test
