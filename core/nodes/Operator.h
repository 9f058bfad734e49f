// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace hybridtree
{

///@{
/// Queries recurse along the depth and may take time in proportion to the leaves, so both have an
/// end. A leaf counts once for each path that leads to it.
inline constexpr int kLargestDepth = 1000;
inline constexpr std::int64_t kMostLeaves = 1'000'000;
///@}

/// How the field of a node at a point follows from those of its children there.
struct PointwiseLaw
{
  std::int32_t number; ///< tells it from all others, parameters included
  /// Whatever is 0 may as well not be there. Otherwise there are at most 3 operands.
  bool isSum = false;
};

/// What a node is computed from.
struct Operand
{
  const Node* node = nullptr;
  std::int32_t firstLeaf = 0; ///< among the leaves of the whole
  std::int32_t count = 1;     ///< how often it is added
  bool hasSources = true;     ///< a triangle may have its source leaf in it
};

/// An inner node: what all operators have in common.
///
/// Children are shared: one node may stand in many places, and the number of paths to it doubles
/// with every node that takes it twice. So whatever rebuilds or prepares a tree is kept here, once
/// for each node instead of once for each path.
class Operator : public Node
{
public:
  int leafCount() const final { return leafCount_; }
  int depth() const final { return depth_; }
  bool isFaceted() const override { return faceted_; }
  std::vector<NodePtr> children() const final { return children_; }
  NodePtr underBlend() const final;
  void prepare(const Progress& progress) const final;

  /// Where field, gradient and source leaf at a point are told by those of the operands there, one
  /// that does not reach it being 0. Nothing for others, such as maps of space.
  virtual std::optional<PointwiseLaw> pointwiseLaw() const { return std::nullopt; }

  /// The operands of that law, in the order in which they are computed with: by default the
  /// children. Of a sum at least those that reach the box.
  virtual void visitOperands(
    const Box3& box, const std::function<void(const Operand&)>& visit) const;

protected:
  /// \throws InvalidParameter when a child is null, TooLarge beyond kLargestDepth or kMostLeaves.
  explicit Operator(std::vector<NodePtr> children);

  const NodePtr& child(std::size_t index = 0) const { return children_[index]; }

  /// A copy of this node over as many other children.
  virtual NodePtr withChildren(std::vector<NodePtr> children) const = 0;

  /// As Node::makeAffine(). By default this operator over the images of its children.
  virtual NodePtr makeImage(const Affine3& map) const;

  /// As Node::underBlend(). By default this operator over its children as they have to be there.
  virtual NodePtr makeUnderBlend() const;

  /// Work of this node itself that its field needs. \pre the children are prepared.
  virtual void prepareField(const Progress& progress) const { static_cast<void>(progress); }

  /// The children's images under a map; those of equal children are one node again.
  std::vector<NodePtr> imagesOfChildren(const Affine3& map) const;

private:
  NodePtr makeAffine(const Affine3& map) const final;

  std::vector<NodePtr> children_;
  int leafCount_ = 0;
  int depth_ = 1;
  bool faceted_ = false;

  mutable std::mutex mutex_;
  mutable bool prepared_ = false;
  mutable bool smoothIsKnown_ = false;
  mutable NodePtr smooth_; ///< underBlend(), null where that is this node
  mutable Affine3 map_;    ///< of the last image
  mutable std::weak_ptr<const Node> image_;
};

} // namespace hybridtree
