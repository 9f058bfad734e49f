// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SlideAxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kBatch = 64;
constexpr int kMaxSteps = 60;
constexpr double kTolerance = 1e-7 * kThreshold;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Batch
{
  double x[kBatch], y[kBatch], z[kBatch], value[kBatch], gx[kBatch], gy[kBatch], gz[kBatch];

  PointBatch points(std::size_t size) const { return { x, y, z, size }; }
  VectorBatch gradient() { return { gx, gy, gz }; }
  void set(std::size_t k, const Vec3& p)
  {
    x[k] = p.x();
    y[k] = p.y();
    z[k] = p.z();
  }
};

struct Search
{
  double t;
  double inner = kUnknown;
  double outer = kUnknown;
};

/// The next t to ask; not-a-number when the search has left its axis.
double next(const SkeletonAxis& axis, Search& search, double f, double slope)
{
  const bool inside = f >= kThreshold;
  (inside ? search.inner : search.outer) = search.t;
  const double newton = slope < 0.0 ? search.t - (f - kThreshold) / slope : kUnknown;
  if (!std::isnan(search.inner) && !std::isnan(search.outer))
  {
    const double low = std::min(search.inner, search.outer);
    const double high = std::max(search.inner, search.outer);
    return newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  const double end = inside ? axis.most : axis.least;
  if (search.t == end)
  {
    return kUnknown;
  }
  const double move =
    std::isnan(newton) ? axis.step : std::min(std::abs(newton - search.t), axis.step);
  return inside ? std::min(search.t + move, end) : std::max(search.t - move, end);
}

void slideBatch(const FieldSource& field, const SkeletonAxis* axes, std::size_t count,
  double* result, Vec3* gradient)
{
  Search searches[kBatch];
  std::size_t active[kBatch];
  std::size_t activeCount = count;
  for (std::size_t k = 0; k < count; ++k)
  {
    active[k] = k;
    searches[k].t = std::clamp(axes[k].start, axes[k].least, axes[k].most);
    result[k] = kUnknown;
  }
  Batch batch;
  for (int step = 0; step < kMaxSteps && activeCount > 0; ++step)
  {
    for (std::size_t n = 0; n < activeCount; ++n)
    {
      const SkeletonAxis& axis = axes[active[n]];
      batch.set(n, axis.base + searches[active[n]].t * axis.direction);
    }
    field.fieldAndGradient(batch.points(activeCount), batch.value, batch.gradient());
    std::size_t left = 0;
    for (std::size_t n = 0; n < activeCount; ++n)
    {
      const std::size_t k = active[n];
      if (std::abs(batch.value[n] - kThreshold) <= kTolerance)
      {
        result[k] = searches[k].t;
        if (gradient)
        {
          gradient[k] = batch.gradient()[n];
        }
        continue;
      }
      const double slope = batch.gradient()[n].dot(axes[k].direction);
      const double t = next(axes[k], searches[k], batch.value[n], slope);
      if (!std::isnan(t))
      {
        searches[k].t = t;
        active[left++] = k;
      }
    }
    activeCount = left;
  }
  // A jump of the field is as good as a root.
  for (std::size_t n = 0; n < activeCount; ++n)
  {
    const Search& search = searches[active[n]];
    result[active[n]] =
      std::isnan(search.inner) || std::isnan(search.outer) ? kUnknown : search.inner;
  }
}

} // namespace

std::vector<double> slideAxes(
  const FieldSource& field, const std::vector<SkeletonAxis>& axes, std::vector<Vec3>* gradient)
{
  std::vector<double> result(axes.size());
  if (gradient)
  {
    gradient->assign(axes.size(), Vec3::Zero());
  }
  for (std::size_t begin = 0; begin < axes.size(); begin += kBatch)
  {
    const std::size_t count = std::min(kBatch, axes.size() - begin);
    slideBatch(field, axes.data() + begin, count, result.data() + begin,
      gradient ? gradient->data() + begin : nullptr);
  }
  return result;
}

std::vector<double> fieldAt(const FieldSource& field, const std::vector<Vec3>& points)
{
  std::vector<double> result(points.size());
  Batch batch;
  for (std::size_t begin = 0; begin < points.size(); begin += kBatch)
  {
    const std::size_t count = std::min(kBatch, points.size() - begin);
    for (std::size_t k = 0; k < count; ++k)
    {
      batch.set(k, points[begin + k]);
    }
    field.field(batch.points(count), result.data() + begin);
  }
  return result;
}

void fieldAndGradientAt(const FieldSource& field, const std::vector<Vec3>& points,
  std::vector<double>& value, std::vector<Vec3>& gradient)
{
  value.resize(points.size());
  gradient.resize(points.size());
  Batch batch;
  for (std::size_t begin = 0; begin < points.size(); begin += kBatch)
  {
    const std::size_t count = std::min(kBatch, points.size() - begin);
    for (std::size_t k = 0; k < count; ++k)
    {
      batch.set(k, points[begin + k]);
    }
    field.fieldAndGradient(batch.points(count), value.data() + begin, batch.gradient());
    for (std::size_t k = 0; k < count; ++k)
    {
      gradient[begin + k] = batch.gradient()[k];
    }
  }
}

} // namespace hybridtree
