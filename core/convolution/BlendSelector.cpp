// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSelector.h"

#include <utility>

namespace hybridtree
{
namespace
{

// What is kept between queries: no allocation once warm.
struct Workspace
{
  std::vector<std::size_t> segmentUnits; // per element of the selection
  std::vector<std::size_t> triangleUnits;
  std::vector<const SegmentElement*> segments;
  std::vector<const TriangleElement*> triangles;
};

thread_local Workspace workspace;

// In order within each unit.
template <class Element>
void sortElements(const std::vector<std::size_t>& unitOf, std::vector<const Element*>& elements,
  std::vector<const Element*>& sorted, std::vector<BlendSelection::Unit>& units,
  std::size_t BlendSelection::Unit::*end)
{
  for (const std::size_t unit : unitOf)
  {
    ++(units[unit].*end);
  }
  std::size_t begin = 0;
  for (BlendSelection::Unit& unit : units)
  {
    begin += std::exchange(unit.*end, begin);
  }
  sorted.assign(elements.begin(), elements.end());
  for (std::size_t k = 0; k < sorted.size(); ++k)
  {
    elements[(units[unitOf[k]].*end)++] = sorted[k];
  }
}

} // namespace

void selectGroups(const ElementGroups& groups, BlendSelection& selection)
{
  Workspace& work = workspace;
  GroupNumbers numbers(groups.count);
  work.segmentUnits.clear();
  work.triangleUnits.clear();
  for (const SegmentElement* segment : selection.all.segments)
  {
    work.segmentUnits.push_back(numbers.add(groups.segments[groups.whole.index(segment)]));
  }
  for (const TriangleElement* triangle : selection.all.triangles)
  {
    work.triangleUnits.push_back(numbers.add(groups.triangles[groups.whole.index(triangle)]));
  }
  selection.units.assign(numbers.size(), { 0, 0 });
  selection.groups.clear();
  for (std::size_t unit = 0; unit < numbers.size(); ++unit)
  {
    selection.groups.push_back({ numbers.group(unit), unit });
  }
  sortElements(work.segmentUnits, selection.all.segments, work.segments, selection.units,
    &BlendSelection::Unit::segmentsEnd);
  sortElements(work.triangleUnits, selection.all.triangles, work.triangles, selection.units,
    &BlendSelection::Unit::trianglesEnd);
}

} // namespace hybridtree
