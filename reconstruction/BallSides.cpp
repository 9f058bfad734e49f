// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/BallSides.h"

#include "reconstruction/JoinedParts.h"
#include "reconstruction/Poles.h"
#include "reconstruction/SignedHarmonic.h"

#include "core/base/Parallel.h"

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
// Weights fall by the square of e^this from balls that are one to balls that but touch.
constexpr double kSharpness = 4.0;
// Cosine between the ways to both poles, one of them turned round, at least.
constexpr double kOpposite = 0.3;
// Poles that see fewer spacings than this count for less.
constexpr double kFar = 3.0;

// Empty balls around the tetrahedra, and half-spaces before the hull.
class Balls
{
public:
  Balls(const Tetrahedralization& tetrahedra, const Progress& progress)
    : tetrahedra_(tetrahedra), balls_(static_cast<std::size_t>(tetrahedra.cellCount()))
  {
    const auto& points = tetrahedra.points();
    Box3 box;
    middle_.setZero();
    for (const Vec3& point : points)
    {
      box.extend(point);
      middle_ += point / double(points.size());
    }
    const double huge = kHuge * box.diagonal().norm();
    parallelFor(balls_.size(), kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        progress.check();
        for (std::size_t cell = begin; cell < end; ++cell)
        {
          balls_[cell] = this->ballOf(static_cast<std::int32_t>(cell), huge);
        }
      });
  }

  /// Whether it is a half-space. It then lies before the hull.
  bool isHalfSpace(std::int32_t cell) const { return balls_[cell].radius == 0.0; }
  double diameter(std::int32_t cell) const { return 2.0 * balls_[cell].radius; }
  /// From a point on its sphere to its centre, of length 1.
  Vec3 way(std::int32_t point, std::int32_t cell) const
  {
    const Ball& ball = balls_[cell];
    return ball.radius > 0.0 ? Vec3((ball.center - tetrahedra_.points()[point]) / ball.radius)
                             : ball.center;
  }

private:
  struct Ball
  {
    Vec3 center;   // of half-spaces the way out
    double radius; // of half-spaces 0
  };

  // A ball of this many times the extent is a half-space: points of a plane face, as far as double
  // can tell. Its centre is rounding, but the side is known: within the hull it would not be empty.
  static constexpr double kHuge = 1e3;
  static constexpr double kFlat = 1e-13;

  Ball ballOf(std::int32_t cell, double huge) const
  {
    if (!tetrahedra_.finite(cell))
    {
      return { hullNormal(tetrahedra_, cell), 0.0 };
    }
    const auto& v = tetrahedra_.cell(cell);
    const auto& p = tetrahedra_.points();
    const Vec3 a = p[v[1]] - p[v[0]];
    const Vec3 b = p[v[2]] - p[v[0]];
    const Vec3 c = p[v[3]] - p[v[0]];
    const Vec3 bc = b.cross(c);
    const Vec3 center =
      (a.squaredNorm() * bc + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
      (2.0 * a.dot(bc));
    const double longest =
      std::sqrt(std::max({ a.squaredNorm(), b.squaredNorm(), c.squaredNorm() }));
    const bool flat = !(std::abs(a.dot(bc)) > kFlat * longest * longest * longest);
    const double radius = center.norm();
    return flat || !(radius < huge) ? this->halfSpace(cell) : Ball{ p[v[0]] + center, radius };
  }

  Ball halfSpace(std::int32_t cell) const
  {
    const auto& p = tetrahedra_.points();
    Vec3 normal = Vec3::Zero();
    for (int facet = 0; facet < 4; ++facet)
    {
      const auto v = tetrahedra_.facet(cell, facet);
      const Vec3 other = (p[v[1]] - p[v[0]]).cross(p[v[2]] - p[v[0]]);
      normal = other.squaredNorm() > normal.squaredNorm() ? other : normal;
    }
    normal = normal.stableNormalized();
    const bool out = normal.dot(p[tetrahedra_.cell(cell)[0]] - middle_) >= 0.0;
    return { out ? normal : Vec3(-normal), 0.0 };
  }

  const Tetrahedralization& tetrahedra_;
  Vec3 middle_; // within the hull
  std::vector<Ball> balls_;
};

class LinksOfBalls
{
public:
  LinksOfBalls(const Tetrahedralization& tetrahedra, const FacetSize& sizes, const Balls& balls)
    : tetrahedra_(tetrahedra), sizes_(sizes), balls_(balls)
  {
  }

  /// Of cells with a common facet.
  std::vector<SignedLink> alike(const Progress& progress) const
  {
    return joined(this->collect(tetrahedra_.finiteCellCount(), progress,
      [this](std::int32_t cell, std::vector<SignedLink>& links)
      {
        for (int facet = 0; facet < 4; ++facet)
        {
          const std::int32_t other = tetrahedra_.neighbor(cell, facet);
          if (other > cell)
          {
            const std::int32_t corner = tetrahedra_.facet(cell, facet)[0];
            const double cosine = balls_.way(corner, cell).dot(balls_.way(corner, other));
            links.push_back({ cell, other, weight(cosine) });
          }
        }
      }));
  }

  /// Of the poles of a point.
  std::vector<SignedLink> opposite(const Progress& progress) const
  {
    return joined(this->collect(static_cast<std::int32_t>(tetrahedra_.points().size()), progress,
      [this](std::int32_t point, std::vector<SignedLink>& links)
      { this->addPoles(point, links); }));
  }

private:
  static float weight(double cosine)
  {
    return static_cast<float>(std::exp(kSharpness * (cosine - 1.0)));
  }

  template <typename Add>
  std::vector<std::vector<SignedLink>> collect(
    std::int32_t count, const Progress& progress, const Add& add) const
  {
    const auto all = static_cast<std::size_t>(count);
    std::vector<std::vector<SignedLink>> parts((all + kGrain - 1) / kGrain);
    parallelFor(all, kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        progress.check();
        for (std::size_t k = begin; k < end; ++k)
        {
          add(static_cast<std::int32_t>(k), parts[begin / kGrain]);
        }
      });
    return parts;
  }

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
      links.push_back({ up, down, -weight(cosine) * static_cast<float>(std::min(1.0, seen)) });
    }
  }

  const Tetrahedralization& tetrahedra_;
  const FacetSize& sizes_;
  const Balls& balls_;
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
    const Balls balls(tetrahedra, progress);
    for (std::int32_t cell = 0; cell < tetrahedra.cellCount(); ++cell)
    {
      held[cell] = balls.isHalfSpace(cell) ? 1.0f : 0.0f;
    }
    const LinksOfBalls all(tetrahedra, sizes, balls);
    links = all.alike(progress);
    opposite = all.opposite(progress);
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
