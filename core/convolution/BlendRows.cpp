// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendRows.h"

#include <algorithm>

namespace hybridtree
{

BlendRows::BlendRows(
  const PiecesNear& pieces, const std::vector<char>& isUsed, PointBatch points, bool haveGradients)
  : pieces_(pieces)
  , share_(pieces.groups().control)
  , isUsed_(isUsed)
  , haveGradients_(haveGradients)
  , size_((points.size + kRowStep - 1) / kRowStep * kRowStep)
  , points_(size_)
  , singles_(kMostPoints * (haveGradients ? 4 : 1) * this->findPieces())
  , groups_(kOfGroup * pieces.groupCount())
  , totals_(kMostPoints * kTotals)
{
  for (std::size_t k = 0; k < size_; ++k)
  {
    points_.batch().set(k, points[std::min(k, points.size - 1)]);
  }
  for (std::size_t at = 0; at < groups_.size(); at += kMostPoints)
  {
    std::fill_n(groups_.data() + at, size_, 0.0); // of each row what is used
  }
  this->integrate();
}

// Segments first, so that their rows are together. \return how many.
std::size_t BlendRows::findPieces()
{
  const auto find = [&](const auto& add)
  {
    for (std::size_t number = 0; number < isUsed_.size(); ++number)
    {
      for (std::size_t k = pieces_.begin(number); isUsed_[number] && k < pieces_.end(number); ++k)
      {
        add(pieces_[k], { pieces_[k].place, number });
      }
    }
  };
  find(
    [&](const BlendPiece& piece, const PlacedPiece& placed)
    {
      if (piece.segment)
      {
        segments_.push_back(piece.segment);
        places_.push_back(placed);
      }
    });
  find(
    [&](const BlendPiece& piece, const PlacedPiece& placed)
    {
      if (piece.triangle)
      {
        triangles_.push_back(piece.triangle);
        places_.push_back(placed);
      }
    });
  return places_.size();
}

// body(number, farthest - d) of the groups near a piece, its own, too.
template <typename Body>
void BlendRows::forNear(std::size_t piece, const Body& body) const
{
  for (const GroupDistance& near : places_[piece].place->distances)
  {
    const std::int32_t number = pieces_.find(near.group);
    if (number >= 0 && isUsed_[static_cast<std::size_t>(number)])
    {
      body(static_cast<std::size_t>(number), share_.farthest() - near.distance);
    }
  }
}

// Where a piece's field goes, in near_.
void BlendRows::findRows(std::size_t piece)
{
  near_.clear();
  near_.push_back({ 1.0, this->of(places_[piece].number, kOwn) });
  this->forNear(piece,
    [&](std::size_t other, double nearness) {
      near_.push_back({ nearness, this->of(other, kNear) });
    });
}

void BlendRows::integrate()
{
  const ConvolutionKernel& kernel = pieces_.groups().whole.kernel();
  const ConvolutionKernels& kernels = convolutionKernels(kernel.kind);
  const auto rows = [&](std::size_t piece) {
    return ElementRows{ this->single(piece), kMostPoints, haveGradients_ };
  };
  kernels.segmentRows({ segments_.data(), segments_.size() }, kernel, points_.points(), rows(0));
  kernels.triangleRows(
    { triangles_.data(), triangles_.size() }, kernel, points_.points(), rows(segments_.size()));
  for (std::size_t piece = 0; piece < places_.size(); ++piece)
  {
    this->findRows(piece);
    kernels_.addScaled(this->single(piece), size_, near_.data(), near_.size());
  }
}

const double* BlendRows::sum()
{
  varies_.assign(isUsed_.size(), 0);
  std::fill_n(totals_.data(), totals_.size(), 0.0);
  const ScaledRow whole{ 1.0, this->total(kWhole) };
  const auto forMembers = [&](const auto& body)
  {
    for (std::size_t number = 0; number < isUsed_.size(); ++number)
    {
      if (isUsed_[number])
      {
        body(number);
      }
    }
  };
  forMembers(
    [&](std::size_t member) { kernels_.addScaled(this->of(member, kOwn), size_, &whole, 1); });
  forMembers(
    [&](std::size_t member)
    {
      varies_[member] = kernels_.findShares(share_.begin(), share_.farthest(), size_,
        { this->total(kWhole), this->of(member, kNear), this->of(member, kOwn),
          this->of(member, kShare), this->of(member, kStep), this->total(kShared),
          this->total(kShift) });
    });
  return this->total(kShared);
}

// With n(c, j) = farthest - d(c, j), that of piece c in the gradient of G is
// alpha_j(c) + sum over j of s_j (near_j / F - n(c, j)).
VectorBatch BlendRows::gradient()
{
  double* first = this->total(kGradient);
  for (std::size_t piece = 0; piece < places_.size(); ++piece)
  {
    const std::size_t own = places_[piece].number;
    near_.clear();
    this->forNear(piece,
      [&](std::size_t other, double nearness)
      {
        if (varies_[other])
        {
          near_.push_back({ nearness, this->of(other, kStep) });
        }
      });
    kernels_.addGradient(this->of(own, kShare), this->total(kShift), near_.data(), near_.size(),
      size_, this->single(piece) + kMostPoints, kMostPoints, first);
  }
  return { first, first + kMostPoints, first + 2 * kMostPoints };
}

} // namespace hybridtree
