// SPDX-License-Identifier: BSD-3-Clause
// Subdivision skeletons: the editor of coarse graphs, and the node over them.
#include "tests/filters/Support.h"

#include "core/nodes/Node.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeSkeletonEditor.h"
#include "vtkHybridTreeSubdivisionSkeleton.h"
#include "vtkLineSource.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPointSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace hybridtree::test
{
namespace
{

// A stem that branches into a leaf of two triangles.
void drawPlant(vtkHybridTreeSkeletonEditor* editor)
{
  const double points[][3] = { { 0, 0, -1 }, { 0, 0.1, 0 }, { 0, 0, 1 }, { 0.6, 0.5, 1.3 },
    { -0.6, 0.5, 1.4 }, { 0, 1, 1.6 } };
  editor->SetNumberOfPoints(6);
  for (int k = 0; k < 6; ++k)
  {
    editor->SetPoint(k, points[k][0], points[k][1], points[k][2]);
  }
  editor->SetNumberOfRadii(2);
  editor->SetRadius(0, 0.25);
  editor->SetRadius(1, 0.2);
  editor->SetNumberOfSegments(2);
  editor->SetSegment(0, 0, 1);
  editor->SetSegment(1, 1, 2);
  editor->SetNumberOfTriangles(2);
  editor->SetTriangle(0, 2, 3, 4);
  editor->SetTriangle(1, 3, 4, 5);
}

TEST(SkeletonEditor, WithoutElementsThePointsMakeOneCurve)
{
  vtkNew<vtkHybridTreeSkeletonEditor> editor;
  editor->SetNumberOfSegments(0);
  editor->SetNumberOfTriangles(0);
  editor->SetNumberOfPoints(4);
  for (int k = 0; k < 4; ++k)
  {
    editor->SetPoint(k, k, k % 2, 0.0);
  }
  editor->SetNumberOfRadii(1);
  editor->SetRadius(0, 0.3);
  editor->Update();
  vtkPolyData* coarse = editor->GetOutput(0);
  EXPECT_EQ(coarse->GetNumberOfPoints(), 4);
  EXPECT_EQ(coarse->GetNumberOfLines(), 3);
  vtkDataArray* radius = coarse->GetPointData()->GetArray("Radius");
  ASSERT_TRUE(radius);
  EXPECT_EQ(radius->GetRange()[0], 0.3);
  EXPECT_EQ(radius->GetRange()[1], 0.3);
}

TEST(SkeletonEditor, SecondOutputIsTheSubdividedGraph)
{
  vtkNew<vtkHybridTreeSkeletonEditor> editor;
  drawPlant(editor);
  for (const int scheme : { 0, 1 })
  {
    for (int level = 0; level < 4; ++level)
    {
      editor->SetScheme(scheme);
      editor->SetLevel(level);
      editor->Update();
      vtkPolyData* refined = editor->GetOutput(1);
      EXPECT_EQ(refined->GetNumberOfLines(), 2 << level);
      EXPECT_EQ(refined->GetNumberOfPolys(), 2 << (2 * level));
      vtkDataArray* parents = refined->GetCellData()->GetArray("CoarseElement");
      ASSERT_TRUE(parents);
      EXPECT_EQ(parents->GetNumberOfTuples(), refined->GetNumberOfCells());
      EXPECT_EQ(parents->GetRange()[0], 0.0);
      EXPECT_EQ(parents->GetRange()[1], 3.0);
    }
  }
}

TEST(SkeletonEditor, WrongTablesAreNamed)
{
  vtkNew<vtkHybridTreeSkeletonEditor> editor;
  drawPlant(editor);
  const auto expectError = [&](const std::string& word)
  {
    const Messages messages(editor);
    editor->Update();
    EXPECT_NE(messages.errors.find(word), std::string::npos) << messages.errors;
    EXPECT_EQ(editor->GetOutput(0)->GetNumberOfPoints(), 0);
    EXPECT_EQ(editor->GetOutput(1)->GetNumberOfPoints(), 0);
  };
  editor->SetSegment(1, 1, 17);
  expectError("segment 1");
  editor->SetSegment(1, 1, 2);
  editor->SetRadius(1, 0.0);
  expectError("radius");
  editor->SetRadius(1, 0.2);
  editor->SetLevel(7);
  expectError("Level");
  editor->SetLevel(1);
  editor->SetScheme(4);
  expectError("Scheme");
  editor->SetScheme(0);
  const Messages messages(editor);
  editor->SetTriangle(5, 0, 1, 2);
  EXPECT_NE(messages.errors.find("element 5"), std::string::npos) << messages.errors;
}

TEST(SubdivisionSkeleton, GraphOfTheEditorBecomesASolid)
{
  vtkNew<vtkHybridTreeSkeletonEditor> editor;
  drawPlant(editor);
  vtkNew<vtkHybridTreeSubdivisionSkeleton> plant;
  plant->SetInputConnection(editor->GetOutputPort(0));
  plant->SetEdgeLength(0.08);
  for (const int scheme : { 0, 1 })
  {
    for (const int blending : { 0, 1 })
    {
      SCOPED_TRACE("scheme " + std::to_string(scheme) + " blending " + std::to_string(blending));
      plant->SetScheme(scheme);
      plant->SetBlending(blending);
      plant->Update();
      expectSolid(plant->GetOutput());
      EXPECT_EQ(plant->GetOutput(1)->GetNumberOfLines(), 8);
      EXPECT_EQ(plant->GetOutput(1)->GetNumberOfPolys(), 32);
    }
  }
}

TEST(SubdivisionSkeleton, StraightSkeletonHasItsRadius)
{
  vtkNew<vtkLineSource> line;
  line->SetPoint1(-3, 0, 0);
  line->SetPoint2(3, 0, 0);
  line->SetResolution(5);
  vtkNew<vtkHybridTreeSubdivisionSkeleton> rod;
  rod->SetInputConnection(line->GetOutputPort());
  rod->SetRadius(0.4);
  for (const int level : { 0, 2 })
  {
    rod->SetLevel(level);
    rod->Update();
    EXPECT_NEAR(fieldAt(*rod->GetTree(), { 0.1, 0.4, 0.0 }), kThreshold, 1e-9);
    EXPECT_NEAR(fieldAt(*rod->GetTree(), { -1.3, 0.0, -0.4 }), kThreshold, 1e-9);
  }
}

TEST(SubdivisionSkeleton, DefaultRadiusFitsTheInput)
{
  for (const double length : { 0x1p-10, 1.0, 500.0 }) // as float, too
  {
    vtkNew<vtkLineSource> line;
    line->SetPoint1(0, 0, 0);
    line->SetPoint2(length, 0, 0);
    vtkNew<vtkHybridTreeSubdivisionSkeleton> rod;
    rod->SetInputConnection(line->GetOutputPort());
    rod->Update();
    EXPECT_GT(rod->GetOutput()->GetNumberOfPolys(), 0);
    EXPECT_NEAR(fieldAt(*rod->GetTree(), { 0.5 * length, 0.03 * length, 0.0 }), kThreshold, 1e-9);
  }
}

TEST(SubdivisionSkeleton, PiecesAtTheSamePlaceHangTogether)
{
  vtkNew<vtkLineSource> line;
  line->SetPoint1(0.5, 0.5, 0);
  line->SetPoint2(2, 0.5, 0);
  vtkNew<vtkPlaneSource> plane; // polygons of four corners
  plane->SetOrigin(-0.5, -0.5, 0);
  plane->SetPoint1(0.5, -0.5, 0);
  plane->SetPoint2(-0.5, 0.5, 0);
  plane->SetResolution(2, 2);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(line->GetOutputPort());
  both->AddInputConnection(plane->GetOutputPort());
  vtkNew<vtkHybridTreeSubdivisionSkeleton> shape;
  shape->SetInputConnection(both->GetOutputPort());
  shape->SetRadius(0.2);
  shape->SetLevel(0);
  shape->Update();
  EXPECT_EQ(shape->GetOutput(1)->GetNumberOfPoints(), 10);
  expectSolid(shape->GetOutput());
  const TriangleMesh mesh = trianglesOf(shape->GetOutput());
  EXPECT_EQ(checkMesh(mesh).components, 1);
}

TEST(SubdivisionSkeleton, CellsOfTooFewPointsDoNotCount)
{
  vtkNew<vtkHybridTreeSkeletonEditor> editor;
  drawPlant(editor);
  editor->Update();
  vtkNew<vtkPolyData> plant;
  plant->ShallowCopy(editor->GetOutput());
  vtkNew<vtkHybridTreeSubdivisionSkeleton> skeleton;
  skeleton->SetInputData(plant);
  skeleton->Update();
  const vtkIdType count = skeleton->GetOutput()->GetNumberOfPoints();
  const vtkIdType ids[2] = { 0, 1 };
  vtkNew<vtkCellArray> lines, polygons;
  for (int size = 0; size < 3; ++size)
  {
    polygons->InsertNextCell(size, ids);
    lines->InsertNextCell(std::min(size, 1), ids);
  }
  lines->Append(plant->GetLines());
  polygons->Append(plant->GetPolys());
  plant->SetLines(lines);
  plant->SetPolys(polygons);
  skeleton->Modified();
  skeleton->Update();
  EXPECT_GT(count, 100);
  EXPECT_EQ(skeleton->GetOutput()->GetNumberOfPoints(), count);
}

TEST(SubdivisionSkeleton, BlendsWithoutAMeshOfItsOwn)
{
  vtkNew<vtkHybridTreeSkeletonEditor> editor;
  drawPlant(editor);
  vtkNew<vtkHybridTreeSubdivisionSkeleton> plant;
  plant->SetInputConnection(editor->GetOutputPort(0));
  plant->SetRadiusArray("Radius");
  const auto pot = ball();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(plant->GetOutputPort());
  blend->AddInputConnection(pot->GetOutputPort());
  blend->SetEdgeLength(0.1);
  blend->Update();
  expectSolid(blend->GetOutput());
  EXPECT_EQ(plant->GetNumberOfMeshings(), 0);
}

TEST(SubdivisionSkeleton, PreviewOverlapsAndKeepsTheTree)
{
  vtkNew<vtkHybridTreeSkeletonEditor> editor;
  drawPlant(editor);
  vtkNew<vtkHybridTreeSubdivisionSkeleton> plant;
  plant->SetInputConnection(editor->GetOutputPort(0));
  plant->Update();
  const TriangleMesh whole = trianglesOf(plant->GetOutput());
  const auto tree = plant->GetTree();
  plant->PreviewOn();
  plant->Update();
  const TriangleMesh pieces = trianglesOf(plant->GetOutput());
  EXPECT_EQ(checkMesh(whole).components, 1);
  EXPECT_EQ(checkMesh(pieces).components, 2); // a curve and a leaf
  EXPECT_TRUE(isClosedManifold(pieces));
  expectSameField(*tree, *plant->GetTree());
}

TEST(SubdivisionSkeleton, NoSurfaceIsTold)
{
  vtkNew<vtkLineSource> line;
  vtkNew<vtkHybridTreeSubdivisionSkeleton> shape;
  shape->SetInputConnection(line->GetOutputPort());
  shape->SetRadius(100.0);
  for (const bool preview : { false, true })
  {
    shape->SetPreview(preview);
    const Messages messages(shape);
    shape->Update();
    EXPECT_NE(messages.warnings.find("no surface"), std::string::npos) << messages.warnings;
    EXPECT_EQ(shape->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_TRUE(shape->GetTree());
  }
  const Messages messages(shape);
  shape->NegativeOn(); // as it should be
  shape->Update();
  EXPECT_EQ(messages.warnings, "");
}

TEST(SubdivisionSkeleton, PointThatIsNotFiniteIsNamed)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 0, 0);
  points->InsertNextPoint(std::nan(""), 1, 0);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1, 2 });
  vtkNew<vtkPolyData> bent;
  bent->SetPoints(points);
  bent->SetLines(lines);
  vtkNew<vtkHybridTreeSubdivisionSkeleton> shape;
  shape->SetInputData(bent);
  const Messages messages(shape);
  shape->Update();
  EXPECT_NE(messages.errors.find("Point 2"), std::string::npos) << messages.errors;
}

TEST(SubdivisionSkeleton, WrongInputIsNamed)
{
  vtkNew<vtkHybridTreeSubdivisionSkeleton> shape;
  const auto expectError = [&](const std::string& word)
  {
    const Messages messages(shape);
    shape->Update();
    EXPECT_NE(messages.errors.find(word), std::string::npos) << messages.errors;
    EXPECT_EQ(shape->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_FALSE(shape->GetTree());
  };
  vtkNew<vtkPointSource> points;
  shape->SetInputConnection(points->GetOutputPort());
  expectError("neither lines nor polygons");
  vtkNew<vtkLineSource> line;
  shape->SetInputConnection(line->GetOutputPort());
  shape->SetRadiusArray("Thickness");
  expectError("Thickness");
  shape->SetRadiusArray("None");
  shape->SetRadius(-1.0);
  expectError("adius");
  shape->SetRadius(0.1);
  for (const auto& [name, set] :
    std::vector<std::pair<std::string, std::function<void(double)>>>{
      { "Level", [&](double v) { shape->SetLevel(static_cast<int>(v)); } },
      { "Scheme", [&](double v) { shape->SetScheme(static_cast<int>(v)); } },
      { "Blending", [&](double v) { shape->SetBlending(static_cast<int>(v)); } },
      { "Kernel", [&](double v) { shape->SetKernel(static_cast<int>(v)); } },
      { "Exponent", [&](double v) { shape->SetExponent(static_cast<int>(v)); } },
      { "InfluenceRatio", [&](double v) { shape->SetInfluenceRatio(v); } },
      { "Refinement", [&](double v) { shape->SetRefinement(v); } } })
  {
    SCOPED_TRACE(name);
    set(-3.0);
    expectError(name);
    set(name == "Exponent" || name == "InfluenceRatio" ? 2.0 : 1.0);
  }
}

} // namespace
} // namespace hybridtree::test
