// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/SkeletonFactory.h"

#include "core/base/Error.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Circle.h"
#include "core/skeletons/Cone.h"
#include "core/skeletons/ConeSphere.h"
#include "core/skeletons/Cylinder.h"
#include "core/skeletons/Disc.h"
#include "core/skeletons/Ellipsoid.h"
#include "core/skeletons/HollowCylinder.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Polygon.h"
#include "core/skeletons/Rectangle.h"
#include "core/skeletons/Revolution.h"
#include "core/skeletons/Segment.h"
#include "core/skeletons/Spline.h"
#include "core/skeletons/Triangle.h"

namespace hybridtree
{
namespace
{

struct Maker
{
  const char* kind;
  SkeletonPtr (*make)(const Parameters&);
};

// One line per kind of skeleton.
constexpr Maker kMakers[] = {
  { "point", &PointSkeleton::fromParameters },
  { "segment", &SegmentSkeleton::fromParameters },
  { "circle", &CircleSkeleton::fromParameters },
  { "box", &BoxSkeleton::fromParameters },
  { "disc", &DiscSkeleton::fromParameters },
  { "cylinder", &CylinderSkeleton::fromParameters },
  { "hollow_cylinder", &HollowCylinderSkeleton::fromParameters },
  { "cone", &ConeSkeleton::fromParameters },
  { "cone_sphere", &ConeSphereSkeleton::fromParameters },
  { "rectangle", &RectangleSkeleton::fromParameters },
  { "triangle", &TriangleSkeleton::fromParameters },
  { "polygon", &PolygonSkeleton::fromParameters },
  { "ellipsoid", &EllipsoidSkeleton::fromParameters },
  { "spline", &SplineSkeleton::fromParameters },
  { "revolution", &RevolutionSkeleton::fromParameters },
};

} // namespace

SkeletonPtr makeSkeleton(const std::string& kind, const Parameters& parameters)
{
  for (const Maker& maker : kMakers)
  {
    if (kind == maker.kind)
    {
      return maker.make(parameters);
    }
  }
  throw InvalidText("There is no skeleton of kind \"" + kind + "\".");
}

} // namespace hybridtree
