// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

#include <array>

namespace hybridtree
{

/// The terms of a sum of fields in a bounding box hierarchy over their influence bounds, so that a
/// brick finds those that reach it. Holds no ownership: the blend that has it owns the nodes.
///
/// Small: a tree of hundreds of primitives is to stay a few dozen kilobytes. Boxes are floats about
/// a common origin, rounded outward, and only groups of terms have one.
class BlendHierarchy
{
public:
  struct Term
  {
    const Node* node = nullptr;
    std::int32_t firstLeaf = 0; ///< index of the node's first leaf among those of the blend
    std::int32_t count = 1;     ///< how often it is added
  };

  explicit BlendHierarchy(std::vector<Term> terms);

  const std::vector<Term>& terms() const { return terms_; }

  /// Calls visit(term) for every term whose group's bounds touch the box. Which of two comes first
  /// is told by these two alone: terms that do not reach a point leave its sum as it is, to the
  /// last bit.
  template <typename Visit>
  void visit(const Box3& box, Visit&& visit) const
  {
    if (groups_.empty() || box.isEmpty())
    {
      return;
    }
    const FloatBox query = this->rounded(box);
    std::uint32_t index = 0;
    while (index < groups_.size())
    {
      const Group& group = groups_[index];
      if (!group.box.touches(query))
      {
        index = group.next;
        continue;
      }
      for (std::uint32_t k = 0; k < group.count; ++k)
      {
        visit(terms_[group.first + k]);
      }
      ++index;
    }
  }

private:
  struct FloatBox
  {
    std::array<float, 3> min;
    std::array<float, 3> max;

    bool touches(const FloatBox& other) const
    {
      return min[0] <= other.max[0] && other.min[0] <= max[0] && min[1] <= other.max[1] &&
        other.min[1] <= max[1] && min[2] <= other.max[2] && other.min[2] <= max[2];
    }
  };

  /// Depth-first order: the first child of an inner group (count 0) is the next one, and `next` is
  /// the first group behind all that is below.
  struct Group
  {
    FloatBox box;
    std::uint32_t first;
    std::uint32_t next;
    std::uint32_t count;
  };

  FloatBox rounded(const Box3& box) const;
  void build(const std::vector<std::pair<Box3, Term>>& items, std::size_t begin, std::size_t end);

  std::vector<Term> terms_;
  std::vector<Group> groups_;
  Vec3 origin_ = Vec3::Zero();
};

} // namespace hybridtree
