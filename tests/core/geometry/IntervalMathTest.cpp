// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/IntervalMath.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

using test::Random;

Interval randomInterval(Random& random, double reach)
{
  const double a = random.uniform(-reach, reach);
  return { a, a + random.uniform(0.0, reach) * random.unit() };
}

TEST(IntervalMath, HoldsEveryResultAndIsAttained)
{
  Random random(1);
  for (int round = 0; round < 300; ++round)
  {
    const Interval a = randomInterval(random, 6.0);
    const Interval b = randomInterval(random, 3.0);
    const Interval product = a * b;
    const Interval cosine = cosRange(a);
    const Interval sine = sinRange(a);
    Interval seenProduct{ 1e9, -1e9 };
    Interval seenCosine{ 1e9, -1e9 };
    for (int i = 0; i <= 60; ++i)
    {
      const double x = a.min + (a.max - a.min) * i / 60.0;
      seenCosine = hull(seenCosine, { std::cos(x), std::cos(x) });
      EXPECT_GE(std::sin(x), sine.min - 1e-14);
      EXPECT_LE(std::sin(x), sine.max + 1e-14);
      for (int j = 0; j <= 10; ++j)
      {
        const double y = b.min + (b.max - b.min) * j / 10.0;
        seenProduct = hull(seenProduct, { x * y, x * y });
      }
    }
    EXPECT_NEAR(seenProduct.min, product.min, 1e-12);
    EXPECT_NEAR(seenProduct.max, product.max, 1e-12);
    const double coarse = 0.5 * (a.max - a.min) / 60.0; // of the samples
    EXPECT_LE(cosine.min, seenCosine.min + 1e-14);
    EXPECT_GE(cosine.max, seenCosine.max - 1e-14);
    EXPECT_NEAR(cosine.min, seenCosine.min, coarse * coarse);
    EXPECT_NEAR(cosine.max, seenCosine.max, coarse * coarse);
  }
}

} // namespace
} // namespace hybridtree
