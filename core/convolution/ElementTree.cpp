// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ElementTree.h"

#include <algorithm>
#include <numeric>

namespace hybridtree
{

ElementTree::ElementTree(const std::vector<Box3>& boxes) : order_(boxes.size())
{
  std::iota(order_.begin(), order_.end(), 0u);
  if (!boxes.empty())
  {
    this->build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
    boxes_.reserve(boxes.size());
    for (const std::uint32_t index : order_)
    {
      boxes_.push_back(boxes[index]);
    }
  }
}

void ElementTree::build(const std::vector<Box3>& boxes, std::uint32_t begin, std::uint32_t end)
{
  constexpr std::uint32_t kLeaf = 4;
  TreeNode node{ Box3(), begin, 0, 0 };
  Box3 centers;
  for (std::uint32_t k = begin; k < end; ++k)
  {
    node.box.extend(boxes[order_[k]]);
    centers.extend(boxes[order_[k]].center());
  }
  const std::size_t place = nodes_.size();
  node.count = end - begin <= kLeaf ? end - begin : 0;
  nodes_.push_back(node);
  if (node.count == 0)
  {
    Eigen::Index axis;
    centers.sizes().maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    // By index where centers are equal: the same order with every library.
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](std::uint32_t a, std::uint32_t b)
      {
        const double centerA = boxes[a].min()[axis] + boxes[a].max()[axis];
        const double centerB = boxes[b].min()[axis] + boxes[b].max()[axis];
        return centerA != centerB ? centerA < centerB : a < b;
      });
    this->build(boxes, begin, middle);
    this->build(boxes, middle, end);
  }
  nodes_[place].next = static_cast<std::uint32_t>(nodes_.size());
}

} // namespace hybridtree
