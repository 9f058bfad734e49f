// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/SoundMesh.h"

#include "core/mesh/MeshChecks.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace hybridtree
{
namespace
{

struct Known
{
  std::weak_ptr<const TriangleMesh> mesh;
  bool sound;
};

} // namespace

bool isSoundMesh(const MeshPtr& mesh)
{
  static std::mutex mutex;
  static std::vector<Known> known;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    known.erase(std::remove_if(known.begin(), known.end(),
                  [](const Known& entry) { return entry.mesh.expired(); }),
      known.end());
    for (const Known& entry : known)
    {
      if (!entry.mesh.owner_before(mesh) && !mesh.owner_before(entry.mesh))
      {
        return entry.sound;
      }
    }
  }
  const bool sound = mesh->normals.size() == mesh->points.size() && isClosedManifold(*mesh);
  const std::lock_guard<std::mutex> lock(mutex);
  known.push_back({ mesh, sound });
  return sound;
}

} // namespace hybridtree
