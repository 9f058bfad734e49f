// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeProbe.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/nodes/Node.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkHybridTreeAlgorithm.h"
#include "vtkHybridTreeFormulation.h"
#include "vtkHybridTreeOperand.h"
#include "vtkHybridTreeProcesses.h"
#include "vtkHybridTreeProgress.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <atomic>

vtkStandardNewMacro(vtkHybridTreeProbe);

struct vtkHybridTreeProbe::State
{
  hybridtree::Operand Tree;
  hybridtree::FormulationRequest Asked;
};

namespace
{

constexpr std::size_t kBatch = 512;

template <class Array>
Array* addArray(vtkDataSet* output, const char* name, int components)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(output->GetNumberOfPoints());
  output->GetPointData()->AddArray(array);
  return array;
}

/// Fills the four arrays, batch by batch.
class Prober
{
public:
  Prober(const hybridtree::Node& node, vtkDataSet* output)
    : node_(node)
    , points_(output)
    , size_(static_cast<std::size_t>(output->GetNumberOfPoints()))
    , field_(addArray<vtkDoubleArray>(output, "Field", 1)->GetPointer(0))
    , gradient_(addArray<vtkDoubleArray>(output, "Gradient", 3)->GetPointer(0))
    , membership_(addArray<vtkSignedCharArray>(output, "Membership", 1)->GetPointer(0))
    , distance_(addArray<vtkDoubleArray>(output, "SignedDistance", 1)->GetPointer(0))
  {
  }

  void run(const hybridtree::Progress& progress) const
  {
    double first[3];
    if (size_ > 0)
    {
      points_->GetPoint(0, first); // builds what the data set needs before threads may ask it
    }
    std::atomic<std::size_t> done{ 0 };
    hybridtree::parallelFor(size_, kBatch,
      [&](std::size_t begin, std::size_t end)
      {
        progress.check();
        for (std::size_t k = begin; k < end; k += kBatch)
        {
          this->probe(k, std::min(kBatch, end - k));
        }
        progress.report(static_cast<double>(done += end - begin) / static_cast<double>(size_));
      });
  }

private:
  void probe(std::size_t begin, std::size_t count) const
  {
    hybridtree::ScratchVectors points(count);
    hybridtree::ScratchVectors gradients(count);
    const hybridtree::VectorBatch position = points.batch();
    const hybridtree::VectorBatch gradient = gradients.batch();
    for (std::size_t k = 0; k < count; ++k)
    {
      hybridtree::Vec3 x;
      points_->GetPoint(static_cast<vtkIdType>(begin + k), x.data());
      position.set(k, x);
    }
    node_.fieldAndGradient(points.points(), field_ + begin, gradient);
    node_.membership(points.points(), membership_ + begin);
    node_.signedDistance(points.points(), distance_ + begin);
    for (std::size_t k = 0; k < count; ++k)
    {
      const hybridtree::Vec3 g = gradient[k];
      std::copy_n(g.data(), 3, gradient_ + 3 * (begin + k));
    }
  }

  const hybridtree::Node& node_;
  vtkDataSet* points_;
  std::size_t size_;
  double* field_;
  double* gradient_;
  signed char* membership_;
  double* distance_;
};

} // namespace

//------------------------------------------------------------------------------
vtkHybridTreeProbe::vtkHybridTreeProbe() : Internals(new State)
{
  this->SetNumberOfInputPorts(2);
}

vtkHybridTreeProbe::~vtkHybridTreeProbe() = default;

//------------------------------------------------------------------------------
int vtkHybridTreeProbe::ModifyRequest(vtkInformation*, int when)
{
  hybridtree::FormulationRequest& asked = this->Internals->Asked;
  when == vtkExecutive::BeforeForward ? asked.send(this) : asked.takeBack();
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeProbe::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    hybridtree::takeComposite(info);
    info->Set(vtkHybridTreeAlgorithm::TAKES_TREE(), 1);
    return 1;
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

//------------------------------------------------------------------------------
int vtkHybridTreeProbe::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataSet* points = vtkDataSet::GetData(inputs[1]);
  vtkDataSet* output = vtkDataSet::GetData(outputs);
  if (!points)
  {
    try
    {
      hybridtree::requireGeometry(vtkDataObject::GetData(inputs[1]));
    }
    catch (const hybridtree::Error& error)
    {
      vtkErrorMacro("Points: " << error.what());
    }
    return 0;
  }
  if (!output || output->GetDataObjectType() != points->GetDataObjectType())
  {
    const auto made = vtk::TakeSmartPointer(points->NewInstance());
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeProbe::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // By default an output takes extent and spacing from port 0; here they are those of Points.
  vtkInformation* points = inputs[1]->GetInformationObject(0);
  vtkInformation* output = outputs->GetInformationObject(0);
  output->CopyEntry(points, vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  output->CopyEntry(points, vtkDataObject::SPACING());
  output->CopyEntry(points, vtkDataObject::ORIGIN());
  output->CopyEntry(points, vtkDataObject::DIRECTION());
  output->CopyEntry(points, vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST());
  output->CopyEntry(points, vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT());
  hybridtree::mergeTimes(this->GetNumberOfInputPorts(), inputs, output);
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeProbe::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  hybridtree::askWhole(0, inputs);
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeProbe::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataSet* output = vtkDataSet::GetData(outputs);
  const auto probe = [&]
  {
    const hybridtree::FilterProgress progress(this);
    const hybridtree::ProgressPart reading(progress, 0.0, hybridtree::kReadingShare);
    const hybridtree::ProgressPart probing(progress, hybridtree::kReadingShare, 1.0);
    std::vector<std::string> warnings;
    try
    {
      this->Internals->Tree.read(
        hybridtree::blocksOf(vtkDataObject::GetData(inputs[0])), warnings, reading);
    }
    catch (const hybridtree::Cancelled&)
    {
      this->Internals->Tree = {}; // or what it has to tell would be lost
      throw;
    }
    catch (const hybridtree::Error& error)
    {
      throw hybridtree::InvalidGeometry(std::string("Tree: ") + error.what());
    }
    for (const std::string& warning : warnings)
    {
      vtkWarningMacro(<< warning);
    }
    output->ShallowCopy(vtkDataSet::GetData(inputs[1]));
    Prober(*this->Internals->Tree.node(), output).run(probing);
  };
  return hybridtree::runOnAll(this, probe, [&] { output->Initialize(); });
}

//------------------------------------------------------------------------------
void vtkHybridTreeProbe::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto& nodes = this->Internals->Tree.nodes();
  os << indent << "Tree: " << (nodes.empty() ? "(none)" : nodes.front()->kind()) << "\n";
}
