// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/LimbSelector.h"

namespace hybridtree
{
namespace
{

class Selector
{
public:
  Selector(const BlendPieces& pieces, const ConvolutionField& elements,
    const ElementSelection& reaching, BlendSelection::Limbs& limbs)
    : pieces_(pieces)
    , elements_(elements)
    , limbs_(limbs)
    , numbers_(pieces.size(), GroupNumbers::kPieces)
  {
    limbs.pieces.clear();
    limbs.segments.assign(reaching.segments.begin(), reaching.segments.end());
    limbs.triangles.assign(reaching.triangles.begin(), reaching.triangles.end());
    this->number(
      limbs.segments, limbs.segmentsBegin, [&](std::size_t k) { return pieces.ofSegment(k); });
    limbs.ofSegments = limbs.pieces.size();
    this->number(
      limbs.triangles, limbs.trianglesBegin, [&](std::size_t k) { return pieces.ofTriangle(k); });
  }

  bool find()
  {
    this->findRows(pieces_.shares(), limbs_.sharesBegin, limbs_.shares);
    if (limbs_.shares.empty())
    {
      return false;
    }
    this->findRows(pieces_.sights(), limbs_.sightsBegin, limbs_.sights);
    return true;
  }

private:
  // Elements of a piece are in a row.
  template <class Element, typename PieceOf>
  void number(const std::vector<const Element*>& elements, std::vector<std::uint32_t>& begin,
    const PieceOf& pieceOf)
  {
    begin.clear();
    for (std::uint32_t k = 0; k < elements.size(); ++k)
    {
      const std::uint32_t piece = pieceOf(elements_.index(elements[k]));
      if (limbs_.pieces.empty() || limbs_.pieces.back() != piece)
      {
        numbers_.add(static_cast<std::int32_t>(piece));
        limbs_.pieces.push_back(piece);
        begin.push_back(k);
      }
    }
    begin.push_back(static_cast<std::uint32_t>(elements.size()));
  }

  void findRows(
    const PieceTable& table, std::vector<std::uint32_t>& begin, std::vector<PieceWeight>& weights)
  {
    begin.assign(1, 0);
    weights.clear();
    for (const std::uint32_t piece : limbs_.pieces)
    {
      for (std::uint32_t k = table.begin[piece]; k < table.begin[piece + 1]; ++k)
      {
        const auto& [other, weight] = table.weights[k];
        const std::int32_t number = numbers_.find(static_cast<std::int32_t>(other));
        if (number >= 0)
        {
          weights.push_back({ static_cast<std::uint32_t>(number), weight });
        }
      }
      begin.push_back(static_cast<std::uint32_t>(weights.size()));
    }
  }

  const BlendPieces& pieces_;
  const ConvolutionField& elements_;
  BlendSelection::Limbs& limbs_;
  GroupNumbers numbers_;
};

} // namespace

bool areGroupsApart(
  const ElementGroups& groups, const BlendPieces& pieces, const ElementSelection& elements)
{
  GroupNumbers numbers(groups.count);
  for (const SegmentElement* segment : elements.segments)
  {
    numbers.add(groups.segments[groups.whole.index(segment)]);
  }
  for (const TriangleElement* triangle : elements.triangles)
  {
    numbers.add(groups.triangles[groups.whole.index(triangle)]);
  }
  for (std::size_t k = 0; k < numbers.size(); ++k)
  {
    for (const std::int32_t other : pieces.apart(static_cast<std::size_t>(numbers.group(k))))
    {
      if (numbers.find(other) >= 0)
      {
        return true;
      }
    }
  }
  return false;
}

bool selectLimbs(const BlendPieces& pieces, const ConvolutionField& whole, const Box3& box,
  BlendSelection& selection)
{
  if (!pieces.elements())
  {
    return Selector(pieces, whole, selection.all, selection.limbs).find();
  }
  static thread_local ElementSelection reaching; // no allocation once warm
  pieces.elements()->select(box, reaching);
  return Selector(pieces, *pieces.elements(), reaching, selection.limbs).find();
}

} // namespace hybridtree
