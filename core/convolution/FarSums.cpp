// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/FarSums.h"

namespace hybridtree
{
namespace
{

thread_local std::vector<double> pieceRows; // kept between queries: no allocation once warm

} // namespace

FarSums::FarSums(const BlendGroups& groups, PointBatch points, bool haveGradients)
  : groups_(groups)
  , share_(groups.control)
  , haveGradients_(haveGradients)
  , size_((points.size + kRowStep - 1) / kRowStep * kRowStep)
  , rowsOf_(groups.size(), nullptr)
  , isKnown_(groups.size(), 0)
  , isMember_(groups.size(), 0)
  , varies_(groups.size(), 0)
  , pieces_(pieceRows)
  , points_(size_)
  , rows_(groups.size() * kRows * size_)
  , totals_(kTotals * size_)
{
  for (std::size_t k = 0; k < size_; ++k)
  {
    points_.batch().set(k, points[std::min(k, points.size - 1)]);
  }
}

const double* FarSums::field(std::int32_t group)
{
  if (!this->isKnown(group))
  {
    this->integrate(group);
  }
  return this->of(group, kOwn);
}

void FarSums::integrate(std::int32_t number)
{
  const FarGroup& group = this->group(number);
  const Known known{ number,
    known_.empty() ? 0
                   : known_.back().pieces +
        this->group(known_.back().group).size() * this->rowsOfPiece() * size_ };
  isKnown_[static_cast<std::size_t>(number)] = 1;
  known_.push_back(known);
  const std::size_t rows = group.size() * this->rowsOfPiece() * size_;
  if (pieces_.size() < known.pieces + rows)
  {
    pieces_.resize(2 * (known.pieces + rows));
  }
  const ConvolutionKernel& kernel = groups_.whole.kernel();
  const ConvolutionKernels& kernels = convolutionKernels(kernel.kind);
  double* first = pieces_.data() + known.pieces;
  kernels.segmentRows({ group.segments.data(), group.segments.size() }, kernel, points_.points(),
    { first, size_, haveGradients_ });
  kernels.triangleRows({ group.triangles.data(), group.triangles.size() }, kernel, points_.points(),
    { first + group.segments.size() * this->rowsOfPiece() * size_, size_, haveGradients_ });
  to_.assign(1, { 0, this->of(number, kOwn) });
  for (std::size_t k = 0; k < group.near.size(); ++k)
  {
    to_.push_back({ 1 + k, this->of(group.near[k], kNear) });
  }
  this->addProducts(known, 1.0);
}

// Of its pieces and what they are to groups, to_.
void FarSums::addProducts(const Known& known, double scale)
{
  const FarGroup& group = this->group(known.group);
  kernels_.addProducts(pieces_.data() + known.pieces, this->rowsOfPiece() * size_, group.size(),
    group.nearness.data(), group.columns(), scale, size_, to_.data(), to_.size());
}

// Integrates the members, and adds them up.
void FarSums::beginSum(std::int32_t center)
{
  std::fill_n(totals_.data(), totals_.size(), 0.0);
  std::fill(isMember_.begin(), isMember_.end(), 0);
  for (const std::int32_t member : this->group(center).members)
  {
    isMember_[static_cast<std::size_t>(member)] = 1;
    const ScaledRow whole{ 1.0, this->total(kWhole) };
    kernels_.addScaled(this->field(member), size_, &whole, 1);
  }
}

void FarSums::addShares(std::int32_t center, OfGroup near)
{
  for (const std::int32_t member : this->group(center).members)
  {
    varies_[static_cast<std::size_t>(member)] =
      kernels_.findShares(share_.begin(), share_.farthest(), size_,
        { this->total(kWhole), this->of(member, near), this->of(member, kOwn),
          this->of(member, kShare), this->of(member, kStep), this->total(kShared),
          this->total(kShift) });
  }
}

const double* FarSums::most(std::int32_t center)
{
  this->beginSum(center);
  this->addShares(center, kNear); // nearer than they are
  return this->total(kShared);
}

const double* FarSums::sum(std::int32_t center)
{
  this->beginSum(center);
  this->findSetNear(center);
  this->addShares(center, kSetNear);
  return this->total(kShared);
}

// From what is known of all pieces without those of other groups, or from the members alone: what
// is less work.
void FarSums::findSetNear(std::int32_t center)
{
  const std::vector<std::int32_t>& members = this->group(center).members;
  const bool withoutOthers = known_.size() < 2 * members.size();
  for (const std::int32_t member : members)
  {
    double* to = this->of(member, kSetNear);
    if (withoutOthers)
    {
      std::copy_n(this->of(member, kNear), size_, to);
    }
    else
    {
      std::fill_n(to, size_, 0.0);
    }
  }
  for (const Known& known : known_)
  {
    if (this->isMember(known.group) == withoutOthers)
    {
      continue;
    }
    to_.clear();
    const std::vector<std::int32_t>& near = this->group(known.group).near;
    for (std::size_t k = 0; k < near.size(); ++k)
    {
      if (this->isMember(near[k]))
      {
        to_.push_back({ 1 + k, this->of(near[k], kSetNear) });
      }
    }
    this->addProducts(known, withoutOthers ? -1.0 : 1.0);
  }
}

// That of piece c in the gradient of G is alpha_j(c) + sum over j of s_j (near_j / F - n(c, j)).
VectorBatch FarSums::gradient()
{
  double* first = this->total(kGradient);
  for (const Known& known : known_)
  {
    if (this->isMember(known.group))
    {
      this->addGradients(known);
    }
  }
  return { first, first + size_, first + 2 * size_ };
}

void FarSums::addGradients(const Known& known)
{
  const FarGroup& group = this->group(known.group);
  columns_.clear();
  steps_.clear();
  for (std::size_t k = 0; k < group.near.size(); ++k)
  {
    const std::int32_t other = group.near[k];
    if (this->isMember(other) && varies_[static_cast<std::size_t>(other)])
    {
      columns_.push_back(1 + k);
      steps_.push_back({ 0.0, this->of(other, kStep) });
    }
  }
  for (std::size_t piece = 0; piece < group.size(); ++piece)
  {
    const double* nearness = group.nearness.data() + piece * group.columns();
    for (std::size_t k = 0; k < columns_.size(); ++k)
    {
      steps_[k].scale = nearness[columns_[k]];
    }
    kernels_.addGradient(this->of(known.group, kShare), this->total(kShift), steps_.data(),
      steps_.size(), size_, pieces_.data() + known.pieces + (4 * piece + 1) * size_, size_,
      this->total(kGradient));
  }
}

} // namespace hybridtree
