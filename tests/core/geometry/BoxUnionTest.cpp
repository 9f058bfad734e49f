// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/BoxUnion.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

Box3 randomBox(Random& random)
{
  const Box3 space(Vec3::Zero(), Vec3::Ones());
  Box3 box(random.inBox(space));
  box.extend(random.inBox(space));
  return box;
}

/// By inclusion and exclusion, as [HT] has it.
double byInclusion(const std::vector<Box3>& boxes)
{
  double sum = 0.0;
  for (unsigned chosen = 1; chosen < 1u << boxes.size(); ++chosen)
  {
    Box3 shared(Vec3::Constant(-1.0), Vec3::Constant(2.0));
    bool odd = false;
    for (std::size_t k = 0; k < boxes.size(); ++k)
    {
      if ((chosen >> k & 1u) != 0)
      {
        shared = shared.intersection(boxes[k]);
        odd = !odd;
      }
    }
    sum += shared.isEmpty() ? 0.0 : odd ? shared.volume() : -shared.volume();
  }
  return sum;
}

TEST(BoxUnion, VolumeIsThatOfInclusionAndExclusion)
{
  Random random(1);
  for (int count = 1; count <= 10; ++count)
  {
    for (int round = 0; round < 20; ++round)
    {
      std::vector<Box3> boxes;
      for (int k = 0; k < count; ++k)
      {
        boxes.push_back(randomBox(random));
      }
      boxes.push_back(boxes[static_cast<std::size_t>(round % count)]); // twice
      EXPECT_NEAR(unionVolume(boxes), byInclusion(boxes), 1e-12);
    }
  }
}

TEST(BoxUnion, EmptyAndFlatBoxesCountNothing)
{
  EXPECT_EQ(unionVolume({}), 0.0);
  EXPECT_EQ(unionVolume({ Box3() }), 0.0);
  const Box3 flat(Vec3(0, 0, 0), Vec3(1, 1, 0));
  const Box3 unit(Vec3(0, 0, 0), Vec3(1, 1, 1));
  EXPECT_EQ(unionVolume({ flat, unit, Box3() }), 1.0);
}

TEST(BoxUnion, RatioIsTheShareOfTheBox)
{
  const Box3 unit(Vec3(0, 0, 0), Vec3(1, 1, 1));
  EXPECT_EQ(overlapRatio(unit, {}), 0.0);
  EXPECT_EQ(overlapRatio(unit, { Box3(Vec3(2, 2, 2), Vec3(3, 3, 3)) }), 0.0);
  EXPECT_EQ(overlapRatio(unit, { Box3(Vec3(-1, -1, -1), Vec3(2, 2, 2)) }), 1.0);
  EXPECT_NEAR(
    overlapRatio(
      unit, { Box3(Vec3(-1, -1, -1), Vec3(0.5, 2, 2)), Box3(Vec3(0.25, 0, 0), Vec3(0.75, 1, 1)) }),
    0.75, 1e-15);
  EXPECT_EQ(overlapRatio(Box3(), { unit }), 0.0);
}

} // namespace
} // namespace hybridtree::test
