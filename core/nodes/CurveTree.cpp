// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/CurveTree.h"

#include "core/base/Error.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"
#include "core/skeletons/SimplifyCurve.h"
#include "core/skeletons/Spline.h"

#include <algorithm>
#include <string>

namespace hybridtree
{
namespace
{

// The largest radius of a curve. \throws InvalidParameter.
double largestRadius(const SplineCurve& curve)
{
  for (const double radius : curve.radii)
  {
    if (!(radius >= 0.0)) // NaN, too
    {
      throw InvalidParameter("A radius", radius, "a finite number >= 0");
    }
  }
  const double largest = *std::max_element(curve.radii.begin(), curve.radii.end());
  if (!(largest > 0.0))
  {
    throw InvalidParameter("The largest radius", largest, "greater than 0");
  }
  return largest;
}

Potential scaledTo(const Potential& potential, double radius)
{
  const std::optional<double> own = potential.surfaceRadius();
  if (!own || !(*own > 0.0))
  {
    throw InvalidParameter("The surface radius of the field", "none or 0",
      "greater than 0 where points have radii of their own, which scale it");
  }
  return potential.scaled(radius / *own);
}

SkeletonPtr skeletonOf(const SplineCurve& curve)
{
  if (curve.radii.empty() && curve.points.size() == 1)
  {
    return std::make_shared<PointSkeleton>(curve.points.front());
  }
  if (curve.radii.empty() && curve.points.size() == 2)
  {
    return std::make_shared<SegmentSkeleton>(curve.points.front(), curve.points.back());
  }
  return makeSpline(curve);
}

NodePtr primitiveOf(SplineCurve curve, const CurveTreeOptions& options)
{
  Potential potential = options.potential;
  if (!curve.radii.empty())
  {
    const double largest = largestRadius(curve);
    potential = scaledTo(potential, largest);
    for (double& radius : curve.radii)
    {
      radius -= largest; // what the offset surface lacks
    }
  }
  curve = requireCurve(std::move(curve));
  curve = simplified(curve, detailTolerance(curve, options.levelOfDetail));
  if (std::all_of(curve.radii.begin(), curve.radii.end(), [](double r) { return r == 0.0; }))
  {
    curve.radii.clear();
  }
  return makePrimitive(skeletonOf(curve), potential);
}

// Balanced, so that the depth of the tree stays small.
NodePtr unionOf(const std::vector<NodePtr>& nodes, std::size_t begin, std::size_t end)
{
  if (end - begin == 1)
  {
    return nodes[begin];
  }
  const std::size_t middle = begin + (end - begin) / 2;
  return makeBoolean(
    BooleanOperation::Union, unionOf(nodes, begin, middle), unionOf(nodes, middle, end));
}

} // namespace

NodePtr makeCurveTree(const std::vector<SplineCurve>& curves, const CurveTreeOptions& options)
{
  if (curves.empty())
  {
    throw InvalidParameter("The number of curves", "0", "at least 1");
  }
  std::vector<NodePtr> nodes;
  nodes.reserve(curves.size());
  for (std::size_t k = 0; k < curves.size(); ++k)
  {
    try
    {
      nodes.push_back(primitiveOf(curves[k], options));
    }
    catch (const InvalidParameter& error)
    {
      throw InvalidGeometry("Curve " + std::to_string(k) + ": " + error.what());
    }
  }
  return options.blendAcross ? makeBlend(std::move(nodes)) : unionOf(nodes, 0, nodes.size());
}

} // namespace hybridtree
