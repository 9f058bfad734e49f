// SPDX-License-Identifier: BSD-3-Clause
// What sums of neighbours depend on besides the elements that reach a place.
#include "core/convolution/BlendPieces.h"
#include "core/convolution/BlendedField.h"

namespace hybridtree
{
namespace
{

/// All numbers of an element are doubles.
template <class Element>
void addNumbers(const Element& element, Contents& contents)
{
  static_assert(sizeof(Element) % sizeof(double) == 0, "an element is made of doubles");
  constexpr std::size_t kCount = sizeof(Element) / sizeof(double);
  double numbers[kCount];
  std::memcpy(numbers, static_cast<const void*>(&element), sizeof(Element));
  for (const double number : numbers)
  {
    contents.add(number);
  }
}

} // namespace

void PaperSums::describe(const std::vector<char>& isMet, Contents& contents) const
{
  for (std::size_t group = 0; group < isMet.size(); ++group)
  {
    if (!isMet[group])
    {
      continue;
    }
    contents.add(static_cast<std::uint64_t>(group));
    for (const Neighbour& neighbour : neighbours_[group])
    {
      if (isMet[static_cast<std::size_t>(neighbour.group)])
      {
        contents.add(neighbour.group);
        for (const double slope : neighbour.slope)
        {
          contents.add(slope);
        }
        contents.add(neighbour.offset);
      }
    }
    contents.add(std::int32_t(-1));
  }
}

// Pieces by the order in which they come here, so that it does not matter how many there are
// elsewhere.
void BlendPieces::describe(
  const std::vector<char>& isMet, const ConvolutionField& whole, Contents& contents) const
{
  const ConvolutionField& elements = elements_ ? *elements_ : whole;
  std::vector<std::int32_t> numbers(this->size(), -1);
  std::int32_t count = 0;
  for (std::size_t k = 0; k < this->size(); ++k)
  {
    numbers[k] = isMet[k] ? count++ : -1;
  }
  const auto addRow = [&](const PieceTable& table, std::size_t piece)
  {
    for (std::uint32_t k = table.begin[piece]; k < table.begin[piece + 1]; ++k)
    {
      if (isMet[table.weights[k].piece])
      {
        contents.add(numbers[table.weights[k].piece]);
        contents.add(table.weights[k].weight);
      }
    }
    contents.add(std::int32_t(-1));
  };
  for (std::size_t k = 0; k < this->size(); ++k)
  {
    if (!isMet[k])
    {
      continue;
    }
    const Piece& piece = pieces_[k];
    contents.add(piece.group);
    for (std::size_t element = piece.begin; element < piece.end; ++element)
    {
      piece.isTriangle ? addNumbers(elements.triangle(element), contents)
                       : addNumbers(elements.segment(element), contents);
    }
    addRow(sights_, k);
    addRow(shares_, k);
  }
}

void BlendedField::describeBlending(const std::vector<Box3>& boxes, Contents& contents) const
{
  if (!pieces_ && !paper_)
  {
    return;
  }
  contents.add(partSize_); // by which points are asked for together
  const ConvolutionField& elements = pieces_ && pieces_->elements() ? *pieces_->elements() : whole_;
  std::vector<char> isMet(pieces_ ? pieces_->size() : groupCount_, 0);
  ElementSelection reaching;
  for (const Box3& box : boxes)
  {
    elements.select(box, reaching);
    for (const SegmentElement* segment : reaching.segments)
    {
      const std::size_t k = elements.index(segment);
      isMet[pieces_ ? pieces_->ofSegment(k) : static_cast<std::size_t>(segmentGroups_[k])] = 1;
    }
    for (const TriangleElement* triangle : reaching.triangles)
    {
      const std::size_t k = elements.index(triangle);
      isMet[pieces_ ? pieces_->ofTriangle(k) : static_cast<std::size_t>(triangleGroups_[k])] = 1;
    }
  }
  if (paper_)
  {
    paper_->describe(isMet, contents);
  }
  else
  {
    pieces_->describe(isMet, whole_, contents);
  }
}

} // namespace hybridtree
