// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendPieces.h"

#include "core/base/Error.h"
#include "core/convolution/ElementBounds.h"
#include "core/convolution/ElementTree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace hybridtree
{
namespace
{

void makeUnique(std::vector<std::int32_t>& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// In units of R. Middles of pieces are then half of R apart, in segments as in triangles.
constexpr double kPieceLength = 0.5;
constexpr double kPieceSide = 0.85;
constexpr int kMostParts = 1024; // of a segment
constexpr int kMostSides = 32;   // parts of a triangle's edge

int partsOf(double length, double longest, int most)
{
  return static_cast<int>(std::clamp(std::ceil(length / longest), 1.0, double(most)));
}

// What the corners of an element have, weighted.
template <std::size_t N>
struct Weighted
{
  std::array<double, N> weights;

  template <typename Values>
  auto operator()(const Values& values) const
  {
    typename Values::value_type sum = weights[0] * values[0];
    for (std::size_t k = 1; k < N; ++k)
    {
      sum += weights[k] * values[k];
    }
    return sum;
  }
};

template <std::size_t N>
std::array<Vec3, N> cornersOf(const GroupedElements& elements, const GroupedElement<N>& element)
{
  std::array<Vec3, N> corners;
  for (std::size_t k = 0; k < N; ++k)
  {
    corners[k] = elements.points[static_cast<std::size_t>(element.corners[k])];
  }
  return corners;
}

// Distances along the skeleton.
class GraphPlaces
{
public:
  GraphPlaces(const GroupedElements& elements, double limit)
    : elements_(elements), limit_(limit), distances_(groupDistances(elements, limit))
  {
  }

  BlendPieces::Place at(const GroupedElement<2>& segment, const Weighted<2>& where) const
  {
    const auto a = static_cast<std::size_t>(segment.corners[0]);
    const auto b = static_cast<std::size_t>(segment.corners[1]);
    const double length = 2.0 * (elements_.points[a] - elements_.points[b]).norm() /
      (elements_.reaches[a] + elements_.reaches[b]);
    return this->place(segment,
      [&](const std::array<double, 2>& ends) {
        return std::min(ends[0] + where.weights[1] * length, ends[1] + where.weights[0] * length);
      });
  }
  // Linear over a triangle.
  BlendPieces::Place at(const GroupedElement<3>& triangle, const Weighted<3>& where) const
  {
    return this->place(
      triangle, [&](const std::array<double, 3>& corners) { return where(corners); });
  }

  std::vector<std::vector<std::int32_t>> neighbours() const
  {
    std::vector<std::vector<std::int32_t>> groupsAtPoints(elements_.points.size());
    collect(elements_.segments, groupsAtPoints);
    collect(elements_.triangles, groupsAtPoints);
    std::vector<std::vector<std::int32_t>> lists(elements_.groups.size());
    for (std::size_t point = 0; point < groupsAtPoints.size(); ++point)
    {
      makeUnique(groupsAtPoints[point]);
      for (const GroupDistance& near : distances_[point])
      {
        for (const std::int32_t group : groupsAtPoints[point])
        {
          if (near.distance < limit_)
          {
            lists[static_cast<std::size_t>(group)].push_back(near.group);
            lists[static_cast<std::size_t>(near.group)].push_back(group);
          }
        }
      }
    }
    for (std::size_t group = 0; group < lists.size(); ++group)
    {
      std::vector<std::int32_t>& list = lists[group];
      makeUnique(list);
      list.erase(
        std::remove(list.begin(), list.end(), static_cast<std::int32_t>(group)), list.end());
    }
    return lists;
  }

private:
  // Corners' lists ascend by group. Absent from one: farther than any limit.
  template <std::size_t N, typename Distance>
  BlendPieces::Place place(const GroupedElement<N>& element, const Distance& distance) const
  {
    BlendPieces::Place place{ element.group, {} };
    std::array<const GroupDistance*, N> next;
    std::array<const GroupDistance*, N> end;
    for (std::size_t k = 0; k < N; ++k)
    {
      const auto& list = distances_[static_cast<std::size_t>(element.corners[k])];
      next[k] = list.data();
      end[k] = list.data() + list.size();
    }
    constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();
    for (;;)
    {
      std::int32_t group = kNone;
      for (std::size_t k = 0; k < N; ++k)
      {
        group = next[k] != end[k] ? std::min(group, next[k]->group) : group;
      }
      if (group == kNone)
      {
        return place;
      }
      std::array<double, N> corners;
      for (std::size_t k = 0; k < N; ++k)
      {
        const bool isNear = next[k] != end[k] && next[k]->group == group;
        corners[k] = isNear ? next[k]++->distance : std::numeric_limits<double>::infinity();
      }
      const double value = group == element.group ? 0.0 : distance(corners);
      if (value < limit_)
      {
        place.distances.push_back({ group, value });
      }
    }
  }

  template <std::size_t N>
  static void collect(const std::vector<GroupedElement<N>>& elements,
    std::vector<std::vector<std::int32_t>>& groupsAtPoints)
  {
    for (const GroupedElement<N>& element : elements)
    {
      for (const std::int32_t corner : element.corners)
      {
        groupsAtPoints[static_cast<std::size_t>(corner)].push_back(element.group);
      }
    }
  }

  const GroupedElements& elements_;
  double limit_;
  std::vector<std::vector<GroupDistance>> distances_;
};

// Of a segment.
int partsOf(const GroupedElement<2>& segment, const std::array<Vec3, 2>& ends)
{
  return partsOf((ends[1] - ends[0]).norm(),
    kPieceLength * std::min(segment.reaches[0], segment.reaches[1]), kMostParts);
}

// Of an edge of a triangle.
int partsOf(const GroupedElement<3>& triangle, const std::array<Vec3, 3>& corners)
{
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    longest = std::max(longest, (corners[(k + 1) % 3] - corners[k]).norm());
  }
  return partsOf(longest,
    kPieceSide * *std::min_element(triangle.reaches.begin(), triangle.reaches.end()), kMostSides);
}

// Of each element every corner has an equal part.
std::vector<double> piecesAtPoints(const GroupedElements& elements)
{
  std::vector<double> pieces(elements.points.size(), 0.0);
  const auto add = [&](const auto& element, double count)
  {
    for (const std::int32_t corner : element.corners)
    {
      pieces[static_cast<std::size_t>(corner)] += count / double(element.corners.size());
    }
  };
  for (const GroupedElement<2>& segment : elements.segments)
  {
    add(segment, partsOf(segment, cornersOf(elements, segment)));
  }
  for (const GroupedElement<3>& triangle : elements.triangles)
  {
    const int sides = partsOf(triangle, cornersOf(elements, triangle));
    add(triangle, double(sides) * sides);
  }
  return pieces;
}

void cut(const GroupedElements& elements, const GroupedElement<2>& segment,
  const GraphPlaces& places, BlendPieces& pieces)
{
  const std::array<Vec3, 2> ends = cornersOf(elements, segment);
  const int parts = partsOf(segment, ends);
  const auto at = [&](double u) { return Weighted<2>{ { 1.0 - u, u } }; };
  for (int k = 0; k < parts; ++k)
  {
    const Weighted<2> from = at(double(k) / parts);
    const Weighted<2> to = at(double(k + 1) / parts);
    pieces.segments.push_back(
      makeSegmentElement(from(ends), to(ends), from(segment.reaches), to(segment.reaches)));
    pieces.segmentPlaces.push_back(places.at(segment, at((k + 0.5) / parts)));
  }
}

void cut(const GroupedElements& elements, const GroupedElement<3>& triangle,
  const GraphPlaces& places, BlendPieces& pieces)
{
  const std::array<Vec3, 3> corners = cornersOf(elements, triangle);
  const int sides = partsOf(triangle, corners);
  const auto at = [&](double i, double j) {
    return Weighted<3>{ { 1.0 - (i + j) / sides, i / sides, j / sides } };
  };
  const auto add = [&](int i, int j, int step)
  {
    const std::array<Weighted<3>, 3> where = { at(i, j), at(i + step, j), at(i, j + step) };
    pieces.triangles.push_back(
      makeTriangleElement({ where[0](corners), where[1](corners), where[2](corners) },
        { where[0](triangle.reaches), where[1](triangle.reaches), where[2](triangle.reaches) }));
    pieces.trianglePlaces.push_back(places.at(triangle, at(i + step / 3.0, j + step / 3.0)));
  };
  for (int j = 0; j < sides; ++j)
  {
    for (int i = 0; i + j < sides; ++i)
    {
      add(i, j, 1);
      if (i + j + 1 < sides)
      {
        add(i + 1, j + 1, -1);
      }
    }
  }
}

BlendPieces cutAll(const GroupedElements& elements, const GraphPlaces& places)
{
  BlendPieces pieces;
  DistanceCount count;
  const auto cutNext = [&](const auto& element, const std::vector<BlendPieces::Place>& made)
  {
    const std::size_t before = made.size();
    cut(elements, element, places, pieces);
    for (std::size_t k = before; k < made.size(); ++k)
    {
      count.add(made[k].distances.size());
    }
  };
  for (const GroupedElement<2>& segment : elements.segments)
  {
    cutNext(segment, pieces.segmentPlaces);
  }
  for (const GroupedElement<3>& triangle : elements.triangles)
  {
    cutNext(triangle, pieces.trianglePlaces);
  }
  pieces.neighbours = places.neighbours();
  return pieces;
}

// Where a compact kernel has a field.
template <class Element>
Box3 reachOf(const Element& element)
{
  const Vec3 reach = Vec3::Constant(largestReach(element));
  const Box3 box = boundsOf(element);
  return Box3(Vec3(box.min() - reach), Vec3(box.max() + reach));
}

template <typename Body>
void forEachPiece(const BlendPieces& pieces, const Body& body)
{
  for (std::size_t k = 0; k < pieces.segments.size(); ++k)
  {
    body(pieces.segmentPlaces[k], reachOf(pieces.segments[k]));
  }
  for (std::size_t k = 0; k < pieces.triangles.size(); ++k)
  {
    body(pieces.trianglePlaces[k], reachOf(pieces.triangles[k]));
  }
}

// Of each group once, ascending, the farthest.
void keepFarthest(std::vector<BlendPieces::Meeting>& list)
{
  std::sort(list.begin(), list.end(),
    [](const BlendPieces::Meeting& a, const BlendPieces::Meeting& b)
    { return a.group != b.group ? a.group < b.group : a.farthest > b.farthest; });
  list.erase(std::unique(list.begin(), list.end(),
               [](const BlendPieces::Meeting& a, const BlendPieces::Meeting& b)
               { return a.group == b.group; }),
    list.end());
}

// The groups that pieces of each meet, with fields that have an end.
std::vector<std::vector<BlendPieces::Meeting>> findMeetings(
  const BlendPieces& pieces, double farthest)
{
  std::vector<Box3> reaches(pieces.neighbours.size());
  forEachPiece(pieces,
    [&](const BlendPieces::Place& place, const Box3& reach)
    { reaches[static_cast<std::size_t>(place.group)].extend(reach); });
  const ElementTree tree(reaches);
  std::vector<std::vector<BlendPieces::Meeting>> lists(reaches.size());
  std::vector<std::size_t> limits(reaches.size(), 256); // of the lists, so that they stay short
  forEachPiece(pieces,
    [&](const BlendPieces::Place& place, const Box3& reach)
    {
      const auto own = static_cast<std::size_t>(place.group);
      if (lists[own].size() > limits[own])
      {
        keepFarthest(lists[own]);
        limits[own] = std::max(limits[own], 2 * lists[own].size());
      }
      tree.visit(reach,
        [&](std::uint32_t other)
        {
          const auto group = static_cast<std::int32_t>(other);
          if (group != place.group)
          {
            lists[own].push_back({ group, false, place.from(group, farthest) });
          }
        });
    });
  for (std::size_t k = 0; k < lists.size(); ++k)
  {
    std::vector<BlendPieces::Meeting>& list = lists[k];
    keepFarthest(list);
    for (BlendPieces::Meeting& meeting : list)
    {
      const std::vector<std::int32_t>& neighbours = pieces.neighbours[k];
      meeting.areNeighbours =
        std::binary_search(neighbours.begin(), neighbours.end(), meeting.group);
    }
  }
  return lists;
}

} // namespace

void validate(const BlendingControl& control)
{
  if (!(control.distance >= 0.5 && control.distance <= 100.0))
  {
    throw InvalidParameter("BlendDistance", control.distance,
      "from 0.5 to 100: the distance along the skeleton, in influence radii, up to which parts "
      "blend fully");
  }
}

double BlendPieces::Place::from(std::int32_t other, double farthest) const
{
  if (other == group)
  {
    return 0.0;
  }
  const auto near = std::lower_bound(distances.begin(), distances.end(), other,
    [](const GroupDistance& a, std::int32_t b) { return a.group < b; });
  return near != distances.end() && near->group == other ? near->distance : farthest;
}

BlendPieces makeBlendPieces(const GroupedElements& elements, const BlendingControl& control)
{
  const BlendShare share(control);
  requireFewDistances(elements, share.end(), piecesAtPoints(elements));
  BlendPieces pieces = cutAll(elements, GraphPlaces(elements, share.end()));
  pieces.meetings = findMeetings(pieces, share.farthest());
  return pieces;
}

} // namespace hybridtree
