// SPDX-License-Identifier: BSD-3-Clause
// The tree that travels with the data: live, copied, through files, and where it ends.
#include "tests/filters/Support.h"

#include "core/tree/Serialize.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkClipPolyData.h"
#include "vtkDecimatePro.h"
#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkFieldData.h"
#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeArray.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace hybridtree::test
{
namespace
{

using NodePtr = vtkHybridTreeArray::NodePtr;

NodePtr treeOf(vtkAlgorithm* algorithm)
{
  algorithm->Update();
  return vtkHybridTreeArray::FindTree(vtkPolyData::SafeDownCast(algorithm->GetOutputDataObject(0)));
}

TEST(CarriedTree, TheNextFilterWorksWithTheVeryNode)
{
  const auto a = ball();
  vtkNew<vtkPVPostFilter> between;
  between->SetInputConnection(a->GetOutputPort());
  const NodePtr carried = treeOf(between);
  EXPECT_EQ(carried, a->GetTree());

  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(a->GetOutput());
  EXPECT_EQ(vtkHybridTreeArray::FindTree(copy), a->GetTree());
}

TEST(CarriedTree, ColoursMayChangeGeometryMayNot)
{
  const auto a = ball();
  vtkNew<vtkElevationFilter> colours;
  colours->SetInputConnection(a->GetOutputPort());
  const NodePtr carried = treeOf(colours);
  EXPECT_EQ(carried, a->GetTree());

  vtkNew<vtkPolyData> moved;
  a->Update();
  moved->DeepCopy(a->GetOutput());
  double x[3];
  moved->GetPoint(0, x);
  moved->GetPoints()->SetPoint(0, x[0] + 1e-12, x[1], x[2]);
  EXPECT_FALSE(vtkHybridTreeArray::FindTree(moved));
}

/// Runs a foreign filter between a ball and an operator, and expects a new mesh leaf of its mesh.
void expectNewLeaf(vtkPolyDataAlgorithm* foreign)
{
  const auto a = ball();
  foreign->SetInputConnection(a->GetOutputPort());
  vtkNew<vtkHybridTreeAffineTransform> node;
  const Messages messages(node); // an open mesh is warned about
  node->SetInputConnection(foreign->GetOutputPort());
  node->Update();
  ASSERT_EQ(messages.errors, "") << foreign->GetClassName();
  EXPECT_TRUE(foreign->GetOutput()->GetFieldData()->GetAbstractArray("HybridTree"))
    << foreign->GetClassName() << " has stopped to copy field data: this test proves nothing";
  ASSERT_TRUE(node->GetTree()->leafMesh()) << foreign->GetClassName();
  EXPECT_EQ(node->GetTree()->leafMesh()->triangles.size(),
    static_cast<std::size_t>(foreign->GetOutput()->GetNumberOfPolys()))
    << foreign->GetClassName();
}

TEST(CarriedTree, ForeignGeometryIsANewLeaf)
{
  vtkNew<vtkTransform> shift;
  shift->Translate(0.5, 0.0, 0.0);
  vtkNew<vtkTransformPolyDataFilter> transform;
  transform->SetTransform(shift);
  expectNewLeaf(transform);

  vtkNew<vtkCleanPolyData> clean; // merges points: other points, other triangles
  clean->SetAbsoluteTolerance(0.08);
  clean->ToleranceIsAbsoluteOn();
  clean->ConvertPolysToLinesOff();
  expectNewLeaf(clean);

  vtkNew<vtkDecimatePro> decimate;
  decimate->SetTargetReduction(0.5);
  expectNewLeaf(decimate);

  vtkNew<vtkPlane> plane;
  plane->SetNormal(1.0, 0.3, 0.2);
  vtkNew<vtkClipPolyData> clip;
  clip->SetClipFunction(plane);
  expectNewLeaf(clip);
}

TEST(CarriedTree, AForeignFilterThatChangesNothingKeepsTheTree)
{
  const auto a = ball();
  vtkNew<vtkTransform> identity;
  vtkNew<vtkTransformPolyDataFilter> transform;
  transform->SetTransform(identity);
  transform->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  transform->SetInputConnection(a->GetOutputPort());
  const NodePtr carried = treeOf(transform);
  EXPECT_EQ(carried, a->GetTree());
}

/// A blend of a ball and a mesh, less another mesh.
struct Model
{
  Model()
  {
    sphere->SetThetaResolution(12);
    sphere->SetCenter(0.7, 0.0, 0.0);
    cut->SetCenter(0.0, 0.5, 0.0);
    cut->SetRadius(0.3);
    field->SetInputConnection(sphere->GetOutputPort());
    field->SetInfluenceRadius(0.4);
    blend->AddInputConnection(point->GetOutputPort());
    blend->AddInputConnection(field->GetOutputPort());
    difference->SetInputConnection(0, blend->GetOutputPort());
    difference->SetInputConnection(1, cut->GetOutputPort());
    difference->SetOperation(vtkHybridTreeBoolean::DIFFERENCE);
    difference->SetEdgeLength(0.1);
  }

  vtkNew<vtkHybridTreePoint> point;
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkSphereSource> cut;
  vtkNew<vtkHybridTreeMeshField> field;
  vtkNew<vtkHybridTreeBlend> blend;
  vtkNew<vtkHybridTreeBoolean> difference;
};

TEST(CarriedTree, AFileReloadsAsALiveTree)
{
  const Model model;
  const NodePtr saved = treeOf(model.difference);
  for (const int mode : { vtkXMLWriter::Ascii, vtkXMLWriter::Binary })
  {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputConnection(model.difference->GetOutputPort());
    writer->SetDataMode(mode);
    writer->WriteToOutputStringOn();
    writer->Write();
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(writer->GetOutputString());
    const NodePtr loaded = treeOf(reader);
    ASSERT_TRUE(loaded);
    EXPECT_NE(loaded, saved);
    expectSameField(*loaded, *saved);

    vtkNew<vtkHybridTreeAffineTransform> edit; // and is edited, though never meshed before
    edit->SetInputConnection(reader->GetOutputPort());
    edit->SetTranslate(1.0, 2.0, 3.0);
    edit->SetEdgeLength(0.1);
    edit->Update();
    Affine3 map = Affine3::Identity();
    map.translate(Vec3(1.0, 2.0, 3.0));
    expectSameField(*edit->GetTree(), *saved->affine(map));
    expectSolid(edit->GetOutput());
  }
}

TEST(CarriedTree, AnEditedReloadSavesAgain)
{
  const Model model;
  model.difference->Update();
  vtkNew<vtkPolyData> loaded; // as a reader gives it: no live tree
  loaded->DeepCopy(model.difference->GetOutput());
  vtkNew<vtkStringArray> text;
  text->DeepCopy(loaded->GetFieldData()->GetAbstractArray("HybridTree"));
  text->SetName("HybridTree");
  loaded->GetFieldData()->AddArray(text);
  vtkNew<vtkHybridTreeAffineTransform> edit;
  edit->SetInputData(loaded);
  edit->SetEdgeLength(0.1);
  edit->Update();
  for (const auto& [hash, mesh] : meshesOf(*edit->GetTree()))
  {
    EXPECT_TRUE(edit->GetOutput()->GetFieldData()->GetArray(("HybridTreePoints:" + hash).c_str()));
    EXPECT_TRUE(
      edit->GetOutput()->GetFieldData()->GetArray(("HybridTreeTriangles:" + hash).c_str()));
  }
  EXPECT_EQ(meshesOf(*edit->GetTree()).size(), 2u);
}

TEST(CarriedTree, LeavesShareTheirMemory)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyData> kept;
  std::string name;
  {
    vtkNew<vtkHybridTreeMeshField> field;
    field->SetInputConnection(sphere->GetOutputPort());
    field->Update();
    const MeshPtr mesh = field->GetTree()->leafMesh();
    name = "HybridTreePoints:" + meshesOf(*field->GetTree()).front().first;
    vtkDataArray* points = field->GetOutput()->GetFieldData()->GetArray(name.c_str());
    ASSERT_TRUE(points);
    EXPECT_EQ(points->GetVoidPointer(0), mesh->points.front().data());
    kept->ShallowCopy(field->GetOutput());
    kept->GetFieldData()->RemoveArray("HybridTree");
  }
  // Filter and tree are gone; what is shared must not be.
  double bounds[6];
  kept->GetPoints()->ComputeBounds();
  kept->GetPoints()->GetBounds(bounds);
  EXPECT_NEAR(bounds[1], 0.5, 0.05);
  vtkDataArray* points = kept->GetFieldData()->GetArray(name.c_str());
  ASSERT_TRUE(points);
  EXPECT_NEAR(points->GetRange(-1)[1], 0.5, 1e-6) << "distance of the points from the centre";
}

TEST(CarriedTree, ADamagedTextIsAnError)
{
  const auto a = ball();
  a->Update();
  vtkNew<vtkPolyData> damaged;
  damaged->DeepCopy(a->GetOutput());
  auto* array =
    vtkStringArray::SafeDownCast(damaged->GetFieldData()->GetAbstractArray("HybridTree"));
  vtkNew<vtkStringArray> text;
  text->SetName("HybridTree");
  text->InsertNextValue("{ \"format\": \"HybridTree\", ");
  text->InsertNextValue(array->GetValue(1));
  damaged->GetFieldData()->AddArray(text);
  vtkNew<vtkHybridTreeAffineTransform> node;
  const Messages messages(node);
  node->SetInputData(damaged);
  node->Update();
  EXPECT_NE(messages.errors.find("Input: "), std::string::npos) << messages.errors;
  EXPECT_EQ(node->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(CarriedTree, ADamagedLeafIsAnError)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputConnection(sphere->GetOutputPort());
  field->Update();
  vtkNew<vtkPolyData> damaged;
  damaged->DeepCopy(field->GetOutput());
  const std::string hash = meshesOf(*field->GetTree()).front().first;
  damaged->GetFieldData()
    ->GetArray(("HybridTreeTriangles:" + hash).c_str())
    ->SetComponent(5, 0, 1e6);
  vtkNew<vtkStringArray> text;
  text->DeepCopy(damaged->GetFieldData()->GetAbstractArray("HybridTree"));
  text->SetName("HybridTree");
  damaged->GetFieldData()->AddArray(text);
  vtkNew<vtkHybridTreeAffineTransform> node;
  const Messages messages(node);
  node->SetInputData(damaged);
  node->Update();
  EXPECT_NE(messages.errors.find("triangle 5"), std::string::npos) << messages.errors;
}

/// A mesh leaf with point and cell data, as a file would bring it: no live tree.
struct LoadedLeaf
{
  LoadedLeaf()
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->Update();
    for (vtkDataSetAttributes* attributes :
      { static_cast<vtkDataSetAttributes*>(sphere->GetOutput()->GetPointData()),
        static_cast<vtkDataSetAttributes*>(sphere->GetOutput()->GetCellData()) })
    {
      vtkNew<vtkDoubleArray> heat;
      heat->SetName("Heat");
      heat->SetNumberOfTuples(attributes == sphere->GetOutput()->GetPointData()
          ? sphere->GetOutput()->GetNumberOfPoints()
          : sphere->GetOutput()->GetNumberOfPolys());
      heat->Fill(1.0);
      attributes->AddArray(heat);
    }
    vtkNew<vtkHybridTreeMeshField> field;
    field->SetInputData(sphere->GetOutput());
    field->Update();
    hash = meshesOf(*field->GetTree()).front().first;
    data->DeepCopy(field->GetOutput());
    vtkNew<vtkStringArray> text;
    text->DeepCopy(fields()->GetAbstractArray("HybridTree"));
    text->SetName("HybridTree");
    fields()->AddArray(text);
  }

  vtkFieldData* fields() { return data->GetFieldData(); }
  vtkDataArray* part(const std::string& kind, const std::string& end = "")
  {
    return fields()->GetArray(("HybridTree" + kind + ":" + hash + end).c_str());
  }
  vtkStringArray* text()
  {
    return vtkStringArray::SafeDownCast(fields()->GetAbstractArray("HybridTree"));
  }

  vtkNew<vtkPolyData> data;
  std::string hash;
};

TEST(CarriedTree, EachDamageIsNamed)
{
  using Damage = std::function<void(LoadedLeaf&)>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto replaceText = [](LoadedLeaf& leaf, const std::string& from, const std::string& to)
  {
    std::string text = leaf.text()->GetValue(0);
    text.replace(text.find(from), from.size(), to);
    leaf.text()->SetValue(0, text);
  };
  const std::pair<Damage, std::string> damages[] = {
    { [](LoadedLeaf&) {}, "" }, // whole, it works
    { [](LoadedLeaf& leaf) { leaf.text()->SetValue(0, leaf.text()->GetValue(0).substr(0, 40)); },
      "JSON" },
    { [](LoadedLeaf& leaf) { leaf.text()->SetValue(0, ""); }, "JSON" },
    { [](LoadedLeaf& leaf) { leaf.text()->SetNumberOfValues(1); }, "\"HybridTree\" is damaged" },
    { [](LoadedLeaf& leaf) { leaf.text()->SetValue(1, "garbled"); }, "fingerprint" },
    { [](LoadedLeaf& leaf)
      {
        vtkNew<vtkDoubleArray> numbers;
        numbers->SetName("HybridTree");
        leaf.fields()->AddArray(numbers);
      },
      "\"HybridTree\" is damaged" },
    { [&](LoadedLeaf& leaf) { replaceText(leaf, "\"mesh\"", "\"mush\""); }, "not a kind of node" },
    { [&](LoadedLeaf& leaf) { replaceText(leaf, "\"exponent\":2", "\"exponent\":1"); }, "xponent" },
    { [](LoadedLeaf& leaf) { leaf.fields()->RemoveArray(leaf.part("Points")->GetName()); },
      "Node 0" },
    { [](LoadedLeaf& leaf) { leaf.fields()->RemoveArray(leaf.part("Triangles")->GetName()); },
      "Node 0" },
    { [=](LoadedLeaf& leaf) { leaf.part("Points")->SetComponent(3, 1, nan); }, "damaged" },
    { [](LoadedLeaf& leaf) { leaf.part("Points")->SetNumberOfTuples(7); }, "triangle" },
    { [](LoadedLeaf& leaf) { leaf.part("Triangles")->SetNumberOfTuples(7); }, "damaged" },
    { [](LoadedLeaf& leaf) { leaf.part("Triangles")->SetComponent(2, 1, -1.0); }, "triangle 2" },
    { [](LoadedLeaf& leaf)
      {
        const std::string name = leaf.part("Points")->GetName();
        vtkNew<vtkDoubleArray> flat;
        flat->SetName(name.c_str());
        flat->SetNumberOfTuples(9);
        flat->Fill(0.0);
        leaf.fields()->AddArray(flat);
      },
      "three components" },
    { [](LoadedLeaf& leaf) { leaf.part("PointData", ":Heat")->SetNumberOfTuples(3); },
      "\"Heat\" has 3 rows" },
    { [](LoadedLeaf& leaf) { leaf.part("CellData", ":Heat")->SetNumberOfTuples(0); },
      "\"Heat\" has 0 rows" },
  };
  int number = 0;
  for (const auto& [damage, complaint] : damages)
  {
    SCOPED_TRACE(number++);
    LoadedLeaf leaf;
    damage(leaf);
    vtkNew<vtkHybridTreeAffineTransform> node;
    const Messages messages(node);
    node->SetInputData(leaf.data);
    node->Update();
    EXPECT_NE(messages.errors.find(complaint), std::string::npos) << messages.errors;
    EXPECT_EQ(messages.errors.empty(), complaint.empty()) << messages.errors;
    EXPECT_EQ(node->GetOutput()->GetNumberOfPoints() == 0, !complaint.empty());
  }
}

TEST(CarriedTree, OtherFieldDataStays)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkNew<vtkPolyData> input;
  input->ShallowCopy(sphere->GetOutput());
  vtkNew<vtkStringArray> note;
  note->SetName("Note");
  note->InsertNextValue("kept");
  input->GetFieldData()->AddArray(note);
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(input);
  field->Update();
  EXPECT_TRUE(field->GetOutput()->GetFieldData()->GetAbstractArray("Note"));
}

} // namespace
} // namespace hybridtree::test
