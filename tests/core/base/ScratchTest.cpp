// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Scratch.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

TEST(Scratch, NestedArraysDoNotOverlap)
{
  ScratchArray outer(1000);
  std::fill_n(outer.data(), outer.size(), 1.0);
  for (int round = 0; round < 3; ++round)
  {
    ScratchArray inner(1u << 17); // larger than a block
    std::fill_n(inner.data(), inner.size(), 2.0);
    ScratchArray innermost(10);
    std::fill_n(innermost.data(), innermost.size(), 3.0);
    EXPECT_EQ(inner[(1u << 17) - 1], 2.0);
  }
  for (std::size_t k = 0; k < outer.size(); ++k)
  {
    ASSERT_EQ(outer[k], 1.0) << "at " << k;
  }
}

TEST(Scratch, MemoryIsUsedAgain)
{
  double* first = nullptr;
  {
    ScratchArray array(100);
    first = array.data();
  }
  ScratchArray again(100);
  EXPECT_EQ(again.data(), first);
}

} // namespace
} // namespace hybridtree
