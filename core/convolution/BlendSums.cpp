// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSums.h"

#include "core/base/Scratch.h"
#include "core/convolution/MixBlends.h"
#include "core/convolution/OwnBlend.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace hybridtree
{
namespace
{

constexpr std::size_t kPart = 256;      // points handled together
constexpr std::size_t kManyGroups = 64; // that reach points whose sums are found together
constexpr std::size_t kFewPoints = 8;   // that are not divided any more

// The units' fields at some points, and where their sum may not be the field.
class UnitSums
{
public:
  UnitSums(const BlendGroups& groups, const BlendSelection& selection, PointBatch points)
    : share_(groups.control)
    , field_(groups.whole)
    , selection_(selection)
    , farthest_(selection.farthest)
    , points_(points)
    , own_(selection.units.size() * points.size)
    , isReached_(selection.units.size(), 0)
  {
  }

  void addUp(double* value, const VectorBatch* gradient)
  {
    std::fill_n(value, points_.size, 0.0);
    std::fill_n(own_.data(), own_.size(), 0.0);
    if (gradient)
    {
      for (double* array : { gradient->x, gradient->y, gradient->z })
      {
        std::fill_n(array, points_.size, 0.0);
      }
    }
    for (std::size_t unit = 0; unit < selection_.units.size(); ++unit)
    {
      const ElementSpans elements = selection_.elementsOf(unit);
      if (gradient)
      {
        field_.addFieldAndGradient(elements, points_, this->own(unit), *gradient);
      }
      else
      {
        field_.addField(elements, points_, this->own(unit));
      }
      const double* own = this->own(unit);
      for (std::size_t k = 0; k < points_.size; ++k)
      {
        value[k] += own[k];
      }
      if (std::any_of(own, own + points_.size, [](double field) { return field > 0.0; }))
      {
        isReached_[unit] = 1;
        reached_.push_back(unit);
      }
    }
  }

  /// Sets isOpen, `points` many, above 0 where a share may be below 1.
  void findOpen(double* isOpen)
  {
    std::fill_n(isOpen, points_.size, 0.0);
    mayBeFar_.assign(selection_.units.size(), 0);
    for (const std::size_t unit : reached_)
    {
      if (unit == 0 && selection_.hasRest)
      {
        continue;
      }
      for (const std::size_t other : reached_)
      {
        const std::size_t pair = other * selection_.units.size() + unit;
        mayBeFar_[unit] |= static_cast<char>(farthest_[pair] > share_.begin());
        if (other < unit && selection_.areUnjoined[pair])
        {
          this->findUnjoined(unit, other, isOpen);
        }
      }
      if (mayBeFar_[unit])
      {
        this->findFar(unit, isOpen);
      }
    }
  }

  /// From now on only pieces near some of the points count: findOpen() holds only for these.
  void narrow(const PiecesNear& pieces)
  {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    const std::size_t units = selection_.units.size();
    std::vector<std::size_t> unitOf(pieces.groupCount(), kNone);
    for (const BlendSelection::Group& group : selection_.groups)
    {
      if (pieces.find(group.group) >= 0)
      {
        unitOf[static_cast<std::size_t>(pieces.find(group.group))] = group.unit;
      }
    }
    const std::vector<double> before = farthest_;
    std::fill(farthest_.begin(), farthest_.end(), 0.0);
    std::vector<double> distances; // of the pieces of one group from all
    for (std::size_t number = 0; number < unitOf.size(); ++number)
    {
      const std::size_t unit = unitOf[number];
      if (unit == kNone || !isReached_[unit])
      {
        continue;
      }
      this->findFarthest(pieces, number, distances);
      for (std::size_t other = 0; other < unitOf.size(); ++other)
      {
        if (unitOf[other] != kNone && mayBeFar_[unitOf[other]])
        {
          const std::size_t pair = unit * units + unitOf[other];
          farthest_[pair] = std::max(farthest_[pair], std::min(before[pair], distances[other]));
        }
      }
    }
  }

private:
  double* own(std::size_t unit) { return own_.data() + unit * points_.size; }
  double farthest(std::size_t a, std::size_t b) const
  {
    return farthest_[a * selection_.units.size() + b];
  }

  // Of the pieces of a group, per number the distance that is farthest.
  void findFarthest(const PiecesNear& pieces, std::size_t number, std::vector<double>& distances)
  {
    const auto count = static_cast<std::int32_t>(pieces.end(number) - pieces.begin(number));
    distances.assign(pieces.groupCount(), 0.0);
    nearPieces_.assign(pieces.groupCount(), 0);
    for (std::size_t k = pieces.begin(number); k < pieces.end(number); ++k)
    {
      for (const GroupDistance& near : pieces[k].place->distances)
      {
        const std::int32_t other = pieces.find(near.group);
        if (other >= 0)
        {
          double& most = distances[static_cast<std::size_t>(other)];
          most = std::max(most, near.distance);
          ++nearPieces_[static_cast<std::size_t>(other)];
        }
      }
    }
    for (std::size_t other = 0; other < distances.size(); ++other)
    {
      distances[other] = nearPieces_[other] < count ? share_.farthest() : distances[other];
    }
  }

  // D = sum of f_c d / sum of f_c > begin, with distances that are at least d.
  void findFar(std::size_t unit, double* isOpen)
  {
    ScratchArray excess(points_.size);
    const double* own = this->own(unit);
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      excess[k] = -share_.begin() * own[k];
    }
    for (const std::size_t other : reached_)
    {
      if (other != unit)
      {
        const double* field = this->own(other);
        const double weight = this->farthest(other, unit) - share_.begin();
        for (std::size_t k = 0; k < points_.size; ++k)
        {
          excess[k] += weight * field[k];
        }
      }
    }
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      isOpen[k] = std::max(isOpen[k], std::min(own[k], excess[k]));
    }
  }

  // Two groups that are no neighbours are in one sum only as neighbours of a third. All groups are
  // neighbours of those of the rest, or never have fields where these do.
  void findUnjoined(std::size_t first, std::size_t second, double* isOpen)
  {
    const double* a = this->own(first);
    const double* b = this->own(second);
    const double* rest = selection_.hasRest ? this->own(0) : nullptr;
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      isOpen[k] = std::max(isOpen[k], rest && rest[k] > 0.0 ? 0.0 : std::min(a[k], b[k]));
    }
  }

  BlendShare share_;
  const ConvolutionField& field_;
  const BlendSelection& selection_;
  std::vector<double> farthest_; // selection.farthest or less
  PointBatch points_;
  ScratchArray own_;            // per unit
  std::vector<char> isReached_; // per unit: any of the points
  std::vector<std::size_t> reached_;
  std::vector<char> mayBeFar_;           // per unit: from another that reaches any
  std::vector<std::int32_t> nearPieces_; // per number, of a group: how many are near it
};

// As mixBlends() or ownBlend(), of some points.
void mixSome(const PiecesNear& pieces, const std::vector<std::size_t>& some, PointBatch points,
  double* value, const VectorBatch* gradient, std::int32_t own)
{
  ScratchVectors at(some.size());
  ScratchArray mixed(some.size());
  ScratchVectors slopes(some.size());
  const VectorBatch slope = slopes.batch();
  for (std::size_t k = 0; k < some.size(); ++k)
  {
    at.batch().set(k, points[some[k]]);
    mixed[k] = value[some[k]];
    if (gradient)
    {
      slope.set(k, (*gradient)[some[k]]);
    }
  }
  if (own == kAnyGroup)
  {
    mixBlends(pieces, at.points(), mixed.data(), gradient ? &slope : nullptr);
  }
  else
  {
    ownBlend(pieces, own, at.points(), mixed.data(), gradient ? &slope : nullptr);
  }
  for (std::size_t k = 0; k < some.size(); ++k)
  {
    value[some[k]] = mixed[k];
    if (gradient)
    {
      gradient->set(some[k], slope[k]);
    }
  }
}

Box3 boxOf(PointBatch points, const std::vector<std::size_t>& some)
{
  Box3 box;
  for (const std::size_t k : some)
  {
    box.extend(points[k]);
  }
  return box;
}

// As mixSome(). Where many groups reach the points these are halved along the longest side of their
// box: what sums cost grows much faster than the groups of which they may be.
void mixInParts(const BlendGroups& groups, const std::vector<std::size_t>& some, PointBatch points,
  double* value, const VectorBatch* gradient, std::int32_t own)
{
  const Box3 box = boxOf(points, some);
  {
    const PiecesNear pieces(groups, box);
    if (pieces.groupCount() <= kManyGroups || some.size() <= kFewPoints)
    {
      mixSome(pieces, some, points, value, gradient, own);
      return;
    }
  }
  Eigen::Index axis;
  box.sizes().maxCoeff(&axis);
  std::vector<std::size_t> sorted = some;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end(),
    [&](std::size_t a, std::size_t b) { return points[a][axis] < points[b][axis]; });
  mixInParts(groups, { sorted.begin(), middle }, points, value, gradient, own);
  mixInParts(groups, { middle, sorted.end() }, points, value, gradient, own);
}

void sumPart(const BlendGroups& groups, const BlendSelection& selection, PointBatch points,
  double* value, const VectorBatch* gradient, std::int32_t own)
{
  UnitSums sums(groups, selection, points);
  ScratchArray isOpen(points.size);
  sums.addUp(value, gradient);
  sums.findOpen(isOpen.data());
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    if (isOpen[k] > 0.0)
    {
      open.push_back(k);
    }
  }
  if (open.empty())
  {
    return;
  }
  {
    // Once more with what is near these points.
    const PiecesNear pieces(groups, boxOf(points, open));
    sums.narrow(pieces);
    sums.findOpen(isOpen.data());
    open.erase(
      std::remove_if(open.begin(), open.end(), [&](std::size_t k) { return !(isOpen[k] > 0.0); }),
      open.end());
    if (open.empty())
    {
      return;
    }
    if (pieces.groupCount() <= kManyGroups)
    {
      mixSome(pieces, open, points, value, gradient, own);
      return;
    }
  }
  mixInParts(groups, open, points, value, gradient, own);
}

} // namespace

void sumBlends(const BlendGroups& groups, const BlendSelection& selection, PointBatch points,
  double* value, const VectorBatch* gradient, std::int32_t own)
{
  if (selection.units.empty())
  {
    mixBlends(groups, points, value, gradient);
    return;
  }
  for (std::size_t begin = 0; begin < points.size; begin += kPart)
  {
    const PointBatch part = points.slice(begin, std::min(kPart, points.size - begin));
    const VectorBatch slopes = gradient ? gradient->slice(begin) : VectorBatch{};
    sumPart(groups, selection, part, value + begin, gradient ? &slopes : nullptr, own);
  }
}

} // namespace hybridtree
