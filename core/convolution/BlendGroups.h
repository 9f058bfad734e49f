// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionField.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Which elements of a field belong together.
struct ElementGroups
{
  const ConvolutionField& whole;
  const std::vector<std::int32_t>& segments; ///< per element of `whole`, as it was given them
  const std::vector<std::int32_t>& triangles;
  std::size_t count; ///< of groups
};

/// Numbers for some of many groups, or pieces, in the order in which they are met. In a thread one
/// at a time of each use.
class GroupNumbers
{
public:
  enum Use
  {
    kReaching,
    kPieces
  };

  explicit GroupNumbers(std::size_t groups, Use use = kReaching);
  ~GroupNumbers();
  GroupNumbers(const GroupNumbers&) = delete;
  GroupNumbers& operator=(const GroupNumbers&) = delete;

  std::size_t size() const { return groups_.size(); }
  /// The number of the group, a new one if it has none.
  std::size_t add(std::int32_t group);
  /// -1 for none.
  std::int32_t find(std::int32_t group) const { return numbers_[static_cast<std::size_t>(group)]; }
  std::int32_t group(std::size_t number) const { return groups_[number]; }

private:
  std::vector<std::int32_t>& numbers_; // per group; -1 for none
  std::vector<std::int32_t>& groups_;
};

} // namespace hybridtree
