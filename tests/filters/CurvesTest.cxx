// SPDX-License-Identifier: BSD-3-Clause
// Splines, surfaces of revolution, and curves of a polydata as one node.
#include "tests/filters/Support.h"

#include "core/nodes/Node.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkHybridTreeCurveSkeletons.h"
#include "vtkHybridTreePolygon.h"
#include "vtkHybridTreeSpline.h"
#include "vtkHybridTreeSurfaceOfRevolution.h"
#include "vtkMassProperties.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace hybridtree::test
{
namespace
{

// Two arches that cross, and a vertex beside them.
class Drawing
{
public:
  Drawing()
  {
    radius->SetName("Thickness");
    for (int curve = 0; curve < 2; ++curve)
    {
      vtkIdType ids[9];
      for (int k = 0; k < 9; ++k)
      {
        const double t = 0.25 * k - 1.0;
        ids[k] = points->InsertNextPoint(curve == 0 ? t : 0.0, curve == 0 ? 0.0 : t, 1.0 - t * t);
        radius->InsertNextValue(0.1 - 0.05 * std::abs(t));
      }
      lines->InsertNextCell(9, ids);
    }
    const vtkIdType alone = points->InsertNextPoint(0.0, 0.0, 0.0);
    radius->InsertNextValue(0.2);
    verts->InsertNextCell(1, &alone);
    data->SetPoints(points);
    data->SetLines(lines);
    data->SetVerts(verts);
    data->GetPointData()->AddArray(radius);
  }

  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkCellArray> verts;
  vtkNew<vtkDoubleArray> radius;
  vtkNew<vtkPolyData> data;
};

double volumeOf(vtkPolyData* mesh)
{
  vtkNew<vtkMassProperties> mass;
  mass->SetInputData(mesh);
  return mass->GetVolume();
}

TEST(Curves, SourcesAreSolidByDefault)
{
  vtkNew<vtkHybridTreeSpline> spline;
  vtkNew<vtkHybridTreeSurfaceOfRevolution> vase;
  for (vtkHybridTreeAlgorithm* source :
    { static_cast<vtkHybridTreeAlgorithm*>(spline), static_cast<vtkHybridTreeAlgorithm*>(vase) })
  {
    SCOPED_TRACE(source->GetClassName());
    source->Update();
    expectSolid(source->GetOutput());
  }
}

TEST(Curves, RevolutionTakesPointsFromAnywhereAround)
{
  vtkNew<vtkHybridTreeSurfaceOfRevolution> vase;
  vase->Update();
  const double volume = volumeOf(vase->GetOutput());
  for (int k = 0; k < vase->GetNumberOfPoints(); ++k)
  {
    double p[3];
    vase->GetPoint(k, p);
    vase->SetPoint(k, p[0] * std::cos(k), p[0] * std::sin(k), p[2]);
  }
  vase->Update();
  EXPECT_NEAR(volumeOf(vase->GetOutput()), volume, 1e-6 * volume);
}

// The points of the default profile as lines: as one polyline, and in pieces that run either way.
vtkNew<vtkPolyData> drawnVase(bool inPieces)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  points->SetDataTypeToDouble();
  vtkNew<vtkHybridTreeSurfaceOfRevolution> vase;
  for (int k = 0; k < vase->GetNumberOfPoints(); ++k)
  {
    double p[3];
    vase->GetPoint(k, p);
    points->InsertNextPoint(p);
  }
  if (inPieces)
  {
    for (const auto& [a, b] : { std::pair{ 2, 1 }, { 0, 1 }, { 2, 3 } })
    {
      const vtkIdType ids[2] = { a, b };
      lines->InsertNextCell(2, ids);
    }
  }
  else
  {
    const vtkIdType ids[4] = { 0, 1, 2, 3 };
    lines->InsertNextCell(4, ids);
  }
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

TEST(Curves, TheProfileMayBeDrawn)
{
  vtkNew<vtkHybridTreeSurfaceOfRevolution> vase;
  vase->SetEdgeLength(0.05);
  vase->Update();
  const double volume = volumeOf(vase->GetOutput());
  vase->SetNumberOfPoints(1); // which nobody asks for with an input
  for (const bool inPieces : { false, true })
  {
    const vtkNew<vtkPolyData> drawing = drawnVase(inPieces);
    vase->SetInputData(drawing);
    vase->Update();
    expectSolid(vase->GetOutput());
    EXPECT_NEAR(volumeOf(vase->GetOutput()), volume, 1e-6 * volume);
    drawing->GetPoints()->SetPoint(1, 1.2, 0.0, -0.4);
    drawing->GetPoints()->Modified();
    drawing->Modified();
    vase->Update();
    EXPECT_GT(volumeOf(vase->GetOutput()), 1.1 * volume);
  }
  vase->SetInputData(nullptr);
  expectError(vase, { "oints" });
}

TEST(Curves, LinesThatCloseAreAClosedProfile)
{
  const vtkNew<vtkPolyData> drawing = drawnVase(true);
  const vtkIdType last[2] = { 0, 3 };
  drawing->GetLines()->InsertNextCell(2, last);
  vtkNew<vtkHybridTreeSurfaceOfRevolution> ring;
  ring->SetInputData(drawing);
  ring->SetKind(vtkHybridTreeSurfaceOfRevolution::POLYLINE);
  ring->Update();
  expectSolid(ring->GetOutput());
  const double drawn = volumeOf(ring->GetOutput());
  vtkNew<vtkHybridTreeSurfaceOfRevolution> same;
  same->SetKind(vtkHybridTreeSurfaceOfRevolution::POLYLINE);
  same->ClosedOn();
  same->Update();
  EXPECT_NEAR(drawn, volumeOf(same->GetOutput()), 1e-6 * drawn);
}

TEST(Curves, AllCurvesAreOneNode)
{
  Drawing drawing;
  vtkNew<vtkHybridTreeCurveSkeletons> curves;
  curves->SetInputData(drawing.data);
  curves->SetSurfaceRadius(0.1);
  curves->SetEdgeLength(0.05);
  for (const int as :
    { vtkHybridTreeCurveSkeletons::SEGMENTS, vtkHybridTreeCurveSkeletons::SPLINE })
  {
    for (const int blend :
      { vtkHybridTreeCurveSkeletons::WITHIN_CURVE, vtkHybridTreeCurveSkeletons::ACROSS_ALL })
    {
      for (const char* array : { "None", "Thickness" })
      {
        SCOPED_TRACE(std::to_string(as) + std::to_string(blend) + array);
        curves->SetAs(as);
        curves->SetBlend(blend);
        curves->SetRadiusArray(array);
        curves->Update();
        expectSolid(curves->GetOutput());
        EXPECT_EQ(curves->GetTree()->leafCount(), 3);
      }
    }
  }
}

TEST(Curves, BlendsAcrossAreLargerThanUnions)
{
  Drawing drawing;
  vtkNew<vtkHybridTreeCurveSkeletons> curves;
  curves->SetInputData(drawing.data);
  curves->SetSurfaceRadius(0.1);
  curves->SetEdgeLength(0.05);
  curves->Update();
  const double blended = volumeOf(curves->GetOutput());
  curves->SetBlend(vtkHybridTreeCurveSkeletons::WITHIN_CURVE);
  curves->Update();
  EXPECT_GT(blended, 1.001 * volumeOf(curves->GetOutput()));
}

TEST(Curves, TheRadiusArrayIsTheRadiusOfTheSurface)
{
  Drawing drawing;
  vtkNew<vtkHybridTreeCurveSkeletons> curves;
  curves->SetInputData(drawing.data);
  curves->SetRadiusArray("Thickness");
  curves->SetBlend(vtkHybridTreeCurveSkeletons::WITHIN_CURVE);
  curves->Update();
  // The ball of the vertex, and the ends of the first arch.
  const double x[4] = { 0.0, 0.0, 1.0, -1.0 };
  const double y[4] = { 0.1999, 0.2001, 0.0499, 0.0501 };
  const double z[4] = { 0.0, 0.0, 0.0, 0.0 };
  std::int8_t side[4];
  curves->GetTree()->membership({ x, y, z, 4 }, side);
  EXPECT_EQ(side[0], 1);
  EXPECT_EQ(side[1], -1);
  EXPECT_EQ(side[2], 1);
  EXPECT_EQ(side[3], -1);
}

TEST(Curves, DefaultRadiiFitTheInput)
{
  Drawing drawing;
  vtkNew<vtkHybridTreeCurveSkeletons> curves;
  curves->SetInputData(drawing.data);
  curves->Update();
  expectSolid(curves->GetOutput());
  const double volume = volumeOf(curves->GetOutput());
  for (vtkIdType k = 0; k < drawing.points->GetNumberOfPoints(); ++k)
  {
    double x[3];
    drawing.points->GetPoint(k, x);
    drawing.points->SetPoint(k, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
  }
  drawing.data->Modified();
  curves->Update();
  EXPECT_NEAR(volumeOf(curves->GetOutput()), 1e9 * volume, 1e7 * volume);
  curves->SetInfluenceRadius(10.0); // less than twice the radius that fits
  curves->Update();
  expectSolid(curves->GetOutput());
  EXPECT_LT(volumeOf(curves->GetOutput()), 1e8 * volume);
}

TEST(Curves, AnEditOfTheInputIsSeen)
{
  Drawing drawing;
  vtkNew<vtkHybridTreeCurveSkeletons> curves;
  curves->SetInputData(drawing.data);
  curves->Update();
  const auto before = curves->GetTree();
  curves->Modified();
  drawing.points->SetPoint(18, 0.0, 0.0, 5.0);
  drawing.points->Modified();
  drawing.data->Modified();
  curves->Update();
  EXPECT_NE(curves->GetTree(), before);
  EXPECT_GT(curves->GetOutput()->GetBounds()[5], 5.0);
}

TEST(Curves, BadInputsAreNamed)
{
  vtkNew<vtkHybridTreeCurveSkeletons> curves;
  vtkNew<vtkSphereSource> sphere;
  curves->SetInputConnection(sphere->GetOutputPort());
  expectError(curves, { "neither vertices nor lines", "96 polygons" });
  Drawing drawing;
  curves->SetInputData(drawing.data);
  curves->SetRadiusArray("Width");
  expectError(curves, { "RadiusArray", "Width" });
  curves->SetRadiusArray("Thickness");
  drawing.radius->SetValue(4, -1.0);
  drawing.data->Modified();
  expectError(curves, { "point 4", "-1", ">= 0" });
  drawing.radius->SetValue(4, 0.1);
  drawing.points->SetPoint(3, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  drawing.data->Modified();
  expectError(curves, { "Point 3", "not finite" });

  vtkNew<vtkHybridTreeSpline> spline;
  spline->SetKind(2);
  expectError(spline, { "Kind", "B-spline" });
  spline->SetKind(1);
  spline->SetLevelOfDetail(5);
  expectError(spline, { "LevelOfDetail", "from 0 to 4" });
  spline->SetLevelOfDetail(4);
  spline->SetNumberOfPoints(0);
  expectError(spline, { "Points", "empty" });
  vtkNew<vtkHybridTreeSurfaceOfRevolution> vase;
  vase->SetAxis(0.0, 0.0, 0.0);
  expectError(vase, { "Axis" });
  vase->SetAxis(0.0, 0.0, 1.0);
  vtkNew<vtkPolyData> nothing;
  vase->SetInputData(nothing);
  expectError(vase, { "neither lines nor a polygon" });
}

TEST(Curves, LowerLevelsOfDetailHaveFewerPointsButNearlyTheSameShape)
{
  vtkNew<vtkHybridTreeSpline> spline;
  spline->SetNumberOfPoints(60);
  for (int k = 0; k < 60; ++k)
  {
    const double t = 2.0 * vtkMath::Pi() * k / 60.0;
    spline->SetPoint(k, std::cos(t), std::sin(t), 0.01 * std::sin(20.0 * t));
  }
  spline->ClosedOn();
  spline->Update();
  const double exact = volumeOf(spline->GetOutput());
  spline->SetLevelOfDetail(0);
  spline->Update();
  EXPECT_NEAR(volumeOf(spline->GetOutput()), exact, 0.05 * exact);
}

TEST(Curves, PolygonsHaveLevelsOfDetail)
{
  vtkNew<vtkHybridTreePolygon> polygon;
  polygon->SetNumberOfPoints(100);
  for (int k = 0; k < 100; ++k)
  {
    const double t = 2.0 * vtkMath::Pi() * k / 100.0;
    polygon->SetPoint(k, std::cos(t), std::sin(t), 0.0);
  }
  polygon->Update();
  const double exact = volumeOf(polygon->GetOutput());
  const auto corners = [&]
  { return polygon->GetTree()->parameters().getDoubles("points").size() / 3; };
  EXPECT_EQ(corners(), 100u);
  polygon->SetLevelOfDetail(0);
  polygon->Update();
  EXPECT_LT(corners(), 30u);
  EXPECT_NEAR(volumeOf(polygon->GetOutput()), exact, 0.1 * exact);
  polygon->SetLevelOfDetail(-1);
  expectError(polygon, { "LevelOfDetail", "from 0 to 4" });
}

} // namespace
} // namespace hybridtree::test
