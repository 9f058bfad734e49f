// SPDX-License-Identifier: BSD-3-Clause
// Normals, SourceId, SourceNames, and the arrays of mesh inputs.
#include "tests/filters/Support.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkTriangle.h"
#include "vtkVariantArray.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace hybridtree::test
{
namespace
{

/// A sphere with the height of each point, the index of each cell and a text per cell.
vtkSmartPointer<vtkPolyData> paintedSphere()
{
  vtkNew<vtkSphereSource> source;
  source->Update();
  auto sphere = vtkSmartPointer<vtkPolyData>::New();
  sphere->ShallowCopy(source->GetOutput());
  vtkNew<vtkFloatArray> height;
  height->SetName("Height");
  vtkNew<vtkIntArray> index;
  index->SetName("Index");
  vtkNew<vtkStringArray> label;
  label->SetName("Label");
  for (vtkIdType k = 0; k < sphere->GetNumberOfPoints(); ++k)
  {
    height->InsertNextValue(static_cast<float>(sphere->GetPoint(k)[2]));
  }
  for (vtkIdType k = 0; k < sphere->GetNumberOfCells(); ++k)
  {
    index->InsertNextValue(static_cast<int>(k));
    label->InsertNextValue("cell " + std::to_string(k));
  }
  sphere->GetPointData()->AddArray(height);
  sphere->GetCellData()->AddArray(index);
  sphere->GetCellData()->AddArray(label);
  return sphere;
}

/// Expects that heights are those of the points, moved up by `up`, and that labels go with indices.
void expectPainted(vtkPolyData* data, double up)
{
  vtkDataArray* height = data->GetPointData()->GetArray("Height");
  vtkDataArray* index = data->GetCellData()->GetArray("Index");
  auto* label = vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("Label"));
  ASSERT_TRUE(height && index && label);
  EXPECT_EQ(height->GetDataType(), VTK_FLOAT);
  ASSERT_EQ(height->GetNumberOfTuples(), data->GetNumberOfPoints());
  ASSERT_EQ(index->GetNumberOfTuples(), data->GetNumberOfCells());
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
  {
    ASSERT_NEAR(height->GetTuple1(k), data->GetPoint(k)[2] - up, 1e-6) << "point " << k;
  }
  std::set<int> seen;
  for (vtkIdType k = 0; k < data->GetNumberOfCells(); ++k)
  {
    const int cell = static_cast<int>(index->GetTuple1(k));
    ASSERT_EQ(label->GetValue(k), "cell " + std::to_string(cell));
    seen.insert(cell);
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(data->GetNumberOfCells()));
}

TEST(Arrays, FollowAMeshThroughNodesAndFiles)
{
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(paintedSphere());
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(field->GetOutputPort());
  move->SetTranslate(0.0, 0.0, 2.0);
  move->Update();
  EXPECT_EQ(field->GetNumberOfMeshings(), 0) << "arrays must not need the mesh between";
  expectPainted(move->GetOutput(), 2.0);

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(move->GetOutputPort());
  writer->WriteToOutputStringOn();
  writer->SetDataModeToBinary(); // newer expat does not let VTK 9.2 read its own appended files
  writer->Write();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(writer->GetOutputString());
  vtkNew<vtkHybridTreeAffineTransform> again;
  again->SetInputConnection(reader->GetOutputPort());
  again->SetTranslate(0.0, 0.0, 1.0);
  again->Update();
  expectPainted(again->GetOutput(), 3.0);
}

TEST(Arrays, NormalsOfTheInputStayBehind)
{
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(paintedSphere()); // has point normals
  field->Update();
  vtkDataArray* normals = field->GetOutput()->GetPointData()->GetNormals();
  ASSERT_TRUE(normals);
  EXPECT_EQ(normals->GetNumberOfTuples(), field->GetOutput()->GetNumberOfPoints());
  for (vtkIdType k = 0; k < normals->GetNumberOfTuples(); ++k)
  {
    const Vec3 normal(normals->GetTuple3(k));
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    EXPECT_GT(normal.dot(Vec3(field->GetOutput()->GetPoint(k))), 0.0);
  }
}

TEST(Arrays, ActiveOnesStayActive)
{
  const auto sphere = paintedSphere();
  sphere->GetPointData()->SetActiveScalars("Height");
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(sphere);
  vtkNew<vtkHybridTreeAffineTransform> moved;
  moved->SetInputConnection(field->GetOutputPort());
  moved->SetTranslate(0.0, 0.0, 3.0);
  moved->Update();
  vtkPolyData* output = moved->GetOutput();
  ASSERT_TRUE(output->GetPointData()->GetScalars());
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "Height");
  EXPECT_FALSE(output->GetPointData()->GetTCoords());
  EXPECT_FALSE(output->GetPointData()->HasArray(""));
  EXPECT_TRUE(output->GetPointData()->GetNormals());
}

// Views color by active scalars: what has none would be shown as missing.
TEST(Arrays, ScalarsOfAPartAreNotActive)
{
  const auto sphere = paintedSphere();
  sphere->GetPointData()->SetActiveScalars("Height");
  const auto round = ball(0.9); // out of the mesh's reach
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputData(sphere);
  blend->AddInputConnection(round->GetOutputPort());
  blend->Update();
  EXPECT_TRUE(blend->GetOutput()->GetPointData()->HasArray("Height"));
  EXPECT_FALSE(blend->GetOutput()->GetPointData()->GetScalars());
}

vtkDataArray* normalsOf(vtkHybridTreeAlgorithm* filter)
{
  filter->Update();
  return filter->GetOutput()->GetPointData()->GetNormals();
}

// A drilled block has faces of two triangles, whose corners have one normal for three faces.
TEST(Arrays, NormalsAreLeftOutWhereTheySmearLargeTriangles)
{
  vtkNew<vtkCubeSource> cube;
  vtkNew<vtkHybridTreeBoolean> drilled;
  drilled->SetOperation(vtkHybridTreeBoolean::DIFFERENCE);
  drilled->SetInputConnection(0, cube->GetOutputPort());
  const auto drill = rod();
  drilled->SetInputConnection(1, drill->GetOutputPort());
  EXPECT_FALSE(normalsOf(drilled));
  const auto node = drilled->GetTree();
  drilled->SetPointNormals(vtkHybridTreeAlgorithm::NORMALS_ALWAYS);
  ASSERT_TRUE(normalsOf(drilled));
  EXPECT_EQ(normalsOf(drilled)->GetNumberOfTuples(), drilled->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(drilled->GetTree(), node);

  const auto round = ball();
  EXPECT_TRUE(normalsOf(round));
  round->SetPointNormals(vtkHybridTreeAlgorithm::NORMALS_NEVER);
  EXPECT_FALSE(normalsOf(round));
  round->SetPointNormals(17);
  EXPECT_EQ(round->GetPointNormals(), vtkHybridTreeAlgorithm::NORMALS_SPLIT);
}

// Both sides of a rim have normals of their own, and what is fed with the output does not notice.
TEST(Arrays, SplitNormalsAreThoseOfTheirSide)
{
  vtkNew<vtkCubeSource> cube;
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputConnection(cube->GetOutputPort());
  vtkNew<vtkHybridTreeBoolean> drilled;
  drilled->SetOperation(vtkHybridTreeBoolean::DIFFERENCE);
  drilled->SetInputConnection(0, elevation->GetOutputPort());
  const auto drill = rod();
  drilled->SetInputConnection(1, drill->GetOutputPort());
  drilled->Update();
  const vtkIdType closedPoints = drilled->GetOutput()->GetNumberOfPoints();
  const vtkIdType triangles = drilled->GetOutput()->GetNumberOfCells();
  drilled->SetPointNormals(vtkHybridTreeAlgorithm::NORMALS_SPLIT);
  vtkDataArray* normals = normalsOf(drilled);
  vtkPolyData* output = drilled->GetOutput();
  ASSERT_TRUE(normals);
  EXPECT_GT(output->GetNumberOfPoints(), closedPoints);
  EXPECT_EQ(output->GetNumberOfCells(), triangles);
  for (vtkIdType t = 0; t < triangles; ++t)
  {
    vtkCell* cell = output->GetCell(t);
    double p[3][3], own[3], side[3];
    for (int k = 0; k < 3; ++k)
    {
      output->GetPoint(cell->GetPointId(k), p[k]);
    }
    vtkTriangle::ComputeNormal(p[0], p[1], p[2], own);
    for (int k = 0; k < 3; ++k)
    {
      normals->GetTuple(cell->GetPointId(k), side);
      EXPECT_GT(vtkMath::Dot(own, side), 0.9) << "triangle " << t;
    }
  }
  vtkDataArray* heights = output->GetPointData()->GetArray("Elevation");
  ASSERT_TRUE(heights);
  EXPECT_EQ(heights->GetNumberOfTuples(), output->GetNumberOfPoints());

  vtkNew<vtkHybridTreeBoolean> next;
  next->SetInputConnection(0, drilled->GetOutputPort());
  const auto knob = ball(5.0);
  next->SetInputConnection(1, knob->GetOutputPort());
  next->Update();
  EXPECT_EQ(next->GetTree()->children()[0], drilled->GetTree());

  vtkNew<vtkHybridTreeMeshField> plain; // without the tree, by welding
  vtkNew<vtkPolyData> bare;
  bare->CopyStructure(output);
  plain->SetInputData(bare);
  plain->Update();
  EXPECT_EQ(plain->GetOutput()->GetNumberOfPoints(), closedPoints);
}

TEST(Arrays, SourceIdNamesLeaves)
{
  const auto left = ball(-3.0);
  vtkNew<vtkHybridTreeMeshField> mesh;
  vtkNew<vtkSphereSource> sphere;
  mesh->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(left->GetOutputPort());
  blend->AddInputConnection(mesh->GetOutputPort());
  blend->SetEdgeLength(0.1);
  blend->Update();
  vtkPolyData* output = blend->GetOutput();
  auto* names =
    vtkStringArray::SafeDownCast(output->GetFieldData()->GetAbstractArray("SourceNames"));
  ASSERT_TRUE(names);
  ASSERT_EQ(names->GetNumberOfValues(), 2);
  EXPECT_EQ(names->GetValue(0), "Point 0");
  EXPECT_EQ(names->GetValue(1), "Mesh 1");
  vtkDataArray* source = output->GetCellData()->GetArray("SourceId");
  ASSERT_TRUE(source);
  ASSERT_EQ(source->GetNumberOfTuples(), output->GetNumberOfCells());
  for (vtkIdType k = 0; k < output->GetNumberOfCells(); ++k)
  {
    double bounds[6];
    output->GetCellBounds(k, bounds);
    ASSERT_EQ(source->GetTuple1(k), bounds[0] < -1.5 ? 0.0 : 1.0) << "cell " << k;
  }
}

TEST(Arrays, OneMeshWithTwoValuesIsTold)
{
  const auto a = paintedSphere();
  vtkNew<vtkPolyData> b;
  b->DeepCopy(a);
  b->GetPointData()->GetArray("Height")->SetComponent(3, 0, 77.0);
  vtkNew<vtkHybridTreeBoolean> both;
  const Messages messages(both);
  both->SetInputData(0, a);
  both->SetInputData(1, b);
  both->SetEdgeLength(0.2);
  both->Update();
  EXPECT_NE(messages.warnings.find("Height"), std::string::npos) << messages.warnings;
}

TEST(Arrays, ThoseWithTooFewValuesAreToldAndLeftOut)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkPolyData* mesh = sphere->GetOutput();
  vtkNew<vtkDoubleArray> few;
  few->SetName("few");
  few->InsertNextValue(1.0);
  mesh->GetPointData()->AddArray(few);
  mesh->GetCellData()->AddArray(few);
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(mesh);
  const Messages messages(field);
  field->Update();
  EXPECT_NE(messages.warnings.find("\"few\" has 1 values for 50 points"), std::string::npos)
    << messages.warnings;
  expectSolid(field->GetOutput());
  EXPECT_FALSE(field->GetOutput()->GetPointData()->HasArray("few"));
  EXPECT_FALSE(field->GetOutput()->GetCellData()->HasArray("few"));
}

TEST(Arrays, VariantsAreToldOnceAndLeftOut)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkPolyData* mesh = sphere->GetOutput();
  vtkNew<vtkVariantArray> anything;
  anything->SetName("anything");
  anything->SetNumberOfTuples(mesh->GetNumberOfCells());
  mesh->GetCellData()->AddArray(anything);
  const auto b = ball(0.4);
  vtkNew<vtkHybridTreeBlend> blend;
  vtkNew<vtkHybridTreeBoolean> boolean;
  blend->AddInputData(mesh);
  blend->AddInputConnection(b->GetOutputPort());
  boolean->SetInputData(0, mesh);
  boolean->SetInputConnection(1, b->GetOutputPort());
  for (vtkHybridTreeAlgorithm* filter : { static_cast<vtkHybridTreeAlgorithm*>(blend.Get()),
         static_cast<vtkHybridTreeAlgorithm*>(boolean.Get()) })
  {
    const Messages messages(filter);
    filter->Update();
    const std::size_t first = messages.warnings.find("\"anything\" holds variants");
    EXPECT_NE(first, std::string::npos) << messages.warnings;
    EXPECT_EQ(messages.warnings.find("\"anything\"", first + 1), std::string::npos)
      << messages.warnings;
    expectSolid(filter->GetOutput());
    EXPECT_FALSE(filter->GetOutput()->GetCellData()->HasArray("anything"));
  }
}

TEST(Arrays, SeamsAreWelded)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(16);
  sphere->SetPhiResolution(9);
  vtkNew<vtkCubeSource> cube; // 24 points, quads
  for (vtkAlgorithm* source :
    { static_cast<vtkAlgorithm*>(sphere), static_cast<vtkAlgorithm*>(cube) })
  {
    vtkNew<vtkHybridTreeMeshField> field;
    const Messages messages(field);
    field->SetInputConnection(source->GetOutputPort());
    field->Update();
    EXPECT_EQ(messages.errors, "");
    expectSolid(field->GetOutput());
  }
}

} // namespace
} // namespace hybridtree::test
