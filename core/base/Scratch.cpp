// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Scratch.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace hybridtree
{
namespace
{

constexpr std::size_t kBlock = 1 << 16; // doubles
constexpr std::size_t kAlign = 8;       // doubles: one cache line

struct Stack
{
  struct Block
  {
    std::unique_ptr<double[]> memory;
    std::size_t capacity;
  };
  std::vector<Block> blocks;
  std::size_t block = 0;
  std::size_t used = 0;
};

Stack& stack()
{
  thread_local Stack instance;
  return instance;
}

} // namespace

ScratchArray::ScratchArray(std::size_t size)
  : size_(size)
{
  Stack& s = stack();
  block_ = s.block;
  offset_ = s.used;
  const std::size_t need = (size + kAlign - 1) / kAlign * kAlign;
  while (s.block >= s.blocks.size() || s.used + need > s.blocks[s.block].capacity)
  {
    if (s.block < s.blocks.size())
    {
      ++s.block;
      s.used = 0;
    }
    if (s.block >= s.blocks.size())
    {
      const std::size_t capacity = std::max(kBlock, need);
      s.blocks.push_back({ std::unique_ptr<double[]>(new double[capacity]), capacity });
    }
  }
  data_ = s.blocks[s.block].memory.get() + s.used;
  s.used += need;
}

ScratchArray::~ScratchArray()
{
  Stack& s = stack();
  s.block = block_;
  s.used = offset_;
}

} // namespace hybridtree
