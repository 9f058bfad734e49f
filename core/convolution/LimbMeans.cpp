// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/LimbMeans.h"

#include "core/convolution/FarLimbs.h"
#include "core/convolution/LimbRanges.h"
#include "core/convolution/LimbRows.h"
#include "core/convolution/LimbSelector.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kPart = 64; // points handled together: bits of a word

// Of some points, as many as a multiple of kRowStep: the last again.
class PaddedPoints
{
public:
  explicit PaddedPoints(PointBatch points)
    : points_((points.size + kRowStep - 1) / kRowStep * kRowStep)
  {
    for (std::size_t k = 0; k < points_.points().size; ++k)
    {
      points_.batch().set(k, points[std::min(k, points.size - 1)]);
    }
  }

  PointBatch points() const { return points_.points(); }

private:
  ScratchVectors points_;
};

bool isEmptyRow(const std::vector<std::uint32_t>& begin, std::size_t row)
{
  return begin[row] == begin[row + 1];
}

// The points that two pieces reach which do not blend fully, as bits.
std::uint64_t findOpen(
  const BlendPieces& pieces, const BlendSelection::Limbs& limbs, PointBatch points)
{
  static thread_local std::vector<std::uint64_t> inside; // no allocation once warm
  const LimbKernels& kernels = limbKernels();
  inside.assign(limbs.pieces.size(), 0);
  for (std::size_t k = 0; k < limbs.pieces.size(); ++k)
  {
    if (!isEmptyRow(limbs.sharesBegin, k))
    {
      inside[k] = kernels.findInside(pieces[limbs.pieces[k]].ball, points);
    }
  }
  std::uint64_t open = 0;
  for (std::size_t a = 0; a < limbs.pieces.size(); ++a)
  {
    for (std::uint32_t k = limbs.sharesBegin[a]; inside[a] != 0 && k < limbs.sharesBegin[a + 1];
         ++k)
    {
      open |= inside[a] & inside[limbs.shares[k].piece];
    }
  }
  return open;
}

PieceElements<SegmentElement> segmentsOf(const BlendSelection::Limbs& limbs)
{
  return { limbs.segments.data(), limbs.segmentsBegin.data(), limbs.ofSegments };
}

PieceElements<TriangleElement> trianglesOf(const BlendSelection::Limbs& limbs)
{
  return { limbs.triangles.data(), limbs.trianglesBegin.data(),
    limbs.pieces.size() - limbs.ofSegments };
}

} // namespace

// Where fields end.
class LimbMeans::Local
{
public:
  Local(const LimbMeans& means, const BlendSelection& selection)
    : means_(means), selection_(selection), limbs_(selection.limbs)
  {
  }

  /// At most kPart points.
  void evaluate(PointBatch points, double* value, const VectorBatch* gradient) const
  {
    const std::uint64_t all = ~std::uint64_t(0) >> (64 - points.size);
    const std::uint64_t open =
      all & findOpen(means_.pieces_, limbs_, PaddedPoints(points).points());
    if (open == 0)
    {
      this->sum(points, value, gradient);
    }
    else if (open == all)
    {
      this->mean(points, value, gradient);
    }
    else
    {
      this->evaluateSome(points, open, value, gradient,
        [&](PointBatch some, double* of, const VectorBatch* slope)
        { this->mean(some, of, slope); });
      this->evaluateSome(points, all & ~open, value, gradient,
        [&](PointBatch some, double* of, const VectorBatch* slope) { this->sum(some, of, slope); });
    }
  }

private:
  template <typename Evaluate>
  void evaluateSome(PointBatch points, std::uint64_t some, double* value,
    const VectorBatch* gradient, const Evaluate& evaluate) const
  {
    std::array<std::size_t, kPart> places;
    std::size_t count = 0;
    for (std::size_t k = 0; k < points.size; ++k)
    {
      places[count] = k;
      count += some >> k & 1;
    }
    ScratchVectors at(count);
    for (std::size_t k = 0; k < count; ++k)
    {
      at.batch().set(k, points[places[k]]);
    }
    ScratchArray values(count);
    ScratchVectors slopes(count);
    const VectorBatch slope = slopes.batch();
    evaluate(at.points(), values.data(), gradient ? &slope : nullptr);
    for (std::size_t k = 0; k < count; ++k)
    {
      value[places[k]] = values[k];
      if (gradient)
      {
        gradient->set(places[k], slope[k]);
      }
    }
  }

  void sum(PointBatch points, double* value, const VectorBatch* gradient) const
  {
    std::fill_n(value, points.size, 0.0);
    if (!gradient)
    {
      means_.whole_.addField(selection_.all, points, value);
      return;
    }
    for (double* array : { gradient->x, gradient->y, gradient->z })
    {
      std::fill_n(array, points.size, 0.0);
    }
    means_.whole_.addFieldAndGradient(selection_.all, points, value, *gradient);
  }

  void mean(PointBatch points, double* value, const VectorBatch* gradient) const
  {
    const std::size_t count = limbs_.pieces.size();
    static thread_local std::vector<std::uint32_t> numbers; // 0, 1, ...
    while (numbers.size() < count)
    {
      numbers.push_back(static_cast<std::uint32_t>(numbers.size()));
    }
    LimbRows rows(means_.whole_.kernel(), count, gradient != nullptr);
    ScratchVectors at(kRowStep);
    ScratchArray values(kRowStep);
    ScratchVectors slopes(kRowStep);
    const VectorBatch slope = slopes.batch();
    for (std::size_t begin = 0; begin < points.size; begin += kRowStep)
    {
      const std::size_t together = std::min(kRowStep, points.size - begin);
      for (std::size_t k = 0; k < kRowStep; ++k)
      {
        at.batch().set(k, points[begin + std::min(k, together - 1)]);
      }
      rows.integrate(segmentsOf(limbs_), 0, at.points());
      rows.integrate(trianglesOf(limbs_), limbs_.ofSegments, at.points());
      rows.findMeans({ numbers.data(), count }, { numbers.data(), count },
        { limbs_.sightsBegin.data(), limbs_.sights.data() },
        { limbs_.sharesBegin.data(), limbs_.shares.data() }, true, values.data(),
        gradient ? &slope : nullptr);
      std::copy_n(values.data(), together, value + begin);
      for (std::size_t k = 0; gradient && k < together; ++k)
      {
        gradient->set(begin + k, slope[k]);
      }
    }
  }

  const LimbMeans& means_;
  const BlendSelection& selection_;
  const BlendSelection::Limbs& limbs_;
};

LimbMeans::LimbMeans(
  const ConvolutionField& whole, const ElementGroups& groups, const BlendPieces& pieces)
  : whole_(whole), groups_(groups), pieces_(pieces)
{
}

void LimbMeans::select(const Box3& box, BlendSelection& selection) const
{
  selection.isControlled = !selection.all.empty() &&
    (!pieces_.isLocal() ||
      (areGroupsApart(groups_, pieces_, selection.all) &&
        selectLimbs(pieces_, whole_, box, selection)));
}

void LimbMeans::evaluate(const BlendSelection& selection, PointBatch points, double* value,
  const VectorBatch* gradient) const
{
  if (!pieces_.isLocal())
  {
    evaluateFarLimbs({ pieces_, whole_, selection.all }, points, value, gradient);
    return;
  }
  const Local local(*this, selection);
  for (std::size_t begin = 0; begin < points.size; begin += kPart)
  {
    const PointBatch part = points.slice(begin, std::min(kPart, points.size - begin));
    const VectorBatch slopes = gradient ? gradient->slice(begin) : VectorBatch{};
    local.evaluate(part, value + begin, gradient ? &slopes : nullptr);
  }
}

Interval LimbMeans::range(const BlendSelection& selection, const Box3& box) const
{
  return pieces_.isLocal() ? localLimbRange(whole_, selection, box)
                           : farLimbRange({ pieces_, whole_, selection.all }, box);
}

} // namespace hybridtree
