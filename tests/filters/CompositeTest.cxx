// SPDX-License-Identifier: BSD-3-Clause
// Composite inputs: one shape, whatever blocks a reader or Group Datasets has made of it.
#include "tests/filters/Support.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkDataSetAttributes.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeCurveSkeletons.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkHybridTreeProbe.h"
#include "vtkHybridTreeTwist.h"
#include "vtkInformation.h"
#include "vtkLineSource.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

vtkSmartPointer<vtkPolyData> sphere(double x)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(x, 0.0, 0.0);
  source->SetThetaResolution(24);
  source->SetPhiResolution(24);
  source->Update();
  return source->GetOutput();
}

/// A cube of edge 1 around the origin in six open pieces, two triangles each.
std::vector<vtkSmartPointer<vtkPolyData>> sides()
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  std::vector<vtkSmartPointer<vtkPolyData>> pieces;
  for (vtkIdType side = 0; side < cube->GetOutput()->GetNumberOfPolys(); ++side)
  {
    vtkNew<vtkCellArray> polygon;
    polygon->InsertNextCell(cube->GetOutput()->GetCell(side));
    auto piece = vtkSmartPointer<vtkPolyData>::New();
    piece->SetPoints(cube->GetOutput()->GetPoints());
    piece->SetPolys(polygon);
    pieces.push_back(piece);
  }
  return pieces;
}

template <class Data>
vtkSmartPointer<vtkMultiBlockDataSet> group(const std::vector<vtkSmartPointer<Data>>& blocks)
{
  auto grouped = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const auto& block : blocks)
  {
    grouped->SetBlock(grouped->GetNumberOfBlocks(), block);
  }
  return grouped;
}

vtkSmartPointer<vtkMultiBlockDataSet> twoSpheres()
{
  return group<vtkPolyData>({ sphere(0.0), sphere(0.8) });
}

/// Both directly, one after the other.
template <class Filter>
void connectSpheres(Filter* filter, int port)
{
  filter->AddInputDataObject(port, sphere(0.0));
  filter->AddInputDataObject(port, sphere(0.8));
}

TEST(Composite, BlocksAreOperandsWhereAnyNumberIsTaken)
{
  vtkNew<vtkHybridTreeBlend> apart;
  connectSpheres(apart.Get(), 0);
  apart->SetEdgeLength(0.1);
  apart->Update();
  vtkNew<vtkHybridTreeBlend> together;
  together->SetInputDataObject(twoSpheres());
  together->SetEdgeLength(0.1);
  together->Update();
  ASSERT_TRUE(together->GetTree());
  EXPECT_EQ(together->GetTree()->leafCount(), 2);
  expectSameField(*apart->GetTree(), *together->GetTree());
  expectSolid(together->GetOutput());
}

TEST(Composite, ADifferenceCutsAllBlocksAway)
{
  vtkNew<vtkHybridTreeBoolean> cut;
  cut->SetInputConnection(0, rod()->GetOutputPort());
  cut->SetInputDataObject(1, twoSpheres());
  cut->SetOperation(vtkHybridTreeBoolean::DIFFERENCE);
  cut->Update();
  ASSERT_TRUE(cut->GetTree());
  EXPECT_LT(fieldAt(*cut->GetTree(), Vec3(0.3, 0.0, 0.0)), kThreshold) << "first block";
  EXPECT_LT(fieldAt(*cut->GetTree(), Vec3(0.9, 0.0, 0.0)), kThreshold) << "second block";
}

TEST(Composite, BlocksAreUnitedWhereOneNodeIsTaken)
{
  vtkNew<vtkHybridTreeBoolean> both;
  both->SetInputDataObject(0, sphere(0.0));
  both->SetInputDataObject(1, sphere(0.8));
  vtkNew<vtkHybridTreeTwist> expected;
  expected->SetInputConnection(both->GetOutputPort());
  expected->Update();
  vtkNew<vtkHybridTreeTwist> twist;
  twist->SetInputDataObject(twoSpheres());
  twist->Update();
  ASSERT_TRUE(twist->GetTree());
  expectSameField(*expected->GetTree(), *twist->GetTree());
  expectSolid(twist->GetOutput());
}

TEST(Composite, TreesOfBlocksAreKept)
{
  const auto node = ball();
  node->Update();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->SetInputDataObject(group<vtkPolyData>({ node->GetOutput(), sphere(0.8) }));
  blend->SetEdgeLength(0.1);
  blend->Update();
  ASSERT_TRUE(blend->GetTree());
  ASSERT_EQ(blend->GetTree()->children().size(), 2u);
  EXPECT_EQ(blend->GetTree()->children()[0], node->GetTree());
}

TEST(Composite, OpenBlocksArePatchesOfOneMesh)
{
  std::vector<vtkSmartPointer<vtkPolyData>> blocks = sides();
  blocks.push_back(sphere(3.0));
  vtkNew<vtkHybridTreeBlend> blend;
  blend->SetInputDataObject(group(blocks));
  const Messages messages(blend);
  blend->Update();
  EXPECT_EQ(messages.errors + messages.warnings, "");
  ASSERT_TRUE(blend->GetTree());
  EXPECT_EQ(blend->GetTree()->leafCount(), 2) << "the cube and the ball";
  expectSolid(blend->GetOutput());
  EXPECT_GT(fieldAt(*blend->GetTree(), Vec3(0.0, 0.0, 0.0)), kThreshold);
}

TEST(Composite, PartitionsAreOneDataSet)
{
  const auto pieces = sides();
  vtkNew<vtkPartitionedDataSet> partitions;
  vtkNew<vtkMultiPieceDataSet> multiple;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    partitions->SetPartition(static_cast<unsigned int>(k), pieces[k]);
    multiple->SetPiece(static_cast<unsigned int>(k), pieces[k]);
  }
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartitionedDataSet(0, partitions);
  collection->SetPartitionedDataSet(1, vtkNew<vtkPartitionedDataSet>());
  vtkNew<vtkMultiBlockDataSet> tree;
  tree->SetBlock(1, multiple);
  for (vtkDataObject* data : { static_cast<vtkDataObject*>(partitions),
         static_cast<vtkDataObject*>(collection), static_cast<vtkDataObject*>(tree) })
  {
    vtkNew<vtkHybridTreeMeshField> mesh;
    mesh->SetInputDataObject(data);
    const Messages messages(mesh);
    mesh->Update();
    EXPECT_EQ(messages.errors + messages.warnings, "") << data->GetClassName();
    expectSolid(mesh->GetOutput());
    EXPECT_EQ(mesh->GetOutput()->GetNumberOfPoints(), 8) << data->GetClassName();
  }
}

TEST(Composite, ABlockThatIsNoMeshIsNamed)
{
  const auto grouped =
    group<vtkDataSet>({ sphere(0.0), vtkSmartPointer<vtkUnstructuredGrid>::New() });
  vtkNew<vtkHybridTreeBlend> blend;
  blend->SetInputDataObject(grouped);
  {
    const Messages messages(blend);
    blend->Update();
    EXPECT_EQ(messages.errors, "") << "an empty block is none";
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(sphere(0.0)->GetPoints());
  grouped->SetBlock(1, grid);
  grouped->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "engine");
  const Messages messages(blend);
  blend->Modified();
  blend->Update();
  for (const char* word : { "Block engine", "vtkUnstructuredGrid", "Extract Surface" })
  {
    EXPECT_NE(messages.errors.find(word), std::string::npos) << messages.errors;
  }
  EXPECT_EQ(blend->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(Composite, NothingIsAnError)
{
  vtkNew<vtkHybridTreeBlend> blend;
  blend->SetInputDataObject(group<vtkPolyData>({ vtkSmartPointer<vtkPolyData>::New() }));
  const Messages messages(blend);
  blend->Update();
  EXPECT_NE(messages.errors.find("no data"), std::string::npos) << messages.errors;
}

TEST(Composite, TheSameBlocksAreTheSameNode)
{
  const auto blocks = twoSpheres();
  vtkNew<vtkHybridTreeTwist> twist;
  twist->SetInputDataObject(blocks);
  twist->Update();
  const auto before = twist->GetTree();
  blocks->Modified();
  twist->Update();
  EXPECT_EQ(twist->GetNumberOfExecutions(), 2);
  EXPECT_EQ(twist->GetTree(), before);
}

TEST(Composite, CurvesOfAllBlocksAreOneNode)
{
  const auto line = [](double y)
  {
    vtkNew<vtkLineSource> source;
    source->SetPoint1(-0.5, y, 0.0);
    source->SetPoint2(0.5, -y, 0.1);
    source->Update();
    return vtkSmartPointer<vtkPolyData>(source->GetOutput());
  };
  vtkNew<vtkHybridTreeCurveSkeletons> curves;
  curves->SetInputDataObject(group<vtkPolyData>({ line(0.3), line(-0.3) }));
  curves->Update();
  ASSERT_TRUE(curves->GetTree());
  EXPECT_EQ(curves->GetTree()->leafCount(), 2);
  expectSolid(curves->GetOutput());
}

TEST(Composite, AProbeAsksTheWholeAndKeepsTheBlocksOfItsPoints)
{
  vtkNew<vtkHybridTreeProbe> probe;
  probe->SetInputDataObject(0, twoSpheres());
  probe->SetInputDataObject(1, twoSpheres());
  probe->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(probe->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  for (unsigned int k = 0; k < 2; ++k)
  {
    auto* block = vtkPolyData::SafeDownCast(output->GetBlock(k));
    ASSERT_TRUE(block);
    double range[2];
    block->GetPointData()->GetArray("Membership")->GetRange(range);
    EXPECT_EQ(range[0], 0.0) << "nothing is outside of both";
    EXPECT_EQ(range[1], 1.0) << "some points are inside of the other";
  }
}

TEST(Composite, GhostCellsAreLeftOut)
{
  const auto mesh = sphere(0.0);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(mesh->GetNumberOfCells() + 1);
  ghosts->Fill(0);
  const vtkIdType extra[3] = { 0, 5, 50 };
  mesh->GetPolys()->InsertNextCell(3, extra);
  ghosts->SetValue(mesh->GetNumberOfCells() - 1, vtkDataSetAttributes::DUPLICATECELL);
  mesh->GetCellData()->AddArray(ghosts);
  const vtkIdType cells = mesh->GetNumberOfCells();
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(mesh);
  const Messages messages(field);
  field->Update();
  EXPECT_EQ(messages.errors + messages.warnings, "");
  EXPECT_EQ(field->GetOutput()->GetNumberOfPolys(), cells - 1);
  EXPECT_EQ(mesh->GetNumberOfCells(), cells) << "the input is not ours to change";
}

} // namespace
} // namespace hybridtree::test
