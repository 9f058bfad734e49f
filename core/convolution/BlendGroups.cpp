// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendGroups.h"

#include <array>

namespace hybridtree
{
namespace
{

// Kept between queries: there may be far more groups than one query meets.
thread_local std::array<std::vector<std::int32_t>, 2> numbers;
thread_local std::array<std::vector<std::int32_t>, 2> met;

} // namespace

GroupNumbers::GroupNumbers(std::size_t groups, Use use) : numbers_(numbers[use]), groups_(met[use])
{
  groups_.clear();
  if (numbers_.size() < groups)
  {
    numbers_.resize(groups, -1);
  }
}

GroupNumbers::~GroupNumbers()
{
  for (const std::int32_t group : groups_)
  {
    numbers_[static_cast<std::size_t>(group)] = -1;
  }
}

std::size_t GroupNumbers::add(std::int32_t group)
{
  std::int32_t& number = numbers_[static_cast<std::size_t>(group)];
  if (number < 0)
  {
    number = static_cast<std::int32_t>(groups_.size());
    groups_.push_back(group);
  }
  return static_cast<std::size_t>(number);
}

} // namespace hybridtree
