// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/OffsetMesh.h"
#include "core/skeletons/RevolvedMesh.h"

namespace hybridtree
{

TriangleMesh meshTorus(const CircleShape& circle, double tube, double edgeLength)
{
  Meridian meridian(Meridian::Kind::Loop, true);
  meridian.addArc(Vec2(circle.radius, 0.0), tube, 0.0, 2.0 * double(EIGEN_PI));
  return meshRevolved(meridian, { circle.center, circle.normal, circle.side }, edgeLength);
}

} // namespace hybridtree
