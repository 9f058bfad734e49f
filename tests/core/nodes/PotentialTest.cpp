// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Potential.h"

#include "core/base/Error.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

using test::Random;

// [HT] 4.1, written as it is printed.
double printed(double I, double R, int n, double r)
{
  return r <= R ? I * std::pow(1.0 - r * r / (R * R), n) : 0.0;
}

TEST(Potential, IsTheFormulaOfThePaper)
{
  Random random(1);
  for (int round = 0; round < 200; ++round)
  {
    const double I = random.uniform(-4.0, 4.0);
    const double R = std::pow(10.0, random.uniform(-3.0, 3.0));
    const int n = random.integer(2, 64);
    const Potential potential(I, R, n);
    std::vector<double> distance, slope(19), field(19), again(19);
    for (int k = 0; k < 19; ++k)
    {
      distance.push_back(R * random.uniform(0.0, 1.3));
    }
    potential.evaluate(distance.data(), field.data(), field.size());
    potential.evaluateWithSlope(distance.data(), again.data(), slope.data(), slope.size());
    for (std::size_t k = 0; k < field.size(); ++k)
    {
      const double h = 1e-6 * R;
      EXPECT_NEAR(field[k], printed(I, R, n, distance[k]), 1e-12);
      EXPECT_EQ(field[k], potential.evaluate(distance[k]));
      EXPECT_NEAR(again[k], field[k], 1e-13);
      const double difference =
        (printed(I, R, n, distance[k] + h) - printed(I, R, n, std::max(0.0, distance[k] - h))) /
        (2.0 * h);
      if (distance[k] > h)
      {
        EXPECT_NEAR(slope[k] * R, difference * R, 1e-3) << "n " << n << " r/R " << distance[k] / R;
      }
    }
  }
}

TEST(Potential, IsExactlyZeroFromTheInfluenceRadiusOn)
{
  Random random(2);
  for (int round = 0; round < 1000; ++round)
  {
    const double R = std::pow(10.0, random.uniform(-6.0, 6.0));
    const Potential potential(1.0, R, random.integer(2, 5));
    EXPECT_EQ(potential.evaluate(R), 0.0);
    EXPECT_EQ(potential.evaluate(std::nextafter(R, 2.0 * R)), 0.0);
    EXPECT_EQ(potential.evaluate(1e6 * R), 0.0);
    EXPECT_GT(potential.evaluate(0.999 * R), 0.0);
  }
}

TEST(Potential, SurfaceRadiusIsWhereTheFieldIsTheThreshold)
{
  Random random(3);
  for (int round = 0; round < 500; ++round)
  {
    const double R = std::pow(10.0, random.uniform(-3.0, 3.0));
    const double surface = R * random.uniform(0.0, 0.95);
    const bool negative = random.chance(0.5);
    const Potential potential =
      Potential::bySurfaceRadius(surface, R, random.integer(2, 20), negative);
    EXPECT_EQ(potential.isNegative(), negative);
    ASSERT_TRUE(potential.surfaceRadius());
    EXPECT_NEAR(*potential.surfaceRadius(), surface, 1e-12 * R);
    EXPECT_NEAR(potential.evaluate(surface), negative ? -kThreshold : kThreshold, 1e-12);
  }
}

TEST(Potential, NoSurfaceAndSurfaceOfRadiusZeroAreTwoAnswers)
{
  EXPECT_EQ(Potential(0.5, 2.0, 3).surfaceRadius(), std::optional<double>(0.0));
  EXPECT_EQ(Potential::bySurfaceRadius(0.0, 2.0, 3).surfaceRadius(), std::optional<double>(0.0));
  EXPECT_EQ(Potential(0.4999, 2.0, 3).surfaceRadius(), std::nullopt);
  EXPECT_EQ(Potential(-0.4999, 2.0, 3).surfaceRadius(), std::nullopt);
}

TEST(Potential, RangeIsThatOverTheDistances)
{
  Random random(4);
  for (int round = 0; round < 300; ++round)
  {
    const Potential potential(random.uniform(-2.0, 2.0), 1.0, random.integer(2, 6));
    const double low = random.uniform(0.0, 1.2);
    const Interval distances{ low, low + random.uniform(0.0, 0.5) };
    const Interval range = potential.range(distances);
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (int k = 0; k <= 100; ++k)
    {
      // Not past the end by rounding: the bound is exact.
      const double distance =
        std::min(distances.max, distances.min + (distances.max - distances.min) * k / 100.0);
      const double field = potential.evaluate(distance);
      EXPECT_TRUE(range.min <= field && field <= range.max);
      least = std::min(least, field);
      most = std::max(most, field);
    }
    EXPECT_NEAR(range.min, least, 1e-12);
    EXPECT_NEAR(range.max, most, 1e-12);
  }
}

TEST(Potential, ScalesWithTheLengths)
{
  const Potential potential(1.5, 2.0, 3);
  const Potential scaled = potential.scaled(4.0);
  for (const double r : { 0.0, 0.3, 1.0, 1.99, 2.5 })
  {
    EXPECT_DOUBLE_EQ(scaled.evaluate(4.0 * r), potential.evaluate(r));
  }
}

TEST(Potential, ParametersMakeExactlyTheSame)
{
  Parameters parameters;
  Potential::bySurfaceRadius(1.0 / 3.0, 0.7, 5, true).describe(parameters);
  Parameters again;
  Potential::fromParameters(parameters).describe(again);
  EXPECT_EQ(again.entries(), parameters.entries());
}

TEST(Potential, BadValuesAreNamed)
{
  const auto message = [](const auto& make) -> std::string
  {
    try
    {
      make();
    }
    catch (const InvalidParameter& error)
    {
      return error.what();
    }
    return "no error";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message([] { Potential(0.0, 1.0, 2); }),
    "MaximumField is 0; it must be a finite number other than 0.");
  EXPECT_EQ(message([&] { Potential(nan, 1.0, 2); }),
    "MaximumField is nan; it must be a finite number other than 0.");
  EXPECT_EQ(message([] { Potential(1.0, -1.0, 2); }),
    "InfluenceRadius is -1; it must be a finite length > 0.");
  EXPECT_EQ(message([] { Potential(1.0, 1.0, 1); }), "Exponent is 1; it must be from 2 to 64.");
  EXPECT_EQ(message([] { Potential(1.0, 1.0, 65); }), "Exponent is 65; it must be from 2 to 64.");
  const std::string range = "it must be at least 0 and less than InfluenceRadius, where the field "
                            "ends.";
  EXPECT_EQ(
    message([] { Potential::bySurfaceRadius(1.0, 1.0, 2); }), "SurfaceRadius is 1; " + range);
  EXPECT_EQ(
    message([] { Potential::bySurfaceRadius(-0.1, 1.0, 2); }), "SurfaceRadius is -0.1; " + range);
  EXPECT_EQ(
    message([&] { Potential::bySurfaceRadius(nan, 1.0, 2); }), "SurfaceRadius is nan; " + range);
  EXPECT_NE(message([] { Potential::bySurfaceRadius(1.0 - 1e-15, 1.0, 64); })
              .find("enlarge InfluenceRadius or lower Exponent"),
    std::string::npos);
  EXPECT_EQ(message([] { Potential::bySurfaceRadius(0.001, 1e6, 2); }),
    "InfluenceRadius is 1e+06; it must be at most 1000000 times SurfaceRadius, for the surface to "
    "be "
    "told from the skeleton in double precision.");
}

} // namespace
} // namespace hybridtree
