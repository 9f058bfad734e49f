// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Boxes in a bounding box hierarchy, to find those that touch another box.
class ElementTree
{
public:
  ElementTree() = default;
  explicit ElementTree(const std::vector<Box3>& boxes);

  /// Of all boxes; empty for none.
  Box3 bounds() const { return nodes_.empty() ? Box3() : nodes_.front().box; }

  /// Calls visit(index) for every box that touches `box`, in the order of the tree.
  template <typename Visit>
  void visit(const Box3& box, Visit&& visit) const
  {
    std::uint32_t index = 0;
    while (index < nodes_.size())
    {
      const TreeNode& node = nodes_[index];
      if (!node.box.intersects(box))
      {
        index = node.next;
        continue;
      }
      for (std::uint32_t k = 0; k < node.count; ++k)
      {
        if (boxes_[node.first + k].intersects(box))
        {
          visit(order_[node.first + k]);
        }
      }
      ++index;
    }
  }

private:
  /// Depth-first: the first child of an inner node (count 0) is the next node; `next` is the first
  /// behind all that is below.
  struct TreeNode
  {
    Box3 box;
    std::uint32_t first;
    std::uint32_t count;
    std::uint32_t next;
  };

  void build(const std::vector<Box3>& boxes, std::uint32_t begin, std::uint32_t end);

  std::vector<std::uint32_t> order_; ///< indices of boxes as leaves have them
  std::vector<Box3> boxes_;          ///< in that order
  std::vector<TreeNode> nodes_;
};

} // namespace hybridtree
