// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/SolidPool.h"

#include "benchmarks/support/PeerBooleans.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/RepairMesh.h"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace hybridtree::benchmark
{
namespace
{

std::unique_ptr<TriangleMesh> readOff(const std::string& file)
{
  std::ifstream stream(file);
  std::string text;
  for (std::string line; std::getline(stream, line);)
  {
    text += line.substr(0, line.find('#')) + "\n";
  }
  std::istringstream words(text);
  std::string magic;
  std::size_t points = 0, faces = 0, edges = 0;
  if (!(words >> magic >> points >> faces >> edges) || magic != "OFF")
  {
    return nullptr;
  }
  auto mesh = std::make_unique<TriangleMesh>();
  mesh->points.resize(points);
  for (Vec3& p : mesh->points)
  {
    words >> p.x() >> p.y() >> p.z();
  }
  std::string line;
  for (std::size_t f = 0; f < faces && words >> std::ws && std::getline(words, line); ++f)
  {
    std::istringstream face(line); // colours may follow
    std::size_t corners = 0;
    face >> corners;
    std::vector<std::int32_t> v(corners);
    for (std::int32_t& corner : v)
    {
      face >> corner;
    }
    for (std::size_t k = 2; k < corners; ++k)
    {
      mesh->triangles.push_back({ v[0], v[k - 1], v[k] });
    }
  }
  return mesh;
}

} // namespace

void addToPool(const std::string& file, Pool& pool)
{
  const std::string name = file.substr(file.rfind('/') + 1);
  const std::unique_ptr<TriangleMesh> read = readOff(file);
  if (!read || read->empty())
  {
    std::printf("%s: left out, not read as triangles\n", name.c_str());
    return;
  }
  try
  {
    TriangleMesh mesh = *repairMesh(read->points, read->triangles).mesh;
    const Box3 bounds = mesh.bounds();
    for (Vec3& p : mesh.points)
    {
      p = (p - bounds.center()) * (2.0 / bounds.diagonal().norm());
    }
    const MeshReport report = checkMesh(mesh);
    if (!report.closedManifold() || !(signedVolume(mesh) > 1e-4))
    {
      std::printf("%s: left out, %s\n", name.c_str(),
        report.closedManifold() ? "encloses nothing" : report.describe().c_str());
    }
    else if (crossesItself(mesh))
    {
      std::printf("%s: left out, crosses itself\n", name.c_str());
    }
    else
    {
      pool.push_back(std::make_unique<const Solid>(name, std::move(mesh)));
    }
  }
  catch (const std::exception& error)
  {
    std::printf("%s: left out, %s\n", name.c_str(), error.what());
  }
}

} // namespace hybridtree::benchmark
