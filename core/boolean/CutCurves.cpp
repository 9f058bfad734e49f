// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/CutCurves.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 256;

// An end of a segment, keyed to find the other end at the same crossing.
struct Reference
{
  std::uint64_t edge; // low, high
  std::int32_t other;
  std::int32_t own;
  std::uint32_t end; // 2 * segment, + 1 for its end
  bool forward;

  bool operator<(const Reference& r) const
  {
    return std::tie(edge, other, forward, own) < std::tie(r.edge, r.other, r.forward, r.own);
  }
};

const SegmentEnd& endOf(const std::vector<Segment>& segments, std::uint32_t end)
{
  const Segment& segment = segments[end / 2];
  return end % 2 == 0 ? segment.start : segment.end;
}

// References to one crossing place: the backward ones first, as many as forward ones.
struct Place
{
  std::size_t begin;
  std::size_t end;

  std::size_t pairs() const { return (end - begin) / 2; }
};

[[noreturn]] void failToPair(const SegmentEnd& end)
{
  throw InvalidGeometry("The crossings of the edge between points " + std::to_string(end.low) +
    " and " + std::to_string(end.high) + " of the " + (end.mesh == 0 ? "first" : "second") +
    " mesh cannot be ordered. Move one mesh a little.");
}

// The crossings on the edges of one mesh.
class EdgeCrossings
{
public:
  EdgeCrossings(const MeshOperand& mine, const MeshOperand& other, int mesh,
    const PerturbedPredicates& predicates, const std::vector<Segment>& segments)
    : mine_(mine), other_(other), mesh_(mesh), predicates_(predicates), segments_(segments)
  {
  }

  void run()
  {
    this->gather();
    for (std::size_t begin = 0, end = 0; begin < references_.size(); begin = end)
    {
      while (end < references_.size() && references_[end].edge == references_[begin].edge)
      {
        ++end;
      }
      this->addEdge(begin, end);
    }
  }

  std::vector<Crossing> crossings;
  /// Crossing of each reference's end of a segment.
  std::vector<std::pair<std::uint32_t, std::int32_t>> ends;

private:
  void gather()
  {
    for (std::uint32_t end = 0; end < 2 * segments_.size(); ++end)
    {
      const SegmentEnd& e = endOf(segments_, end);
      if (e.mesh == mesh_)
      {
        const std::uint64_t edge = std::uint64_t(e.low) << 32 | std::uint32_t(e.high);
        references_.push_back({ edge, e.other, e.own, end, e.forward });
      }
    }
    std::sort(references_.begin(), references_.end());
    ends.reserve(references_.size());
    crossings.reserve(references_.size() / 2);
  }

  void addEdge(std::size_t begin, std::size_t end)
  {
    places_.clear();
    for (std::size_t k = begin; k < end;)
    {
      const std::size_t first = k;
      std::size_t forward = 0;
      for (; k < end && references_[k].other == references_[first].other; ++k)
      {
        forward += references_[k].forward;
      }
      places_.push_back({ first, k });
      if (2 * forward != k - first || places_.back().pairs() != places_.front().pairs())
      {
        failToPair(endOf(segments_, references_[first].end));
      }
    }
    this->sortPlaces();
    for (std::size_t rank = 0; rank < places_.front().pairs(); ++rank)
    {
      for (const Place& place : places_)
      {
        this->addCrossing(references_[place.begin + rank],
          references_[place.begin + place.pairs() + rank], std::int32_t(rank));
      }
    }
  }

  std::array<Site, 3> cornersOf(std::int32_t triangle) const
  {
    const Triangle& corner = other_.mesh().triangles[std::size_t(triangle)];
    return { siteOf(other_, corner[0], mesh_ == 0), siteOf(other_, corner[1], mesh_ == 0),
      siteOf(other_, corner[2], mesh_ == 0) };
  }

  void sortPlaces()
  {
    if (places_.size() < 2)
    {
      return;
    }
    const SegmentEnd& edge = endOf(segments_, references_[places_.front().begin].end);
    const Site low = siteOf(mine_, edge.low, mesh_ == 1);
    const Site high = siteOf(mine_, edge.high, mesh_ == 1);
    std::sort(places_.begin(), places_.end(),
      [&](const Place& a, const Place& b)
      {
        if (a.begin == b.begin)
        {
          return false;
        }
        const int order = predicates_.order(low, high, this->cornersOf(references_[a.begin].other),
          this->cornersOf(references_[b.begin].other));
        if (order == 0)
        {
          failToPair(edge);
        }
        return order < 0;
      });
  }

  void addCrossing(const Reference& backward, const Reference& forward, std::int32_t row)
  {
    const std::int32_t index = std::int32_t(crossings.size());
    ends.push_back({ backward.end, index });
    ends.push_back({ forward.end, index });
    const SegmentEnd& end = endOf(segments_, forward.end);
    crossings.push_back(
      { end.low, end.high, end.other, row, std::int8_t(mesh_), end.lowOutside, 0.0, Vec3::Zero() });
  }

  const MeshOperand& mine_;
  const MeshOperand& other_;
  const int mesh_;
  const PerturbedPredicates& predicates_;
  const std::vector<Segment>& segments_;
  std::vector<Reference> references_;
  std::vector<Place> places_;
};

void place(const MeshOperand& mine, const MeshOperand& other, const PerturbedPredicates& predicates,
  Crossing& crossing)
{
  const bool second = crossing.mesh == 1;
  const Triangle& corner = other.mesh().triangles[std::size_t(crossing.other)];
  const Site low = siteOf(mine, crossing.low, second);
  const Site high = siteOf(mine, crossing.high, second);
  const double t = predicates.parameter(low, high,
    { siteOf(other, corner[0], !second), siteOf(other, corner[1], !second),
      siteOf(other, corner[2], !second) });
  crossing.parameter = t;
  crossing.position = pointOnEdge(low.position, high.position, t);
}

CutCurves::Cuts cutsOf(const std::vector<Segment>& segments, std::size_t mesh)
{
  std::vector<std::uint64_t> keys(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s)
  {
    keys[s] = std::uint64_t(segments[s].triangle[mesh]) << 32 | s;
  }
  std::sort(keys.begin(), keys.end());
  CutCurves::Cuts cuts;
  cuts.segments.reserve(keys.size());
  for (const std::uint64_t key : keys)
  {
    const std::int32_t triangle = std::int32_t(key >> 32);
    if (cuts.triangles.empty() || cuts.triangles.back() != triangle)
    {
      cuts.triangles.push_back(triangle);
      cuts.first.push_back(std::int32_t(cuts.segments.size()));
    }
    cuts.segments.push_back(std::int32_t(std::uint32_t(key)));
  }
  cuts.first.push_back(std::int32_t(cuts.segments.size()));
  return cuts;
}

} // namespace

Vec3 pointOnEdge(const Vec3& low, const Vec3& high, double parameter)
{
  return parameter < 0.5 ? Vec3(low + parameter * (high - low))
                         : Vec3(high + (1.0 - parameter) * (low - high));
}

CutCurves cutCurves(const MeshOperand& a, const MeshOperand& b,
  const PerturbedPredicates& predicates, std::vector<Segment> segments)
{
  CutCurves curves;
  curves.segments = std::move(segments);
  curves.ends.resize(curves.segments.size());
  std::array<EdgeCrossings, 2> found = { EdgeCrossings(a, b, 0, predicates, curves.segments),
    EdgeCrossings(b, a, 1, predicates, curves.segments) };
  parallelFor(2, 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t mesh = begin; mesh < end; ++mesh)
      {
        found[mesh].run();
        curves.cuts[mesh] = cutsOf(curves.segments, mesh);
      }
    });
  for (const EdgeCrossings& part : found)
  {
    const std::int32_t offset = std::int32_t(curves.crossings.size());
    for (const auto& [end, crossing] : part.ends)
    {
      curves.ends[end / 2][end % 2] = offset + crossing;
    }
    curves.crossings.insert(curves.crossings.end(), part.crossings.begin(), part.crossings.end());
  }
  parallelFor(curves.crossings.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        Crossing& crossing = curves.crossings[k];
        place(crossing.mesh == 0 ? a : b, crossing.mesh == 0 ? b : a, predicates, crossing);
      }
    });
  return curves;
}

std::vector<std::vector<std::int32_t>> chainsOf(const CutCurves& curves)
{
  // Each crossing starts one segment and ends one.
  std::vector<std::int32_t> next(curves.crossings.size(), -1);
  for (const std::array<std::int32_t, 2>& end : curves.ends)
  {
    next[std::size_t(end[0])] = end[1];
  }
  std::vector<std::vector<std::int32_t>> chains;
  for (std::size_t first = 0; first < next.size(); ++first)
  {
    std::vector<std::int32_t> chain;
    for (std::int32_t at = std::int32_t(first); at >= 0; at = std::exchange(next[at], -1))
    {
      chain.push_back(at);
    }
    if (chain.size() > 1)
    {
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

} // namespace hybridtree
