// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/PeerReconstructions.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Scale_space_surface_reconstruction_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/jet_estimate_normals.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/poisson_surface_reconstruction.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace hybridtree::benchmark
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::vector<Kernel::Point_3> forCgal(const std::vector<Vec3>& points)
{
  std::vector<Kernel::Point_3> copies(points.size());
  std::transform(points.begin(), points.end(), copies.begin(),
    [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); });
  return copies;
}

TriangleMesh meshOf(
  const std::vector<Vec3>& points, const std::vector<std::array<std::size_t, 3>>& triangles)
{
  TriangleMesh mesh;
  mesh.points = points;
  for (const auto& t : triangles)
  {
    mesh.triangles.push_back({ static_cast<std::int32_t>(t[0]), static_cast<std::int32_t>(t[1]),
      static_cast<std::int32_t>(t[2]) });
  }
  return mesh;
}

} // namespace

TriangleMesh advancingFront(const std::vector<Vec3>& points)
{
  const auto sites = forCgal(points);
  std::vector<std::array<std::size_t, 3>> triangles;
  CGAL::advancing_front_surface_reconstruction(
    sites.begin(), sites.end(), std::back_inserter(triangles));
  return meshOf(points, triangles);
}

TriangleMesh scaleSpace(const std::vector<Vec3>& points)
{
  const auto sites = forCgal(points);
  CGAL::Scale_space_surface_reconstruction_3<Kernel> reconstruction(sites.begin(), sites.end());
  reconstruction.increase_scale(4);
  reconstruction.reconstruct_surface();
  const std::vector<std::array<std::size_t, 3>> triangles(
    reconstruction.facets_begin(), reconstruction.facets_end());
  return meshOf(points, triangles);
}

TriangleMesh poisson(const std::vector<Vec3>& points)
{
  using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;
  std::vector<Oriented> sites;
  for (const Kernel::Point_3& p : forCgal(points))
  {
    sites.emplace_back(p, CGAL::NULL_VECTOR);
  }
  const auto maps = CGAL::parameters::point_map(CGAL::First_of_pair_property_map<Oriented>())
                      .normal_map(CGAL::Second_of_pair_property_map<Oriented>());
  CGAL::jet_estimate_normals<CGAL::Sequential_tag>(sites, 18, maps);
  sites.erase(CGAL::mst_orient_normals(sites, 18, maps), sites.end());
  const double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(sites, 6, maps);
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  CGAL::poisson_surface_reconstruction_delaunay(sites.begin(), sites.end(),
    CGAL::First_of_pair_property_map<Oriented>(), CGAL::Second_of_pair_property_map<Oriented>(),
    surface, spacing);
  TriangleMesh mesh;
  for (const auto v : surface.vertices())
  {
    const auto& p = surface.point(v);
    mesh.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : surface.faces())
  {
    Triangle triangle{};
    std::size_t corner = 0;
    for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface))
    {
      triangle.at(corner++) = static_cast<std::int32_t>(v.idx());
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

} // namespace hybridtree::benchmark
