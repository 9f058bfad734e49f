// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/TestMeshes.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

namespace hybridtree::test
{
namespace
{

constexpr double kTwoPi = 6.283185307179586;

TriangleMesh icosahedron()
{
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  mesh.points = { { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g }, { 0, 1, g },
    { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 }, { -g, 0, 1 } };
  mesh.triangles = { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 },
    { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 },
    { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 },
    { 9, 8, 1 } };
  return mesh;
}

TriangleMesh quartered(const TriangleMesh& mesh)
{
  TriangleMesh fine;
  fine.points = mesh.points;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b)
  {
    const auto [entry, isNew] =
      middles.emplace(std::minmax(a, b), std::int32_t(fine.points.size()));
    if (isNew)
    {
      const Vec3 sum = fine.points[std::size_t(a)] + fine.points[std::size_t(b)];
      fine.points.push_back(0.5 * sum);
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const std::int32_t ab = middle(a, b);
    const std::int32_t bc = middle(b, c);
    const std::int32_t ca = middle(c, a);
    for (const Triangle& corner : { Triangle{ a, ab, ca }, Triangle{ b, bc, ab },
           Triangle{ c, ca, bc }, Triangle{ ab, bc, ca } })
    {
      fine.triangles.push_back(corner);
    }
  }
  return fine;
}

} // namespace

TriangleMesh icosphere(double radius, int subdivisions, const Vec3& center)
{
  TriangleMesh mesh = icosahedron();
  for (int level = 0; level < subdivisions; ++level)
  {
    mesh = quartered(mesh);
  }
  for (Vec3& point : mesh.points)
  {
    point = center + radius * point.normalized();
  }
  return mesh;
}

TriangleMesh torus(double ringRadius, double tubeRadius, int around, int across)
{
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
  {
    const double u = kTwoPi * i / around;
    for (int j = 0; j < across; ++j)
    {
      const double v = kTwoPi * j / across;
      const double ring = ringRadius + tubeRadius * std::cos(v);
      mesh.points.emplace_back(ring * std::cos(u), ring * std::sin(u), tubeRadius * std::sin(v));
    }
  }
  const auto at = [&](int i, int j) { return std::int32_t((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      mesh.triangles.push_back({ at(i, j), at(i + 1, j), at(i + 1, j + 1) });
      mesh.triangles.push_back({ at(i, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
  return mesh;
}

TriangleMesh box(const Vec3& lower, const Vec3& upper)
{
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
  {
    mesh.points.emplace_back(
      k & 1 ? upper.x() : lower.x(), k & 2 ? upper.y() : lower.y(), k & 4 ? upper.z() : lower.z());
  }
  mesh.triangles = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
    { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return mesh;
}

TriangleMesh bumpySphere(double radius, int subdivisions)
{
  TriangleMesh mesh = icosphere(1.0, subdivisions);
  for (Vec3& point : mesh.points)
  {
    const double bump =
      std::sin(5.0 * point.x() + 1.0) * std::sin(6.0 * point.y()) * std::sin(7.0 * point.z() - 2.0);
    point *= radius * (1.0 + 0.35 * bump);
  }
  return mesh;
}

TriangleMesh hollowSphere(double outer, double inner, int subdivisions)
{
  TriangleMesh cavity = icosphere(inner, subdivisions);
  for (Triangle& corner : cavity.triangles)
  {
    std::swap(corner[1], corner[2]);
  }
  return joined(icosphere(outer, subdivisions), cavity);
}

TriangleMesh withoutTriangles(TriangleMesh mesh, std::size_t first, std::size_t count)
{
  const auto begin = mesh.triangles.begin() + std::ptrdiff_t(first);
  mesh.triangles.erase(begin, begin + std::ptrdiff_t(count));
  return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b)
{
  TriangleMesh both;
  both.points = a.points;
  both.points.insert(both.points.end(), b.points.begin(), b.points.end());
  both.triangles = a.triangles;
  const std::int32_t shift = std::int32_t(a.points.size());
  for (const auto& [i, j, k] : b.triangles)
  {
    both.triangles.push_back({ i + shift, j + shift, k + shift });
  }
  return both;
}

std::optional<TriangleMesh> demoMesh(const std::string& name)
{
  // Read through tar: the package ships its data packed.
  const std::string command =
    "tar -xzOf /usr/share/doc/libcgal-dev/data.tar.gz data/meshes/" + name + " 2>/dev/null";
  std::string text;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 65536> block;
  for (std::size_t got; pipe && (got = fread(block.data(), 1, block.size(), pipe.get())) > 0;)
  {
    text.append(block.data(), got);
  }
  std::istringstream stream(text);
  std::string magic;
  std::size_t points = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  if (!(stream >> magic >> points >> faces >> edges) || magic != "OFF")
  {
    return std::nullopt;
  }
  TriangleMesh mesh;
  mesh.points.resize(points);
  for (Vec3& p : mesh.points)
  {
    stream >> p.x() >> p.y() >> p.z();
  }
  for (std::size_t k = 0; k < faces; ++k)
  {
    std::size_t count = 0;
    stream >> count;
    std::vector<std::int32_t> corner(stream && count <= points ? count : 0);
    for (std::int32_t& c : corner)
    {
      stream >> c;
    }
    for (std::size_t c = 2; c < corner.size(); ++c)
    {
      mesh.triangles.push_back({ corner[0], corner[c - 1], corner[c] });
    }
    stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n'); // a colour may follow
  }
  return stream ? std::optional<TriangleMesh>(mesh) : std::nullopt;
}

} // namespace hybridtree::test
