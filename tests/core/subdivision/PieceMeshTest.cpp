// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceMeshes.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/MeshDistance.h"
#include "core/nodes/SkeletonElementFields.h"
#include "tests/core/subdivision/SkeletonFieldCase.h"
#include "tests/support/Random.h"
#include "tests/support/SkeletonShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

using test::SkeletonFieldCase;

const double kPi = std::acos(-1.0);

MeshReport reportOf(const PieceMesh& piece)
{
  TriangleMesh mesh;
  mesh.points = piece.points;
  mesh.triangles = piece.triangles;
  return checkMesh(mesh);
}

double volumeOf(const PieceMesh& piece)
{
  TriangleMesh mesh;
  mesh.points = piece.points;
  mesh.triangles = piece.triangles;
  return signedVolume(mesh);
}

/// A band of 2 n triangles that is turned by half when it comes back.
SkeletonGraph moebius(int n)
{
  SkeletonGraph graph;
  for (int k = 0; k < n; ++k)
  {
    const double turn = 2.0 * kPi * k / n;
    const Vec3 out(std::cos(turn), std::sin(turn), 0.0);
    const Vec3 side = std::cos(0.5 * turn) * out + std::sin(0.5 * turn) * Vec3::UnitZ();
    graph.points.push_back(3.0 * out - 0.6 * side);
    graph.points.push_back(3.0 * out + 0.6 * side);
    graph.radii.insert(graph.radii.end(), 2, 0.25);
    const bool last = k == n - 1;
    const std::int32_t a = 2 * k;
    const std::int32_t c = last ? 1 : a + 2;
    const std::int32_t d = last ? 0 : a + 3;
    graph.triangles.push_back({ a, a + 1, c });
    graph.triangles.push_back({ a + 1, d, c });
  }
  return graph;
}

SkeletonGraph ring(int n)
{
  SkeletonGraph graph;
  for (int k = 0; k < n; ++k)
  {
    const double turn = 2.0 * kPi * k / n;
    graph.points.emplace_back(2.0 * std::cos(turn), 2.0 * std::sin(turn), 0.5 * std::sin(2 * turn));
    graph.radii.push_back(0.3);
    graph.segments.push_back({ k, (k + 1) % n });
  }
  return graph;
}

void expectOnSurface(const SkeletonFieldCase& shape, const PieceMesh& piece)
{
  std::vector<Vec3> gradient;
  const std::vector<double> value = fieldAt(*shape.node, piece.points, &gradient);
  for (std::size_t k = 0; k < piece.points.size(); ++k)
  {
    if (piece.onSurface[k])
    {
      ASSERT_NEAR(value[k], kThreshold, 1e-6);
      ASSERT_NEAR(piece.normals[k].dot(gradient[k].normalized()), -1.0, 1e-6);
    }
  }
}

// Of all edges that could have been split, none needs it any more.
void expectRefined(const SkeletonFieldCase& shape, const PieceMesh& piece, double refinement)
{
  const double thickest = *std::max_element(shape.graph.radii.begin(), shape.graph.radii.end());
  std::vector<Vec3> middles;
  for (const Triangle& t : piece.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = t[k];
      const std::int32_t b = t[(k + 1) % 3];
      const double length = (piece.points[a] - piece.points[b]).norm();
      if (a < b && piece.onSurface[a] && piece.onSurface[b] && length > 0.1 * thickest)
      {
        middles.push_back(0.5 * (piece.points[a] + piece.points[b]));
      }
    }
  }
  for (const double value : fieldAt(*shape.node, middles))
  {
    ASSERT_LE(std::abs(value - kThreshold), refinement * kThreshold + 1e-9);
  }
}

TEST(PieceMesh, IsClosedAndLiesOnTheSurfaceForEveryPiece)
{
  for (const SkeletonGraph& graph : { test::bretzel(), test::figure7(), test::alien() })
  {
    for (const int level : { 0, 2, 4 })
    {
      for (const auto scheme :
        { SubdivisionScheme::Approximating, SubdivisionScheme::Interpolating })
      {
        const SkeletonFieldCase shape(graph, level, scheme);
        const std::vector<PieceMeshPtr> pieces = pieceMeshes(shape.field(), {});
        for (std::size_t k = 0; k < pieces.size(); ++k)
        {
          const MeshReport report = reportOf(*pieces[k]);
          ASSERT_TRUE(report.closedManifold())
            << "level " << level << ", piece " << k << ": " << report.describe();
          EXPECT_EQ(report.eulerCharacteristic, 2) << "level " << level << ", piece " << k;
          EXPECT_GT(volumeOf(*pieces[k]), 0.0);
          expectOnSurface(shape, *pieces[k]);
          if (level < 4)
          {
            expectRefined(shape, *pieces[k], 0.1);
          }
        }
      }
    }
  }
}

TEST(PieceMesh, RingsAndBandsCloseAroundTheirHole)
{
  for (const SkeletonGraph& graph : { ring(6), ring(3), moebius(12) })
  {
    const SkeletonFieldCase shape(graph);
    const std::vector<PieceMeshPtr> pieces = pieceMeshes(shape.field(), {});
    ASSERT_EQ(pieces.size(), 1u);
    const MeshReport report = reportOf(*pieces[0]);
    EXPECT_TRUE(report.closedManifold()) << report.describe();
    EXPECT_EQ(report.eulerCharacteristic, 0);
    EXPECT_EQ(std::count(pieces[0]->onSurface.begin(), pieces[0]->onSurface.end(), 0), 0);
    EXPECT_GT(volumeOf(*pieces[0]), 0.0);
    expectRefined(shape, *pieces[0], 0.1);
  }
}

TEST(PieceMesh, ALongStraightCurveIsACylinder)
{
  SkeletonGraph graph;
  for (int k = 0; k <= 4; ++k)
  {
    graph.points.emplace_back(2.0 * k, 0.0, 0.0);
    graph.radii.push_back(0.5);
    if (k > 0)
    {
      graph.segments.push_back({ k - 1, k });
    }
  }
  const SkeletonFieldCase shape(graph, 1);
  double before = std::numeric_limits<double>::infinity();
  for (const double refinement : { 0.3, 0.1, 0.03 })
  {
    PieceMeshOptions options;
    options.refinement = refinement;
    const PieceMeshPtr piece = pieceMeshes(shape.field(), options).front();
    double deepest = 0.0;
    for (const Triangle& t : piece->triangles)
    {
      const Vec3 center = (piece->points[t[0]] + piece->points[t[1]] + piece->points[t[2]]) / 3.0;
      if (center.x() > 2.0 && center.x() < 6.0)
      {
        deepest = std::max(deepest, std::abs(center.tail<2>().norm() - 0.5));
      }
    }
    EXPECT_LT(deepest, 0.5 * before);
    EXPECT_LT(deepest, 0.5 * 1.5 * refinement);
    before = deepest;
  }
}

TEST(PieceMesh, WhatHasNoSurfaceHasNoMesh)
{
  SkeletonGraph graph;
  graph.points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 9, 0, 0 }, { 9.1, 0, 0 }, { 9, 0.1, 0 } };
  graph.radii.assign(5, 1.0); // fields of elements this short do not reach T
  graph.segments = { { 0, 1 } };
  graph.triangles = { { 2, 3, 4 } };
  const SkeletonFieldCase shape(graph, 1);
  for (const PieceMeshPtr& piece : pieceMeshes(shape.field(), {}))
  {
    EXPECT_TRUE(piece->triangles.empty());
  }
}

TEST(PieceMesh, RefusesARadiusThatIsTinyBesideTheLength)
{
  for (const double radius : { 1e-6, 1e-9 })
  {
    const SkeletonFieldCase thread({ { { 0, 0, 0 }, { 1, 0.2, 0 }, { 2, 0, 0 } },
      { radius, radius, radius }, { { 0, 1 }, { 1, 2 } }, {} });
    EXPECT_THROW(pieceMeshes(thread.field(), {}, nullptr), TooLarge);
  }
}

TEST(PieceMesh, LongestEdgeIsKept)
{
  const SkeletonFieldCase shape(test::bretzel());
  PieceMeshOptions options;
  options.longestEdge = 0.15;
  for (const PieceMeshPtr& piece : pieceMeshes(shape.field(), options))
  {
    for (const Triangle& t : piece->triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t a = t[k];
        const std::int32_t b = t[(k + 1) % 3];
        if (piece->onSurface[a] && piece->onSurface[b])
        {
          EXPECT_LE((piece->points[a] - piece->points[b]).norm(), 0.15);
        }
      }
    }
  }
}

// [SUB] 4: the closed meshes of the pieces cover the whole surface together.
TEST(PieceMeshes, CoverTheSurface)
{
  for (const SkeletonGraph& graph : { test::bretzel(), test::figure7(), test::alien() })
  {
    const SkeletonFieldCase shape(graph);
    const std::vector<PieceMeshPtr> pieces = pieceMeshes(shape.field(), {});
    const auto preview = std::make_shared<TriangleMesh>(joinPieces(pieces));
    ASSERT_EQ(preview->sourceLeaf.size(), preview->triangles.size());
    EXPECT_EQ(preview->sourceLeaf.back(), std::int32_t(pieces.size() - 1));
    const MeshDistance distance(preview);
    const MeshPtr lattice = shape.node->mesh(0.12);
    const test::PointList points(lattice->points);
    std::vector<double> off(points.size());
    distance.distance(points, std::numeric_limits<double>::infinity(), off.data());
    const double thickest = *std::max_element(graph.radii.begin(), graph.radii.end());
    EXPECT_LT(*std::max_element(off.begin(), off.end()), 0.2 * thickest);
  }
}

TEST(PieceMeshCache, AfterAnEditOnlyPiecesInReachAreMadeAndTheResultIsThatOfAColdStart)
{
  for (const BlendingKind blending : { BlendingKind::All, BlendingKind::Neighbours })
  {
    SkeletonGraph graph = test::alien();
    PieceMeshCache cache;
    const auto shapeOf = [&]
    { return SkeletonFieldCase(graph, 2, SubdivisionScheme::Approximating, blending); };
    const SkeletonFieldCase before = shapeOf();
    const std::vector<PieceMeshPtr> first = pieceMeshes(before.field(), {}, &cache);
    EXPECT_EQ(pieceMeshes(shapeOf().field(), {}, &cache), first);
    // A finger's tip.
    graph.points[graph.segments[24][1]] += Vec3(0.02, 0.01, 0.03);
    const SkeletonFieldCase after = shapeOf();
    const std::vector<PieceMeshPtr> warm = pieceMeshes(after.field(), {}, &cache);
    const std::vector<PieceMeshPtr> cold = pieceMeshes(after.field(), {});
    std::size_t kept = 0;
    for (std::size_t k = 0; k < warm.size(); ++k)
    {
      kept += warm[k] == first[k] ? 1 : 0;
      EXPECT_EQ(warm[k]->triangles, cold[k]->triangles) << "piece " << k;
      EXPECT_EQ(warm[k]->points, cold[k]->points) << "piece " << k;
      EXPECT_EQ(warm[k]->normals, cold[k]->normals) << "piece " << k;
    }
    EXPECT_GT(kept, warm.size() / 2);
    EXPECT_LT(kept, warm.size());
  }
}

// As the preview has it where elements blend with their immediate neighbours: with any kernel an
// edit reaches no farther than these.
TEST(PieceMeshCache, SumsOfElementsAreKeptByTheElementsThatTouchThem)
{
  for (const KernelKind kernel : { KernelKind::Compact, KernelKind::Cauchy })
  {
    SubdivisionSkeletonOptions options;
    options.level = 1;
    options.kernel.kind = kernel;
    options.blending.kind = BlendingKind::Paper;
    SkeletonGraph graph = test::alien();
    PieceMeshCache cache;
    std::vector<PieceMeshPtr> before;
    test::Random random(5);
    std::size_t kept = 0;
    constexpr int kEdits = 12;
    for (int edit = 0; edit <= kEdits; ++edit)
    {
      const NodePtr node = makeSubdivisionSkeleton(graph, options);
      const auto& leaf = static_cast<const SubdivisionSkeleton&>(*node);
      const SkeletonElementFields elements(leaf, SkeletonElementFields::Sums::Own);
      const SkeletonLocalField local(leaf);
      const SkeletonField field{ leaf.coarse(), leaf.refined(), options.level, leaf, &elements,
        false, &local };
      const std::vector<PieceMeshPtr> warm = pieceMeshes(field, {}, &cache);
      const std::vector<PieceMeshPtr> cold = pieceMeshes(field, {});
      ASSERT_EQ(warm.size(), cold.size());
      for (std::size_t k = 0; k < warm.size(); ++k)
      {
        SCOPED_TRACE("edit " + std::to_string(edit) + ", piece " + std::to_string(k));
        EXPECT_EQ(warm[k]->triangles, cold[k]->triangles);
        EXPECT_EQ(warm[k]->points, cold[k]->points);
        EXPECT_EQ(warm[k]->normals, cold[k]->normals);
        kept += edit > 0 && warm[k] == before[k] ? 1 : 0;
      }
      before = warm;
      const int last = static_cast<int>(graph.points.size()) - 1;
      const auto point = static_cast<std::size_t>(random.integer(0, last));
      graph.points[point] += random.uniform(0.0, 0.1) * random.direction();
    }
    EXPECT_GT(kept, kEdits * before.size() / 2);
    EXPECT_LT(kept, kEdits * before.size());
  }
}

} // namespace
} // namespace hybridtree
