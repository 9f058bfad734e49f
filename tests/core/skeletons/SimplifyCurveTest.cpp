// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail: fewer points, and surfaces no farther apart than the level says.
#include "core/skeletons/SimplifyCurve.h"

#include "core/base/Error.h"
#include "core/nodes/CurveTree.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Polygon.h"
#include "core/skeletons/Revolution.h"
#include "core/skeletons/Spline.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

using test::PointList;

SplineCurve wave(SplineKind kind, bool closed, bool thick)
{
  SplineCurve curve;
  curve.kind = kind;
  curve.closed = closed;
  const int count = 120;
  for (int k = 0; k < count; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * k / count;
    curve.points.emplace_back(std::cos(turn) + 0.004 * std::cos(31.0 * turn),
      std::sin(turn) + 0.1 * std::sin(5.0 * turn), 0.2 * std::cos(3.0 * turn));
    if (thick)
    {
      curve.radii.push_back(0.05 + 0.03 * std::cos(4.0 * turn));
    }
  }
  return curve;
}

// Points of the surface at 0.1 from one curve: how far from that of the other?
double surfaceDistance(const SplineCurve& from, const SplineCurve& to)
{
  test::Random random(3);
  const SplinePtr source = makeSpline(from);
  const SplinePtr target = makeSpline(to);
  std::vector<CubicSpan> spans;
  splineSpans(from, spans);
  PointList points;
  for (const CubicSpan& span : spans)
  {
    for (int k = 0; k < 20; ++k)
    {
      const double t = random.unit();
      const Vec3 across = random.direction().cross(span.slope(t).at).normalized();
      points.add(span.at(t).at + (0.1 + span.at(t).radius) * across);
    }
  }
  std::vector<double> own(points.size()), other(points.size());
  source->signedDistance(points, own.data());
  target->signedDistance(points, other.data());
  double most = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    most = std::max(most, std::abs(own[k] - other[k]));
  }
  return most;
}

TEST(SimplifyCurve, SurfacesStayWithinTheToleranceOfTheLevel)
{
  for (const SplineKind kind :
    { SplineKind::CatmullRom, SplineKind::BSpline, SplineKind::Polyline })
  {
    for (const bool closed : { false, true })
    {
      for (const bool thick : { false, true })
      {
        const SplineCurve full = wave(kind, closed, thick);
        std::size_t before = 0;
        for (int level = 0; level <= kExactDetail; ++level)
        {
          const double tolerance = detailTolerance(full, level);
          const SplineCurve fewer = simplified(full, tolerance);
          EXPECT_GE(fewer.points.size(), before);
          before = fewer.points.size();
          EXPECT_LE(surfaceDistance(full, fewer), tolerance + 1e-12) << level;
          EXPECT_LE(surfaceDistance(fewer, full), tolerance + 1e-12) << level;
          EXPECT_EQ(fewer.radii.size(), thick ? fewer.points.size() : 0u);
          if (level == 0)
          {
            EXPECT_LE(fewer.points.size(), full.points.size() / 2);
          }
        }
        EXPECT_EQ(before, full.points.size()); // the last level is exact
      }
    }
  }
}

// The farthest of the mesh's points from the surface at `radius` around another skeleton.
double meshDistance(const TriangleMesh& mesh, const Skeleton& other, double radius)
{
  const PointList points(mesh.points);
  std::vector<double> distance(points.size());
  other.signedDistance(points, distance.data());
  double most = 0.0;
  for (const double d : distance)
  {
    most = std::max(most, std::abs(d - radius));
  }
  return most;
}

RevolutionShape vase(SplineKind kind, bool solid, const SplineCurve* profile = nullptr)
{
  RevolutionShape shape{ Vec3(1, 2, 3), Vec3(1, -1, 2), {}, solid };
  shape.profile.kind = kind;
  for (int k = 0; k <= 80; ++k)
  {
    const double height = 0.05 * k;
    shape.profile.points.emplace_back(
      1.2 + 0.5 * std::sin(1.7 * height) + 0.004 * std::cos(9.0 * height), height, 0.0);
  }
  shape.profile = profile ? *profile : shape.profile;
  return shape;
}

TEST(SimplifyCurve, SurfacesOfRevolutionStayWithinTheToleranceOfTheLevel)
{
  constexpr double kRadius = 0.1;
  for (const SplineKind kind :
    { SplineKind::CatmullRom, SplineKind::BSpline, SplineKind::Polyline })
  {
    for (const bool solid : { false, true })
    {
      const RevolutionSkeleton full(vase(kind, solid));
      const SplineCurve& profile = full.shape().profile;
      const auto fullMesh = full.offsetMesh(kRadius, 0.2);
      std::size_t before = 0;
      for (int level = 0; level <= kExactDetail; ++level)
      {
        const double tolerance = detailTolerance(profile, level);
        const SplineCurve fewer = simplified(profile, tolerance);
        const RevolutionSkeleton coarse(vase(kind, solid, &fewer));
        // Each query looks at spans: there are fewer of them.
        const std::size_t spans = drawnProfile(coarse.shape()).size();
        EXPECT_GE(spans, before);
        before = spans;
        if (level == 0)
        {
          EXPECT_LE(spans, drawnProfile(full.shape()).size() / 2);
        }
        ASSERT_TRUE(fullMesh) << int(kind) << solid;
        EXPECT_LE(meshDistance(*fullMesh, coarse, kRadius), tolerance + 1e-12) << level;
        if (const auto mesh = coarse.offsetMesh(kRadius, 0.2))
        {
          EXPECT_LE(meshDistance(*mesh, full, kRadius), tolerance + 1e-12) << level;
        }
      }
      EXPECT_EQ(before, drawnProfile(full.shape()).size());
    }
  }
}

TEST(SimplifyCurve, PolygonsStayWithinTheToleranceOfTheLevel)
{
  std::vector<Vec3> corners;
  for (int k = 0; k < 200; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * k / 200.0;
    const double wide = 1.0 + 0.3 * std::sin(5.0 * turn) + 0.002 * std::cos(71.0 * turn);
    corners.emplace_back(wide * std::cos(turn), wide * std::sin(turn), 0.5);
  }
  const PolygonSkeleton full(corners);
  std::size_t before = 0;
  for (int level = 0; level <= kExactDetail; ++level)
  {
    const SkeletonPtr coarse = makePolygon(corners, level);
    const std::size_t count = dynamic_cast<const PolygonSkeleton&>(*coarse).points().size();
    EXPECT_GE(count, before);
    before = count;
    const double tolerance = detailTolerance(full.bounds(), level);
    EXPECT_LE(meshDistance(*full.offsetMesh(0.05, 0.05), *coarse, 0.05), tolerance + 1e-12)
      << level;
    EXPECT_LE(meshDistance(*coarse->offsetMesh(0.05, 0.05), full, 0.05), tolerance + 1e-12)
      << level;
    if (level == 0)
    {
      EXPECT_LE(count, 40u);
    }
  }
  EXPECT_EQ(before, corners.size());
  EXPECT_THROW(makePolygon(corners, 5), InvalidParameter);
}

// A blade thinner than the tolerance would have no area left.
TEST(SimplifyCurve, APolygonThatWouldVanishStaysAsItIs)
{
  const std::vector<Vec3> blade = { Vec3(0, 0, 0), Vec3(1, -0.001, 0), Vec3(2, 0, 0),
    Vec3(1, 0.001, 0) };
  const SkeletonPtr coarse = makePolygon(blade, 0);
  const auto mesh = coarse->offsetMesh(0.05, 0.02);
  ASSERT_TRUE(mesh);
  EXPECT_LE(
    meshDistance(*mesh, PolygonSkeleton(blade), 0.05), detailTolerance(coarse->bounds(), 0));
}

// Leaf by leaf: a blend of curves moves by more where it is flat.
TEST(SimplifyCurve, LeavesOfACurveTreeStayWithinTheToleranceOfTheLevel)
{
  const std::vector<SplineCurve> curves = { wave(SplineKind::CatmullRom, false, true),
    wave(SplineKind::BSpline, true, false), wave(SplineKind::CatmullRom, true, true) };
  const auto treeOf = [&](int level) {
    return makeCurveTree(curves, { Potential::bySurfaceRadius(0.1, 0.25, 2), true, level });
  };
  const auto skeletonOf = [](const NodePtr& leaf) -> const SplineSkeleton&
  { return dynamic_cast<const SplineSkeleton&>(dynamic_cast<const Primitive&>(*leaf).skeleton()); };
  const std::vector<NodePtr> full = treeOf(kExactDetail)->children();
  std::size_t before = 0;
  for (int level = 0; level < kExactDetail; ++level)
  {
    const NodePtr coarseTree = treeOf(level);
    const std::vector<NodePtr> coarse = coarseTree->children();
    ASSERT_EQ(coarse.size(), curves.size());
    std::size_t spans = 0;
    for (std::size_t k = 0; k < curves.size(); ++k)
    {
      spans += splineSpanCount(skeletonOf(coarse[k]).curve());
      const double tolerance = detailTolerance(curves[k], level);
      const auto farthest = [&](const Node& from, const Node& to)
      {
        const PointList points(from.mesh(0.1)->points);
        std::vector<double> distance(points.size());
        to.signedDistance(points, distance.data());
        double most = 0.0;
        for (const double d : distance)
        {
          most = std::isnan(d) ? most : std::max(most, std::abs(d)); // not known inside
        }
        return most;
      };
      EXPECT_LE(farthest(*coarse[k], *full[k]), tolerance + 1e-12) << k << " level " << level;
      EXPECT_LE(farthest(*full[k], *coarse[k]), tolerance + 1e-12) << k << " level " << level;
    }
    EXPECT_GE(spans, before);
    before = spans;
    EXPECT_LE(spans, 120u + 120u + 119u);
    if (level == 0)
    {
      EXPECT_LE(spans, (120u + 120u + 119u) / 2);
    }
  }
}

} // namespace
} // namespace hybridtree
