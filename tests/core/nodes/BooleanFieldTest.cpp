// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BooleanField.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hybridtree::test
{
namespace
{

constexpr double T = kThreshold;
constexpr BooleanOperation kOperations[] = { BooleanOperation::Union,
  BooleanOperation::Intersection, BooleanOperation::Difference };
constexpr BooleanForm kForms[] = { BooleanForm::MinMax, BooleanForm::Smooth, BooleanForm::Paper };

double value(BooleanOperation operation, BooleanForm form, double a, double b)
{
  return booleanValue(operation, form, a, b).value;
}

double sharp(BooleanOperation operation, double a, double b)
{
  return value(operation, BooleanForm::MinMax, a, b);
}

// Fields as they come: none, within reach, and deep inside of sums.
double randomField(Random& random)
{
  switch (random.integer(0, 3))
  {
    case 0:
      return random.uniform(0.0, T);
    case 1:
      return random.uniform(T, 2.0 * T);
    case 2:
      return random.uniform(-1.0, 20.0 * T);
    default:
      return random.integer(0, 4) * 0.5 * T;
  }
}

TEST(BooleanField, AllFormsHaveTheSurfaceOfMinAndMax)
{
  Random random(1);
  for (int round = 0; round < 20000; ++round)
  {
    const double a = randomField(random);
    const double b = randomField(random);
    for (const BooleanOperation operation : kOperations)
    {
      const double expected = sharp(operation, a, b);
      for (const BooleanForm form : kForms)
      {
        const double f = value(operation, form, a, b);
        ASSERT_GE(f, 0.0);
        if (std::abs(expected - T) > 1e-6)
        {
          ASSERT_EQ(f > T, expected > T) << int(operation) << int(form) << " " << a << " " << b;
        }
        else if (expected == T)
        {
          ASSERT_NEAR(f, T, 1e-14) << int(operation) << int(form) << " " << a << " " << b;
        }
      }
    }
  }
}

TEST(BooleanField, SmoothFormIsCompactAndNeutral)
{
  Random random(2);
  for (int round = 0; round < 2000; ++round)
  {
    const double f = randomField(random);
    const double kept = std::max(f, 0.0);
    const auto smooth = [](BooleanOperation operation, double a, double b)
    { return value(operation, BooleanForm::Smooth, a, b); };
    EXPECT_EQ(smooth(BooleanOperation::Union, f, 0.0), kept);
    EXPECT_EQ(smooth(BooleanOperation::Union, 0.0, f), kept);
    EXPECT_EQ(smooth(BooleanOperation::Union, f, -0.3), kept) << "what carves unites with nothing";
    EXPECT_EQ(smooth(BooleanOperation::Intersection, f, 0.0), 0.0);
    EXPECT_EQ(smooth(BooleanOperation::Intersection, 0.0, f), 0.0);
    EXPECT_EQ(smooth(BooleanOperation::Difference, f, 0.0), std::min(kept, 2.0 * T));
    EXPECT_EQ(smooth(BooleanOperation::Difference, 0.0, f), 0.0);
  }
}

TEST(BooleanField, SlopesAreThoseOfTheValue)
{
  Random random(3);
  const double step = 1e-6;
  int tested = 0;
  for (int round = 0; round < 20000; ++round)
  {
    const double a = random.uniform(0.0, 6.0 * T);
    const double b = random.uniform(0.0, 6.0 * T);
    for (const BooleanOperation operation : kOperations)
    {
      // Not across a stated corner: a = b = T, a field of 0 or T, b = 2T, and those of min and max.
      const double corners[] = { a, b, a - T, b - T, b - 2.0 * T, a - b, a + b - 2.0 * T };
      if (std::any_of(std::begin(corners), std::end(corners),
            [&](double c) { return std::abs(c) < 10.0 * step; }) ||
        std::hypot(a - T, b - T) < 1e-2)
      {
        continue;
      }
      for (const BooleanForm form : kForms)
      {
        const BooleanValue at = booleanValue(operation, form, a, b);
        const double byA =
          (value(operation, form, a + step, b) - value(operation, form, a - step, b)) / (2 * step);
        const double byB =
          (value(operation, form, a, b + step) - value(operation, form, a, b - step)) / (2 * step);
        ASSERT_NEAR(at.byA, byA, 1e-5) << int(operation) << int(form) << " " << a << " " << b;
        ASSERT_NEAR(at.byB, byB, 1e-5) << int(operation) << int(form) << " " << a << " " << b;
        ++tested;
      }
    }
  }
  EXPECT_GT(tested, 100000);
}

TEST(BooleanField, SlopesAtCornersAreFinite)
{
  for (const double a : { 0.0, T, 2.0 * T })
  {
    for (const double b : { 0.0, T, 2.0 * T })
    {
      for (const BooleanOperation operation : kOperations)
      {
        for (const BooleanForm form : kForms)
        {
          const BooleanValue at = booleanValue(operation, form, a, b);
          EXPECT_TRUE(std::isfinite(at.byA) && std::isfinite(at.byB));
          if (a == T && b == T)
          {
            EXPECT_GT(std::abs(at.byA) + std::abs(at.byB), 0.1) << "a normal at the edge";
          }
        }
      }
    }
  }
}

TEST(BooleanField, RangeBoundsAllValuesOfTheIntervals)
{
  Random random(4);
  for (int round = 0; round < 5000; ++round)
  {
    Interval a{ randomField(random), randomField(random) };
    Interval b{ randomField(random), randomField(random) };
    if (round % 2 == 0) // narrow ones, where nothing but the slack can hide a fall
    {
      a.max = a.min + random.uniform(0.0, 0.1);
      b.max = b.min + random.uniform(0.0, 0.1);
    }
    if (a.min > a.max)
    {
      std::swap(a.min, a.max);
    }
    if (b.min > b.max)
    {
      std::swap(b.min, b.max);
    }
    for (const BooleanOperation operation : kOperations)
    {
      for (const BooleanForm form : kForms)
      {
        const Interval range = booleanRange(operation, form, a, b);
        for (int sample = 0; sample < 20; ++sample)
        {
          const double f = value(operation, form, random.uniform(a.min, a.max),
            sample % 4 == 0 ? b.min : random.uniform(b.min, b.max));
          ASSERT_GE(f, range.min - 1e-13) << int(operation) << int(form);
          ASSERT_LE(f, range.max + 1e-13) << int(operation) << int(form);
        }
        const Interval point = booleanRange(operation, form, { a.min, a.min }, { b.min, b.min });
        EXPECT_EQ(point.min, point.max);
      }
    }
  }
}

// The slack of booleanRange(): how far the smooth functions fall while an operand rises.
TEST(BooleanField, SmoothFormIsNearlyMonotone)
{
  const double step = 0.002;
  double steepest = 0.0;
  for (double a = step; a < 10.0; a += a < 1.5 ? step : 0.1)
  {
    for (double b = step; b < 10.0; b += b < 1.5 ? step : 0.1)
    {
      for (const BooleanOperation operation : kOperations)
      {
        const BooleanValue at = booleanValue(operation, BooleanForm::Smooth, a, b);
        const double rising = operation == BooleanOperation::Difference ? -at.byB : at.byB;
        steepest = std::max({ steepest, -at.byA, -rising });
      }
    }
  }
  EXPECT_LT(steepest, 0.005);
}

TEST(BooleanField, PaperFormIsThatOfThePaper)
{
  // [HT] 4.4, f_A = 0.9 and f_B = 0 with T = 0.5: the union is changed by a field of nothing.
  const double root = std::sqrt(0.4 * 0.4 + 0.5 * 0.5);
  EXPECT_NEAR(value(BooleanOperation::Union, BooleanForm::Paper, 0.9, 0.0),
    0.5 + (0.4 - 0.5 + root) / (2.0 - std::sqrt(2.0)), 1e-15);
  EXPECT_NEAR(value(BooleanOperation::Intersection, BooleanForm::Paper, 0.9, 0.0),
    0.5 + (0.4 - 0.5 - root) / (2.0 + std::sqrt(2.0)), 1e-15);
  EXPECT_EQ(value(BooleanOperation::Union, BooleanForm::Paper, 0.0, 0.0), 0.0);
}

} // namespace
} // namespace hybridtree::test
