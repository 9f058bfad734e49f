// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/SurfaceParts.h"

#include "reconstruction/SolidBoundary.h"

#include "core/base/DisjointSets.h"
#include "core/mesh/MeshChecks.h"

namespace hybridtree
{
namespace
{

SurfaceParts partsOf(std::size_t points, std::size_t pieces, double eulerCharacteristic)
{
  return { points, double(pieces) + 0.5 * (2.0 * double(pieces) - eulerCharacteristic) };
}

} // namespace

SurfaceParts partsOfBoundary(const Tetrahedralization& tetrahedra,
  const std::vector<std::uint8_t>& inside, const Progress& progress)
{
  const std::vector<std::int32_t> facets = boundaryFacets(tetrahedra, inside, progress);
  const std::size_t count = tetrahedra.points().size();
  DisjointSets pieces(count);
  std::vector<std::uint8_t> used(count, 0);
  for (const std::int32_t facet : facets)
  {
    const Triangle v = tetrahedra.facet(facet >> 2, facet & 3);
    for (int corner = 0; corner < 3; ++corner)
    {
      used[v[corner]] = 1;
      pieces.join(static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[corner]));
    }
  }
  std::size_t points = 0;
  std::size_t roots = 0;
  for (std::uint32_t point = 0; point < count; ++point)
  {
    points += used[point];
    roots += used[point] && pieces.find(point) == point;
  }
  // Each edge has two triangles.
  return partsOf(points, roots, double(points) - 0.5 * double(facets.size()));
}

SurfaceParts partsOfMesh(const TriangleMesh& mesh)
{
  const MeshReport report = checkMesh(mesh);
  return partsOf(report.points, report.components, double(report.eulerCharacteristic));
}

bool isPaidByPoints(const SurfaceParts& now, const SurfaceParts& before, double pointsOfPart)
{
  return now.parts <= before.parts ||
    double(now.points) - double(before.points) >= pointsOfPart * (now.parts - before.parts);
}

} // namespace hybridtree
