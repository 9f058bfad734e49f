// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/ProjectPoints.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr std::size_t kPointsPerTask = 64; // that lie together, mostly: one part of the field does
constexpr int kNewtonSteps = 5;
constexpr double kSettled = 2e-4;    // of the reach: a residual step below this is the last
constexpr double kSearchReach = 2.0; // that of Newton steps, for the search along the normal
constexpr int kProbes = 8;           // to each side
constexpr int kBisections = 16;

/// The nearest change of side along the normal, or else along the axes.
class NormalSearch
{
public:
  NormalSearch(const FieldSource& field, double reach, TriangleMesh& mesh)
    : field_(field), reach_(reach), mesh_(mesh)
  {
  }

  /// \return false where there is none; the point stays.
  bool run(std::size_t point)
  {
    const Vec3 start = mesh_.points[point];
    const bool inside = this->isInside(start);
    // The solid lies against the normal: from inside, the surface is ahead.
    const Vec3 ahead = mesh_.normals[point] * (inside ? 1.0 : -1.0);
    std::vector<Vec3> ways{ ahead, -ahead };
    if (this->search(point, start, ways, inside))
    {
      return true;
    }
    ways.clear();
    for (int axis = 0; axis < 3; ++axis)
    {
      ways.push_back(Vec3::Unit(axis));
      ways.push_back(-Vec3::Unit(axis));
    }
    return this->search(point, start, ways, inside);
  }

private:
  bool search(
    std::size_t point, const Vec3& start, const std::vector<Vec3>& ways, bool inside) const
  {
    for (int probe = 1; probe <= kProbes; ++probe)
    {
      const double step = reach_ * probe / kProbes;
      for (const Vec3& way : ways)
      {
        if (this->isInside(start + step * way) != inside)
        {
          mesh_.points[point] = start + this->bisect(start, way, step, inside) * way;
          return true;
        }
      }
    }
    return false;
  }

  bool isInside(const Vec3& p) const
  {
    double value = 0.0;
    field_.field({ &p.x(), &p.y(), &p.z(), 1 }, &value);
    return value >= kThreshold;
  }

  double bisect(const Vec3& start, const Vec3& direction, double beyond, bool inside) const
  {
    double before = 0.0;
    for (int k = 0; k < kBisections; ++k)
    {
      const double middle = 0.5 * (before + beyond);
      (this->isInside(start + middle * direction) == inside ? before : beyond) = middle;
    }
    return 0.5 * (before + beyond);
  }

  const FieldSource& field_;
  const double reach_;
  TriangleMesh& mesh_;
};

/// \return the places in the list of points that did not settle.
std::vector<std::size_t> newton(const FieldSource& field, const std::size_t* begin,
  std::size_t count, double reach, TriangleMesh& mesh)
{
  std::vector<std::size_t> active(count);
  std::iota(active.begin(), active.end(), 0);
  std::vector<Vec3> place;
  for (std::size_t k = 0; k < count; ++k)
  {
    place.push_back(mesh.points[begin[k]]);
  }
  std::vector<std::size_t> failed;
  for (int step = 0; step < kNewtonSteps && !active.empty(); ++step)
  {
    ScratchVectors points(active.size()), gradients(active.size());
    ScratchArray values(active.size());
    for (std::size_t k = 0; k < active.size(); ++k)
    {
      points.batch().set(k, place[k]);
    }
    field.fieldAndGradient(points.points(), values.data(), gradients.batch());
    std::size_t left = 0;
    for (std::size_t k = 0; k < active.size(); ++k)
    {
      const Vec3 gradient = gradients.points()[k];
      const double squared = gradient.squaredNorm();
      const Vec3 move = gradient * ((kThreshold - values[k]) / squared);
      const Vec3 to = place[k] + move;
      if (!(squared * reach * reach > 1e-20) ||
        !((to - mesh.points[begin[active[k]]]).norm() <= reach))
      {
        failed.push_back(active[k]);
      }
      else if (move.norm() <= kSettled * reach)
      {
        mesh.points[begin[active[k]]] = to;
        mesh.normals[begin[active[k]]] = gradient / -std::sqrt(squared);
      }
      else
      {
        active[left] = active[k];
        place[left++] = to;
      }
    }
    active.resize(left);
  }
  failed.insert(failed.end(), active.begin(), active.end());
  return failed;
}

} // namespace

std::vector<char> projectPoints(const FieldSource& field, const std::vector<std::size_t>& points,
  double reach, TriangleMesh& mesh)
{
  std::vector<char> found(points.size(), 0);
  parallelFor(points.size(), kPointsPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      Box3 box;
      for (std::size_t k = begin; k < end; ++k)
      {
        box.extend(mesh.points[points[k]]);
      }
      const Vec3 margin = Vec3::Constant(1.01 * kSearchReach * reach);
      const FieldSourcePtr near =
        field.restrictedTo(Box3(Vec3(box.min() - margin), Vec3(box.max() + margin)));
      if (!near)
      {
        return;
      }
      NormalSearch search(*near, kSearchReach * reach, mesh);
      std::fill(found.begin() + std::ptrdiff_t(begin), found.begin() + std::ptrdiff_t(end), 1);
      for (const std::size_t k : newton(*near, &points[begin], end - begin, reach, mesh))
      {
        found[begin + k] = search.run(points[begin + k]) ? 1 : 0;
      }
    });
  return found;
}

} // namespace hybridtree
