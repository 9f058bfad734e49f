// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/TrianglePoints.h"

#include "core/base/Parallel.h"
#include "core/geometry/PointTriangle.h"
#include "core/mesh/MeshBvh.h"
#include "core/mesh/NearestKernels.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 4096;

} // namespace

void TrianglePoints::measure(
  const std::vector<std::int32_t>& points, const DynamicSurface& surface, const Progress& progress)
{
  states_.resize(points_->size());
  const std::vector<std::int32_t> triangles = surface.surface();
  if (points.empty() || triangles.empty())
  {
    return;
  }
  TriangleMesh mesh;
  mesh.points = surface.sites();
  mesh.triangles.reserve(triangles.size());
  for (const std::int32_t triangle : triangles)
  {
    mesh.triangles.push_back(surface.triangle(triangle));
  }
  const MeshBvh bvh(mesh);
  const std::size_t count = points.size();
  std::vector<double> coordinates(3 * count);
  std::vector<double> squared(count);
  std::vector<std::int32_t> nearest(count);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          coordinates[axis * count + k] = (*points_)[points[k]][static_cast<Eigen::Index>(axis)];
        }
      }
      const double* at = coordinates.data() + begin;
      const std::size_t size = end - begin;
      findNearest({ &mesh, &bvh, nullptr, { at, at + count, at + 2 * count, size }, nullptr, size,
                    std::numeric_limits<double>::infinity() },
        squared.data() + begin, nearest.data() + begin);
    });
  for (std::size_t k = 0; k < count; ++k)
  {
    this->move(points[k], triangles[nearest[k]], std::sqrt(squared[k]));
  }
}

void TrianglePoints::clear()
{
  first_.clear();
  states_.assign(points_->size(), State());
  refused_.clear();
}

void TrianglePoints::refuse(std::int32_t point, Scratch& scratch)
{
  states_[point].refused = true;
  scratch.refused.push_back(point);
}

void TrianglePoints::gather(Scratch& scratch)
{
  refused_.insert(refused_.end(), scratch.refused.begin(), scratch.refused.end());
  scratch.refused.clear();
}

std::vector<std::int32_t> TrianglePoints::forgive()
{
  for (const std::int32_t point : refused_)
  {
    states_[point].refused = false;
  }
  return std::exchange(refused_, {});
}

void TrianglePoints::put(std::int32_t point, std::int32_t triangle, double distance)
{
  if (first_.size() <= static_cast<std::size_t>(triangle))
  {
    first_.resize(static_cast<std::size_t>(triangle) + 1 + first_.size() / 2, -1);
  }
  states_[point] = { distance, triangle, first_[triangle], false };
  first_[triangle] = point;
}

void TrianglePoints::remove(std::int32_t point)
{
  State& state = states_[point];
  if (state.triangle < 0)
  {
    return;
  }
  std::int32_t* link = &first_[state.triangle];
  while (*link != point)
  {
    link = &states_[*link].next;
  }
  *link = state.next;
  state = State();
}

void TrianglePoints::move(std::int32_t point, std::int32_t triangle, double distance)
{
  this->remove(point);
  this->put(point, triangle, distance);
}

std::int32_t TrianglePoints::neighbor(std::int32_t point) const
{
  const State& state = states_[point];
  const std::int32_t first = first_[state.triangle];
  return first != point ? first : state.next;
}

std::int32_t TrianglePoints::takeList(std::int32_t triangle)
{
  return static_cast<std::size_t>(triangle) < first_.size() ? std::exchange(first_[triangle], -1)
                                                            : -1;
}

void TrianglePoints::reserve(const DynamicSurface& surface)
{
  if (const auto end = static_cast<std::size_t>(surface.endOfNumbers()); first_.size() < end)
  {
    first_.resize(end, -1);
  }
}

void TrianglePoints::follow(
  const DynamicSurface& surface, const DynamicSurface::Change& change, Scratch& scratch)
{
  scratch.points.clear();
  for (const std::int32_t triangle : change.removed)
  {
    for (std::int32_t at = this->takeList(triangle); at >= 0; at = states_[at].next)
    {
      scratch.points.push_back(at);
    }
  }
  // New numbers may be old ones of others: all lists are taken before any is put.
  scratch.lists.clear();
  for (const auto& [from, to] : change.renamed)
  {
    if (const std::int32_t list = this->takeList(from); list >= 0)
    {
      scratch.lists.emplace_back(list, to);
    }
  }
  for (const auto& [list, triangle] : scratch.lists)
  {
    for (std::int32_t at = list; at >= 0;)
    {
      const State state = states_[at];
      this->put(at, triangle, state.distance);
      states_[at].refused = state.refused;
      at = state.next;
    }
  }
  const std::vector<Vec3>& sites = surface.sites();
  scratch.news.clear();
  for (const std::int32_t triangle : change.added)
  {
    const Triangle t = surface.triangle(triangle);
    Box3 box(sites[t[0]]);
    box.extend(sites[t[1]]).extend(sites[t[2]]);
    scratch.news.push_back({ sites[t[0]], sites[t[1]], sites[t[2]], box, triangle });
  }
  for (const std::int32_t point : scratch.points)
  {
    const Vec3& p = (*points_)[point];
    double least = std::numeric_limits<double>::infinity();
    std::int32_t nearest = scratch.news.front().number;
    for (const Scratch::New& triangle : scratch.news)
    {
      if (triangle.box.squaredExteriorDistance(p) > least) // most are farther
      {
        continue;
      }
      const double squared =
        nearestOnTriangle(p, triangle.a, triangle.b, triangle.c).squaredDistance;
      if (squared < least)
      {
        least = squared;
        nearest = triangle.number;
      }
    }
    this->put(point, nearest, std::sqrt(least));
  }
}

} // namespace hybridtree
