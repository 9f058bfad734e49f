// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/boolean/BooleanCases.h"

#include "core/mesh/MeshChecks.h"
#include "tests/support/TestMeshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace hybridtree::test
{
namespace
{

TriangleMesh boxAt(double x, double y, double z, double sizeX, double sizeY, double sizeZ)
{
  return box(Vec3(x, y, z), Vec3(x + sizeX, y + sizeY, z + sizeZ));
}

TriangleMesh shiftedByOneUlp(TriangleMesh mesh)
{
  for (Vec3& p : mesh.points)
  {
    p.x() = std::nextafter(p.x(), 2.0);
  }
  return mesh;
}

TriangleMesh turned90(TriangleMesh mesh)
{
  for (Vec3& p : mesh.points)
  {
    p = Vec3(-p.y(), p.x(), p.z());
  }
  return mesh;
}

TriangleMesh shiftedByEdge(TriangleMesh mesh)
{
  const Triangle& corner = mesh.triangles.front();
  const Vec3 edge = mesh.points[std::size_t(corner[1])] - mesh.points[std::size_t(corner[0])];
  return moved(std::move(mesh), Affine3(Eigen::Translation3d(edge)));
}

// The cap above z = 0.5 pulled out or pressed in: all else coincides.
TriangleMesh edited(TriangleMesh mesh, double factor)
{
  for (Vec3& p : mesh.points)
  {
    p *= p.z() > 0.5 ? factor : 1.0;
  }
  return mesh;
}

// A unit cube and a box of eighths of every size and at every place of a grid: all contacts there
// are.
void addBoxGrid(std::vector<BooleanCase>& cases)
{
  const TriangleMesh cube = boxAt(0, 0, 0, 1, 1, 1);
  const std::array<std::array<double, 2>, 5> spans = { { { -0.5, 0.5 }, { 0.0, 0.5 }, { 0.25, 0.5 },
    { 0.0, 1.0 }, { -0.25, 1.5 } } };
  for (const auto& x : spans)
  {
    for (const auto& y : spans)
    {
      for (const auto& z : spans)
      {
        const auto common = [](const std::array<double, 2>& span)
        { return std::min(1.0, span[0] + span[1]) - std::max(0.0, span[0]); };
        cases.push_back({ "cube and box at " + std::to_string(x[0]) + " " + std::to_string(y[0]) +
            " " + std::to_string(z[0]) + " of size " + std::to_string(x[1]) + " " +
            std::to_string(y[1]) + " " + std::to_string(z[1]),
          cube, boxAt(x[0], y[0], z[0], x[1], y[1], z[1]), common(x) * common(y) * common(z) });
      }
    }
  }
}

} // namespace

std::vector<BooleanCase> hardCases()
{
  const TriangleMesh cube = boxAt(0, 0, 0, 1, 1, 1);
  const TriangleMesh sphere = icosphere(1.0, 3);
  const TriangleMesh ring = torus(1.0, 0.4, 24, 12);
  const double ballVolume = signedVolume(sphere);
  const double ringVolume = signedVolume(ring);
  std::vector<BooleanCase> cases = {
    { "touching in a vertex", cube, boxAt(1, 1, 1, 1, 1, 1), 0.0 },
    { "touching in an edge", cube, boxAt(1, 1, 0, 1, 1, 1), 0.0 },
    { "touching in a part of an edge", cube, boxAt(1, 1, 0.25, 1, 1, 0.5), 0.0 },
    { "sphere with itself", sphere, sphere, ballVolume },
    { "sphere and a copy in other order", sphere, turned90(sphere), -1.0 },
    { "sphere shifted by one ulp", sphere, shiftedByOneUlp(sphere), ballVolume },
    { "sphere shifted by an edge", sphere, shiftedByEdge(sphere), -1.0 },
    { "sphere and a bumped copy", sphere, edited(sphere, 1.1), ballVolume },
    { "sphere and a dented copy", sphere, edited(sphere, 0.9), signedVolume(edited(sphere, 0.9)) },
    { "torus shifted by one ulp", ring, shiftedByOneUlp(ring), ringVolume },
    { "torus shifted by an edge", ring, shiftedByEdge(ring), -1.0 },
    { "torus turned by 90 degrees", ring, turned90(ring), ringVolume },
    { "nested spheres", sphere, icosphere(0.5, 3), signedVolume(icosphere(0.5, 3)) },
    { "spheres that touch in a vertex", sphere, icosphere(0.5, 3, Vec3(1.5, 0, 0)), -1.0 },
    { "hollow sphere and a cube in its cavity", hollowSphere(2.0, 1.5, 2),
      boxAt(-0.5, -0.5, -0.5, 1, 1, 1), 0.0 },
  };
  addBoxGrid(cases);
  return cases;
}

double areaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area += 0.5 * areaNormal(mesh, t).norm();
  }
  return area;
}

double coveredTwice(const BooleanResults& results, const TriangleMesh& a, const TriangleMesh& b)
{
  const double area = areaOf(a) + areaOf(b);
  return (areaOf(results.unite.mesh) + areaOf(results.intersect.mesh) - area) / area;
}

double foldedArea(const MeshBooleanResult& result, const TriangleMesh& a, const TriangleMesh& b)
{
  double area = 0.0;
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
  {
    if (result.sourceTriangle[t] >= 0)
    {
      const Vec3 source =
        areaNormal(result.sourceOperand[t] == 0 ? a : b, std::size_t(result.sourceTriangle[t]));
      const Vec3 made = areaNormal(result.mesh, t);
      area += source.dot(made) < 0.0 ? 0.5 * made.norm() : 0.0;
    }
  }
  return area;
}

TriangleMesh moved(TriangleMesh mesh, const Affine3& map)
{
  for (Vec3& p : mesh.points)
  {
    p = map * p;
  }
  return mesh;
}

Affine3 randomPlacement(Random& random, double reach)
{
  Affine3 map = Affine3::Identity();
  map.translate(Vec3(random.direction() * random.uniform(0.0, reach)));
  map.rotate(random.rotation());
  return map;
}

BooleanResults allOperations(const TriangleMesh& a, const TriangleMesh& b)
{
  const MeshOperand first(std::make_shared<const TriangleMesh>(a));
  const MeshOperand second(std::make_shared<const TriangleMesh>(b));
  return { meshBoolean(MeshOperation::Union, first, second),
    meshBoolean(MeshOperation::Intersection, first, second),
    meshBoolean(MeshOperation::Difference, first, second) };
}

double foldedShare(const BooleanResults& results, const TriangleMesh& a, const TriangleMesh& b)
{
  TriangleMesh around = b; // as a difference has it
  for (Triangle& corner : around.triangles)
  {
    std::swap(corner[1], corner[2]);
  }
  return std::max({ foldedArea(results.unite, a, b), foldedArea(results.intersect, a, b),
           foldedArea(results.subtract, a, around) }) /
    (areaOf(a) + areaOf(b));
}

namespace
{

// Rounding moves all of a surface, which for thin solids is more than a share of their volumes.
double volumeOfRounding(const TriangleMesh& a, const TriangleMesh& b)
{
  const Box3 bounds = a.bounds().merged(b.bounds());
  if (bounds.isEmpty())
  {
    return 0.0;
  }
  const double largest = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).maxCoeff();
  return 0x1p-48 * largest * (areaOf(a) + areaOf(b) + bounds.diagonal().squaredNorm());
}

} // namespace

std::string faultsOf(const BooleanResults& results, const TriangleMesh& a, const TriangleMesh& b,
  double common, double folded)
{
  std::string faults;
  const auto check = [&](const MeshBooleanResult& result, const char* name)
  {
    const MeshReport report = checkMesh(result.mesh);
    if (!result.usable)
    {
      faults += std::string(name) + ": not usable; ";
    }
    if (!report.closedManifold() || report.unusedPoints > 0)
    {
      faults += std::string(name) + ": " + report.describe() + "; ";
    }
  };
  check(results.unite, "union");
  check(results.intersect, "intersection");
  check(results.subtract, "difference");
  const double volumeA = signedVolume(a);
  const double volumeB = signedVolume(b);
  const double tolerance = 1e-10 * (volumeA + volumeB) + volumeOfRounding(a, b);
  const double both = signedVolume(results.intersect.mesh);
  const auto compare = [&](double volume, double expected, const char* name)
  {
    if (!(std::abs(volume - expected) <= tolerance))
    {
      std::ostringstream told;
      told.precision(17);
      told << name << " of volume " << volume << " instead of " << expected << "; ";
      faults += told.str();
    }
  };
  compare(both, common < 0.0 ? both : common, "intersection");
  compare(signedVolume(results.unite.mesh), volumeA + volumeB - both, "union");
  compare(signedVolume(results.subtract.mesh), volumeA - both, "difference");
  const double twice = coveredTwice(results, a, b);
  if (twice > folded)
  {
    faults += std::to_string(1e6 * twice) + " millionths covered twice; ";
  }
  const double share = foldedShare(results, a, b);
  if (share > folded)
  {
    faults += std::to_string(1e6 * share) + " millionths folded; ";
  }
  return faults;
}

} // namespace hybridtree::test
