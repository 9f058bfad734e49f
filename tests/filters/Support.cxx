// SPDX-License-Identifier: BSD-3-Clause
#include "tests/filters/Support.h"

#include "tests/support/Random.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

#include <gtest/gtest.h>

vtkStandardNewMacro(vtkPVPostFilter);

int vtkPVPostFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject::GetData(outputs)->ShallowCopy(vtkDataObject::GetData(inputs[0]));
  return 1;
}

namespace hybridtree::test
{

Messages::Messages(vtkAlgorithm* algorithm)
{
  for (vtkObject* object :
    { static_cast<vtkObject*>(algorithm), static_cast<vtkObject*>(algorithm->GetExecutive()) })
  {
    for (const auto& [event, text] : { std::pair(vtkCommand::ErrorEvent, &this->errors),
           std::pair(vtkCommand::WarningEvent, &this->warnings) })
    {
      vtkNew<vtkCallbackCommand> command;
      command->SetClientData(text);
      command->SetCallback([](vtkObject*, unsigned long, void* kept, void* message)
        { *static_cast<std::string*>(kept) += static_cast<const char*>(message); });
      observers_.emplace_back(object, object->AddObserver(event, command));
    }
  }
}

Messages::~Messages()
{
  for (const auto& [object, tag] : observers_)
  {
    object->RemoveObserver(tag);
  }
}

void expectError(vtkHybridTreeAlgorithm* filter, const std::vector<std::string>& words)
{
  const Messages messages(filter);
  filter->Update();
  for (const std::string& word : words)
  {
    EXPECT_NE(messages.errors.find(word), std::string::npos)
      << "no \"" << word << "\" in: " << messages.errors;
  }
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_FALSE(filter->GetTree());
}

TriangleMesh trianglesOf(vtkPolyData* data)
{
  TriangleMesh mesh;
  mesh.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    data->GetPoint(static_cast<vtkIdType>(k), mesh.points[k].data());
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType t = 0; t < data->GetNumberOfCells(); ++t)
  {
    data->GetCellPoints(t, corners);
    EXPECT_EQ(corners->GetNumberOfIds(), 3) << "cell " << t;
    if (corners->GetNumberOfIds() == 3)
    {
      mesh.triangles.push_back({ static_cast<std::int32_t>(corners->GetId(0)),
        static_cast<std::int32_t>(corners->GetId(1)),
        static_cast<std::int32_t>(corners->GetId(2)) });
    }
  }
  return mesh;
}

void expectSolid(vtkPolyData* data)
{
  const TriangleMesh mesh = trianglesOf(data);
  EXPECT_FALSE(mesh.empty());
  const MeshReport report = checkMesh(mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_GT(signedVolume(mesh), 0.0);
}

double fieldAt(const Node& node, const Vec3& p)
{
  double value = 0.0;
  node.field({ &p.x(), &p.y(), &p.z(), 1 }, &value);
  return value;
}

void expectSameField(const Node& a, const Node& b)
{
  Random random(11u);
  const Box3 box = a.influenceBounds().merged(b.influenceBounds());
  for (int k = 0; k < 200; ++k)
  {
    const Vec3 p = random.inBox(box);
    ASSERT_EQ(fieldAt(a, p), fieldAt(b, p)) << "at " << p.transpose();
  }
}

vtkNew<vtkHybridTreePoint> ball(double x)
{
  vtkNew<vtkHybridTreePoint> source;
  source->SetCenter(x, 0.0, 0.0);
  source->SetEdgeLength(0.1);
  return source;
}

vtkNew<vtkHybridTreeSegment> rod()
{
  vtkNew<vtkHybridTreeSegment> source;
  source->SetPoint1(0.0, 0.0, 0.0);
  source->SetPoint2(1.5, 0.0, 0.0);
  source->SetSurfaceRadius(0.2);
  source->SetInfluenceRadius(0.6);
  source->SetEdgeLength(0.1);
  return source;
}

} // namespace hybridtree::test
