// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/GraphDistances.h"

#include "core/base/Error.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <string>

namespace hybridtree
{
namespace
{

struct Way
{
  std::size_t to;
  double length;
};

using Ways = std::vector<std::vector<Way>>;

Ways waysOf(const GroupedElements& elements)
{
  Ways ways(elements.points.size());
  const auto add = [&](std::int32_t first, std::int32_t second)
  {
    const auto a = static_cast<std::size_t>(first);
    const auto b = static_cast<std::size_t>(second);
    const double length = 2.0 * (elements.points[a] - elements.points[b]).norm() /
      (elements.reaches[a] + elements.reaches[b]);
    ways[a].push_back({ b, length });
    ways[b].push_back({ a, length });
  };
  for (const GroupedElement<2>& segment : elements.segments)
  {
    add(segment.corners[0], segment.corners[1]);
  }
  for (const GroupedElement<3>& triangle : elements.triangles)
  {
    add(triangle.corners[0], triangle.corners[1]);
    add(triangle.corners[1], triangle.corners[2]);
    add(triangle.corners[2], triangle.corners[0]);
  }
  return ways;
}

template <std::size_t N>
void collectPoints(
  const std::vector<GroupedElement<N>>& elements, std::vector<std::vector<std::size_t>>& points)
{
  for (const GroupedElement<N>& element : elements)
  {
    std::vector<std::size_t>& of = points[static_cast<std::size_t>(element.group)];
    of.insert(of.end(), element.corners.begin(), element.corners.end());
  }
}

// Dijkstra from all points of one group. Touched points are those whose distance is set.
class Search
{
public:
  explicit Search(const Ways& ways)
    : ways_(ways), distance_(ways.size(), std::numeric_limits<double>::infinity())
  {
  }

  template <typename Found>
  void run(const std::vector<std::size_t>& sources, double limit, const Found& found)
  {
    for (const std::size_t source : sources)
    {
      this->reach(source, 0.0);
    }
    while (!queue_.empty())
    {
      const auto [distance, point] = queue_.top();
      queue_.pop();
      if (distance > distance_[point] || distance > limit)
      {
        continue;
      }
      for (const Way& way : ways_[point])
      {
        this->reach(way.to, distance + way.length);
      }
    }
    for (const std::size_t point : touched_)
    {
      found(point, distance_[point]);
      distance_[point] = std::numeric_limits<double>::infinity();
    }
    touched_.clear();
  }

private:
  void reach(std::size_t point, double distance)
  {
    if (distance >= distance_[point])
    {
      return;
    }
    if (distance_[point] == std::numeric_limits<double>::infinity())
    {
      touched_.push_back(point);
    }
    distance_[point] = distance;
    queue_.push({ distance, point });
  }

  using Entry = std::pair<double, std::size_t>;
  const Ways& ways_;
  std::vector<double> distance_;
  std::vector<std::size_t> touched_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

// The points of each group.
std::vector<std::vector<std::size_t>> sourcesOf(const GroupedElements& elements)
{
  std::vector<std::vector<std::size_t>> sources(elements.groups.size());
  collectPoints(elements.segments, sources);
  collectPoints(elements.triangles, sources);
  return sources;
}

constexpr std::size_t kMostDistances = 60000000; // about a gigabyte
constexpr std::size_t kSamples = 512;
constexpr double kClearly = 1.15; // so that what would fit is not refused by an estimate

[[noreturn]] void refuse()
{
  throw TooLarge("Blending = neighbours would have to keep more than " +
    std::to_string(kMostDistances) +
    " distances along the skeleton: its elements are many and small beside the radius. Choose "
    "Blending = all, a lower Level, a smaller radius or BlendDistance, or a coarser skeleton.");
}

} // namespace

void DistanceCount::add(std::size_t distances)
{
  count_ += distances;
  if (count_ > kMostDistances)
  {
    refuse();
  }
}

void requireFewDistances(
  const GroupedElements& elements, double limit, const std::vector<double>& piecesAt)
{
  const double groups = static_cast<double>(elements.groups.size());
  const double pieces = std::accumulate(piecesAt.begin(), piecesAt.end(), 0.0);
  if (groups * pieces <= static_cast<double>(kMostDistances))
  {
    return;
  }
  const Ways ways = waysOf(elements);
  const std::vector<std::vector<std::size_t>> sources = sourcesOf(elements);
  const std::size_t samples = std::min(kSamples, sources.size());
  Search search(ways);
  double found = 0.0;
  for (std::size_t k = 0; k < samples; ++k)
  {
    search.run(sources[k * sources.size() / samples], limit,
      [&](std::size_t point, double distance)
      { found += distance < limit ? piecesAt[point] : 0.0; });
  }
  if (found / static_cast<double>(samples) * groups >
    kClearly * static_cast<double>(kMostDistances))
  {
    refuse();
  }
}

std::vector<std::vector<GroupDistance>> groupDistances(
  const GroupedElements& elements, double limit)
{
  const Ways ways = waysOf(elements);
  const std::vector<std::vector<std::size_t>> sources = sourcesOf(elements);
  std::vector<std::vector<GroupDistance>> distances(elements.points.size());
  Search search(ways);
  DistanceCount count;
  for (std::size_t group = 0; group < sources.size(); ++group)
  {
    search.run(sources[group], limit,
      [&](std::size_t point, double distance)
      {
        count.add(1);
        distances[point].push_back({ static_cast<std::int32_t>(group), distance });
      });
  }
  return distances;
}

} // namespace hybridtree
