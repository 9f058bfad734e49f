// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Contents.h"
#include "core/nodes/SubdivisionSkeleton.h"
#include "core/subdivision/LocalField.h"

#include <mutex>
#include <optional>

namespace hybridtree
{

/// The field of a skeleton leaf, for what is kept while the skeleton is edited.
///
/// With the compact kernel a place depends on the elements that reach it, and where neighbours
/// blend on how far these are from each other along the skeleton, or, as in [SUB], on the corners
/// of these coarse elements. The Cauchy kernel reaches everywhere: there every place depends on the
/// whole skeleton, but for the sum of one element in [SUB]. That depends on the elements that share
/// a corner with it, with any kernel.
class SkeletonLocalField final : public LocalField
{
public:
  /// \pre the leaf has no map and is not negative. Lives no longer than the leaf.
  explicit SkeletonLocalField(const SubdivisionSkeleton& leaf) : leaf_(leaf) {}

  Dependency around(const std::vector<Box3>& boxes) const override;
  Dependency ownSums(
    const std::vector<std::int32_t>& elements, const std::vector<Box3>& boxes) const override;
  Near near(const std::vector<Box3>& boxes) const override;
  /// The nearest piece of the skeleton.
  void findSources(TriangleMesh& island, const Progress& progress) const override;

private:
  bool isLocal() const;
  void addOptions(Contents& contents) const;
  void addElements(const std::vector<Box3>& boxes, Contents& contents) const;
  void addChildren(std::size_t element, Contents& contents) const;
  void addPoint(std::int32_t point, Contents& contents) const;
  const Dependency& whole() const;

  const SubdivisionSkeleton& leaf_;
  mutable std::once_flag wholeOnce_;
  mutable std::optional<Dependency> whole_;
};

} // namespace hybridtree
