// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/PieceGraph.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

// What a full piece extends from its center: half of a segment's, a corner of a triangle's.
constexpr double kSegmentExtent = 0.5 * PieceGraph::kPieceLength;
constexpr double kTriangleExtent = 0.72; // of a side of kPieceSide

constexpr double kShortest = 0.8; // of a straight way through a sheet, beside that over a point
constexpr double kZigzag = 0.93;  // of a straight way, beside that from center to center
constexpr std::size_t kMany = 12; // pieces at one point that are not joined one by one

constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace

PieceGraph::PieceGraph(std::vector<PiecePlace> places, std::vector<PieceContact> contacts,
  std::vector<PieceSide> sides, const std::vector<Vec3>& points)
  : places_(std::move(places)), nodeCount_(places_.size())
{
  this->joinContacts(contacts);
  this->joinSides(sides, points);
  this->sortLinks();
}

double PieceGraph::extent(std::uint32_t piece) const
{
  return places_[piece].isTriangle ? kTriangleExtent : kSegmentExtent;
}

// The larger R: so it is not more than the way.
double PieceGraph::straight(std::uint32_t a, std::uint32_t b) const
{
  return (places_[a].center - places_[b].center).norm() /
    std::max(places_[a].reach, places_[b].reach);
}

double PieceGraph::over(std::uint32_t a, std::uint32_t b, const Vec3& place) const
{
  const double mean = 0.5 * (places_[a].reach + places_[b].reach);
  const double way =
    ((places_[a].center - place).norm() + (places_[b].center - place).norm()) / mean;
  return places_[a].isTriangle && places_[b].isTriangle
    ? std::max(kShortest * way, (places_[a].center - places_[b].center).norm() / mean)
    : way;
}

void PieceGraph::addLink(std::uint32_t a, std::uint32_t b, double length)
{
  links_.push_back({ a, b, length });
  links_.push_back({ b, a, length });
}

void PieceGraph::joinContacts(std::vector<PieceContact>& contacts)
{
  std::sort(contacts.begin(), contacts.end(),
    [](const PieceContact& a, const PieceContact& b)
    { return a.point != b.point ? a.point < b.point : a.piece < b.piece; });
  contacts.erase(std::unique(contacts.begin(), contacts.end(),
                   [](const PieceContact& a, const PieceContact& b)
                   { return a.point == b.point && a.piece == b.piece; }),
    contacts.end());
  for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end)
  {
    while (end < contacts.size() && contacts[end].point == contacts[begin].point)
    {
      ++end;
    }
    if (end - begin > kMany)
    {
      const auto node = static_cast<std::uint32_t>(nodeCount_++);
      for (std::size_t k = begin; k < end; ++k)
      {
        const PiecePlace& at = places_[contacts[k].piece];
        this->addLink(node, contacts[k].piece, (at.center - contacts[k].place).norm() / at.reach);
      }
      continue;
    }
    for (std::size_t a = begin; a < end; ++a)
    {
      for (std::size_t b = a + 1; b < end; ++b)
      {
        this->addLink(contacts[a].piece, contacts[b].piece,
          this->over(contacts[a].piece, contacts[b].piece, contacts[a].place));
      }
    }
  }
}

void PieceGraph::joinSides(std::vector<PieceSide>& sides, const std::vector<Vec3>& points)
{
  std::sort(sides.begin(), sides.end(),
    [](const PieceSide& one, const PieceSide& other)
    {
      return one.a != other.a    ? one.a < other.a
        : one.b != other.b       ? one.b < other.b
        : one.from != other.from ? one.from < other.from
                                 : one.piece < other.piece;
    });
  constexpr double kRounding = 1e-9;
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    const PieceSide& side = sides[k];
    const Vec3& a = points[static_cast<std::size_t>(side.a)];
    const Vec3& b = points[static_cast<std::size_t>(side.b)];
    for (std::size_t next = k + 1; next < sides.size(); ++next)
    {
      const PieceSide& other = sides[next];
      if (other.a != side.a || other.b != side.b || other.from > side.to + kRounding)
      {
        break;
      }
      if (other.piece != side.piece)
      {
        const double middle = 0.5 * (other.from + std::min(side.to, other.to));
        this->addLink(
          side.piece, other.piece, this->over(side.piece, other.piece, a + middle * (b - a)));
      }
    }
  }
}

// By nodes, of each pair the shortest.
void PieceGraph::sortLinks()
{
  begin_.assign(nodeCount_ + 1, 0);
  for (const Link& link : links_)
  {
    ++begin_[link.a + 1];
  }
  for (std::size_t k = 0; k < nodeCount_; ++k)
  {
    begin_[k + 1] += begin_[k];
  }
  std::vector<Way> ways(links_.size());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (const Link& link : links_)
  {
    ways[next[link.a]++] = { link.b, link.length };
  }
  links_ = {};
  std::uint32_t kept = 0;
  for (std::size_t k = 0; k < nodeCount_; ++k)
  {
    const auto first = ways.begin() + begin_[k];
    const auto last = ways.begin() + begin_[k + 1];
    std::sort(first, last,
      [](const Way& a, const Way& b) { return a.to != b.to ? a.to < b.to : a.length < b.length; });
    const auto end =
      std::unique(first, last, [](const Way& a, const Way& b) { return a.to == b.to; });
    begin_[k] = kept;
    kept += static_cast<std::uint32_t>(end - first);
    std::move(first, end, std::back_inserter(ways_));
  }
  begin_[nodeCount_] = kept;
}

PieceGraph::Search::Search(const PieceGraph& graph)
  : graph_(graph), ways_(graph.nodeCount_, kInfinity)
{
}

void PieceGraph::Search::reach(std::uint32_t piece, double way)
{
  if (way >= ways_[piece])
  {
    return;
  }
  if (ways_[piece] == kInfinity)
  {
    touched_.push_back(piece);
  }
  ways_[piece] = way;
  queue_.emplace_back(way, piece);
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void PieceGraph::Search::run(std::uint32_t from, double distance)
{
  for (const std::uint32_t piece : touched_)
  {
    ways_[piece] = kInfinity;
  }
  touched_.clear();
  from_ = from;
  const bool isTriangle = graph_.places_[from].isTriangle;
  const double most = distance + graph_.extent(from) + kTriangleExtent;
  const double limit = isTriangle ? most / kZigzag : most;
  this->reach(from, 0.0);
  while (!queue_.empty())
  {
    const auto [way, piece] = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    if (way > ways_[piece])
    {
      continue;
    }
    const std::uint32_t end = graph_.begin_[piece + 1];
    for (std::uint32_t k = graph_.begin_[piece]; k < end; ++k)
    {
      const Way& next = graph_.ways_[k];
      if (way + next.length <= limit)
      {
        this->reach(next.to, way + next.length);
      }
    }
  }
  touched_.erase(std::remove_if(touched_.begin(), touched_.end(),
                   [&](std::uint32_t node)
                   {
                     const bool isPoint = node >= graph_.size();
                     ways_[node] = isPoint ? kInfinity : ways_[node];
                     return isPoint;
                   }),
    touched_.end());
}

double PieceGraph::Search::distance(std::uint32_t to) const
{
  if (to == from_)
  {
    return 0.0;
  }
  const bool areTriangles = graph_.places_[from_].isTriangle && graph_.places_[to].isTriangle;
  const double way =
    areTriangles ? std::max(kZigzag * ways_[to], graph_.straight(from_, to)) : ways_[to];
  return std::max(0.0, way - graph_.extent(from_) - graph_.extent(to));
}

} // namespace hybridtree
