// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/BallSides.h"

#include "reconstruction/EmptyBalls.h"
#include "reconstruction/JoinedParts.h"
#include "reconstruction/SignedHarmonic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 2048;
// Cosine between the ways to both poles, one of them turned round, at least.
constexpr double kOpposite = 0.3;
// Poles that see fewer spacings than this count for less.
constexpr double kFar = 3.0;

// Of the poles of points.
class LinksOfPoles
{
public:
  LinksOfPoles(
    const Tetrahedralization& tetrahedra, const FacetSize& sizes, const EmptyBalls& balls)
    : tetrahedra_(tetrahedra), sizes_(sizes), balls_(balls)
  {
  }

  std::vector<SignedLink> collect(const Progress& progress) const
  {
    return collectInParts<SignedLink>(tetrahedra_.points().size(), kGrain, progress,
      [&](std::size_t begin, std::size_t end, std::vector<SignedLink>& links)
      {
        for (std::size_t point = begin; point < end; ++point)
        {
          this->addPoles(static_cast<std::int32_t>(point), links);
        }
      });
  }

private:
  // Of slivers the balls are larger than what they see.
  double size(std::int32_t cell) const
  {
    return std::min(balls_.diameter(cell), double(sizes_.lengthOfCell(cell)));
  }

  // The half-spaces at a point are one pole together, in the mean of their ways.
  void addPoles(std::int32_t point, std::vector<SignedLink>& links) const
  {
    std::int32_t up = -1;
    double upSize = 0.0;
    Vec3 out = Vec3::Zero();
    for (const std::int32_t cell : tetrahedra_.star(point))
    {
      if (balls_.isHalfSpace(cell))
      {
        out += balls_.way(point, cell);
        up = cell;
        upSize = std::numeric_limits<double>::infinity();
      }
      else if (this->size(cell) > upSize)
      {
        up = cell;
        upSize = this->size(cell);
      }
    }
    if (up < 0)
    {
      return; // a duplicate
    }
    const Vec3 way = std::isinf(upSize) ? out.normalized() : balls_.way(point, up);
    std::int32_t down = -1;
    double downSize = 0.0;
    double cosine = 0.0;
    for (const std::int32_t cell : tetrahedra_.star(point))
    {
      const double against = balls_.isHalfSpace(cell) ? 0.0 : -balls_.way(point, cell).dot(way);
      if (against >= kOpposite && against * this->size(cell) > downSize)
      {
        down = cell;
        downSize = against * this->size(cell);
        cosine = against;
      }
    }
    if (down >= 0)
    {
      const double seen = std::min(upSize, downSize) / (kFar * sizes_.spacing(point));
      links.push_back(
        { up, down, -EmptyBalls::weight(cosine) * static_cast<float>(std::min(1.0, seen)) });
    }
  }

  const Tetrahedralization& tetrahedra_;
  const FacetSize& sizes_;
  const EmptyBalls& balls_;
};

// By weight.
double shareContradicted(const std::vector<SignedLink>& opposite, const std::vector<double>& value)
{
  double sum = 0.0;
  double contradicted = 0.0;
  for (const SignedLink& link : opposite)
  {
    sum -= double(link.weight);
    contradicted -= value[link.a] * value[link.b] > 0.0 ? double(link.weight) : 0.0;
  }
  return sum > 0.0 ? contradicted / sum : 0.0;
}

} // namespace

BallSides findSidesByBalls(
  const Tetrahedralization& tetrahedra, const FacetSize& sizes, const Progress& progress)
{
  std::vector<float> held(static_cast<std::size_t>(tetrahedra.cellCount()), 0.0f);
  std::vector<SignedLink> links;
  std::vector<SignedLink> opposite;
  {
    const EmptyBalls balls(tetrahedra, progress);
    for (std::int32_t cell = 0; cell < tetrahedra.cellCount(); ++cell)
    {
      held[cell] = balls.isHalfSpace(cell) ? 1.0f : 0.0f;
    }
    links = linksOfNeighbors(tetrahedra, balls, progress);
    opposite = LinksOfPoles(tetrahedra, sizes, balls).collect(progress);
    links.insert(links.end(), opposite.begin(), opposite.end());
  }
  const std::vector<double> value = signedHarmonic(held, std::move(links), progress);
  BallSides sides;
  sides.inside.resize(value.size());
  std::transform(value.begin(), value.end(), sides.inside.begin(),
    [](double side) { return static_cast<std::uint8_t>(side < 0.0 ? 1 : 0); });
  sides.contradicted = shareContradicted(opposite, value);
  return sides;
}

} // namespace hybridtree
