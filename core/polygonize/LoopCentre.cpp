// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/LoopCentre.h"

#include "core/polygonize/NearSurface.h"

namespace hybridtree
{

LoopCentre centreOf(const TriangleMesh& mesh, const std::vector<std::int32_t>& loop,
  const FieldSource& field, double cellSize)
{
  LoopCentre centre;
  for (const std::int32_t v : loop)
  {
    centre.point += mesh.points[v] / static_cast<double>(loop.size());
    centre.normal += mesh.normals[v];
  }
  centre.normal.stableNormalize();
  const Vec3 reach = Vec3::Constant(cellSize);
  const FieldSourcePtr near =
    field.restrictedTo(Box3(Vec3(centre.point - reach), Vec3(centre.point + reach)));
  for (const Vec3& way :
    { centre.normal, Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ()) })
  {
    if (near && !way.isZero() && moveToSurface(*near, 0.5 * cellSize, way, centre.point))
    {
      break;
    }
  }
  return centre;
}

} // namespace hybridtree
