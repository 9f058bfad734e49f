// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/CarriedCurves.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace hybridtree
{
namespace
{

using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edgeOf(std::int32_t a, std::int32_t b)
{
  return std::minmax(a, b);
}

class Carrier
{
public:
  Carrier(
    const PointChains& chains, std::size_t points, int operand, const MeshBooleanResult& result)
    : result_(result)
  {
    this->findKept(points, operand);
    this->findCuts(chains, operand);
    this->findEdges(chains);
  }

  void carry(const std::vector<std::int32_t>& chain, PointChains& carried) const
  {
    PointChains runs(1);
    for (const std::int32_t point : this->pointsAlong(chain))
    {
      std::vector<std::int32_t>& run = runs.back();
      const bool goesOn =
        point >= 0 && (run.empty() || edges_.count(edgeOf(run.back(), point)) > 0);
      (goesOn ? run : runs.emplace_back()).push_back(point);
    }
    runs.erase(
      std::remove_if(runs.begin(), runs.end(), [](const auto& run) { return run.size() < 2; }),
      runs.end());
    // Through the point where a closed chain begins.
    if (runs.size() > 1 && runs.back().back() == runs.front().front())
    {
      runs.back().insert(runs.back().end(), runs.front().begin() + 1, runs.front().end());
      runs.erase(runs.begin());
    }
    carried.insert(carried.end(), runs.begin(), runs.end());
  }

private:
  void findKept(std::size_t points, int operand)
  {
    kept_.assign(points, -1);
    const std::size_t begin = operand == 0 ? 0 : result_.firstOfB;
    const std::size_t end = operand == 0 ? result_.firstOfB : result_.firstCut;
    for (std::size_t k = begin; k < end; ++k)
    {
      const std::int32_t source = result_.sourcePoint[k];
      if (source >= 0 && std::size_t(source) < points)
      {
        kept_[std::size_t(source)] = std::int32_t(k);
      }
    }
  }

  void findCuts(const PointChains& chains, int operand)
  {
    for (const std::vector<std::int32_t>& chain : chains)
    {
      for (std::size_t k = 1; k < chain.size(); ++k)
      {
        cuts_[edgeOf(chain[k - 1], chain[k])];
      }
    }
    for (std::size_t k = 0; k < result_.cutPoints.size(); ++k)
    {
      const CutPoint& cut = result_.cutPoints[k];
      const auto found =
        cut.operand == operand ? cuts_.find(edgeOf(cut.low, cut.high)) : cuts_.end();
      if (found != cuts_.end())
      {
        found->second.push_back(std::int32_t(result_.firstCut + k));
      }
    }
    for (auto& [edge, cuts] : cuts_)
    {
      std::sort(cuts.begin(), cuts.end(),
        [&, low = edge.first](std::int32_t a, std::int32_t b)
        { return this->alongFrom(low, a) < this->alongFrom(low, b); });
    }
  }

  // Those of the result between points that the chains may have there.
  void findEdges(const PointChains& chains)
  {
    std::vector<bool> wanted(result_.mesh.points.size(), false);
    for (const std::vector<std::int32_t>& chain : chains)
    {
      for (const std::int32_t point : this->pointsAlong(chain))
      {
        if (point >= 0)
        {
          wanted[std::size_t(point)] = true;
        }
      }
    }
    for (const Triangle& c : result_.mesh.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t from = c[std::size_t(k)];
        const std::int32_t to = c[std::size_t((k + 1) % 3)];
        if (from < to && wanted[std::size_t(from)] && wanted[std::size_t(to)])
        {
          edges_.insert({ from, to });
        }
      }
    }
  }

  double alongFrom(std::int32_t end, std::int32_t point) const
  {
    const CutPoint& cut = result_.cutPoints[std::size_t(point) - result_.firstCut];
    return cut.low == end ? cut.parameter : 1.0 - cut.parameter;
  }

  // Points of the result: those of the chain, -1 for what is gone, and cuts between.
  std::vector<std::int32_t> pointsAlong(const std::vector<std::int32_t>& chain) const
  {
    std::vector<std::int32_t> points;
    for (std::size_t k = 0; k < chain.size(); ++k)
    {
      if (k > 0)
      {
        const std::vector<std::int32_t>& cuts = cuts_.at(edgeOf(chain[k - 1], chain[k]));
        chain[k - 1] < chain[k] ? points.insert(points.end(), cuts.begin(), cuts.end())
                                : points.insert(points.end(), cuts.rbegin(), cuts.rend());
      }
      points.push_back(kept_[std::size_t(chain[k])]);
    }
    return points;
  }

  const MeshBooleanResult& result_;
  std::vector<std::int32_t> kept_;                 // by point of the operand: where it is now
  std::map<Edge, std::vector<std::int32_t>> cuts_; // by edge of a chain: points from its low end
  std::set<Edge> edges_;
};

} // namespace

PointChains carriedCurves(
  const PointChains& chains, std::size_t points, int operand, const MeshBooleanResult& result)
{
  PointChains carried;
  if (chains.empty())
  {
    return carried;
  }
  const Carrier carrier(chains, points, operand, result);
  for (const std::vector<std::int32_t>& chain : chains)
  {
    carrier.carry(chain, carried);
  }
  return carried;
}

} // namespace hybridtree
