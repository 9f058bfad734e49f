// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/OwnBlend.h"

#include "core/convolution/ShareKernels.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kStride = 64; // points at once

// The sum at up to kStride points. Rows of that many numbers, of which `size_` count.
class OwnBlend
{
public:
  OwnBlend(const PiecesNear& pieces, std::int32_t group, PointBatch points, bool haveGradients)
    : pieces_(pieces)
    , share_(pieces.groups().control)
    , haveGradients_(haveGradients)
    , size_((points.size + kRowStep - 1) / kRowStep * kRowStep)
    , members_(this->membersOf(group))
    , points_(size_)
    , singles_(kStride * (haveGradients ? 4 : 1) * this->findPieces())
    , groups_(kStride * 4 * pieces.groupCount())
    , totals_(kStride * 6)
  {
    for (std::size_t k = 0; k < size_; ++k)
    {
      points_.batch().set(k, points[std::min(k, points.size - 1)]);
    }
    std::fill_n(groups_.data(), groups_.size(), 0.0);
    std::fill_n(totals_.data(), totals_.size(), 0.0);
    this->integrate();
    this->findShares();
    if (haveGradients)
    {
      this->addGradients();
    }
  }

  double value(std::size_t k) const { return totals_.data()[kTotal * kStride + k]; }
  Vec3 gradient(std::size_t k) const
  {
    const double* first = totals_.data() + kGradient * kStride + k;
    return { first[0], first[kStride], first[2 * kStride] };
  }

private:
  enum Totals // rows
  {
    kSum,
    kTotal,
    kShift,
    kGradient
  };
  enum OfGroup
  {
    kOwn,
    kNear,
    kShare,
    kStep
  };

  double* total(Totals row) { return totals_.data() + row * kStride; }
  double* of(std::size_t number, OfGroup row)
  {
    return groups_.data() + (4 * number + row) * kStride;
  }
  double* single(std::size_t piece)
  {
    return singles_.data() + piece * (haveGradients_ ? 4 : 1) * kStride;
  }

  // Per number: whether it is in the sum.
  std::vector<char> membersOf(std::int32_t group) const
  {
    std::vector<char> members(pieces_.groupCount(), 0);
    const auto add = [&](std::int32_t member)
    {
      if (pieces_.find(member) >= 0)
      {
        members[static_cast<std::size_t>(pieces_.find(member))] = 1;
      }
    };
    add(group);
    const auto& others = pieces_.groups().places.neighbours[static_cast<std::size_t>(group)];
    std::for_each(others.begin(), others.end(), add);
    return members;
  }

  // Segments first, so that their rows are together. \return how many.
  std::size_t findPieces()
  {
    const auto find = [&](const auto& add)
    {
      for (std::size_t number = 0; number < members_.size(); ++number)
      {
        for (std::size_t k = pieces_.begin(number); members_[number] && k < pieces_.end(number);
             ++k)
        {
          add(pieces_[k], number);
        }
      }
    };
    find(
      [&](const BlendPiece& piece, std::size_t number)
      {
        if (piece.segment)
        {
          segments_.push_back(piece.segment);
          places_.push_back({ piece.place, number });
        }
      });
    find(
      [&](const BlendPiece& piece, std::size_t number)
      {
        if (piece.triangle)
        {
          triangles_.push_back(piece.triangle);
          places_.push_back({ piece.place, number });
        }
      });
    return places_.size();
  }

  /// The other members near a piece, in rows of theirs.
  template <typename Uses>
  void findNear(std::size_t piece, OfGroup row, const Uses& uses)
  {
    near_.clear();
    const auto& [place, own] = places_[piece];
    for (const GroupDistance& near : place->distances)
    {
      const std::int32_t number = pieces_.find(near.group);
      if (number >= 0 && near.group != place->group && uses(static_cast<std::size_t>(number)))
      {
        near_.push_back(
          { share_.farthest() - near.distance, this->of(static_cast<std::size_t>(number), row) });
      }
    }
    if (uses(own))
    {
      near_.push_back({ share_.farthest(), this->of(own, row) });
    }
  }

  void integrate()
  {
    const ConvolutionKernel& kernel = pieces_.groups().whole.kernel();
    const ConvolutionKernels& kernels = convolutionKernels(kernel.kind);
    const PointBatch points = points_.points();
    const auto rows = [&](std::size_t piece) {
      return ElementRows{ this->single(piece), kStride, haveGradients_ };
    };
    kernels.segmentRows({ segments_.data(), segments_.size() }, kernel, points, rows(0));
    kernels.triangleRows(
      { triangles_.data(), triangles_.size() }, kernel, points, rows(segments_.size()));
    for (std::size_t piece = 0; piece < places_.size(); ++piece)
    {
      this->findNear(piece, kNear, [&](std::size_t number) { return members_[number] != 0; });
      near_.push_back({ 1.0, this->of(places_[piece].number, kOwn) });
      near_.push_back({ 1.0, this->total(kSum) });
      rows_.addScaled(this->single(piece), size_, near_.data(), near_.size());
    }
  }

  void findShares()
  {
    varies_.assign(members_.size(), 0);
    for (std::size_t number = 0; number < members_.size(); ++number)
    {
      if (members_[number])
      {
        varies_[number] = rows_.findShares(share_.begin(), share_.farthest(), size_,
          { this->total(kSum), this->of(number, kNear), this->of(number, kOwn),
            this->of(number, kShare), this->of(number, kStep), this->total(kTotal),
            this->total(kShift) });
      }
    }
  }

  // With n(c, j) = farthest - d(c, j), that of piece c in the gradient of G is
  // alpha_j(c) + sum over j of s_j (near_j / F - n(c, j)).
  void addGradients()
  {
    for (std::size_t piece = 0; piece < places_.size(); ++piece)
    {
      this->findNear(piece, kStep, [&](std::size_t number) { return varies_[number] != 0; });
      rows_.addGradient(this->of(places_[piece].number, kShare), this->total(kShift), near_.data(),
        near_.size(), size_, this->single(piece) + kStride, kStride, this->total(kGradient));
    }
  }

  struct PlacedPiece
  {
    const BlendPieces::Place* place;
    std::size_t number; // of its group
  };

  const PiecesNear& pieces_;
  const ShareKernels& rows_ = shareKernels();
  BlendShare share_;
  bool haveGradients_;
  std::size_t size_;
  std::vector<char> members_;
  std::vector<char> varies_; // shares do, per number
  std::vector<const SegmentElement*> segments_;
  std::vector<const TriangleElement*> triangles_;
  std::vector<PlacedPiece> places_; // of segments, then of triangles
  std::vector<ScaledRow> near_;
  ScratchVectors points_;
  ScratchArray singles_; // per piece: value and gradient
  ScratchArray groups_;  // per number: OfGroup
  ScratchArray totals_;
};

} // namespace

void ownBlend(const PiecesNear& pieces, std::int32_t group, PointBatch points, double* value,
  const VectorBatch* gradient)
{
  for (std::size_t begin = 0; begin < points.size; begin += kStride)
  {
    const PointBatch part = points.slice(begin, std::min(kStride, points.size - begin));
    const OwnBlend blend(pieces, group, part, gradient != nullptr);
    for (std::size_t k = 0; k < part.size; ++k)
    {
      value[begin + k] = blend.value(k);
      if (gradient)
      {
        gradient->set(begin + k, blend.gradient(k));
      }
    }
  }
}

} // namespace hybridtree
