// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/SolidPool.h"

#include "benchmarks/support/OffFile.h"
#include "benchmarks/support/PeerBooleans.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/RepairMesh.h"

#include <cstdio>

namespace hybridtree::benchmark
{
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
