// SPDX-License-Identifier: BSD-3-Clause
// Private: arrays that find all of their ranges at once.
#ifndef vtkHybridTreeRangedArray_h
#define vtkHybridTreeRangedArray_h

#include "vtkType.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace hybridtree
{

/// Least and largest values of an array.
struct ArrayRanges
{
  std::vector<double> components; ///< two for each: the least, the largest
  double squaredNorm[2];          ///< of the tuples
};

///@{
/// Of an array of at least one tuple of 1 or 3 values, in one pass over it, with all threads. None
/// of other arrays, and none where a value is not finite or its square is not.
std::optional<ArrayRanges> rangesOf(const double* values, int components, vtkIdType tuples);
std::optional<ArrayRanges> rangesOf(const vtkTypeInt32* values, int components, vtkIdType tuples);
///@}

/// An array of VTK that looks for its ranges once, when it is first asked for any of them.
///
/// After every update ParaView asks all arrays for four kinds of ranges, and points for their
/// bounds in addition. VTK makes a pass for each, on one thread as it is packaged: for a mesh that
/// is dragged that took twice as long as to mesh it anew. As VTK's own ranges, these are kept until
/// Modified(). To all others this is a Base, by class name too, and so are its copies.
///
/// \tparam Base vtkDoubleArray or vtkTypeInt32Array.
template <class Base>
class RangedArray : public Base
{
public:
  static RangedArray* New()
  {
    auto* array = new RangedArray;
    array->InitializeObjectBase();
    return array;
  }

  RangedArray(const RangedArray&) = delete;
  RangedArray& operator=(const RangedArray&) = delete;

protected:
  RangedArray() = default;
  ~RangedArray() override = default;

  // Those without ghosts are the ones that ParaView asks for.
  using Base::ComputeFiniteScalarRange;
  using Base::ComputeFiniteVectorRange;
  using Base::ComputeScalarRange;
  using Base::ComputeVectorRange;

  bool ComputeScalarRange(double* ranges) override
  {
    return this->CopyComponents(ranges) || Base::ComputeScalarRange(ranges);
  }

  bool ComputeFiniteScalarRange(double* ranges) override
  {
    return this->CopyComponents(ranges) || Base::ComputeFiniteScalarRange(ranges);
  }

  bool ComputeVectorRange(double range[2]) override
  {
    return this->CopyNorm(range) || Base::ComputeVectorRange(range);
  }

  bool ComputeFiniteVectorRange(double range[2]) override
  {
    return this->CopyNorm(range) || Base::ComputeFiniteVectorRange(range);
  }

private:
  /// Null where VTK has to look.
  const ArrayRanges* Known()
  {
    if (this->FoundAt != this->GetMTime())
    {
      const vtkIdType tuples = this->GetNumberOfTuples();
      this->Found = tuples > 0
        ? rangesOf(this->GetPointer(0), this->GetNumberOfComponents(), tuples)
        : std::nullopt;
      this->FoundAt = this->GetMTime();
    }
    return this->Found ? &*this->Found : nullptr;
  }

  bool CopyComponents(double* ranges)
  {
    const ArrayRanges* known = this->Known();
    if (known)
    {
      std::copy(known->components.begin(), known->components.end(), ranges);
    }
    return known != nullptr;
  }

  bool CopyNorm(double range[2])
  {
    const ArrayRanges* known = this->Known();
    if (known)
    {
      range[0] = std::sqrt(known->squaredNorm[0]);
      range[1] = std::sqrt(known->squaredNorm[1]);
    }
    return known != nullptr;
  }

  std::optional<ArrayRanges> Found;
  vtkMTimeType FoundAt = 0;
};

} // namespace hybridtree

#endif
