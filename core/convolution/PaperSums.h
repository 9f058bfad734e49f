// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Contents.h"
#include "core/convolution/BlendSelection.h"
#include "core/convolution/BlendingControl.h"
#include "core/convolution/GroupedElements.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// Blending as [SUB] 5 has it (BlendingKind::Paper): G_i = f_i + sum of alpha(u) f_j over the
/// immediate neighbours j of coarse element i, u being 0 where j is attached to i and 1 opposite
/// (Figure 12).
///
/// u is the parameter of the point's projection onto the line or plane through the corners of i in
/// the refined skeleton. It is not cut off beyond the ends, where alpha is constant in any case.
///
/// Immutable: any number of threads may ask.
class PaperSums
{
public:
  /// \param whole the field of all `elements`; lives as long as this, but may be moved.
  PaperSums(const GroupedElements& elements, const ConvolutionField& whole);

  /// G_i of one group, for points that are known to belong to it, as the vertices of a mesh around
  /// it are: no other element is looked at, and where i is not the largest it is not the field.
  /// Overwrites `value`, and `gradient` unless null.
  void evaluate(std::int32_t group, const ConvolutionKernel& kernel, PointBatch points,
    double* value, const VectorBatch* gradient) const;

  /// The field anywhere: the largest of all G_i, in each of which f_j counts no more than f_i. That
  /// makes it continuous, and changes nothing where i is the largest element.
  /// \param selection each of its units is one group. Overwrites as evaluate().
  void largest(const BlendSelection& selection, const ConvolutionField& whole, PointBatch points,
    double* value, const VectorBatch* gradient) const;

  /// Upper bound of the length of the gradient of largest(). \param bounds per unit.
  double slope(const BlendSelection& selection, const std::vector<FieldBounds>& bounds) const;

  /// What largest() depends on besides the elements that reach a place. \param isMet per group:
  /// whether any of its elements does.
  void describe(const std::vector<char>& isMet, Contents& contents) const;

private:
  // A neighbour of a group, and u: slope . p + offset.
  struct Neighbour
  {
    std::int32_t group;
    Vec3 slope;
    double offset;

    double parameter(const Vec3& p) const { return slope.dot(p) + offset; }
  };

  // Elements of all groups, one after the other, and the first of each group.
  template <class Element>
  struct Members
  {
    std::vector<const Element*> elements;
    std::vector<std::size_t> begin;

    ElementSpan<Element> of(std::int32_t group) const
    {
      const std::size_t* at = begin.data() + group;
      return { elements.data() + at[0], at[1] - at[0] };
    }
  };
  template <class Element, typename GroupOf>
  static Members<Element> sortByGroups(
    const std::vector<const Element*>& elements, std::size_t groupCount, const GroupOf& groupOf);

  void findShared();

  class Largest;

  static Neighbour neighbour(
    const GroupedElements& elements, std::size_t group, std::int32_t other);

  BlendShare share_;
  Members<SegmentElement> segments_;
  Members<TriangleElement> triangles_;
  std::vector<std::vector<Neighbour>> neighbours_; // per group
  // Per group: its own elements, and those of the neighbours, together where they have the same u.
  std::vector<std::vector<SharedElements>> shared_;
  std::vector<const SegmentElement*> sharedSegments_; // of all of them, one after the other
  std::vector<const TriangleElement*> sharedTriangles_;
};

} // namespace hybridtree
