// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSelector.h"

#include <algorithm>
#include <utility>

namespace hybridtree
{
namespace
{

// Finds the units of a selection.
class Finder
{
public:
  Finder(const BlendGroups& field, BlendSelection& selection)
    : field_(field)
    , begin_(BlendShare(field.control).begin())
    , selection_(selection)
    , numbers_(field.size())
  {
    for (const SegmentElement* segment : selection.all.segments)
    {
      segmentGroups_.push_back(numbers_.add(field.segmentGroups[field.whole.index(segment)]));
    }
    for (const TriangleElement* triangle : selection.all.triangles)
    {
      triangleGroups_.push_back(numbers_.add(field.triangleGroups[field.whole.index(triangle)]));
    }
  }

  void find()
  {
    this->numberUnits();
    if (selection_.units.empty())
    {
      return;
    }
    selection_.isControlled = true;
    this->sortElements(segmentGroups_, selection_.all.segments, &BlendSelection::Unit::segmentsEnd);
    this->sortElements(
      triangleGroups_, selection_.all.triangles, &BlendSelection::Unit::trianglesEnd);
    this->findPairs();
  }

private:
  const std::vector<GroupDistance>& farthest(std::size_t number) const
  {
    return field_.places.farthest[static_cast<std::size_t>(numbers_.group(number))];
  }

  // Single units are the groups with another in reach that they may be apart from. The rest of the
  // groups is unit 0.
  void numberUnits()
  {
    const std::size_t count = numbers_.size();
    units_.assign(count, 0);
    for (std::size_t k = 0; k < count; ++k)
    {
      for (const GroupDistance& other : this->farthest(k))
      {
        const std::int32_t number = other.distance > begin_ ? numbers_.find(other.group) : -1;
        if (number >= 0)
        {
          units_[k] = units_[static_cast<std::size_t>(number)] = 1;
        }
      }
    }
    const auto singles = static_cast<std::size_t>(std::count(units_.begin(), units_.end(), 1));
    if (singles == 0)
    {
      return;
    }
    selection_.hasRest = singles < count;
    std::size_t next = selection_.hasRest ? 1 : 0;
    for (std::size_t& unit : units_)
    {
      unit = unit == 1 ? next++ : 0;
    }
    selection_.units.assign(next, { 0, 0 });
  }

  // By units, in order within each.
  template <class Element>
  void sortElements(const std::vector<std::size_t>& groups, std::vector<const Element*>& elements,
    std::size_t BlendSelection::Unit::*end)
  {
    std::vector<BlendSelection::Unit>& units = selection_.units;
    for (const std::size_t group : groups)
    {
      ++(units[units_[group]].*end);
    }
    std::size_t begin = 0;
    for (BlendSelection::Unit& unit : units)
    {
      begin += std::exchange(unit.*end, begin);
    }
    static thread_local std::vector<const Element*> sorted;
    sorted.resize(elements.size());
    for (std::size_t k = 0; k < elements.size(); ++k)
    {
      sorted[(units[units_[groups[k]]].*end)++] = elements[k];
    }
    elements.swap(sorted);
  }

  void findPairs()
  {
    const std::size_t count = selection_.units.size();
    selection_.farthest.assign(count * count, 0.0);
    for (std::size_t k = 0; k < numbers_.size(); ++k)
    {
      for (const GroupDistance& other : this->farthest(k))
      {
        const std::int32_t number = numbers_.find(other.group);
        if (number >= 0)
        {
          double& most =
            selection_.farthest[count * units_[k] + units_[static_cast<std::size_t>(number)]];
          most = std::max(most, other.distance);
        }
      }
    }
    std::vector<std::size_t> groups(count);
    for (std::size_t k = 0; k < units_.size(); ++k)
    {
      groups[units_[k]] = k;
    }
    for (std::size_t a = selection_.hasRest ? 1 : 0; a < count; ++a)
    {
      for (std::size_t b = a + 1; b < count; ++b)
      {
        if (std::max(selection_.farthest[count * a + b], selection_.farthest[count * b + a]) >
          begin_)
        {
          selection_.apart.push_back(
            { a, b, field_.areNeighbours(numbers_.group(groups[a]), numbers_.group(groups[b])) });
        }
      }
    }
  }

  const BlendGroups& field_;
  double begin_;
  BlendSelection& selection_;
  GroupNumbers numbers_;
  std::vector<std::size_t> segmentGroups_; // numbers, per element of the selection
  std::vector<std::size_t> triangleGroups_;
  std::vector<std::size_t> units_; // per number
};

} // namespace

void selectBlends(const BlendGroups& groups, BlendSelection& selection)
{
  selection.isControlled = false;
  selection.units.clear();
  selection.apart.clear();
  if (selection.all.empty())
  {
    return;
  }
  if (groups.isLocal())
  {
    Finder(groups, selection).find();
  }
  else
  {
    selection.isControlled = true;
  }
}

} // namespace hybridtree
