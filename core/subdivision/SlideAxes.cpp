// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SlideAxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

/// The field and its slope at a place on an axis.
struct Place
{
  double t = 0.0;
  double value = kUnknown;
  double slope = 0.0;
};

struct Search
{
  double t;
  double inner = kUnknown;
  double outer = kUnknown;
  Place before; ///< the one asked last
};

/// Where t, as the cubic in f through two places, has f = T: of an error in the product of the
/// squares of both, where Newton's has that of one. Newton's, where these differ much.
double rootFrom(const Place& before, const Place& here)
{
  constexpr double kAgree = 0.5; // of Newton's step
  if (!(here.slope < 0.0))
  {
    return kUnknown;
  }
  const double newton = here.t - (here.value - kThreshold) / here.slope;
  const double across = here.value - before.value;
  if (!(before.slope < 0.0) || std::isnan(across) || across == 0.0)
  {
    return newton;
  }
  const double s = (kThreshold - before.value) / across;
  const double rest = 1.0 - s;
  const double cubic = rest * rest * ((1.0 + 2.0 * s) * before.t + s * across / before.slope) +
    s * s * ((1.0 + 2.0 * rest) * here.t - rest * across / here.slope);
  return std::abs(cubic - newton) <= kAgree * std::abs(newton - here.t) ? cubic : newton;
}

/// The next t to ask; not-a-number when the search has left its axis.
double next(const SkeletonAxis& axis, Search& search, double f, double slope)
{
  const bool inside = f >= kThreshold;
  (inside ? search.inner : search.outer) = search.t;
  const Place here{ search.t, f, slope };
  const double newton = rootFrom(search.before, here);
  search.before = here;
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

// The axes order[0] to order[count - 1], of one element.
void slideBatch(const PlacedField& field, const std::vector<SkeletonAxis>& all,
  const std::size_t* order, std::size_t count, double* result, Vec3* gradient)
{
  const auto axes = [&](std::size_t k) -> const SkeletonAxis& { return all[order[k]]; };
  Search searches[kBatch];
  std::size_t active[kBatch];
  std::size_t activeCount = count;
  for (std::size_t k = 0; k < count; ++k)
  {
    active[k] = k;
    searches[k].t = std::clamp(axes(k).start, axes(k).least, axes(k).most);
    searches[k].before = { 0.0, axes(k).value, axes(k).slope };
    result[order[k]] = kUnknown;
  }
  Batch batch;
  for (int step = 0; step < kMaxSteps && activeCount > 0; ++step)
  {
    for (std::size_t n = 0; n < activeCount; ++n)
    {
      const SkeletonAxis& axis = axes(active[n]);
      batch.set(n, axis.base + searches[active[n]].t * axis.direction);
    }
    const VectorBatch slopes = batch.gradient();
    field.evaluate(axes(0).element, batch.points(activeCount), batch.value, &slopes);
    std::size_t left = 0;
    for (std::size_t n = 0; n < activeCount; ++n)
    {
      const std::size_t k = active[n];
      if (std::abs(batch.value[n] - kThreshold) <= kTolerance)
      {
        result[order[k]] = searches[k].t;
        if (gradient)
        {
          gradient[order[k]] = batch.gradient()[n];
        }
        continue;
      }
      const double slope = batch.gradient()[n].dot(axes(k).direction);
      const double t = next(axes(k), searches[k], batch.value[n], slope);
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
    result[order[active[n]]] =
      std::isnan(search.inner) || std::isnan(search.outer) ? kUnknown : search.inner;
  }
}

/// Numbers of things, by their elements, otherwise as they were. Elements of one piece are few.
template <class Thing>
std::vector<std::size_t> orderByElements(const std::vector<Thing>& things)
{
  std::vector<std::size_t> order(things.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto isBefore = [](const Thing& a, const Thing& b) { return a.element < b.element; };
  if (std::is_sorted(things.begin(), things.end(), isBefore))
  {
    return order;
  }
  const auto [least, most] = std::minmax_element(things.begin(), things.end(), isBefore);
  const std::int32_t first = least->element;
  const auto range = std::size_t(most->element - first) + 1;
  if (range > 2 * things.size())
  {
    std::stable_sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return isBefore(things[a], things[b]); });
    return order;
  }
  std::vector<std::size_t> next(range + 1, 0);
  for (const Thing& thing : things)
  {
    ++next[std::size_t(thing.element - first) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::size_t k = 0; k < things.size(); ++k)
  {
    order[next[std::size_t(things[k].element - first)]++] = k;
  }
  return order;
}

/// body(order, count) for at most kBatch numbers of things at a time, of one element each if these
/// have fields of their own.
template <class Thing, typename Body>
void forBatches(const PlacedField& field, const std::vector<Thing>& things, const Body& body)
{
  std::vector<std::size_t> order;
  if (field.elements)
  {
    order = orderByElements(things);
  }
  else
  {
    order.resize(things.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
  }
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < order.size(); begin = end)
  {
    end = std::min(begin + kBatch, order.size());
    if (field.elements)
    {
      const std::int32_t element = things[order[begin]].element;
      end = std::size_t(std::find_if(order.begin() + begin, order.begin() + end,
                          [&](std::size_t k) { return things[k].element != element; }) -
        order.begin());
    }
    field.progress.check();
    body(order.data() + begin, end - begin);
  }
}

} // namespace

std::vector<double> slideAxes(
  const PlacedField& field, const std::vector<SkeletonAxis>& axes, std::vector<Vec3>* gradient)
{
  std::vector<double> result(axes.size());
  if (gradient)
  {
    gradient->assign(axes.size(), Vec3::Zero());
  }
  forBatches(field, axes,
    [&](const std::size_t* order, std::size_t count) {
      slideBatch(field, axes, order, count, result.data(), gradient ? gradient->data() : nullptr);
    });
  return result;
}

std::vector<double> fieldAt(
  const PlacedField& field, const std::vector<PlacedPoint>& points, std::vector<Vec3>* gradient)
{
  std::vector<double> result(points.size());
  if (gradient)
  {
    gradient->resize(points.size());
  }
  Batch batch;
  const VectorBatch slopes = batch.gradient();
  forBatches(field, points,
    [&](const std::size_t* order, std::size_t count)
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        batch.set(k, points[order[k]].at);
      }
      field.evaluate(
        points[order[0]].element, batch.points(count), batch.value, gradient ? &slopes : nullptr);
      for (std::size_t k = 0; k < count; ++k)
      {
        result[order[k]] = batch.value[k];
        if (gradient)
        {
          (*gradient)[order[k]] = slopes[k];
        }
      }
    });
  return result;
}

std::vector<double> fieldAt(
  const FieldSource& field, const std::vector<Vec3>& points, std::vector<Vec3>* gradient)
{
  std::vector<PlacedPoint> placed;
  placed.reserve(points.size());
  for (const Vec3& point : points)
  {
    placed.push_back({ point, 0 });
  }
  return fieldAt(PlacedField(field), placed, gradient);
}

} // namespace hybridtree
