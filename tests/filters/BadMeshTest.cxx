// SPDX-License-Identifier: BSD-3-Clause
// What users load: each fault of a mesh gets an error that names it, and an empty output, or a
// stated repair.
#include "tests/filters/Support.h"

#include "vtkCellArray.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeCurveSkeletons.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkHybridTreePoint.h"
#include "vtkHybridTreeSubdivisionSkeleton.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <limits>

namespace hybridtree::test
{
namespace
{

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The four corners of a tetrahedron, and its triangles.
struct Tetrahedron
{
  Tetrahedron()
  {
    const double corners[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    for (const auto& corner : corners)
    {
      points->InsertNextPoint(corner);
    }
    data->SetPoints(points);
    this->addTriangle(0, 2, 1);
    this->addTriangle(0, 1, 3);
    this->addTriangle(1, 2, 3);
    this->addTriangle(2, 0, 3);
    data->SetPolys(cells);
  }

  void addTriangle(vtkIdType a, vtkIdType b, vtkIdType c)
  {
    const vtkIdType corners[3] = { a, b, c };
    cells->InsertNextCell(3, corners);
  }

  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkPolyData> data;
};

TEST(BadMesh, PointSetsNameTheReconstruction)
{
  Tetrahedron shape;
  shape.data->SetPolys(nullptr);
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputData(shape.data);
  expectError(
    blend, { "Input: The input is a point set", "4 points", "HybridTree Surface Reconstruction" });
}

TEST(BadMesh, EmptyData)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(empty);
  expectError(field, { "empty" });
  vtkNew<vtkHybridTreeSubdivisionSkeleton> skeleton;
  skeleton->SetInputData(empty);
  expectError(skeleton, { "empty", "the filter it comes from" });
}

TEST(BadMesh, CoordinatesThatAreNoNumbers)
{
  Tetrahedron shape;
  shape.points->SetPoint(2, 0.0, kNaN, 0.0);
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(shape.data);
  expectError(field, { "oint 2" });
  shape.points->SetPoint(2, 0.0, std::numeric_limits<double>::infinity(), 0.0);
  shape.points->Modified();
  shape.data->Modified();
  expectError(field, { "oint 2" });
}

TEST(BadMesh, AMeshOfNothingButDegenerateTriangles)
{
  Tetrahedron shape;
  shape.cells->Reset();
  shape.addTriangle(0, 1, 1);
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(shape.data);
  expectError(field, { "riangle" });
}

TEST(BadMesh, RepairsAreMadeAndTold)
{
  Tetrahedron shape;
  shape.addTriangle(0, 2, 1); // once more
  shape.addTriangle(0, 1, 1); // degenerate
  vtkNew<vtkHybridTreeMeshField> field;
  const Messages messages(field);
  field->SetInputData(shape.data);
  field->Update();
  EXPECT_EQ(messages.errors, "");
  EXPECT_NE(messages.warnings, "");
  EXPECT_EQ(field->GetOutput()->GetNumberOfPolys(), 4);
  expectSolid(field->GetOutput());
}

TEST(BadMesh, InsideOutMeshesAreTurned)
{
  Tetrahedron shape;
  shape.cells->Reset();
  shape.addTriangle(0, 1, 2);
  shape.addTriangle(0, 3, 1);
  shape.addTriangle(1, 3, 2);
  shape.addTriangle(2, 3, 0);
  vtkNew<vtkHybridTreeMeshField> field;
  const Messages messages(field);
  field->SetInputData(shape.data);
  field->Update();
  EXPECT_NE(messages.warnings, "");
  expectSolid(field->GetOutput());
}

TEST(BadMesh, OpenAndCrowdedMeshesAreToldOnce)
{
  for (const bool open : { true, false })
  {
    Tetrahedron shape;
    if (open)
    {
      shape.cells->Reset();
      shape.addTriangle(0, 2, 1);
      shape.addTriangle(0, 1, 3);
      shape.addTriangle(1, 2, 3);
    }
    else
    {
      const vtkIdType fin = shape.points->InsertNextPoint(2.0, 2.0, 2.0);
      shape.addTriangle(0, 1, fin);
    }
    vtkNew<vtkHybridTreeMeshField> field;
    Messages messages(field);
    field->SetInputData(shape.data);
    field->Update();
    EXPECT_EQ(messages.errors, "");
    EXPECT_NE(messages.warnings, "") << (open ? "open" : "crowded");
    EXPECT_GT(field->GetOutput()->GetNumberOfPolys(), 0);
    messages.warnings.clear();
    field->SetEdgeLength(0.3);
    field->Update();
    EXPECT_EQ(messages.warnings, "") << "the same node has nothing new to say";
    field->SetInfluenceRadius(0.3);
    field->Update();
    EXPECT_EQ(messages.warnings, "") << "nor has the next one";
  }
}

TEST(BadMesh, CellsOfPointsThatDoNotExist)
{
  for (const vtkIdType bad : { vtkIdType(-1), vtkIdType(4), vtkIdType(1) << 32 })
  {
    Tetrahedron shape;
    const vtkIdType corners[4] = { 0, 1, 2, bad };
    shape.cells->InsertNextCell(4, corners);
    vtkNew<vtkHybridTreeBlend> blend;
    blend->AddInputData(shape.data);
    const std::string which = "refers to point " + std::to_string(bad);
    expectError(blend, { "Cell 4 " + which, "4 points" });
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell(4, corners);
    shape.data->SetLines(lines);
    vtkNew<vtkHybridTreeCurveSkeletons> curves;
    curves->SetInputData(shape.data);
    expectError(curves, { "Cell 0 " + which });
  }
}

TEST(BadMesh, OperandsThatCannotKeepTheirTrianglesAreTold)
{
  vtkNew<vtkSphereSource> open;
  open->SetEndPhi(150.0);
  open->SetThetaResolution(40);
  open->SetPhiResolution(40);
  vtkNew<vtkHybridTreePoint> knob;
  knob->SetCenter(0.0, 0.0, 0.5);
  knob->SetSurfaceRadius(0.1);
  knob->SetInfluenceRadius(0.2);
  vtkNew<vtkHybridTreeBlend> blend;
  const Messages messages(blend);
  blend->AddInputConnection(open->GetOutputPort());
  blend->AddInputConnection(knob->GetOutputPort());
  blend->Update();
  EXPECT_NE(messages.warnings.find("Close its holes"), std::string::npos) << messages.warnings;
}

TEST(BadMesh, StripsPolygonsAndTheCellsBesideThem)
{
  // A pyramid: a concave base of five corners as one polygon, its sides as a strip and triangles.
  vtkNew<vtkPoints> points;
  const double corners[6][3] = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 1, 0.5, 0 }, { 0, 2, 0 },
    { 1, 0.25, 1 } };
  for (const auto& corner : corners)
  {
    points->InsertNextPoint(corner);
  }
  vtkNew<vtkCellArray> verts, lines, polys, strips;
  const vtkIdType base[5] = { 0, 4, 3, 2, 1 };
  polys->InsertNextCell(5, base);
  const vtkIdType sides[3][3] = { { 2, 3, 5 }, { 3, 4, 5 }, { 4, 0, 5 } };
  for (const auto& side : sides)
  {
    polys->InsertNextCell(3, side);
  }
  const vtkIdType strip[4] = { 0, 1, 5, 2 };
  strips->InsertNextCell(4, strip);
  verts->InsertNextCell(1, strip);
  lines->InsertNextCell(2, strip);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(verts);
  data->SetLines(lines);
  data->SetPolys(polys);
  data->SetStrips(strips);
  vtkNew<vtkHybridTreeMeshField> field;
  const Messages messages(field);
  field->SetInputData(data);
  field->Update();
  EXPECT_EQ(messages.errors + messages.warnings, "");
  expectSolid(field->GetOutput());
  // The base is the square less a triangle of base 2 and height 1.5.
  EXPECT_NEAR(signedVolume(trianglesOf(field->GetOutput())), (4.0 - 1.5) / 3.0, 1e-12);
}

} // namespace
} // namespace hybridtree::test
