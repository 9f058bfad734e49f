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

constexpr std::size_t kPart = 256; // points handled together

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
    , isReached_(selection.units.size())
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
      isReached_[unit] = static_cast<char>(
        std::any_of(own, own + points_.size, [](double field) { return field > 0.0; }));
    }
  }

  /// Sets isOpen, `points` many, above 0 where a share may be below 1.
  void findOpen(double* isOpen)
  {
    std::fill_n(isOpen, points_.size, 0.0);
    const std::size_t count = selection_.units.size();
    mayBeFar_.assign(count, 0);
    for (const BlendSelection::Pair& pair : selection_.apart)
    {
      if (isReached_[pair.a] && isReached_[pair.b])
      {
        mayBeFar_[pair.a] |= static_cast<char>(this->farthest(pair.b, pair.a) > share_.begin());
        mayBeFar_[pair.b] |= static_cast<char>(this->farthest(pair.a, pair.b) > share_.begin());
        if (!pair.areNeighbours)
        {
          this->findUnjoined(pair, isOpen);
        }
      }
    }
    for (std::size_t unit = 0; unit < count; ++unit)
    {
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
    for (std::size_t number = 0; number < unitOf.size(); ++number)
    {
      const std::size_t unit = unitOf[number];
      if (unit == kNone || !isReached_[unit])
      {
        continue;
      }
      for (std::size_t other = 0; other < unitOf.size(); ++other)
      {
        if (unitOf[other] != kNone && mayBeFar_[unitOf[other]])
        {
          const std::size_t pair = unit * units + unitOf[other];
          const double distance = this->farthest(pieces, number, pieces.group(other));
          farthest_[pair] = std::max(farthest_[pair], std::min(before[pair], distance));
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

  // Of the pieces of a group.
  double farthest(const PiecesNear& pieces, std::size_t number, std::int32_t from) const
  {
    double distance = 0.0;
    for (std::size_t k = pieces.begin(number); k < pieces.end(number); ++k)
    {
      distance = std::max(distance, pieces[k].place->from(from, share_.farthest()));
    }
    return distance;
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
    for (std::size_t other = 0; other < selection_.units.size(); ++other)
    {
      if (other != unit && isReached_[other])
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
  void findUnjoined(const BlendSelection::Pair& pair, double* isOpen)
  {
    const double* a = this->own(pair.a);
    const double* b = this->own(pair.b);
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
  std::vector<char> mayBeFar_;  // per unit: from another that reaches any
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

void sumPart(const BlendGroups& groups, const BlendSelection& selection, PointBatch points,
  double* value, const VectorBatch* gradient, std::int32_t own)
{
  UnitSums sums(groups, selection, points);
  ScratchArray isOpen(points.size);
  sums.addUp(value, gradient);
  sums.findOpen(isOpen.data());
  std::vector<std::size_t> open;
  Box3 box;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    if (isOpen[k] > 0.0)
    {
      open.push_back(k);
      box.extend(points[k]);
    }
  }
  if (open.empty())
  {
    return;
  }
  // Once more with what is near these points.
  const PiecesNear pieces(groups, box);
  sums.narrow(pieces);
  sums.findOpen(isOpen.data());
  open.erase(
    std::remove_if(open.begin(), open.end(), [&](std::size_t k) { return !(isOpen[k] > 0.0); }),
    open.end());
  if (!open.empty())
  {
    mixSome(pieces, open, points, value, gradient, own);
  }
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
