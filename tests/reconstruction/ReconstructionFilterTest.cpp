// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeReconstruction.h"

#include "core/mesh/MeshChecks.h"
#include "core/nodes/Node.h"
#include "tests/reconstruction/DemoPoints.h"
#include "tests/reconstruction/Samples.h"
#include "vtkCellArrayIterator.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkHybridTreeArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

void fill(vtkPointSet* data, const std::vector<Vec3>& source, int type)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  vtkNew<vtkFloatArray> number;
  number->SetName("Number");
  for (const Vec3& p : source)
  {
    number->InsertNextValue(static_cast<float>(points->InsertNextPoint(p.data())));
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(number);
}

TEST(ReconstructionFilter, TellsWhatItWillTakeBeforeItStarts)
{
  vtkNew<vtkPolyData> input;
  fill(input, randomTorus(1.0, 0.4, 4000, 1), VTK_FLOAT);
  vtkNew<vtkHybridTreeReconstruction> filter;
  EXPECT_EQ(filter->GetEstimatedMemory(), 0.0);
  filter->SetInputData(input);
  filter->UpdateInformation();
  const double all = filter->GetEstimatedMemory();
  EXPECT_GT(all, 1.0);
  filter->Update();
  EXPECT_EQ(filter->GetEstimatedMemory(), all);
  EXPECT_GT(filter->GetEstimatedTime(), 0.0);
  EXPECT_NE(std::string(filter->GetProgressText()).find("4000 points"), std::string::npos);
  filter->SetLevelOfDetailToTargetVertices();
  filter->SetTargetVertices(400);
  filter->Update();
  EXPECT_LT(filter->GetEstimatedMemory(), all);
}

TEST(ReconstructionFilter, MakesALiveMeshOfThePoints)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    vtkNew<vtkPolyData> input;
    fill(input, randomTorus(1.0, 0.4, 4000, 1), type);
    vtkNew<vtkHybridTreeReconstruction> filter;
    filter->SetInputData(input);
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    ASSERT_GT(output->GetNumberOfPolys(), 7000);
    EXPECT_EQ(output->GetPoints()->GetDataType(), type);
    auto* ids = vtkIdTypeArray::SafeDownCast(output->GetPointData()->GetArray("PointIds"));
    auto* numbers = output->GetPointData()->GetArray("Number");
    ASSERT_TRUE(ids && numbers && output->GetPointData()->GetNormals());
    for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
    {
      double here[3];
      double there[3];
      output->GetPoint(k, here);
      input->GetPoint(ids->GetValue(k), there);
      ASSERT_TRUE(std::equal(here, here + 3, there)) << "vertex " << k;
      ASSERT_EQ(numbers->GetTuple1(k), ids->GetValue(k));
    }
    EXPECT_NE(vtkHybridTreeArray::FindTree(output), nullptr);
  }
}

TEST(ReconstructionFilter, ThinsAndCleans)
{
  std::vector<Vec3> points = randomSphere(5000, 2);
  points.push_back({ 0.0, 0.0, 30.0 });
  vtkNew<vtkPolyData> input;
  fill(input, points, VTK_DOUBLE);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(input);
  filter->SetSpacing(0.1);
  filter->RemoveOutliersOn();
  filter->Update();
  EXPECT_LT(filter->GetOutput()->GetNumberOfPoints(), 2000);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 500);
  EXPECT_LT(filter->GetOutput()->GetBounds()[5], 2.0);
}

TEST(ReconstructionFilter, FollowsTheLevelOfDetail)
{
  vtkNew<vtkPolyData> input;
  fill(input, randomTorus(1.0, 0.4, 8000, 3), VTK_DOUBLE);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(input);
  filter->SetLevelOfDetailToTargetVertices();
  filter->SetTargetVertices(2000);
  filter->Update();
  EXPECT_NEAR(filter->GetOutput()->GetNumberOfPoints(), 2000, 100);
  filter->SetLevelOfDetailToDetailLevel();
  filter->SetDetailLevel(0.125);
  filter->Update();
  EXPECT_NEAR(filter->GetOutput()->GetNumberOfPoints(), 1000, 50);
  filter->SetLevelOfDetailToTolerance();
  filter->SetTolerance(0.02);
  filter->Update();
  const vtkIdType coarse = filter->GetOutput()->GetNumberOfPoints();
  filter->SetTolerance(0.005);
  filter->Update();
  const vtkIdType fine = filter->GetOutput()->GetNumberOfPoints();
  EXPECT_LT(coarse, fine);
  filter->SetTolerance(0.0); // a thousandth of 2.8
  filter->Update();
  EXPECT_LT(fine, filter->GetOutput()->GetNumberOfPoints());
  auto* ids =
    vtkIdTypeArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("PointIds"));
  auto* numbers = filter->GetOutput()->GetPointData()->GetArray("Number");
  ASSERT_TRUE(ids && numbers);
  for (vtkIdType k = 0; k < filter->GetOutput()->GetNumberOfPoints(); ++k)
  {
    ASSERT_EQ(numbers->GetTuple1(k), ids->GetValue(k)); // arrays follow the points picked
  }
}

TEST(ReconstructionFilter, TakesAnyDataSet)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 5, 5);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(image);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0);
}

TriangleMesh meshOf(vtkPolyData* data)
{
  TriangleMesh mesh;
  mesh.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    data->GetPoint(static_cast<vtkIdType>(k), mesh.points[k].data());
  }
  const auto cells = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* corner = nullptr;
    cells->GetCurrentCell(size, corner);
    EXPECT_EQ(size, 3);
    mesh.triangles.push_back({ static_cast<std::int32_t>(corner[0]),
      static_cast<std::int32_t>(corner[1]), static_cast<std::int32_t>(corner[2]) });
  }
  return mesh;
}

// Scans of Debian's libcgal-demo, the files as they come.
void reconstructScan(const std::vector<Vec3>& points, TriangleMesh& mesh)
{
  vtkNew<vtkPolyData> input;
  fill(input, points, VTK_DOUBLE);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(input);
  filter->Update();
  mesh = meshOf(filter->GetOutput());
  const MeshReport report = checkMesh(mesh);
  ASSERT_GT(report.triangles, 0u);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.unusedPoints, 0u);
  EXPECT_GT(signedVolume(mesh), 0.0);
  auto* ids =
    vtkIdTypeArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("PointIds"));
  ASSERT_TRUE(ids);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    ASSERT_EQ(mesh.points[k], points.at(static_cast<std::size_t>(ids->GetValue(vtkIdType(k)))));
  }
}

TEST(ReconstructionFilter, ReconstructsTheScannedKitten)
{
  const std::optional<std::vector<Vec3>> points = demoPoints("kitten.xyz");
  if (!points)
  {
    GTEST_SKIP() << "kitten.xyz needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  TriangleMesh mesh;
  reconstructScan(*points, mesh);
  EXPECT_EQ(checkMesh(mesh).components, 1u);
  EXPECT_EQ(checkMesh(mesh).genus(), 1);
  EXPECT_GT(mesh.points.size(), points->size() * 9 / 10);
}

TEST(ReconstructionFilter, ReconstructsTheScannedOni)
{
  const std::optional<std::vector<Vec3>> points = demoPoints("oni.pwn");
  if (!points)
  {
    GTEST_SKIP() << "oni.pwn needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  TriangleMesh mesh;
  reconstructScan(*points, mesh);
  EXPECT_EQ(checkMesh(mesh).components, 1u);
}

using SetUp = std::function<void(vtkHybridTreeReconstruction*)>;

std::string errorOf(const std::vector<Vec3>& points, const SetUp& setUp)
{
  vtkNew<vtkPolyData> input;
  fill(input, points, VTK_DOUBLE);
  vtkNew<vtkHybridTreeReconstruction> filter;
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> executive;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
  filter->SetInputData(input);
  setUp(filter);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  return errors->GetErrorMessage();
}

void expectError(
  const std::vector<Vec3>& points, const char* text, const SetUp& setUp = [](auto*) {})
{
  const std::string error = errorOf(points, setUp);
  EXPECT_NE(error.find(text), std::string::npos) << error;
}

TEST(ReconstructionFilter, SaysWhatIsWrongWithThePoints)
{
  expectError({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
    "The point set has 3 different points: a closed surface needs at least 4.");
  expectError(std::vector<Vec3>(50, Vec3(1.0, 2.0, 3.0)),
    "The point set has 1 different points: a closed surface needs at least 4.");
  std::vector<Vec3> flat = randomSphere(50, 4);
  for (Vec3& p : flat)
  {
    p.z() = 0.0;
  }
  expectError(
    flat, "All points lie on one plane: a closed surface needs points that span a volume.");
  std::vector<Vec3> broken = randomSphere(50, 5);
  broken[17].z() = std::numeric_limits<double>::quiet_NaN();
  expectError(broken, "Point 17 ");
}

TEST(ReconstructionFilter, NamesTheParameterThatIsWrong)
{
  const std::vector<Vec3> points = randomSphere(100, 3);
  expectError(points, "Spacing", [](auto* filter) { filter->SetSpacing(-1.0); });
  expectError(points, "PocketFactor", [](auto* filter) { filter->SetPocketFactor(0.5); });
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double radius : { -1.0, nan, std::numeric_limits<double>::infinity() })
  {
    expectError(
      points, "SmoothingRadius", [&](auto* filter) { filter->SetSmoothingRadius(radius); });
  }
  for (const double share : { nan, 0.0, 1.5 })
  {
    expectError(points, "0.001 to 1",
      [&](auto* filter)
      {
        filter->SetLevelOfDetailToDetailLevel();
        filter->SetDetailLevel(share);
      });
  }
  expectError(points, "3 (detail level)", [](auto* filter) { filter->SetLevelOfDetail(4); });
  expectError(points, "TargetVertices",
    [](auto* filter)
    {
      filter->SetLevelOfDetailToTargetVertices();
      filter->SetTargetVertices(3);
    });
  for (const int neighbors : { 0, 1001 })
  {
    expectError(points, "OutlierNeighbors",
      [&](auto* filter)
      {
        filter->RemoveOutliersOn();
        filter->SetOutlierNeighbors(neighbors);
      });
  }
  const auto refine = [](auto* filter)
  {
    filter->SetLevelOfDetailToTargetVertices();
    filter->SetTargetVertices(50);
    filter->RefineRegionOn();
    filter->SetRefineOrigin(-0.5, -0.5, -0.5);
  };
  expectError(points, "RefineTolerance",
    [&](auto* filter)
    {
      refine(filter);
      filter->SetRefineTolerance(-1.0);
    });
  expectError(points, "RefineOrigin",
    [&](auto* filter)
    {
      refine(filter);
      filter->SetRefineOrigin(0.0, nan, 0.0);
    });
  // At once, and where the factor is known to be too small only at the end.
  for (const double factor : { 0.5, 1.0 })
  {
    expectError(points, "HoleFactor",
      [&](auto* filter)
      {
        refine(filter);
        filter->CloseHolesOff();
        filter->SetHoleFactor(factor);
      });
  }
}

std::vector<vtkIdType> pointIds(vtkPolyData* output)
{
  auto* ids = vtkIdTypeArray::SafeDownCast(output->GetPointData()->GetArray("PointIds"));
  return { ids->Begin(), ids->End() };
}

TEST(ReconstructionFilter, KeepsItsStateFromLevelToLevel)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 8000, 11);
  vtkNew<vtkPolyData> input;
  fill(input, points, VTK_DOUBLE);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(input);
  filter->SetLevelOfDetailToTargetVertices();
  const auto idsAt = [&](int vertices)
  {
    filter->SetTargetVertices(vertices);
    filter->Update();
    return pointIds(filter->GetOutput());
  };
  const auto before = idsAt(1500);
  EXPECT_EQ(before.size(), 1500u);
  EXPECT_EQ(idsAt(2500).size(), 2500u);
  EXPECT_EQ(idsAt(1500), before);

  // All the points of a box on top of them, elsewhere none.
  filter->RefineRegionOn();
  filter->SetRefineOrigin(0.5, -0.5, -0.5);
  filter->SetRefineLengths(1.0, 1.0, 1.0);
  const auto refined = idsAt(1500);
  EXPECT_GT(refined.size(), 1600u);
  const std::set<vtkIdType> known(before.begin(), before.end());
  for (const vtkIdType id : refined)
  {
    EXPECT_TRUE(known.count(id) != 0 || (points[id] - Vec3(1, 0, 0)).cwiseAbs().maxCoeff() <= 0.5);
  }
  filter->RefineRegionOff();
  EXPECT_EQ(idsAt(1500), before);

  // Other points, and no state: as if fresh.
  vtkNew<vtkPolyData> other;
  fill(other, randomTorus(1.0, 0.4, 8000, 12), VTK_DOUBLE);
  filter->SetInputData(other);
  const auto changed = idsAt(1500);
  filter->KeepStateOff();
  EXPECT_EQ(idsAt(1500), changed);
}

// Whatever was asked for before.
TEST(ReconstructionFilter, KeepsNothingOfHolesWithItsState)
{
  std::vector<Vec3> points = randomSphere(4000, 24);
  points.erase(
    std::remove_if(points.begin(), points.end(), [](const Vec3& p) { return p.z() > 0; }),
    points.end());
  vtkNew<vtkPolyData> input;
  fill(input, points, VTK_DOUBLE);
  const auto set = [&](vtkHybridTreeReconstruction* filter, int vertices, bool close, double factor)
  {
    filter->SetInputData(input);
    filter->SetLevelOfDetailToTargetVertices();
    filter->SetTargetVertices(vertices);
    filter->SetCloseHoles(close);
    filter->SetHoleFactor(factor);
    filter->Update();
    return meshOf(filter->GetOutput()).triangles;
  };
  vtkNew<vtkHybridTreeReconstruction> used;
  for (const int vertices : { 500, 5000 }) // and more than there are points
  {
    for (const auto& [close, factor] :
      { std::pair(true, 5.0), std::pair(false, 2.0), std::pair(false, 8.0), std::pair(true, 5.0) })
    {
      vtkNew<vtkHybridTreeReconstruction> fresh;
      EXPECT_EQ(set(used, vertices, close, factor), set(fresh, vertices, close, factor))
        << vertices << " vertices, holes closed: " << close << ", from " << factor;
    }
  }
}

// Two scans of a torus, a little apart, with noise.
TEST(ReconstructionFilter, MakesOneSheetOfTwoNoisyLayers)
{
  Random random(21);
  std::vector<Vec3> points;
  for (const double tube : { 0.39, 0.41 })
  {
    for (Vec3 p : randomTorus(1.0, tube, 8000, 22))
    {
      points.push_back(p + random.uniform(-0.008, 0.008) * random.direction());
    }
  }
  vtkNew<vtkPolyData> input;
  fill(input, points, VTK_DOUBLE);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(input);
  filter->SetSmoothingRadius(0.15);
  filter->Update();
  const TriangleMesh mesh = meshOf(filter->GetOutput());
  const MeshReport report = checkMesh(mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.genus(), 1);
  for (const Vec3& p : mesh.points)
  {
    EXPECT_LT(distanceToTorus(p, 1.0, 0.4), 0.012);
  }
}

TEST(ReconstructionFilter, LeavesHolesOpenAndFollowsNormals)
{
  std::vector<Vec3> points;
  for (const Vec3& p : randomSphere(4000, 23))
  {
    if (p.z() < 0.5)
    {
      points.push_back(p);
    }
  }
  vtkNew<vtkPolyData> input;
  fill(input, points, VTK_DOUBLE);
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const Vec3& p : points)
  {
    normals->InsertNextTuple3(-p.x(), -p.y(), -p.z()); // inward
  }
  input->GetPointData()->SetNormals(normals);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(input);
  filter->CloseHolesOff();
  filter->Update();
  const TriangleMesh inward = meshOf(filter->GetOutput());
  EXPECT_GT(checkMesh(inward).boundaryEdges, 0u);
  EXPECT_TRUE(checkMesh(inward).oriented() && checkMesh(inward).vertexManifold());
  double facing = 0.0;
  for (std::size_t t = 0; t < inward.triangles.size(); ++t)
  {
    facing += areaNormal(inward, t).dot(inward.points[inward.triangles[t][0]]);
  }
  EXPECT_LT(facing, 0.0);
  filter->CloseHolesOn();
  filter->Update();
  const TriangleMesh closed = meshOf(filter->GetOutput());
  EXPECT_TRUE(checkMesh(closed).closedManifold());
  EXPECT_NE(vtkHybridTreeArray::FindTree(filter->GetOutput()), nullptr);
}

} // namespace
