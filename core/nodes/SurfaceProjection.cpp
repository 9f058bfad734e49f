// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SurfaceProjection.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 512;
constexpr int kNewtonSteps = 8;
constexpr int kSamples = 8; // on each side of a point, when the normal is searched
constexpr int kBisections = 30;

class Projection
{
public:
  Projection(const FieldSource& field, double reach) : field_(field), reach_(reach) {}

  void project(Vec3* points, Vec3* normals, std::size_t count) const
  {
    ScratchVectors place(count);
    ScratchVectors gradient(count);
    ScratchArray value(count);
    for (std::size_t k = 0; k < count; ++k)
    {
      place.batch().set(k, points[k]);
    }
    field_.fieldAndGradient(place.points(), value.data(), gradient.batch());
    for (int step = 0; step < kNewtonSteps; ++step)
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        place.batch().set(k, place.batch()[k] + newtonStep(value[k], gradient.batch()[k]));
      }
      field_.fieldAndGradient(place.points(), value.data(), gradient.batch());
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      Vec3 moved = place.batch()[k];
      Vec3 slope = gradient.batch()[k];
      const bool there = (moved - points[k]).norm() <= reach_ && this->isOnSurface(value[k], slope);
      if (there || (normals && this->search(points[k], normals[k], moved, slope)))
      {
        points[k] = moved;
        if (normals && slope.norm() > 0.0)
        {
          normals[k] = -slope.stableNormalized();
        }
      }
    }
  }

private:
  static Vec3 newtonStep(double value, const Vec3& gradient)
  {
    const double squared = gradient.squaredNorm();
    const Vec3 step = gradient * ((kThreshold - value) / squared);
    return squared > 0.0 && step.allFinite() ? step : Vec3::Zero();
  }

  // Not-a-number is not.
  bool isOnSurface(double value, const Vec3& gradient) const
  {
    return std::abs(value - kThreshold) <= 1e-6 + 1e-3 * reach_ * gradient.norm();
  }

  double excessAt(const Vec3& p, Vec3& gradient) const
  {
    double value = 0.0;
    field_.fieldAndGradient({ p.data(), p.data() + 1, p.data() + 2, 1 }, &value,
      { &gradient.x(), &gradient.y(), &gradient.z() });
    return value - kThreshold;
  }

  // The crossing of the surface along the normal that is nearest to the point.
  bool search(const Vec3& point, const Vec3& normal, Vec3& moved, Vec3& gradient) const
  {
    const double step = reach_ / kSamples;
    Vec3 slope;
    const double here = this->excessAt(point, slope);
    double last[2] = { here, here };
    for (int sample = 1; sample <= kSamples; ++sample)
    {
      for (const int side : { 0, 1 })
      {
        const Vec3 direction = side == 0 ? normal : Vec3(-normal);
        const double next = this->excessAt(point + sample * step * direction, slope);
        if ((next >= 0.0) != (last[side] >= 0.0))
        {
          moved = this->bisect(point + (sample - 1) * step * direction,
            point + sample * step * direction, last[side] >= 0.0);
          return this->isOnSurface(this->excessAt(moved, gradient) + kThreshold, gradient);
        }
        last[side] = next;
      }
    }
    return false;
  }

  Vec3 bisect(Vec3 a, Vec3 b, bool aIsInside) const
  {
    Vec3 slope;
    for (int step = 0; step < kBisections; ++step)
    {
      const Vec3 middle = 0.5 * (a + b);
      ((this->excessAt(middle, slope) >= 0.0) == aIsInside ? a : b) = middle;
    }
    return 0.5 * (a + b);
  }

  const FieldSource& field_;
  const double reach_;
};

} // namespace

void projectOntoSurface(const FieldSource& field, double reach, std::vector<Vec3>& points,
  std::vector<Vec3>& normals, const Progress& progress)
{
  const Projection projection(field, reach);
  parallelFor(points.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      projection.project(&points[begin], normals.empty() ? nullptr : &normals[begin], end - begin);
    });
}

} // namespace hybridtree
