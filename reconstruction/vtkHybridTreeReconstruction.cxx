// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeReconstruction.h"

#include "core/base/Error.h"
#include "core/nodes/MeshNode.h"
#include "reconstruction/Convection.h"
#include "reconstruction/FilterProgress.h"
#include "reconstruction/KeptReconstruction.h"
#include "reconstruction/LevelOfDetail.h"
#include "reconstruction/PointCloud.h"
#include "reconstruction/WorkEstimate.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkHybridTreeArray.h"
#include "vtkHybridTreeBlocks.h"
#include "vtkHybridTreeProcesses.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace
{

constexpr double kAutomaticTolerance = 1e-3; // in longest sides of the bounds
constexpr const char* kNormals = "Normals";
constexpr const char* kPointIds = "PointIds";

std::vector<hybridtree::Vec3> readPoints(vtkDataSet* input)
{
  const vtkIdType count = input->GetNumberOfPoints();
  if (count > std::numeric_limits<std::int32_t>::max())
  {
    throw hybridtree::TooLarge("The input has " + std::to_string(count) +
      " points, more than the 2147483647 that can be counted: thin it first.");
  }
  std::vector<hybridtree::Vec3> points(static_cast<std::size_t>(count));
  for (vtkIdType k = 0; k < count; ++k)
  {
    input->GetPoint(k, points[static_cast<std::size_t>(k)].data());
  }
  return points;
}

// Of the chosen points; none if the input has none.
std::vector<hybridtree::Vec3> readNormals(
  vtkDataSet* input, const std::vector<std::int32_t>& chosen)
{
  vtkDataArray* array = input->GetPointData()->GetNormals();
  if (!array)
  {
    array = input->GetPointData()->GetArray(kNormals);
  }
  std::vector<hybridtree::Vec3> normals;
  if (array && array->GetNumberOfComponents() == 3 &&
    array->GetNumberOfTuples() >= input->GetNumberOfPoints())
  {
    normals.resize(chosen.size());
    for (std::size_t k = 0; k < chosen.size(); ++k)
    {
      array->GetTuple(chosen[k], normals[k].data());
    }
  }
  return normals;
}

hybridtree::Box3 boundsOf(const std::vector<hybridtree::Vec3>& points)
{
  hybridtree::Box3 bounds;
  for (const hybridtree::Vec3& point : points)
  {
    bounds.extend(point);
  }
  return bounds;
}

double automaticTolerance(const hybridtree::Box3& bounds)
{
  return bounds.isEmpty() ? 0.0 : kAutomaticTolerance * bounds.sizes().maxCoeff();
}

void checkParameters(vtkHybridTreeReconstruction& filter)
{
  using Filter = vtkHybridTreeReconstruction;
  using hybridtree::InvalidParameter;
  const int level = filter.GetLevelOfDetail();
  if (level < Filter::ALL_POINTS || level > Filter::DETAIL_LEVEL)
  {
    throw InvalidParameter("LevelOfDetail", level,
      "0 (all points), 1 (tolerance), 2 (target vertices) or 3 (detail level)");
  }
  if (filter.GetRemoveOutliers() && filter.GetOutlierNeighbors() > 1000)
  {
    throw InvalidParameter("OutlierNeighbors", filter.GetOutlierNeighbors(), "1 to 1000");
  }
  if (level == Filter::TARGET_VERTICES && filter.GetTargetVertices() < 4)
  {
    throw InvalidParameter("TargetVertices", filter.GetTargetVertices(), "4 or more");
  }
  const double share = filter.GetDetailLevel();
  if (level == Filter::DETAIL_LEVEL && !(share >= 0.001 && share <= 1.0))
  {
    throw InvalidParameter("DetailLevel", share, "0.001 to 1, a share of the points");
  }
}

// Where a face of the box widget is dragged past the opposite one, a length turns negative.
hybridtree::Box3 refinedRegion(vtkHybridTreeReconstruction& filter)
{
  const hybridtree::Vec3 corner(filter.GetRefineOrigin());
  const hybridtree::Vec3 opposite = corner + hybridtree::Vec3(filter.GetRefineLengths());
  if (!opposite.allFinite())
  {
    return { corner, opposite }; // to be refused with the other bounds that are not finite
  }
  return { corner.cwiseMin(opposite), corner.cwiseMax(opposite) };
}

hybridtree::LevelOfDetail detailOf(
  vtkHybridTreeReconstruction& filter, std::size_t count, const hybridtree::Box3& bounds)
{
  hybridtree::LevelOfDetail detail;
  switch (filter.GetLevelOfDetail())
  {
    case vtkHybridTreeReconstruction::TOLERANCE:
      detail.tolerance =
        filter.GetTolerance() == 0.0 ? automaticTolerance(bounds) : filter.GetTolerance();
      break;
    case vtkHybridTreeReconstruction::TARGET_VERTICES:
      detail.vertices = static_cast<std::size_t>(filter.GetTargetVertices());
      break;
    case vtkHybridTreeReconstruction::DETAIL_LEVEL:
      detail.vertices = std::max<std::size_t>(
        4, static_cast<std::size_t>(std::lround(filter.GetDetailLevel() * double(count))));
      break;
    default:
      break;
  }
  if (filter.GetRefineRegion())
  {
    detail.region = refinedRegion(filter);
    detail.regionTolerance = filter.GetRefineTolerance();
  }
  return detail;
}

hybridtree::WorkEstimate estimateOf(
  vtkHybridTreeReconstruction& filter, std::size_t count, const hybridtree::Box3& bounds)
{
  return filter.GetLevelOfDetail() == vtkHybridTreeReconstruction::ALL_POINTS
    ? hybridtree::estimateWork(count)
    : hybridtree::estimateWork(count, bounds, detailOf(filter, count, bounds));
}

/// Numbers of the points that the surface is made of. Smoothing moves them in `all`.
std::vector<std::int32_t> choosePoints(vtkHybridTreeReconstruction& filter,
  std::vector<hybridtree::Vec3>& all, const hybridtree::Progress& progress)
{
  using namespace hybridtree;
  std::vector<std::int32_t> chosen = withoutDuplicates(all, allPoints(all), progress);
  if (filter.GetRemoveOutliers())
  {
    chosen = withoutOutliers(all, chosen, filter.GetOutlierNeighbors(),
      filter.GetOutlierDeviation(), ProgressPart(progress, 0.0, 0.5));
  }
  const double radius = filter.GetSmoothingRadius();
  if (radius != 0.0)
  {
    chosen = smooth(all, chosen, radius, ProgressPart(progress, 0.5, 0.75));
  }
  // Points of several layers have come to lie side by side: closer ones would only make slivers.
  const double spacing = filter.GetSpacing();
  const double least = spacing >= 0.0 ? 0.25 * radius : spacing;
  return thinned(all, chosen, std::max(spacing, least), ProgressPart(progress, 0.75, 1.0));
}

hybridtree::ConvectionOptions optionsOf(vtkHybridTreeReconstruction& filter)
{
  hybridtree::ConvectionOptions options;
  options.openPockets = filter.GetOpenPockets();
  options.pocketFactor = filter.GetPocketFactor();
  options.closeHoles = filter.GetCloseHoles();
  options.holeFactor = filter.GetHoleFactor();
  return options;
}

hybridtree::Box3 boundsOf(vtkDataObject* data)
{
  double ends[6];
  vtkMath::UninitializeBounds(ends);
  if (auto* set = vtkDataSet::SafeDownCast(data))
  {
    set->GetBounds(ends);
  }
  else if (auto* blocks = vtkCompositeDataSet::SafeDownCast(data))
  {
    blocks->GetBounds(ends);
  }
  hybridtree::Box3 bounds;
  if (vtkMath::AreBoundsInitialized(ends))
  {
    bounds.extend(hybridtree::Vec3(ends[0], ends[2], ends[4]));
    bounds.extend(hybridtree::Vec3(ends[1], ends[3], ends[5]));
  }
  return bounds;
}

int pointType(vtkDataSet* input)
{
  vtkPointSet* set = vtkPointSet::SafeDownCast(input);
  return set && set->GetPoints() && set->GetPoints()->GetDataType() == VTK_FLOAT ? VTK_FLOAT
                                                                                 : VTK_DOUBLE;
}

void writeGeometry(const hybridtree::TriangleMesh& mesh, int type, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    points->SetPoint(static_cast<vtkIdType>(k), mesh.points[k].data());
  }
  vtkNew<vtkCellArray> polygons;
  polygons->AllocateExact(static_cast<vtkIdType>(mesh.triangles.size()),
    static_cast<vtkIdType>(3 * mesh.triangles.size()));
  for (const hybridtree::Triangle& triangle : mesh.triangles)
  {
    polygons->InsertNextCell({ triangle[0], triangle[1], triangle[2] });
  }
  output->SetPoints(points);
  output->SetPolys(polygons);
}

void writeArrays(const hybridtree::TriangleMesh& mesh, const std::vector<std::int32_t>& ids,
  vtkIdType points, vtkPointData* input, vtkPointData* output)
{
  const auto count = static_cast<vtkIdType>(ids.size());
  output->CopyFieldOff(kNormals);
  output->CopyFieldOff(kPointIds);
  for (int k = 0; k < input->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = input->GetAbstractArray(k);
    if (array->GetName() && array->GetNumberOfTuples() < points)
    {
      output->CopyFieldOff(array->GetName()); // not there for all points: VTK would read beyond it
    }
  }
  output->CopyAllocate(input, count);
  vtkNew<vtkDoubleArray> normals;
  normals->SetName(kNormals);
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const auto index = static_cast<std::size_t>(k);
    output->CopyData(input, ids[index], k);
    normals->SetTuple(k, mesh.normals[index].data());
  }
  output->SetNormals(normals);
}

void writePointIds(const std::vector<std::int32_t>& ids, vtkPointData* output)
{
  vtkNew<vtkIdTypeArray> pointIds;
  pointIds->SetName(kPointIds);
  pointIds->SetNumberOfTuples(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), pointIds->GetPointer(0));
  output->AddArray(pointIds);
}

// The whole surface is one leaf, numbered and named as the other nodes number and name leaves.
void writeSource(vtkPolyData* output)
{
  vtkNew<vtkIntArray> ids;
  ids->SetName("SourceId");
  ids->SetNumberOfTuples(output->GetNumberOfCells());
  ids->Fill(0);
  output->GetCellData()->AddArray(ids);
  vtkNew<vtkStringArray> names;
  names->SetName("SourceNames");
  names->InsertNextValue("Mesh 0");
  output->GetFieldData()->AddArray(names);
}

} // namespace

vtkStandardNewMacro(vtkHybridTreeReconstruction);

//------------------------------------------------------------------------------
vtkHybridTreeReconstruction::vtkHybridTreeReconstruction()
  : Kept(std::make_unique<hybridtree::KeptReconstruction>())
{
}

vtkHybridTreeReconstruction::~vtkHybridTreeReconstruction() = default;

//------------------------------------------------------------------------------
int vtkHybridTreeReconstruction::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  hybridtree::takeComposite(info);
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeReconstruction::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  // ParaView reads it right after this, so the panel has it before the work is asked for.
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  const vtkIdType points = input ? input->GetNumberOfElements(vtkDataObject::POINT) : 0;
  if (points > 0)
  {
    this->KeepEstimate(estimateOf(*this, static_cast<std::size_t>(points), boundsOf(input)));
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeReconstruction::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (info->Has(Pipeline::WHOLE_EXTENT()))
  {
    int extent[6];
    info->Get(Pipeline::WHOLE_EXTENT(), extent);
    info->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreeReconstruction::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkPolyData* output = vtkPolyData::GetData(info);
  const auto work = [&]
  {
    const auto blocks = hybridtree::blocksOf(vtkDataObject::GetData(inputs[0]));
    if (info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
    {
      output->Initialize();
      return;
    }
    const vtkSmartPointer<vtkDataSet> input = hybridtree::joined(blocks);
    if (!input)
    {
      throw hybridtree::InvalidGeometry("There is no data. Check the filter it comes from.");
    }
    this->Reconstruct(input, output);
  };
  return hybridtree::runOnAll(this, work, [&] { output->Initialize(); });
}

//------------------------------------------------------------------------------
void vtkHybridTreeReconstruction::Reconstruct(vtkDataSet* input, vtkPolyData* output)
{
  using namespace hybridtree;
  checkParameters(*this);
  const FilterProgress progress(this);
  std::vector<Vec3> all = readPoints(input);
  const std::vector<std::int32_t> chosen =
    choosePoints(*this, all, ProgressPart(progress, 0.0, 0.2));
  std::vector<Vec3> points(chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k)
  {
    points[k] = all[chosen[k]];
  }
  ConvectionOptions options = optionsOf(*this);
  if (this->UseNormals)
  {
    options.normals = readNormals(input, chosen);
  }
  const ProgressPart part(progress, 0.2, 1.0);
  const Box3 bounds = boundsOf(points);
  const hybridtree::LevelOfDetail detail = detailOf(*this, points.size(), bounds);
  const bool keep = this->KeepState && this->LevelOfDetail != ALL_POINTS;
  if (!keep)
  {
    this->Kept->clear();
  }
  this->KeepEstimate(estimateOf(*this, points.size(), bounds));
  this->TellEstimate(points.size());
  ReconstructedSurface surface = keep   ? this->Kept->update(points, detail, options, part)
    : this->LevelOfDetail == ALL_POINTS ? reconstruct(points, options, part)
                                        : reconstruct(points, detail, options, part);
  for (std::int32_t& id : surface.pointIds)
  {
    id = chosen[id];
  }
  for (const std::string& warning : surface.warnings)
  {
    vtkWarningMacro(<< warning);
  }

  writeGeometry(surface.mesh, pointType(input), output);
  writeArrays(surface.mesh, surface.pointIds, input->GetNumberOfPoints(), input->GetPointData(),
    output->GetPointData());
  writeSource(output);
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(surface.mesh));
  vtkHybridTreeArray::PutLeaf(
    makeMeshNode(mesh, 2.0 * kThreshold, defaultInfluenceRadius(*mesh), 2), output);
  writePointIds(surface.pointIds, output->GetPointData()); // of this surface only: not on the leaf
}

//------------------------------------------------------------------------------
void vtkHybridTreeReconstruction::KeepEstimate(const hybridtree::WorkEstimate& estimate)
{
  this->EstimatedMemory = std::ceil(std::ldexp(estimate.bytes, -20));
  this->EstimatedTime = 0.1 * std::ceil(10.0 * estimate.seconds);
}

//------------------------------------------------------------------------------
void vtkHybridTreeReconstruction::TellEstimate(std::size_t points)
{
  std::ostringstream text;
  text << std::fixed << "Reconstructing " << points << " points, in about "
       << std::setprecision(this->EstimatedTime < 10.0 ? 1 : 0) << this->EstimatedTime << " s and "
       << std::setprecision(0) << this->EstimatedMemory << " MiB";
  this->SetProgressText(text.str().c_str());
  vtkDebugMacro(<< text.str());
}

//------------------------------------------------------------------------------
void vtkHybridTreeReconstruction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EstimatedMemory: " << this->EstimatedMemory << "\n";
  os << indent << "EstimatedTime: " << this->EstimatedTime << "\n";
  os << indent << "Spacing: " << this->Spacing << "\n";
  os << indent << "RemoveOutliers: " << this->RemoveOutliers << "\n";
  os << indent << "OutlierNeighbors: " << this->OutlierNeighbors << "\n";
  os << indent << "OutlierDeviation: " << this->OutlierDeviation << "\n";
  os << indent << "OpenPockets: " << this->OpenPockets << "\n";
  os << indent << "PocketFactor: " << this->PocketFactor << "\n";
  os << indent << "CloseHoles: " << this->CloseHoles << "\n";
  os << indent << "HoleFactor: " << this->HoleFactor << "\n";
  os << indent << "UseNormals: " << this->UseNormals << "\n";
  os << indent << "SmoothingRadius: " << this->SmoothingRadius << "\n";
  os << indent << "LevelOfDetail: " << this->LevelOfDetail << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TargetVertices: " << this->TargetVertices << "\n";
  os << indent << "DetailLevel: " << this->DetailLevel << "\n";
  os << indent << "RefineRegion: " << this->RefineRegion << "\n";
  os << indent << "RefineOrigin: " << this->RefineOrigin[0] << " " << this->RefineOrigin[1] << " "
     << this->RefineOrigin[2] << "\n";
  os << indent << "RefineLengths: " << this->RefineLengths[0] << " " << this->RefineLengths[1]
     << " " << this->RefineLengths[2] << "\n";
  os << indent << "RefineTolerance: " << this->RefineTolerance << "\n";
  os << indent << "KeepState: " << this->KeepState << "\n";
}
