// SPDX-License-Identifier: BSD-3-Clause
// Meshes of revolved meridians that no skeleton of the elementary ones has: wavy, concave, closed
// without symmetry, with creases.
#include "core/skeletons/RevolvedMesh.h"

#include "core/mesh/MeshChecks.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

// A vase: a bottom with a crease, a wavy side as one general piece, and a top with a crease.
double waist(double height)
{
  return 0.5 + 0.2 * std::sin(3.0 * height);
}

Meridian vase()
{
  // By the length of the wave, from a table.
  constexpr int kSteps = 4000;
  std::vector<double> lengths{ 0.0 };
  for (int k = 0; k < kSteps; ++k)
  {
    const double slope = 0.6 * std::cos(3.0 * 2.0 * (k + 0.5) / kSteps);
    lengths.push_back(lengths.back() + std::hypot(1.0, slope) * 2.0 / kSteps);
  }
  Meridian meridian(Meridian::Kind::AxisToAxis);
  meridian.addLine({ 0.0, 0.0 }, { waist(0.0), 0.0 });
  meridian.addCurve(lengths.back(),
    [lengths](double s)
    {
      const auto above = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, s);
      const double part = (s - *(above - 1)) / (*above - *(above - 1));
      const double height = 2.0 * (double(above - 1 - lengths.begin()) + part) / kSteps;
      const double slope = 0.6 * std::cos(3.0 * height);
      return MeridianPoint{ { waist(height), height }, Vec2(1.0, -slope).normalized() };
    });
  meridian.addLine({ waist(2.0), 2.0 }, { 0.0, 2.0 });
  return meridian;
}

double volumeOfVase()
{
  constexpr int kSteps = 20000;
  double volume = 0.0;
  for (int k = 0; k < kSteps; ++k)
  {
    volume += kPi * std::pow(waist(2.0 * (k + 0.5) / kSteps), 2) * 2.0 / kSteps;
  }
  return volume;
}

// A ring of triangular section, rounded at one corner only.
Meridian ring()
{
  Meridian meridian(Meridian::Kind::Loop);
  meridian.addLine({ 0.6, 0.0 }, { 1.0, 0.0 });
  meridian.addArc({ 1.0, 0.1 }, 0.1, -0.5 * kPi, 0.25 * kPi);
  const Vec2 end = Vec2(1.0, 0.1) + 0.1 * Vec2(std::sqrt(0.5), std::sqrt(0.5));
  meridian.addLine(end, { end.x() - 0.3, end.y() + 0.3 });
  meridian.addLine({ end.x() - 0.3, end.y() + 0.3 }, { 0.6, 0.0 });
  return meridian;
}

// A ball with a spherical dint.
Meridian bowl()
{
  Meridian meridian(Meridian::Kind::AxisToAxis);
  meridian.addArc({ 0.0, 0.0 }, 1.0, -0.5 * kPi, 0.25 * kPi);
  meridian.addArc({ 0.0, std::sqrt(2.0) }, 1.0, -0.25 * kPi, -0.5 * kPi);
  return meridian;
}

double volumeOfBowl()
{
  const double h = 1.0 - std::sqrt(0.5);
  return 4.0 / 3.0 * kPi - 2.0 * kPi * h * h * (3.0 - h) / 3.0;
}

RevolvedFrame anyFrame()
{
  test::Random random(41);
  const Mat3 axes = random.rotation();
  return { random.direction(), axes.col(2), axes.col(0) };
}

double longestEdge(const TriangleMesh& mesh)
{
  double longest = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(longest, (mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]).norm());
    }
  }
  return longest;
}

TEST(RevolvedMesh, IsClosedAndFineEnough)
{
  const std::pair<Meridian, int> shapes[] = { { vase(), 0 }, { ring(), 1 }, { bowl(), 0 } };
  for (const auto& [meridian, genus] : shapes)
  {
    for (const double length : { 0.02, 0.07, 0.2, 0.5, 1.0, 50.0 })
    {
      const TriangleMesh mesh = meshRevolved(meridian, anyFrame(), length);
      const MeshReport report = checkMesh(mesh);
      EXPECT_TRUE(report.closedManifold()) << length << ": " << report.describe();
      EXPECT_EQ(report.genus(), genus) << length;
      EXPECT_EQ(report.components, 1u) << length;
      EXPECT_EQ(report.degenerateTriangles, 0u) << length;
      EXPECT_LE(longestEdge(mesh), length * (1.0 + 1e-12));
    }
  }
}

TEST(RevolvedMesh, EnclosesTheSolid)
{
  EXPECT_NEAR(signedVolume(meshRevolved(vase(), anyFrame(), 0.02)), volumeOfVase(), 2e-3);
  EXPECT_NEAR(signedVolume(meshRevolved(bowl(), anyFrame(), 0.02)), volumeOfBowl(), 2e-3);
}

TEST(RevolvedMesh, PointsAndNormalsAreThoseOfTheMeridian)
{
  const RevolvedFrame frame = anyFrame();
  const TriangleMesh mesh = meshRevolved(vase(), frame, 0.1);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    const Vec3 p = mesh.points[k] - frame.origin;
    const double height = frame.axis.dot(p);
    const Vec3 across = p - height * frame.axis;
    EXPECT_NEAR(mesh.normals[k].norm(), 1.0, 1e-13);
    if (height > 1e-9 && height < 2.0 - 1e-9)
    {
      EXPECT_NEAR(across.norm(), waist(height), 1e-12);
      const Vec3 outward = across.normalized() - 0.6 * std::cos(3.0 * height) * frame.axis;
      EXPECT_LE((mesh.normals[k] - outward.normalized()).norm(), 1e-12);
    }
  }
}

TEST(RevolvedMesh, CreasesHaveARingOfMeanNormals)
{
  const RevolvedFrame frame;
  const TriangleMesh mesh = meshRevolved(bowl(), frame, 0.1);
  int onCrease = 0;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    const Vec3& p = mesh.points[k];
    if (std::abs(p.z() - std::sqrt(0.5)) < 1e-12)
    {
      ++onCrease;
      // Outward of the ball and towards the axis of the dint: straight up in the mean.
      EXPECT_LE((mesh.normals[k] - Vec3::UnitZ()).norm(), 1e-12);
    }
  }
  EXPECT_GE(onCrease, 2.0 * kPi * std::sqrt(0.5) / 0.1);
}

TEST(RevolvedMesh, ArcsAreSplitAtRightAngles)
{
  Meridian meridian(Meridian::Kind::Loop, true);
  meridian.addArc({ 2.0, 0.0 }, 1.0, 0.0, 2.0 * kPi);
  ASSERT_EQ(meridian.pieces().size(), 4u);
  EXPECT_NEAR(meridian.length(), 2.0 * kPi, 1e-14);
  const MeridianPoint top = meridian.at(0.5 * kPi);
  EXPECT_LE((top.position - Vec2(2.0, 1.0)).norm(), 1e-14);
  EXPECT_LE((top.normal - Vec2(0.0, 1.0)).norm(), 1e-14);
}

} // namespace
} // namespace hybridtree
