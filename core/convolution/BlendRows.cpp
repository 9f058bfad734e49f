// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendRows.h"

#include <algorithm>

namespace hybridtree
{

BlendRows::BlendRows(const PiecesNear& pieces, const std::vector<char>& isUsed, Sums sums,
  PointBatch points, bool haveGradients)
  : pieces_(pieces)
  , share_(pieces.groups().control)
  , isUsed_(isUsed)
  , sums_(sums)
  , haveGradients_(haveGradients)
  , size_((points.size + kRowStep - 1) / kRowStep * kRowStep)
  , points_(size_)
  , singles_(kMostPoints * (haveGradients ? 4 : 1) * this->findPieces())
  , groups_(kOfGroup * pieces.groupCount())
  , pairs_(kMostPoints * this->findPairs())
  , totals_(kMostPoints * kTotals)
{
  for (std::size_t k = 0; k < size_; ++k)
  {
    points_.batch().set(k, points[std::min(k, points.size - 1)]);
  }
  // Of each row what is used.
  const auto clear = [&](ScratchArray& rows)
  {
    for (std::size_t at = 0; at < rows.size(); at += kMostPoints)
    {
      std::fill_n(rows.data() + at, size_, 0.0);
    }
  };
  clear(groups_);
  clear(pairs_);
  this->integrate();
}

const FarGroup& BlendRows::farGroup(std::size_t number) const
{
  return pieces_.groups().farGroups[static_cast<std::size_t>(pieces_.group(number))];
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
        add(pieces_[k], { pieces_[k].place, number, k - pieces_.begin(number) });
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

// \return how many.
std::size_t BlendRows::findPairs()
{
  std::size_t count = 0;
  if (sums_ == kMany)
  {
    for (std::size_t number = 0; number < isUsed_.size(); ++number)
    {
      pairsAt_.push_back(count);
      count += isUsed_[number] ? this->farGroup(number).near.size() : 0;
    }
  }
  return count;
}

// Where a piece's field goes, in near_.
void BlendRows::findRows(std::size_t piece)
{
  near_.clear();
  const auto& [place, own, index] = places_[piece];
  near_.push_back({ 1.0, this->of(own, kOwn) });
  if (sums_ == kOne)
  {
    this->forNear(piece,
      [&](std::size_t other, double nearness) {
        near_.push_back({ nearness, this->of(other, kNear) });
      });
    return;
  }
  const std::vector<std::uint32_t>& at = this->farGroup(own).nearAt[index];
  double* first = pairs_.data() + kMostPoints * pairsAt_[own];
  for (std::size_t k = 0; k < at.size(); ++k)
  {
    near_.push_back(
      { share_.farthest() - place->distances[k].distance, first + kMostPoints * at[k] });
  }
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

void BlendRows::addPairs(const std::size_t* begin, const std::size_t* end)
{
  std::for_each(
    begin, end, [&](std::size_t member) { std::fill_n(this->of(member, kNear), size_, 0.0); });
  for (const std::size_t* member = begin; member != end; ++member)
  {
    const double* from = pairs_.data() + kMostPoints * pairsAt_[*member];
    for (const std::int32_t group : this->farGroup(*member).near)
    {
      const std::int32_t other = pieces_.find(group);
      if (other >= 0 && isMember_[static_cast<std::size_t>(other)])
      {
        const ScaledRow to{ 1.0, this->of(static_cast<std::size_t>(other), kNear) };
        kernels_.addScaled(from, size_, &to, 1);
      }
      from += kMostPoints;
    }
  }
}

const double* BlendRows::sum(const std::size_t* begin, const std::size_t* end)
{
  isMember_.assign(isUsed_.size(), 0);
  varies_.assign(isUsed_.size(), 0);
  std::fill_n(totals_.data(), totals_.size(), 0.0);
  const ScaledRow whole{ 1.0, this->total(kWhole) };
  for (const std::size_t* member = begin; member != end; ++member)
  {
    isMember_[*member] = 1;
    kernels_.addScaled(this->of(*member, kOwn), size_, &whole, 1);
  }
  if (sums_ == kMany)
  {
    this->addPairs(begin, end);
  }
  for (const std::size_t* member = begin; member != end; ++member)
  {
    varies_[*member] = kernels_.findShares(share_.begin(), share_.farthest(), size_,
      { this->total(kWhole), this->of(*member, kNear), this->of(*member, kOwn),
        this->of(*member, kShare), this->of(*member, kStep), this->total(kShared),
        this->total(kShift) });
  }
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
    if (!isMember_[own])
    {
      continue;
    }
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
