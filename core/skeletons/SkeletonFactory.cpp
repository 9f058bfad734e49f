// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/SkeletonFactory.h"

#include "core/base/Error.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Circle.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"

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
