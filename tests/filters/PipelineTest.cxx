// SPDX-License-Identifier: BSD-3-Clause
// What runs when, and what is meshed: FIELD and MESH requests, caching, abort, pieces.
#include "tests/filters/Support.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkElevationFilter.h"
#include "vtkFieldData.h"
#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeArray.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkHybridTreeTwist.h"
#include "vtkInformation.h"
#include "vtkPoints.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hybridtree::test
{
namespace
{

TEST(Pipeline, NodesBetweenAreNotMeshed)
{
  const auto a = ball();
  const auto b = rod();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  vtkNew<vtkHybridTreeTwist> twist;
  twist->SetInputConnection(blend->GetOutputPort());
  twist->SetEdgeLength(0.1);
  twist->Update();
  for (vtkHybridTreeAlgorithm* between : { static_cast<vtkHybridTreeAlgorithm*>(a),
         static_cast<vtkHybridTreeAlgorithm*>(b), static_cast<vtkHybridTreeAlgorithm*>(blend) })
  {
    EXPECT_EQ(between->GetNumberOfExecutions(), 1) << between->GetClassName();
    EXPECT_EQ(between->GetNumberOfMeshings(), 0) << between->GetClassName();
    EXPECT_EQ(between->GetOutput()->GetNumberOfPoints(), 0) << between->GetClassName();
    EXPECT_TRUE(vtkHybridTreeArray::FindTree(between->GetOutput())) << between->GetClassName();
  }
  EXPECT_EQ(twist->GetNumberOfMeshings(), 1);
  expectSolid(twist->GetOutput());
}

TEST(Pipeline, FieldFirstThenMesh)
{
  const auto a = ball();
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(a->GetOutputPort());
  move->Update();
  EXPECT_EQ(a->GetNumberOfMeshings(), 0);
  const auto tree = a->GetTree();

  a->Update(); // somebody looks at it
  EXPECT_EQ(a->GetNumberOfMeshings(), 1);
  EXPECT_EQ(a->GetTree(), tree) << "a look must not make the tree anew";
  expectSolid(a->GetOutput());

  move->Update();
  EXPECT_EQ(move->GetNumberOfExecutions(), 1) << "nothing has changed for it";
}

TEST(Pipeline, AMeshMadeServesALaterField)
{
  const auto a = ball();
  a->Update();
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(a->GetOutputPort());
  move->Update();
  EXPECT_EQ(a->GetNumberOfExecutions(), 1);
  expectSolid(a->GetOutput());
}

// Nobody but the filter holds its tree while it makes the next one.
TEST(Pipeline, AnEditBelowAMapKeepsTheImagesOfTheRest)
{
  const auto a = ball();
  const auto b = rod();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(blend->GetOutputPort());
  move->SetTranslate(1.0, 0.0, 0.0);
  move->Update();
  const std::weak_ptr<const Node> imageOfA = move->GetTree()->children().at(0);
  const std::weak_ptr<const Node> imageOfB = move->GetTree()->children().at(1);
  b->SetSurfaceRadius(0.9 * b->GetSurfaceRadius());
  move->Update();
  EXPECT_EQ(move->GetTree()->children().at(0), imageOfA.lock());
  EXPECT_NE(move->GetTree()->children().at(1), imageOfB.lock());
}

TEST(Pipeline, PassThroughFiltersAreSeenThrough)
{
  const auto a = ball();
  vtkNew<vtkPVPostFilter> shown;
  shown->SetInputConnection(a->GetOutputPort());
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(shown->GetOutputPort());
  move->Update();
  EXPECT_EQ(a->GetNumberOfMeshings(), 0);

  shown->Update();
  EXPECT_EQ(a->GetNumberOfMeshings(), 1);
  expectSolid(vtkPolyData::SafeDownCast(shown->GetOutputDataObject(0)));
}

TEST(Pipeline, AFailureBesideLeavesNoRequestBehind)
{
  const auto good = ball();
  const auto bad = ball();
  bad->SetSurfaceRadius(2.0); // beyond the influence
  const Messages messages(bad);
  vtkNew<vtkHybridTreeBlend> blend;
  const Messages above(blend);
  blend->AddInputConnection(good->GetOutputPort());
  blend->AddInputConnection(bad->GetOutputPort());
  blend->Update();
  EXPECT_NE(messages.errors, "");
  good->Update();
  expectSolid(good->GetOutput());
}

TEST(Pipeline, WhatAForeignFilterSeesIsMeshed)
{
  const auto a = ball();
  vtkNew<vtkElevationFilter> foreign;
  foreign->SetInputConnection(a->GetOutputPort());
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(a->GetOutputPort());
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(foreign->GetOutputPort());
  both->AddInputConnection(move->GetOutputPort());
  both->Update();
  const vtkIdType one = a->GetOutput()->GetNumberOfPoints();
  EXPECT_GT(one, 0);
  EXPECT_GT(both->GetOutput()->GetNumberOfPoints(), one);
}

TEST(Pipeline, AForeignFilterElsewhereDoesNoHarm)
{
  const auto a = ball();
  vtkNew<vtkElevationFilter> elsewhere; // as the views that ParaView keeps of hidden nodes
  elsewhere->SetInputConnection(a->GetOutputPort());
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(a->GetOutputPort());
  move->Update();
  EXPECT_EQ(a->GetNumberOfMeshings(), 0);
  elsewhere->Update();
  expectSolid(vtkPolyData::SafeDownCast(elsewhere->GetOutputDataObject(0)));
}

TEST(Pipeline, AForeignFilterBesideInEitherOrder)
{
  for (const bool foreignFirst : { true, false })
  {
    const auto a = ball();
    vtkNew<vtkHybridTreeAffineTransform> move;
    move->SetInputConnection(a->GetOutputPort());
    vtkNew<vtkTransform> shift;
    shift->Translate(3.0, 0.0, 0.0);
    vtkNew<vtkTransformPolyDataFilter> foreign;
    foreign->SetTransform(shift);
    foreign->SetInputConnection(a->GetOutputPort());
    vtkNew<vtkHybridTreeBoolean> both;
    both->SetInputConnection(foreignFirst ? 0 : 1, foreign->GetOutputPort());
    both->SetInputConnection(foreignFirst ? 1 : 0, move->GetOutputPort());
    both->SetEdgeLength(0.1);
    both->Update();
    expectSolid(both->GetOutput());
    EXPECT_EQ(checkMesh(trianglesOf(both->GetOutput())).components, 2u);
  }
}

TEST(Pipeline, AMeshFieldBesideGetsItsMesh)
{
  const auto a = ball();
  vtkNew<vtkHybridTreeMeshField> leaf;
  leaf->SetInputConnection(a->GetOutputPort());
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(leaf->GetOutputPort());
  blend->AddInputConnection(a->GetOutputPort());
  blend->SetEdgeLength(0.2);
  blend->Update();
  EXPECT_EQ(a->GetNumberOfMeshings(), 1);
  expectSolid(blend->GetOutput());
}

TEST(Pipeline, AChangedPropertyRunsThePathToTheRoot)
{
  const auto a = ball();
  const auto b = rod();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  blend->SetEdgeLength(0.1);
  blend->Update();
  const double before = signedVolume(trianglesOf(blend->GetOutput()));
  const auto kept = b->GetTree();

  a->SetSurfaceRadius(0.6);
  blend->Update();
  EXPECT_EQ(a->GetNumberOfExecutions(), 2);
  EXPECT_EQ(b->GetNumberOfExecutions(), 1);
  EXPECT_EQ(b->GetTree(), kept);
  EXPECT_EQ(blend->GetNumberOfExecutions(), 2);
  EXPECT_GT(signedVolume(trianglesOf(blend->GetOutput())), before);
}

TEST(Pipeline, AnEdgeLengthKeepsTheTree)
{
  const auto a = ball();
  a->Update();
  const auto tree = a->GetTree();
  const vtkIdType coarse = a->GetOutput()->GetNumberOfPoints();
  a->SetEdgeLength(0.05);
  a->Update();
  EXPECT_EQ(a->GetTree(), tree);
  EXPECT_GT(a->GetOutput()->GetNumberOfPoints(), 2 * coarse);
}

TEST(Pipeline, AMeshInputKeepsItsLeaf)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(sphere->GetOutputPort());
  move->Update();
  const MeshPtr leaf = move->GetTree()->leafMesh();
  ASSERT_TRUE(leaf);
  move->SetTranslate(1.0, 0.0, 0.0);
  move->Update();
  EXPECT_EQ(move->GetTree()->leafMesh(), leaf) << "dragging must not convert the mesh again";
}

/// VTK keeps what it found out about an array, such as its range, with the array.
TEST(Pipeline, AnEditKeepsTheArraysOfMeshLeaves)
{
  vtkNew<vtkSphereSource> sphere;
  const auto other = ball();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(sphere->GetOutputPort());
  blend->AddInputConnection(other->GetOutputPort());
  const auto leafArrays = [&]
  {
    blend->Update();
    std::vector<vtkSmartPointer<vtkDataArray>> arrays;
    vtkFieldData* data = blend->GetOutput()->GetFieldData();
    for (int k = 0; k < data->GetNumberOfArrays(); ++k)
    {
      if (vtkDataArray* array = data->GetArray(k))
      {
        arrays.emplace_back(array);
      }
    }
    return arrays;
  };
  const auto before = leafArrays();
  EXPECT_EQ(before.size(), 2u) << "points and triangles";
  other->SetCenter(0.3, 0.2, 0.1);
  EXPECT_EQ(leafArrays(), before);
  sphere->SetRadius(0.4);
  const auto changed = leafArrays();
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_NE(changed[0], before[0]);
  double range[2];
  changed[0]->GetRange(range, 2);
  EXPECT_NEAR(range[1], 0.4, 1e-6);
}

/// Asks a filter to stop, whenever it reports progress.
class Stop
{
public:
  explicit Stop(vtkAlgorithm* filter) : filter_(filter)
  {
    vtkNew<Command> command;
    tag_ = filter->AddObserver(vtkCommand::ProgressEvent, command);
  }
  ~Stop() { filter_->RemoveObserver(tag_); }
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

private:
  class Command : public vtkCommand
  {
  public:
    static Command* New() { return new Command; }
    void Execute(vtkObject* caller, unsigned long, void*) override
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  };

  vtkSmartPointer<vtkAlgorithm> filter_;
  unsigned long tag_;
};

TEST(Pipeline, AbortEmptiesTheOutputUntilTheNextUpdate)
{
  const auto a = ball();
  const auto b = rod();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  blend->SetEdgeLength(0.05);
  const Messages messages(blend);
  {
    const Stop stop(blend);
    blend->Update();
    EXPECT_EQ(blend->GetOutput()->GetNumberOfPoints(), 0);
  }
  EXPECT_EQ(messages.errors, "") << "a user's wish is no error";
  blend->Update(); // nothing has changed
  expectSolid(blend->GetOutput());
  EXPECT_EQ(messages.errors, "");
}

TEST(Pipeline, ReadingAMeshIsToldAndCanBeStopped)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetEndPhi(120.0); // open, which is told once
  const auto b = rod();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(sphere->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  class FirstText : public vtkCommand
  {
  public:
    static FirstText* New() { return new FirstText; }
    void Execute(vtkObject* caller, unsigned long, void*) override
    {
      const char* text = static_cast<vtkAlgorithm*>(caller)->GetProgressText();
      Texts.push_back(text ? text : "");
    }
    std::vector<std::string> Texts;
  };
  vtkNew<FirstText> record;
  blend->AddObserver(vtkCommand::ProgressEvent, record);
  const Messages messages(blend);
  {
    const Stop stop(blend);
    blend->Update();
  }
  EXPECT_EQ(blend->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_FALSE(blend->GetTree()) << "stopped before it was made";
  EXPECT_EQ(messages.errors, "");
  EXPECT_EQ(std::count(record->Texts.begin(), record->Texts.end(), "Reading Input 1"), 1);
  EXPECT_EQ(messages.warnings, "");

  blend->Update();
  EXPECT_NE(messages.warnings.find("not a closed surface"), std::string::npos) << messages.warnings;
  expectSolid(blend->GetOutput());
  EXPECT_EQ(record->Texts.back(), "");
}

// Triangles that cross each other leave nothing but the lattice, whose search for sharp edges is
// most of the work.
TEST(Pipeline, ABooleanOfASoupCanBeStoppedLate)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (vtkIdType k = 0; k < 25; ++k)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      points->InsertNextPoint(unit(random), unit(random), unit(random));
    }
    const vtkIdType corners[3] = { 3 * k, 3 * k + 1, 3 * k + 2 };
    cells->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> soup;
  soup->SetPoints(points);
  soup->SetPolys(cells);
  const auto b = ball();
  vtkNew<vtkHybridTreeBoolean> unite;
  unite->SetInputData(0, soup);
  unite->SetInputConnection(1, b->GetOutputPort());
  unite->SetEdgeLength(0.06);
  class StopLate : public vtkCommand
  {
  public:
    static StopLate* New() { return new StopLate; }
    void Execute(vtkObject* caller, unsigned long, void* amount) override
    {
      After += Stopped;
      Stopped = Stopped || *static_cast<double*>(amount) >= From;
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(Stopped);
    }
    double From = 2.0;
    bool Stopped = false;
    int After = 0;
  };
  const Messages messages(unite);
  for (const double from : { 0.3, 0.8, 0.9 })
  {
    vtkNew<StopLate> stop;
    stop->From = from;
    const unsigned long tag = unite->AddObserver(vtkCommand::ProgressEvent, stop);
    unite->Modified();
    unite->Update();
    unite->RemoveObserver(tag);
    EXPECT_TRUE(stop->Stopped) << from;
    EXPECT_LE(stop->After, 2) << from;
    EXPECT_EQ(unite->GetOutput()->GetNumberOfPoints(), 0) << from;
  }
  EXPECT_EQ(messages.errors, "");
  unite->Update();
  expectSolid(unite->GetOutput());
}

TEST(Pipeline, WhatStandsBehindAnAbortedNodeFollowsAtTheNextUpdate)
{
  const auto a = ball();
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(a->GetOutputPort());
  vtkNew<vtkPVPostFilter> post;
  post->SetInputConnection(move->GetOutputPort());
  vtkNew<vtkElevationFilter> foreign;
  foreign->SetInputConnection(post->GetOutputPort());
  {
    const Stop stop(move);
    foreign->Update();
    EXPECT_EQ(foreign->GetOutput()->GetNumberOfPoints(), 0);
  }
  foreign->Update();
  expectSolid(vtkPolyData::SafeDownCast(foreign->GetOutput()));
}

TEST(Pipeline, ProgressReachesTheEndInOrder)
{
  const auto a = ball();
  const auto b = rod();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  blend->SetEdgeLength(0.02);
  class Record : public vtkCommand
  {
  public:
    void Execute(vtkObject*, unsigned long, void* amount) override
    {
      Amounts.push_back(*static_cast<double*>(amount));
    }
    std::vector<double> Amounts;
  };
  Record* record = new Record;
  blend->AddObserver(vtkCommand::ProgressEvent, record);
  blend->Update();
  EXPECT_GT(record->Amounts.size(), 4u);
  EXPECT_TRUE(std::is_sorted(record->Amounts.begin(), record->Amounts.end()));
  EXPECT_EQ(record->Amounts.back(), 1.0);
  record->Delete();
}

TEST(Pipeline, TheFirstPieceIsEverything)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkHybridTreeAffineTransform> move;
  move->SetInputConnection(sphere->GetOutputPort());
  move->UpdatePiece(1, 2, 0);
  EXPECT_EQ(move->GetOutput()->GetNumberOfPoints(), 0);
  move->UpdatePiece(0, 2, 0);
  expectSolid(move->GetOutput());

  const auto a = ball();
  a->UpdatePiece(1, 3, 0);
  EXPECT_EQ(a->GetOutput()->GetNumberOfPoints(), 0);
  a->UpdatePiece(0, 3, 0);
  expectSolid(a->GetOutput());
}

} // namespace
} // namespace hybridtree::test
