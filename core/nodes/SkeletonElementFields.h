// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/SubdivisionSkeleton.h"
#include "core/subdivision/PlacedField.h"

#include <memory>
#include <mutex>

namespace hybridtree
{

/// The field of a skeleton near single coarse elements, for meshes around its pieces. Which refined
/// elements reach the surroundings of a coarse one is found once for all its points.
class SkeletonElementFields final : public ElementFields
{
public:
  enum class Sums
  {
    Largest, ///< the field itself
    Own      ///< with BlendingKind::Paper the sum of the element alone, as [SUB] has it
  };

  /// \pre the leaf has no map and is not negative. Lives no longer than the leaf.
  SkeletonElementFields(const SubdivisionSkeleton& leaf, Sums sums);
  ~SkeletonElementFields() override;

  bool areOwnSums() const override { return haveOwnSums_; }
  void evaluate(std::int32_t element, PointBatch points, double* value,
    const VectorBatch* gradient) const override;

private:
  struct Surroundings;

  const Surroundings& surroundings(std::int32_t element) const;

  const SubdivisionSkeleton& leaf_;
  bool haveOwnSums_;
  std::unique_ptr<Surroundings[]> surroundings_;
};

} // namespace hybridtree
