// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Operator.h"

#include "core/base/Error.h"
#include "core/nodes/DerivedNodes.h"

#include <algorithm>
#include <unordered_map>

namespace hybridtree
{

namespace
{

NodePtr imageOf(const NodePtr& node, const Affine3& map)
{
  static auto* const images = new DerivedNodes; // outlives all statics
  return images->of({ { node, 0.0, 0 } }, map, [&] { return node->affine(map); });
}

} // namespace

Operator::Operator(std::vector<NodePtr> children) : children_(std::move(children))
{
  std::int64_t leaves = 0;
  for (const NodePtr& child : children_)
  {
    if (!child)
    {
      throw InvalidParameter("A child of the node", "null", "a node");
    }
    leaves += child->leafCount();
    depth_ = std::max(depth_, child->depth() + 1);
    faceted_ = faceted_ || child->isFaceted();
  }
  if (leaves > kMostLeaves)
  {
    throw TooLarge("The tree would have " + std::to_string(leaves) +
      " leaves, where one that stands in several places counts several times; at most " +
      std::to_string(kMostLeaves) + " are allowed. Combine fewer nodes.");
  }
  if (depth_ > kLargestDepth)
  {
    throw TooLarge("The tree would have " + std::to_string(depth_) +
      " nodes above each other; at most " + std::to_string(kLargestDepth) +
      " are allowed. Combine more nodes in one blend, or fewer in a row.");
  }
  leafCount_ = static_cast<int>(leaves);
}

NodePtr Operator::underBlend() const
{
  // Held meanwhile: below are only other nodes, as a tree has no cycles.
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!smoothIsKnown_)
  {
    NodePtr smooth = this->makeUnderBlend();
    smooth_ = smooth.get() == this ? nullptr : std::move(smooth);
    smoothIsKnown_ = true;
  }
  return smooth_ ? smooth_ : this->shared_from_this();
}

void Operator::prepare(const Progress& progress) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (prepared_)
  {
    return;
  }
  progress.check();
  for (const NodePtr& child : children_)
  {
    child->prepare(progress);
  }
  this->prepareField(progress);
  prepared_ = true;
}

void Operator::visitOperands(const Box3&, const std::function<void(const Operand&)>& visit) const
{
  Operand operand;
  for (const NodePtr& child : children_)
  {
    operand.node = child.get();
    visit(operand);
    operand.firstLeaf += child->leafCount();
  }
}

NodePtr Operator::makeAffine(const Affine3& map) const
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    NodePtr known = image_.lock();
    if (known && map_.matrix() == map.matrix())
    {
      return known;
    }
  }
  NodePtr image = this->makeImage(map);
  const std::lock_guard<std::mutex> lock(mutex_);
  map_ = map;
  image_ = image;
  return image;
}

NodePtr Operator::makeImage(const Affine3& map) const
{
  return this->withChildren(this->imagesOfChildren(map));
}

NodePtr Operator::makeUnderBlend() const
{
  std::vector<NodePtr> smooth;
  smooth.reserve(children_.size());
  for (const NodePtr& child : children_)
  {
    smooth.push_back(child->underBlend());
  }
  return smooth == children_ ? this->shared_from_this() : this->withChildren(std::move(smooth));
}

std::vector<NodePtr> Operator::imagesOfChildren(const Affine3& map) const
{
  std::unordered_map<const Node*, NodePtr> images;
  std::vector<NodePtr> result;
  result.reserve(children_.size());
  for (const NodePtr& child : children_)
  {
    NodePtr& image = images[child.get()];
    image = image ? image : imageOf(child, map);
    result.push_back(image);
  }
  return result;
}

} // namespace hybridtree
