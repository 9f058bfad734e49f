// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/Expansion.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

__extension__ typedef __int128 Wide;

// Integers of 50 bits: their products of two are exact in 128 bits, which is the judge.
TEST(Expansion, AgreesWithWideIntegers)
{
  test::Random random(11);
  const auto integer = [&]
  { return std::int64_t(random.bits() >> 14) * (random.chance(0.5) ? 1 : -1); };
  for (int round = 0; round < 2000; ++round)
  {
    const std::int64_t a = integer(), b = integer(), c = integer();
    const std::int64_t d = random.chance(0.3) ? b : integer();
    const Expansion left =
      Expansion(double(a)) * Expansion(double(b)) - Expansion(double(c)) * Expansion(double(d));
    const Wide exact = Wide(a) * b - Wide(c) * d;
    EXPECT_EQ(left.sign(), exact > 0 ? 1 : exact < 0 ? -1 : 0);
    EXPECT_DOUBLE_EQ(left.value(), double(exact));
  }
}

TEST(Expansion, KeepsWhatADoubleLoses)
{
  const Expansion big(1e200), small(1e-50);
  const Expansion sum = big * big.difference(1.0, 0.0) + small;
  EXPECT_EQ((sum - big).value(), 1e-50);
  EXPECT_TRUE((sum - big - small).isZero());
  EXPECT_EQ(Expansion::difference(1.0, 0x1p-80).sign(), 1);
  EXPECT_TRUE((Expansion::difference(1.0, 0x1p-80) - Expansion(1.0) + Expansion(0x1p-80)).isZero());
}

} // namespace
} // namespace hybridtree
