// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/DynamicSurface.h"

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace hybridtree
{

/// Which points of a set each triangle of a changing surface stands for, and how far they are.
///
/// Each point is with one triangle, at first the nearest. Where triangles give way to others, their
/// points go to the nearest of those (Garland, Heckbert 1995 do the same on height fields). So a
/// step costs what it changes, and the distance is an upper bound of that to the surface. May be
/// copied. Not for several threads at once.
class TrianglePoints
{
public:
  /// What it takes to follow(), for whom does it often.
  class Scratch
  {
    friend class TrianglePoints;
    struct New
    {
      Vec3 a, b, c;
      Box3 box;
      std::int32_t number;
    };
    std::vector<std::int32_t> points;
    std::vector<std::pair<std::int32_t, std::int32_t>> lists; // first point, triangle
    std::vector<New> news;
    std::vector<std::int32_t> refused;
  };

  /// \param points must stay alive; may be appended to.
  explicit TrianglePoints(const std::vector<Vec3>& points) : points_(&points) {}

  double distance(std::int32_t point) const { return states_[point].distance; }
  /// -1: none.
  std::int32_t triangle(std::int32_t point) const { return states_[point].triangle; }
  /// Whether the surface would not take the point up, until its triangle changes.
  bool refused(std::int32_t point) const { return states_[point].refused; }
  void refuse(std::int32_t point, Scratch& scratch);
  /// Notes what was refused with this scratch.
  void gather(Scratch& scratch);
  /// \returns all that were refused since, some of them no longer.
  std::vector<std::int32_t> forgive();

  /// Puts points with the triangles that are nearest of all the surface's. In parallel; fastest
  /// where neighbours follow each other.
  /// \throws Cancelled.
  void measure(const std::vector<std::int32_t>& points, const DynamicSurface& surface,
    const Progress& progress);
  /// Parts all points from their triangles, which are no more.
  void clear();

  /// After a step of the surface. Where several hands place points at a time, each may call it, and
  /// move(), for the triangles that it may replace. \pre reserve().
  void follow(
    const DynamicSurface& surface, const DynamicSurface::Change& change, Scratch& scratch);
  /// Makes room for all triangles that there may be.
  void reserve(const DynamicSurface& surface);
  void move(std::int32_t point, std::int32_t triangle, double distance);
  void remove(std::int32_t point);

  /// Another point of the same triangle; -1: none.
  std::int32_t neighbor(std::int32_t point) const;
  template <typename Visit>
  void forEach(std::int32_t triangle, const Visit& visit) const
  {
    const bool known = static_cast<std::size_t>(triangle) < first_.size();
    for (std::int32_t at = known ? first_[triangle] : -1; at >= 0; at = states_[at].next)
    {
      visit(at);
    }
  }

private:
  struct State
  {
    double distance = std::numeric_limits<double>::infinity();
    std::int32_t triangle = -1;
    std::int32_t next = -1; // of the points of its triangle
    bool refused = false;
  };
  void put(std::int32_t point, std::int32_t triangle, double distance);
  std::int32_t takeList(std::int32_t triangle);

  const std::vector<Vec3>* points_;
  std::vector<State> states_;       // per point
  std::vector<std::int32_t> first_; // per number of a triangle
  std::vector<std::int32_t> refused_;
};

} // namespace hybridtree
