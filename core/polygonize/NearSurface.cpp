// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/NearSurface.h"

#include "core/base/Scratch.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr int kProbes = 6; // to each side, each four times as far as the one before
constexpr int kMostSteps = 30;
constexpr double kNarrow = 4e-6;    // of the reach, between two sides: near enough
constexpr double kOnSurface = 1e-7; // of the larger excess at the ends of the first bracket

/// All searches of moveToSurface(), in step.
class SurfaceSearch
{
public:
  SurfaceSearch(const FieldSource& field, double reach, std::vector<SurfaceMove>& moves)
    : field_(field), reach_(reach), moves_(moves), ways_(moves.size())
  {
  }

  void run()
  {
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < moves_.size(); ++k)
    {
      left.push_back(k);
    }
    const std::vector<double> excess = this->excessOf(left);
    for (std::size_t k = 0; k < moves_.size(); ++k)
    {
      ways_[k].inside = excess[k] >= 0.0;
      ways_[k].last[0] = ways_[k].last[1] = excess[k];
      moves_[k].found = false;
    }
    for (int probe = 1; probe <= kProbes; ++probe)
    {
      const double step = reach_ * std::pow(0.25, kProbes - probe);
      this->probe(step, left);
      this->probe(-step, left);
      for (const std::size_t k : left)
      {
        ways_[k].low = step;
      }
    }
    this->narrow();
  }

private:
  /// Along the direction of a move; the surface is between low and high.
  struct Way
  {
    double low = 0.0;
    double high = 0.0;
    double at = 0.0;     ///< to be asked
    double last[2] = {}; ///< excess at the last probe ahead, and behind
    double atLow = 0.0;  ///< excess there, or a share of it: see narrow()
    double atHigh = 0.0;
    double onSurface = 0.0; ///< an excess as small as this
    bool inside = false;
    bool lowMoved = false; ///< by the last step
  };

  std::vector<double> excessOf(const std::vector<std::size_t>& chosen) const
  {
    std::vector<Vec3> points;
    for (const std::size_t k : chosen)
    {
      points.push_back(moves_[k].point + ways_[k].at * moves_[k].direction);
    }
    return excessAt(field_, points);
  }

  /// Takes out those that have found another side there.
  void probe(double at, std::vector<std::size_t>& left)
  {
    for (const std::size_t k : left)
    {
      ways_[k].at = at;
    }
    const std::vector<double> excess = this->excessOf(left);
    std::size_t kept = 0;
    for (std::size_t n = 0; n < left.size(); ++n)
    {
      const std::size_t k = left[n];
      Way& way = ways_[k];
      double& last = way.last[at < 0.0];
      if ((excess[n] >= 0.0) == way.inside)
      {
        left[kept++] = k;
      }
      else
      {
        moves_[k].found = true;
        way.low = std::copysign(way.low, at);
        way.high = at;
        way.atLow = last;
        way.atHigh = excess[n];
        way.onSurface = kOnSurface * std::max(std::abs(last), std::abs(excess[n]));
      }
      last = excess[n];
    }
    left.resize(kept);
  }

  /// By regula falsi, in which an end that stays twice counts half (Illinois), and now and then by
  /// halves: fields may jump.
  void narrow()
  {
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < moves_.size(); ++k)
    {
      if (moves_[k].found)
      {
        open.push_back(k);
      }
    }
    for (int step = 1; step <= kMostSteps && !open.empty(); ++step)
    {
      for (const std::size_t k : open)
      {
        Way& way = ways_[k];
        const double share = way.atLow / (way.atLow - way.atHigh);
        const bool halves = step % 4 == 0 || !(share > 0.0 && share < 1.0);
        way.at = way.low + (halves ? 0.5 : share) * (way.high - way.low);
      }
      const std::vector<double> excess = this->excessOf(open);
      std::size_t kept = 0;
      for (std::size_t n = 0; n < open.size(); ++n)
      {
        const std::size_t k = open[n];
        if (!this->take(excess[n], ways_[k]))
        {
          open[kept++] = k;
        }
      }
      open.resize(kept);
    }
    for (std::size_t k = 0; k < moves_.size(); ++k)
    {
      if (moves_[k].found)
      {
        moves_[k].point += ways_[k].at * moves_[k].direction;
      }
    }
  }

  /// \return whether that is near enough.
  bool take(double excess, Way& way) const
  {
    const bool movesLow = (excess >= 0.0) == way.inside;
    (movesLow ? way.low : way.high) = way.at;
    (movesLow ? way.atLow : way.atHigh) = excess;
    if (movesLow == way.lowMoved)
    {
      (movesLow ? way.atHigh : way.atLow) *= 0.5;
    }
    way.lowMoved = movesLow;
    return std::abs(excess) <= way.onSurface || std::abs(way.high - way.low) <= kNarrow * reach_;
  }

  const FieldSource& field_;
  const double reach_;
  std::vector<SurfaceMove>& moves_;
  std::vector<Way> ways_;
};

} // namespace

double excessAt(const FieldSource& field, const Vec3& p)
{
  double value = 0.0;
  field.field({ &p.x(), &p.y(), &p.z(), 1 }, &value);
  return value - kThreshold;
}

std::vector<double> excessAt(const FieldSource& field, const std::vector<Vec3>& points)
{
  ScratchVectors places(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    places.batch().set(k, points[k]);
  }
  std::vector<double> excess(points.size());
  field.field(places.points(), excess.data());
  for (double& value : excess)
  {
    value -= kThreshold;
  }
  return excess;
}

bool moveToSurface(const FieldSource& field, double reach, const Vec3& direction, Vec3& point)
{
  std::vector<SurfaceMove> moves{ { point, direction, false } };
  moveToSurface(field, reach, moves);
  point = moves.front().point;
  return moves.front().found;
}

void moveToSurface(const FieldSource& field, double reach, std::vector<SurfaceMove>& moves)
{
  if (!moves.empty())
  {
    SurfaceSearch(field, reach, moves).run();
  }
}

} // namespace hybridtree
