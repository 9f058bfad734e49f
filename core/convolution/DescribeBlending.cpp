// SPDX-License-Identifier: BSD-3-Clause
// What sums of neighbours depend on besides the elements that reach a place.
#include "core/convolution/BlendedField.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

/// All numbers of an element are doubles.
template <class Element>
void addNumbers(const Element& element, Contents& contents)
{
  static_assert(sizeof(Element) % sizeof(double) == 0, "an element is made of doubles");
  constexpr std::size_t kCount = sizeof(Element) / sizeof(double);
  double numbers[kCount];
  std::memcpy(numbers, static_cast<const void*>(&element), sizeof(Element));
  for (const double number : numbers)
  {
    contents.add(number);
  }
}

template <class Element>
std::vector<const Element*> unique(std::vector<const Element*> elements)
{
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

/// Distances from the groups that are met at all.
class Describer
{
public:
  Describer(std::size_t groups, Contents& contents) : isMet_(groups, 0), contents_(contents) {}

  void meet(std::int32_t group) { isMet_[static_cast<std::size_t>(group)] = 1; }

  const std::vector<char>& met() const { return isMet_; }

  void addDistances(const std::vector<GroupDistance>& distances)
  {
    for (const auto& [group, distance] : distances)
    {
      if (isMet_[static_cast<std::size_t>(group)])
      {
        contents_.add(group);
        contents_.add(distance);
      }
    }
    contents_.add(std::int32_t(-1));
  }

  void addGroups(const BlendPieces& places)
  {
    for (std::size_t group = 0; group < isMet_.size(); ++group)
    {
      if (!isMet_[group])
      {
        continue;
      }
      contents_.add(static_cast<std::uint64_t>(group));
      for (const std::int32_t other : places.neighbours[group])
      {
        if (isMet_[static_cast<std::size_t>(other)])
        {
          contents_.add(other);
        }
      }
      this->addMeetings(places.meetings[group]);
    }
  }

private:
  void addMeetings(const std::vector<BlendPieces::Meeting>& meetings)
  {
    for (const BlendPieces::Meeting& meeting : meetings)
    {
      if (isMet_[static_cast<std::size_t>(meeting.group)])
      {
        contents_.add(meeting.group);
        contents_.add(meeting.farthest);
      }
    }
    contents_.add(std::int32_t(-1));
  }

  std::vector<char> isMet_;
  Contents& contents_;
};

} // namespace

void PaperSums::describe(const std::vector<char>& isMet, Contents& contents) const
{
  for (std::size_t group = 0; group < isMet.size(); ++group)
  {
    if (!isMet[group])
    {
      continue;
    }
    contents.add(static_cast<std::uint64_t>(group));
    for (const Neighbour& neighbour : neighbours_[group])
    {
      if (isMet[static_cast<std::size_t>(neighbour.group)])
      {
        contents.add(neighbour.group);
        for (const double slope : neighbour.slope)
        {
          contents.add(slope);
        }
        contents.add(neighbour.offset);
      }
    }
    contents.add(std::int32_t(-1));
  }
}

void BlendedField::describeBlending(const std::vector<Box3>& boxes, Contents& contents) const
{
  if (!pieces_ && !paper_)
  {
    return;
  }
  ElementSelection all;
  ElementSelection reaching;
  Describer describer(groupCount_, contents);
  for (const Box3& box : boxes)
  {
    whole_.select(box, reaching);
    for (const SegmentElement* segment : reaching.segments)
    {
      describer.meet(segmentGroups_[whole_.index(segment)]);
    }
    for (const TriangleElement* triangle : reaching.triangles)
    {
      describer.meet(triangleGroups_[whole_.index(triangle)]);
    }
    if (paper_)
    {
      continue;
    }
    pieces_->select(box, reaching);
    all.segments.insert(all.segments.end(), reaching.segments.begin(), reaching.segments.end());
    all.triangles.insert(all.triangles.end(), reaching.triangles.begin(), reaching.triangles.end());
  }
  contents.add(partSize_); // by which points are asked for together
  if (paper_)
  {
    paper_->describe(describer.met(), contents);
    return;
  }
  const std::vector<const SegmentElement*> segments = unique(std::move(all.segments));
  const std::vector<const TriangleElement*> triangles = unique(std::move(all.triangles));
  const auto placeOf = [&](const auto* element,
                         const std::vector<BlendPieces::Place>& places) -> const BlendPieces::Place&
  { return places[pieces_->index(element)]; };
  const auto forEachPiece = [&](const auto& body)
  {
    for (const SegmentElement* segment : segments)
    {
      body(*segment, placeOf(segment, places_.segmentPlaces));
    }
    for (const TriangleElement* triangle : triangles)
    {
      body(*triangle, placeOf(triangle, places_.trianglePlaces));
    }
  };
  forEachPiece([&](const auto&, const BlendPieces::Place& place) { describer.meet(place.group); });
  describer.addGroups(places_);
  forEachPiece(
    [&](const auto& element, const BlendPieces::Place& place)
    {
      contents.add(place.group);
      addNumbers(element, contents);
      describer.addDistances(place.distances);
    });
}

} // namespace hybridtree
