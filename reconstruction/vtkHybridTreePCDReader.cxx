// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreePCDReader.h"

#include "core/base/Error.h"
#include "reconstruction/FilterProgress.h"
#include "reconstruction/PcdFile.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkHybridTreeAbort.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtksys/FStream.hxx"

#include <array>
#include <cmath>
#include <cstring>

namespace
{

using hybridtree::PcdCloud;
using hybridtree::PcdField;
using Rows = std::vector<std::size_t>; // points that are kept

int vtkType(const PcdField& field)
{
  switch (field.size)
  {
    case 1:
      return field.type == 'I' ? VTK_TYPE_INT8 : VTK_TYPE_UINT8;
    case 2:
      return field.type == 'I' ? VTK_TYPE_INT16 : VTK_TYPE_UINT16;
    case 4:
      return field.type == 'F' ? VTK_FLOAT : field.type == 'I' ? VTK_TYPE_INT32 : VTK_TYPE_UINT32;
    default:
      return field.type == 'F' ? VTK_DOUBLE : field.type == 'I' ? VTK_TYPE_INT64 : VTK_TYPE_UINT64;
  }
}

// All numbers of a field, of all points.
vtkSmartPointer<vtkDataArray> toArray(const PcdCloud& cloud, std::size_t field)
{
  const PcdField& about = cloud.fields[field];
  auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(vtkType(about)));
  array->SetName(about.name.c_str());
  array->SetNumberOfComponents(static_cast<int>(about.count));
  array->SetNumberOfTuples(static_cast<vtkIdType>(cloud.points));
  if (!cloud.data[field].empty())
  {
    std::memcpy(array->GetVoidPointer(0), cloud.data[field].data(), cloud.data[field].size());
  }
  return array;
}

vtkSmartPointer<vtkDataArray> picked(vtkDataArray* all, const Rows& rows)
{
  if (rows.size() == static_cast<std::size_t>(all->GetNumberOfTuples()))
  {
    return all;
  }
  auto array = vtk::TakeSmartPointer(all->NewInstance());
  array->SetName(all->GetName());
  array->SetNumberOfComponents(all->GetNumberOfComponents());
  array->SetNumberOfTuples(static_cast<vtkIdType>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    array->SetTuple(static_cast<vtkIdType>(k), static_cast<vtkIdType>(rows[k]), all);
  }
  return array;
}

int findField(const PcdCloud& cloud, const std::string& name)
{
  for (std::size_t k = 0; k < cloud.fields.size(); ++k)
  {
    if (cloud.fields[k].name == name && cloud.fields[k].count == 1)
    {
      return static_cast<int>(k);
    }
  }
  return -1;
}

// Three fields as one array; null unless all are there. Float if all are, else double.
vtkSmartPointer<vtkDataArray> toVectors(
  const PcdCloud& cloud, const std::array<const char*, 3>& names)
{
  vtkSmartPointer<vtkDataArray> parts[3];
  bool allFloat = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int field = findField(cloud, names[axis]);
    if (field < 0)
    {
      return nullptr;
    }
    parts[axis] = toArray(cloud, field);
    allFloat = allFloat && parts[axis]->GetDataType() == VTK_FLOAT;
  }
  auto vectors =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(allFloat ? VTK_FLOAT : VTK_DOUBLE));
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(static_cast<vtkIdType>(cloud.points));
  for (int axis = 0; axis < 3; ++axis)
  {
    vectors->CopyComponent(axis, parts[axis], 0);
  }
  return vectors;
}

// From 0xAARRGGBB, whatever type the four bytes pass for.
vtkSmartPointer<vtkDataArray> toColors(const PcdCloud& cloud, std::size_t field)
{
  const bool alpha = cloud.fields[field].name == "rgba";
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName(alpha ? "RGBA" : "RGB");
  colors->SetNumberOfComponents(alpha ? 4 : 3);
  colors->SetNumberOfTuples(static_cast<vtkIdType>(cloud.points));
  unsigned char* to = colors->GetPointer(0);
  for (std::size_t k = 0; k < cloud.points; ++k)
  {
    std::uint32_t packed = 0;
    std::memcpy(&packed, cloud.data[field].data() + 4 * k, 4);
    *to++ = static_cast<unsigned char>(packed >> 16);
    *to++ = static_cast<unsigned char>(packed >> 8);
    *to++ = static_cast<unsigned char>(packed);
    if (alpha)
    {
      *to++ = static_cast<unsigned char>(packed >> 24);
    }
  }
  return colors;
}

bool isColor(const PcdField& field)
{
  return (field.name == "rgb" || field.name == "rgba") && field.size == 4 && field.count == 1;
}

bool isFinite(vtkDataArray* places, std::size_t point)
{
  double p[3];
  places->GetTuple(static_cast<vtkIdType>(point), p);
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

void writePoints(vtkDataArray* places, const Rows& rows, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetData(picked(places, rows));
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateEstimate(static_cast<vtkIdType>(rows.size()), 1);
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    if (isFinite(places, rows[k]))
    {
      vertices->InsertNextCell({ static_cast<vtkIdType>(k) });
    }
  }
  output->SetPoints(points);
  output->SetVerts(vertices);
}

void writeArrays(const PcdCloud& cloud, const Rows& rows, vtkPointData* output)
{
  const auto normals = toVectors(cloud, { "normal_x", "normal_y", "normal_z" });
  if (normals)
  {
    normals->SetName("Normals");
    output->SetNormals(picked(normals, rows));
  }
  for (std::size_t k = 0; k < cloud.fields.size(); ++k)
  {
    const PcdField& field = cloud.fields[k];
    if (isColor(field))
    {
      output->SetScalars(picked(toColors(cloud, k), rows));
      continue;
    }
    const bool place = field.name == "x" || field.name == "y" || field.name == "z";
    const bool normal = normals && field.name.compare(0, 7, "normal_") == 0 &&
      field.name.size() == 8 && field.name[7] >= 'x' && field.name[7] <= 'z';
    if (!place && !normal)
    {
      output->AddArray(picked(toArray(cloud, k), rows));
    }
  }
}

void writeField(const PcdCloud& cloud, const Rows& rows, vtkFieldData* output)
{
  vtkNew<vtkDoubleArray> viewpoint;
  viewpoint->SetName("Viewpoint");
  viewpoint->SetNumberOfComponents(7);
  viewpoint->InsertNextTuple(cloud.viewpoint);
  output->AddArray(viewpoint);
  if (cloud.height > 1 && rows.size() == cloud.points)
  {
    vtkNew<vtkIntArray> dimensions;
    dimensions->SetName("Dimensions");
    dimensions->SetNumberOfComponents(2);
    dimensions->InsertNextTuple2(double(cloud.width), double(cloud.height));
    output->AddArray(dimensions);
  }
}

} // namespace

vtkStandardNewMacro(vtkHybridTreePCDReader);

//------------------------------------------------------------------------------
vtkHybridTreePCDReader::vtkHybridTreePCDReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkHybridTreePCDReader::~vtkHybridTreePCDReader()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkHybridTreePCDReader::CanReadFile(const char* fileName)
{
  vtksys::ifstream stream(fileName, std::ios::binary);
  for (std::string word; stream >> word;)
  {
    if (word[0] != '#')
    {
      return word == "VERSION" || word == "FIELDS" || word == "COLUMNS";
    }
    stream.ignore(65536, '\n');
  }
  return 0;
}

//------------------------------------------------------------------------------
int vtkHybridTreePCDReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkHybridTreePCDReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkPolyData* output = vtkPolyData::GetData(info);
  if (info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    output->Initialize();
    return 1;
  }
  try
  {
    this->Read(output);
    return 1;
  }
  catch (const hybridtree::Cancelled&) // the user's wish, not an error
  {
    output->Initialize();
    hybridtree::haveStopped(this);
    return 1;
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro(<< (this->FileName ? this->FileName : "(no file)") << ": " << error.what());
    return 0;
  }
}

//------------------------------------------------------------------------------
void vtkHybridTreePCDReader::Read(vtkPolyData* output)
{
  using namespace hybridtree;
  vtksys::ifstream stream(this->FileName ? this->FileName : "", std::ios::binary);
  if (!stream)
  {
    throw InvalidGeometry("The file cannot be opened: set FileName to one that exists.");
  }
  const FilterProgress progress(this);
  const PcdCloud cloud = readPcd(stream, progress);
  const auto places = toVectors(cloud, { "x", "y", "z" });
  if (!places)
  {
    throw InvalidGeometry("The file has no fields x, y and z, one number each.");
  }
  Rows rows;
  for (std::size_t k = 0; k < cloud.points; ++k)
  {
    if (this->KeepInvalidPoints || isFinite(places, k))
    {
      rows.push_back(k);
    }
  }
  writePoints(places, rows, output);
  writeArrays(cloud, rows, output->GetPointData());
  writeField(cloud, rows, output->GetFieldData());
}

//------------------------------------------------------------------------------
void vtkHybridTreePCDReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "KeepInvalidPoints: " << this->KeepInvalidPoints << "\n";
}
