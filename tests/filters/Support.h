// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshChecks.h"
#include "core/nodes/Node.h"
#include "vtkCommand.h"
#include "vtkHybridTreeAlgorithm.h"
#include "vtkHybridTreePoint.h"
#include "vtkHybridTreeSegment.h"
#include "vtkNew.h"
#include "vtkPassInputTypeAlgorithm.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <utility>
#include <vector>

/// Stands for the filter of this name that ParaView puts behind every output: it hands on a shallow
/// copy without the keys of the data's information.
class vtkPVPostFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkPVPostFilter* New();
  vtkTypeMacro(vtkPVPostFilter, vtkPassInputTypeAlgorithm);

protected:
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
};

namespace hybridtree::test
{

/// Keeps the errors and warnings of a filter and its executive, which are not printed then.
class Messages
{
public:
  explicit Messages(vtkAlgorithm* algorithm);
  ~Messages();
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  std::string errors;
  std::string warnings;

private:
  std::vector<std::pair<vtkSmartPointer<vtkObject>, unsigned long>> observers_;
};

/// Runs a filter; expects an error that has all the words, and an empty output.
void expectError(vtkHybridTreeAlgorithm* filter, const std::vector<std::string>& words);

/// The triangles of a polydata. Fails the test when there are other cells.
TriangleMesh trianglesOf(vtkPolyData* data);

/// Expects a closed, oriented 2-manifold of outward orientation, not empty.
void expectSolid(vtkPolyData* data);

/// Expects equal fields at random points around both.
void expectSameField(const Node& a, const Node& b);

/// f(p).
double fieldAt(const Node& node, const Vec3& p);

/// A ball, and a rod that reaches out of it along x.
vtkNew<vtkHybridTreePoint> ball(double x = 0.0);
vtkNew<vtkHybridTreeSegment> rod();

} // namespace hybridtree::test
