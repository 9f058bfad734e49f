// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Tetrahedralization.h"

#include "reconstruction/DelaunayTypes.h"

#include "core/base/Error.h"

#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <cmath>
#include <numeric>
#include <string>

namespace hybridtree
{
namespace
{

void triangulate(
  const std::vector<Vec3>& points, DelaunayTriangulation& delaunay, const Progress& progress)
{
  Delaunay::Cell_handle near;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const std::size_t known = delaunay.number_of_vertices();
    const Delaunay::Vertex_handle vertex = delaunay.insert(toCgal(points[k]), near);
    if (delaunay.number_of_vertices() > known)
    {
      vertex->info() = static_cast<std::int32_t>(k);
    }
    near = vertex->cell();
    if (k % 256 == 0)
    {
      progress.check();
      progress.report(double(k) / double(points.size()));
    }
  }
}

// Looks now and then whether to go on.
class Breath
{
public:
  explicit Breath(const Progress& progress) : progress_(progress) {}
  void operator()()
  {
    if (++steps_ % 65536 == 0)
    {
      progress_.check();
    }
  }

private:
  const Progress& progress_;
  std::size_t steps_ = 0;
};

void checkSolid(const Delaunay& delaunay)
{
  if (delaunay.number_of_vertices() < 4)
  {
    throw InvalidGeometry("The point set has " + std::to_string(delaunay.number_of_vertices()) +
      " different points: a closed surface needs at least 4.");
  }
  if (delaunay.dimension() < 3)
  {
    throw InvalidGeometry(std::string("All points lie on one ") +
      (delaunay.dimension() < 2 ? "line" : "plane") +
      ": a closed surface needs points that span a volume.");
  }
}

} // namespace

void checkFinite(const std::vector<Vec3>& points)
{
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (!points[k].allFinite())
    {
      throw InvalidGeometry("Point " + std::to_string(k) +
        " has a coordinate that is not a finite number: remove it, or mend it where it was made.");
    }
  }
}

std::vector<std::int32_t> spatialOrder(const std::vector<Vec3>& points)
{
  checkFinite(points);
  std::vector<Kernel::Point_3> sites(points.size());
  std::transform(points.begin(), points.end(), sites.begin(), toCgal);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto siteMap = CGAL::make_property_map(sites);
  using SortTraits = CGAL::Spatial_sort_traits_adapter_3<Kernel, decltype(siteMap)>;
  CGAL::spatial_sort(order.begin(), order.end(), SortTraits(siteMap));
  return { order.begin(), order.end() };
}

Tetrahedralization::Tetrahedralization(const std::vector<Vec3>& points, const Progress& progress)
  : points_(&points)
{
  checkFinite(points);
  DelaunayTriangulation delaunay;
  triangulate(points, delaunay, progress);
  this->copy(delaunay, progress);
}

Tetrahedralization::Tetrahedralization(
  const std::vector<Vec3>& points, const DelaunayTriangulation& delaunay, const Progress& progress)
  : points_(&points)
{
  this->copy(delaunay, progress);
}

void Tetrahedralization::copy(const DelaunayTriangulation& delaunay, const Progress& progress)
{
  checkSolid(delaunay);
  Breath breath(progress);

  std::int32_t next = 0;
  for (const auto cell : delaunay.finite_cell_handles())
  {
    breath();
    cell->info().number = next++;
  }
  finiteCells_ = next;
  for (const auto cell : delaunay.all_cell_handles())
  {
    breath();
    if (delaunay.is_infinite(cell))
    {
      cell->info().number = next++;
    }
  }
  cells_.resize(next);
  neighbors_.resize(next);
  for (const auto cell : delaunay.all_cell_handles())
  {
    breath();
    for (int i = 0; i < 4; ++i)
    {
      const auto vertex = cell->vertex(i);
      cells_[cell->info().number][i] = delaunay.is_infinite(vertex) ? kInfinite : vertex->info();
      neighbors_[cell->info().number][i] = cell->neighbor(i)->info().number;
    }
  }
  this->collectStars(progress);
}

void Tetrahedralization::collectStars(const Progress& progress)
{
  Breath breath(progress);
  starOffset_.assign(points_->size() + 1, 0);
  for (const Cell& cell : cells_)
  {
    breath();
    for (const std::int32_t vertex : cell)
    {
      if (vertex != kInfinite)
      {
        ++starOffset_[vertex + 1];
      }
    }
  }
  std::partial_sum(starOffset_.begin(), starOffset_.end(), starOffset_.begin());
  starCells_.resize(starOffset_.back());
  std::vector<std::int32_t> next(starOffset_.begin(), starOffset_.end() - 1);
  for (std::int32_t c = 0; c < this->cellCount(); ++c)
  {
    breath();
    for (const std::int32_t vertex : cells_[c])
    {
      if (vertex != kInfinite)
      {
        starCells_[next[vertex]++] = c;
      }
    }
  }
}

Tetrahedralization::Star Tetrahedralization::star(std::int32_t vertex) const
{
  return { starCells_.data() + starOffset_[vertex], starCells_.data() + starOffset_[vertex + 1] };
}

int Tetrahedralization::mirror(std::int32_t cell, int facet) const
{
  const Cell& back = neighbors_[neighbors_[cell][facet]];
  int i = 0;
  while (back[i] != cell)
  {
    ++i;
  }
  return i;
}

int Tetrahedralization::indexOf(std::int32_t cell, std::int32_t vertex) const
{
  for (int i = 0; i < 4; ++i)
  {
    if (cells_[cell][i] == vertex)
    {
      return i;
    }
  }
  return -1;
}

std::array<std::int32_t, 3> Tetrahedralization::facet(std::int32_t cell, int facet) const
{
  const Cell& v = cells_[cell];
  const int* corner = kFacetCorners[facet];
  return { v[corner[0]], v[corner[1]], v[corner[2]] };
}

bool Tetrahedralization::isOrientedGabriel(std::int32_t cell, int facet) const
{
  const auto corner = this->facet(cell, facet);
  const auto point = [&](std::int32_t vertex) { return toCgal((*points_)[vertex]); };
  return Kernel().side_of_bounded_sphere_3_object()(point(corner[0]), point(corner[1]),
           point(corner[2]), point(cells_[cell][facet])) != CGAL::ON_BOUNDED_SIDE;
}

} // namespace hybridtree
