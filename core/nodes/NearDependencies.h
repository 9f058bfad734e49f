// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Dependency.h"
#include "core/nodes/Operator.h"

#include <unordered_map>
#include <vector>

namespace hybridtree
{

/// What the fields of trees in some boxes depend on: the leaves that reach into one of them, and
/// how they are put together above. An edit anywhere else leaves it equal.
///
/// Equal lists tell that fields, gradients, ranges, restrictions and source leaves are the same
/// there, to the last bit. Goes down through blends, Booleans and local blends
/// (Operator::pointwiseLaw()); any other node is one dependency as a whole.
class NearDependencies
{
public:
  /// Whether the numbers of leaves matter, or only the fields.
  enum class Leaves
  {
    Numbered,
    Nameless
  };

  NearDependencies(std::vector<Box3> boxes, Leaves leaves);

  /// \param node owned by a shared pointer. \param firstLeaf its first leaf in the whole tree.
  /// \param count whatever else is to be told of it.
  void add(const Node& node, std::int32_t firstLeaf, double count = 1.0)
  {
    this->add(node, firstLeaf, count, leaves_);
  }

  /// Adds a number that the rest depends on, too.
  void addNumber(double number, std::int64_t index);

  /// Whether a field that is 0 outside of `influence` may be felt in a box.
  bool reaches(const Box3& influence) const;

  /// Whether one of the nodes that were found is shaped by a mesh, as Node::isFaceted().
  bool isFaceted() const { return faceted_; }

  std::vector<Dependency> take() { return std::move(found_); }

private:
  void add(const Node& node, std::int32_t firstLeaf, double count, Leaves leaves);
  void addOperands(const Operator& node, const PointwiseLaw& law, std::int32_t firstLeaf,
    double count, Leaves leaves);

  std::vector<Box3> boxes_;
  Box3 whole_; ///< of the boxes
  Leaves leaves_;
  bool faceted_ = false;
  std::vector<Dependency> found_;
  ///@{
  /// Of operators in what was found, with leaves that are told apart and without.
  std::unordered_map<const Node*, std::int64_t> numberedPlaces_;
  std::unordered_map<const Node*, std::int64_t> namelessPlaces_;
  ///@}
};

} // namespace hybridtree
