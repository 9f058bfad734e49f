// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSelector.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hybridtree
{
namespace
{

// What is kept between queries: no allocation once warm.
struct Workspace
{
  std::vector<std::size_t> segmentGroups; // numbers, per element of the selection
  std::vector<std::size_t> triangleGroups;
  std::vector<double> farthest;                              // per pair of numbers
  std::vector<std::pair<std::size_t, std::size_t>> unjoined; // numbers that no sum has both of
  std::vector<std::size_t> units;                            // per number
  std::vector<std::size_t> groups;                           // per unit one of its numbers
  std::vector<const SegmentElement*> segments;
  std::vector<const TriangleElement*> triangles;
};

// The groups of a selection.
class Sorter
{
public:
  Sorter(const ElementGroups& elements, BlendSelection& selection, Workspace& work)
    : selection_(selection), work_(work), numbers_(elements.count)
  {
    work.segmentGroups.clear();
    work.triangleGroups.clear();
    for (const SegmentElement* segment : selection.all.segments)
    {
      work.segmentGroups.push_back(numbers_.add(elements.segments[elements.whole.index(segment)]));
    }
    for (const TriangleElement* triangle : selection.all.triangles)
    {
      work.triangleGroups.push_back(
        numbers_.add(elements.triangles[elements.whole.index(triangle)]));
    }
  }

  /// Each is a unit.
  void separate()
  {
    work_.units.resize(numbers_.size());
    std::iota(work_.units.begin(), work_.units.end(), std::size_t(0));
    selection_.hasRest = false;
    selection_.units.assign(numbers_.size(), { 0, 0 });
    this->sortByUnits();
  }

protected:
  /// Sets selection.groups, and sorts the elements by units, in order within each.
  void sortByUnits()
  {
    for (std::size_t k = 0; k < numbers_.size(); ++k)
    {
      selection_.groups.push_back({ numbers_.group(k), work_.units[k] });
    }
    this->sortElements(work_.segmentGroups, selection_.all.segments, work_.segments,
      &BlendSelection::Unit::segmentsEnd);
    this->sortElements(work_.triangleGroups, selection_.all.triangles, work_.triangles,
      &BlendSelection::Unit::trianglesEnd);
  }

  BlendSelection& selection_;
  Workspace& work_;
  GroupNumbers numbers_;

private:
  template <class Element>
  void sortElements(const std::vector<std::size_t>& groups, std::vector<const Element*>& elements,
    std::vector<const Element*>& sorted, std::size_t BlendSelection::Unit::*end)
  {
    std::vector<BlendSelection::Unit>& units = selection_.units;
    for (const std::size_t group : groups)
    {
      ++(units[work_.units[group]].*end);
    }
    std::size_t begin = 0;
    for (BlendSelection::Unit& unit : units)
    {
      begin += std::exchange(unit.*end, begin);
    }
    sorted.assign(elements.begin(), elements.end());
    for (std::size_t k = 0; k < sorted.size(); ++k)
    {
      elements[(units[work_.units[groups[k]]].*end)++] = sorted[k];
    }
  }
};

// Finds the units of a selection.
class Finder : private Sorter
{
public:
  Finder(const BlendGroups& field, BlendSelection& selection, Workspace& work)
    : Sorter(field.elements, selection, work)
    , field_(field)
    , begin_(BlendShare(field.control).begin())
  {
  }

  void find()
  {
    if (!this->findDistances())
    {
      return;
    }
    selection_.isControlled = true;
    this->numberUnits();
    this->findPairs();
    this->sortByUnits();
  }

private:
  // Marks the groups with another in reach that they may be apart from as single units: 1, others
  // 0. Returns whether there are any.
  bool findDistances()
  {
    const std::size_t count = numbers_.size();
    work_.farthest.assign(count * count, 0.0);
    work_.units.assign(count, 0);
    work_.unjoined.clear();
    bool areApart = false;
    for (std::size_t k = 0; k < count; ++k)
    {
      for (const BlendPieces::Meeting& other :
        field_.places.meetings[static_cast<std::size_t>(numbers_.group(k))])
      {
        const std::int32_t number = numbers_.find(other.group);
        if (number < 0)
        {
          continue;
        }
        const auto at = static_cast<std::size_t>(number);
        work_.farthest[count * k + at] = other.farthest;
        if (!other.areNeighbours)
        {
          work_.unjoined.emplace_back(k, at);
        }
        if (other.farthest > begin_)
        {
          work_.units[k] = work_.units[at] = 1;
          areApart = true;
        }
      }
    }
    return areApart;
  }

  // All groups that are not single are unit 0.
  void numberUnits()
  {
    const auto singles = std::count(work_.units.begin(), work_.units.end(), 1);
    selection_.hasRest = static_cast<std::size_t>(singles) < numbers_.size();
    work_.groups.assign(selection_.hasRest ? 1 : 0, 0);
    for (std::size_t k = 0; k < numbers_.size(); ++k)
    {
      if (work_.units[k] == 1)
      {
        work_.units[k] = work_.groups.size();
        work_.groups.push_back(k);
      }
    }
    selection_.units.assign(work_.groups.size(), { 0, 0 });
  }

  void findPairs()
  {
    const std::size_t groups = numbers_.size();
    const std::size_t units = selection_.units.size();
    selection_.farthest.assign(units * units, 0.0);
    for (std::size_t a = 0; a < groups; ++a)
    {
      for (std::size_t b = 0; b < groups; ++b)
      {
        double& most = selection_.farthest[units * work_.units[a] + work_.units[b]];
        most = std::max(most, work_.farthest[groups * a + b]);
      }
    }
    selection_.areUnjoined.assign(units * units, 0);
    for (const auto& [a, b] : work_.unjoined)
    {
      const std::size_t first = work_.units[a];
      const std::size_t second = work_.units[b];
      selection_.areUnjoined[units * first + second] = 1;
      selection_.areUnjoined[units * second + first] = 1;
    }
  }

  const BlendGroups& field_;
  double begin_;
};

void clearUnits(BlendSelection& selection)
{
  selection.isControlled = false;
  selection.units.clear();
  selection.groups.clear();
}

thread_local Workspace workspace;

} // namespace

void selectBlends(const BlendGroups& groups, BlendSelection& selection)
{
  clearUnits(selection);
  if (selection.all.empty())
  {
    return;
  }
  if (groups.isLocal())
  {
    Finder(groups, selection, workspace).find();
  }
  else
  {
    selection.isControlled = true;
  }
}

void selectGroups(const ElementGroups& groups, BlendSelection& selection)
{
  clearUnits(selection);
  if (!selection.all.empty())
  {
    selection.isControlled = true;
    Sorter(groups, selection, workspace).separate();
  }
}

} // namespace hybridtree
