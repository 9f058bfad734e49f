// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/RandomTree.h"

#include "core/nodes/Barr.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/FreeForm.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/nodes/SubdivisionSkeleton.h"
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
#include "tests/support/TestMeshes.h"

namespace hybridtree::test
{
namespace
{

class Grower
{
public:
  Grower(std::uint64_t seed, const BlendOptions& blends, double deformedEdge)
    : random_(seed), blends_(blends), deformedEdge_(deformedEdge)
  {
  }

  NodePtr grow(int depth)
  {
    if (depth <= 1 || random_.chance(0.1))
    {
      return this->leaf(false);
    }
    switch (random_.integer(0, 9))
    {
      case 0:
      case 1:
      case 2:
        return this->blend(depth - 1);
      case 3:
      case 4:
        return makeLocalBlend(
          this->grow(depth - 1), this->grow(depth - 2), this->leaf(false), blends_);
      case 5:
      case 6:
        return makeBoolean(static_cast<BooleanOperation>(random_.integer(0, 2)),
          this->grow(depth - 1), this->grow(depth - 2),
          static_cast<BooleanForm>(random_.integer(0, 3)));
      case 7:
        return this->warp(this->grow(depth - 1));
      case 8:
        return this->freeForm(this->grow(depth - 1));
      default:
        return this->grow(depth - 1)->affine(randomMap(random_));
    }
  }

private:
  Vec3 place() { return 0.5 * Vec3(this->coordinate(), this->coordinate(), this->coordinate()); }
  double coordinate() { return random_.uniform(-1.0, 1.0); }

  // Concave for most notches.
  static std::vector<Vec3> outline(
    const Vec3& corner, const Vec3& side, const Vec3& other, double notch)
  {
    return { corner, corner + side, corner + notch * (side + other), corner + other };
  }

  SkeletonPtr flatOrEllipsoid()
  {
    // Two sides that do not line up.
    const Vec3 corner = this->place();
    const Mat3 axes = random_.rotation();
    const Vec3 side = random_.uniform(0.2, 0.7) * axes.col(0);
    const Vec3 other = random_.uniform(0.2, 0.7) * (axes.col(1) + 0.4 * axes.col(0));
    switch (random_.integer(0, 3))
    {
      case 0:
        return std::make_shared<RectangleSkeleton>(corner, corner + side, corner + other);
      case 2:
        return std::make_shared<PolygonSkeleton>(
          outline(corner, side, other, random_.uniform(0.2, 0.9)));
      case 1:
        return std::make_shared<TriangleSkeleton>(corner, corner + side, corner + other);
      default:
        return std::make_shared<EllipsoidSkeleton>(corner,
          Vec3(random_.uniform(0.1, 0.4), random_.uniform(0.1, 0.4), random_.uniform(0.1, 0.4)),
          axes);
    }
  }

  // Of revolution about an axis that has a direction.
  SkeletonPtr roundSkeleton()
  {
    const Vec3 start = this->place();
    const Vec3 end = start + random_.uniform(0.2, 0.8) * random_.direction();
    const double radius = random_.uniform(0.1, 0.4);
    const double share = random_.uniform(0.0, 1.0);
    switch (random_.integer(0, 4))
    {
      case 0:
        return std::make_shared<DiscSkeleton>(start, random_.direction(), radius);
      case 1:
        return std::make_shared<CylinderSkeleton>(start, end, radius);
      case 2:
        return std::make_shared<HollowCylinderSkeleton>(start, end, radius, share * radius);
      case 3:
        return std::make_shared<ConeSkeleton>(start, end, radius, share * radius);
      default:
        return std::make_shared<ConeSphereSkeleton>(start, end, radius, share * radius);
    }
  }

  SkeletonPtr skeleton()
  {
    switch (random_.integer(0, 8))
    {
      case 4:
        return this->flatOrEllipsoid();
      case 5:
      case 6:
        return this->roundSkeleton();
      case 7:
        return makeSpline(
          SplineCurve{ { this->place(), this->place(), this->place(), this->place() }, {},
            random_.chance(0.5) ? SplineKind::CatmullRom : SplineKind::BSpline,
            random_.chance(0.3) });
      case 8:
        return std::make_shared<RevolutionSkeleton>(RevolutionShape{ this->place(),
          random_.direction(),
          { { Vec3(random_.uniform(0.1, 0.5), -0.4, 0.0), Vec3(random_.uniform(0.1, 0.5), 0.0, 0.0),
            Vec3(random_.uniform(0.0, 0.4), 0.3, 0.0) } },
          random_.chance(0.5) });
      case 0:
        return std::make_shared<PointSkeleton>(this->place());
      case 1:
        return std::make_shared<SegmentSkeleton>(this->place(), this->place());
      case 2:
        return std::make_shared<CircleSkeleton>(
          this->place(), random_.direction(), random_.uniform(0.2, 0.6));
      default:
        return std::make_shared<BoxSkeleton>(this->place(),
          Vec3(random_.uniform(0.1, 0.7), random_.uniform(0.1, 0.7), random_.uniform(0.1, 0.7)),
          random_.rotation());
    }
  }

  NodePtr leaf(bool negative)
  {
    if (random_.chance(0.2))
    {
      return this->meshLeaf(negative);
    }
    if (random_.chance(0.15))
    {
      return this->subdivisionSkeleton(negative);
    }
    const double radius = random_.uniform(0.15, 0.4);
    const Potential potential = Potential::bySurfaceRadius(
      radius, radius * random_.uniform(1.3, 2.5), random_.integer(2, 4), negative);
    return makePrimitive(this->skeleton(), potential);
  }

  // A triangle with a limb.
  NodePtr subdivisionSkeleton(bool negative)
  {
    const Vec3 corner = this->place();
    const Mat3 axes = random_.rotation();
    SkeletonGraph graph;
    graph.points = { corner, corner + random_.uniform(0.2, 0.7) * axes.col(0),
      corner + random_.uniform(0.2, 0.7) * axes.col(1),
      corner + random_.uniform(0.4, 0.8) * random_.direction() };
    for (std::size_t k = 0; k < graph.points.size(); ++k)
    {
      graph.radii.push_back(random_.uniform(0.15, 0.3));
    }
    graph.segments = { { 0, 3 } };
    graph.triangles = { { 0, 1, 2 } };
    SubdivisionSkeletonOptions options;
    options.level = random_.integer(0, 2);
    options.kernel.exponent = random_.integer(2, 4);
    options.kernel.influenceRatio = random_.uniform(1.5, 2.5);
    options.blending.kind = options.level == 1 ? BlendingKind::Neighbours : BlendingKind::All;
    options.negative = negative;
    return makeSubdivisionSkeleton(graph, options);
  }

  NodePtr meshLeaf(bool negative)
  {
    TriangleMesh mesh;
    switch (random_.integer(0, 2))
    {
      case 0:
        mesh = icosphere(random_.uniform(0.3, 0.5), 1, this->place());
        break;
      case 1:
        mesh = torus(0.45, random_.uniform(0.1, 0.25), 12, 8);
        break;
      default:
        mesh = box(Vec3(-0.3, -0.35, -0.25), Vec3(0.4, 0.3, 0.35));
        break;
    }
    const double maximum = random_.uniform(0.6, 2.0);
    return makeMeshNode(std::make_shared<const TriangleMesh>(std::move(mesh)),
      negative ? -maximum : maximum, random_.uniform(0.1, 0.5), random_.integer(2, 4));
  }

  NodePtr blend(int depth)
  {
    std::vector<NodePtr> children{ this->grow(depth) };
    for (int more = random_.integer(1, 3); more > 0; --more)
    {
      children.push_back(
        random_.chance(0.25) ? this->leaf(true) : this->grow(random_.integer(1, depth)));
    }
    return makeBlend(std::move(children), blends_);
  }

  NodePtr warp(NodePtr child)
  {
    BarrFrame frame;
    frame.axis = random_.direction();
    frame.normal = frame.axis.unitOrthogonal();
    frame.origin = 0.3 * this->place();
    frame.begin = random_.uniform(-0.8, -0.1);
    frame.end = random_.uniform(0.1, 0.8);
    switch (random_.integer(0, 2))
    {
      case 0:
        return makeTwist(std::move(child), frame, random_.uniform(-1.5, 1.5));
      case 1:
        return makeTaper(std::move(child), frame, random_.uniform(0.5, 1.6));
      default:
        return makeBend(std::move(child), frame, random_.uniform(-0.4, 0.4));
    }
  }

  // Moves only control points inside of the lattice box: the map stays continuous and without
  // folds.
  NodePtr freeForm(NodePtr child)
  {
    FreeFormLattice lattice;
    lattice.dimensions = { 4, 4, 4 };
    lattice.origin = Vec3(-1.2, -1.2, -1.2);
    lattice.axes = 2.4 * Mat3::Identity();
    lattice.displacements.assign(64, Vec3::Zero());
    for (int k = 1; k < 3; ++k)
    {
      for (int j = 1; j < 3; ++j)
      {
        for (int i = 1; i < 3; ++i)
        {
          lattice.displacements[static_cast<std::size_t>(i + 4 * (j + 4 * k))] =
            random_.uniform(0.0, 0.2) * random_.direction();
        }
      }
    }
    const FieldFrom from = random_.chance(0.7) ? FieldFrom::InverseMap : FieldFrom::DeformedMesh;
    return makeFreeForm(std::move(child), lattice, from, deformedEdge_);
  }

  Random random_;
  BlendOptions blends_;
  double deformedEdge_;
};

} // namespace

NodePtr randomTree(std::uint64_t seed, int depth, const BlendOptions& blends, double deformedEdge)
{
  return Grower(seed, blends, deformedEdge).grow(depth);
}

Affine3 randomMap(Random& random)
{
  Affine3 map = Affine3::Identity();
  map.linear() = random.rotation() * random.uniform(0.8, 1.2);
  if (random.chance(0.3))
  {
    map.linear().col(0) *= -1.0;
  }
  if (random.chance(0.4))
  {
    const Vec3 stretch(
      random.uniform(0.7, 1.4), random.uniform(0.7, 1.4), random.uniform(0.7, 1.4));
    map.linear() = map.linear() * stretch.asDiagonal() * random.rotation();
  }
  map.translation() = random.uniform(0.0, 0.3) * random.direction();
  return map;
}

} // namespace hybridtree::test
