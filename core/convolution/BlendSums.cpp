// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSums.h"

#include "core/base/Scratch.h"
#include "core/convolution/MixBlends.h"

#include <algorithm>
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
    : begin_(BlendShare(groups.control).begin())
    , field_(groups.whole)
    , selection_(selection)
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
    std::vector<char> mayBeFar(count, 0);
    for (const BlendSelection::Pair& pair : selection_.apart)
    {
      if (isReached_[pair.a] && isReached_[pair.b])
      {
        mayBeFar[pair.a] |= static_cast<char>(this->farthest(pair.b, pair.a) > begin_);
        mayBeFar[pair.b] |= static_cast<char>(this->farthest(pair.a, pair.b) > begin_);
        if (!pair.areNeighbours)
        {
          this->findUnjoined(pair, isOpen);
        }
      }
    }
    for (std::size_t unit = 0; unit < count; ++unit)
    {
      if (mayBeFar[unit])
      {
        this->findFar(unit, isOpen);
      }
    }
  }

private:
  double* own(std::size_t unit) { return own_.data() + unit * points_.size; }
  double farthest(std::size_t a, std::size_t b) const
  {
    return selection_.farthest[a * selection_.units.size() + b];
  }

  // D = sum of f_c d / sum of f_c > begin, with distances that are at least d.
  void findFar(std::size_t unit, double* isOpen)
  {
    ScratchArray excess(points_.size);
    const double* own = this->own(unit);
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      excess[k] = -begin_ * own[k];
    }
    for (std::size_t other = 0; other < selection_.units.size(); ++other)
    {
      if (other != unit && isReached_[other])
      {
        const double* field = this->own(other);
        const double weight = this->farthest(other, unit) - begin_;
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

  double begin_;
  const ConvolutionField& field_;
  const BlendSelection& selection_;
  PointBatch points_;
  ScratchArray own_;            // per unit
  std::vector<char> isReached_; // per unit: any of the points
};

// As mixBlends(), of some points.
void mixSome(const BlendGroups& groups, const std::vector<std::size_t>& some, PointBatch points,
  double* value, const VectorBatch* gradient)
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
  mixBlends(groups, at.points(), mixed.data(), gradient ? &slope : nullptr);
  for (std::size_t k = 0; k < some.size(); ++k)
  {
    value[some[k]] = mixed[k];
    if (gradient)
    {
      gradient->set(some[k], slope[k]);
    }
  }
}

} // namespace

void sumBlends(const BlendGroups& groups, const BlendSelection& selection, PointBatch points,
  double* value, const VectorBatch* gradient)
{
  if (selection.units.empty())
  {
    mixBlends(groups, points, value, gradient);
    return;
  }
  ScratchArray isOpen(std::min(kPart, points.size));
  std::vector<std::size_t> open;
  for (std::size_t begin = 0; begin < points.size; begin += kPart)
  {
    const PointBatch part = points.slice(begin, std::min(kPart, points.size - begin));
    const VectorBatch slope = gradient ? gradient->slice(begin) : VectorBatch{};
    UnitSums sums(groups, selection, part);
    sums.addUp(value + begin, gradient ? &slope : nullptr);
    sums.findOpen(isOpen.data());
    for (std::size_t k = 0; k < part.size; ++k)
    {
      if (isOpen[k] > 0.0)
      {
        open.push_back(begin + k);
      }
    }
  }
  if (!open.empty())
  {
    mixSome(groups, open, points, value, gradient);
  }
}

} // namespace hybridtree
