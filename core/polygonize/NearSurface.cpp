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
constexpr int kBisections = 18;

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
    const std::vector<bool> inside = this->sidesAt(left);
    for (std::size_t k = 0; k < moves_.size(); ++k)
    {
      ways_[k].inside = inside[k];
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
    this->bisect();
  }

private:
  /// Along the direction of a move; the surface is between low and high.
  struct Way
  {
    double low = 0.0;
    double high = 0.0;
    double at = 0.0; ///< to be asked
    bool inside = false;
  };

  std::vector<bool> sidesAt(const std::vector<std::size_t>& chosen) const
  {
    std::vector<Vec3> points;
    for (const std::size_t k : chosen)
    {
      points.push_back(moves_[k].point + ways_[k].at * moves_[k].direction);
    }
    std::vector<bool> inside;
    for (const double excess : excessAt(field_, points))
    {
      inside.push_back(excess >= 0.0);
    }
    return inside;
  }

  /// Takes out those that have found another side there.
  void probe(double at, std::vector<std::size_t>& left)
  {
    for (const std::size_t k : left)
    {
      ways_[k].at = at;
    }
    const std::vector<bool> inside = this->sidesAt(left);
    std::size_t kept = 0;
    for (std::size_t n = 0; n < left.size(); ++n)
    {
      const std::size_t k = left[n];
      if (inside[n] == ways_[k].inside)
      {
        left[kept++] = k;
        continue;
      }
      moves_[k].found = true;
      ways_[k].low = std::copysign(ways_[k].low, at);
      ways_[k].high = at;
    }
    left.resize(kept);
  }

  void bisect()
  {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < moves_.size(); ++k)
    {
      if (moves_[k].found)
      {
        found.push_back(k);
      }
    }
    for (int step = 0; step < kBisections; ++step)
    {
      for (const std::size_t k : found)
      {
        ways_[k].at = 0.5 * (ways_[k].low + ways_[k].high);
      }
      const std::vector<bool> inside = this->sidesAt(found);
      for (std::size_t n = 0; n < found.size(); ++n)
      {
        Way& way = ways_[found[n]];
        (inside[n] == way.inside ? way.low : way.high) = way.at;
      }
    }
    for (const std::size_t k : found)
    {
      moves_[k].point += 0.5 * (ways_[k].low + ways_[k].high) * moves_[k].direction;
    }
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
