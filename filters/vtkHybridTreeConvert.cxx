// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeConvert.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/PlanarTriangulation.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHybridTreeBlocks.h"
#include "vtkHybridTreeRangedArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

namespace hybridtree
{
namespace
{

// ---------------------------------------------------------------------------- shared memory

/// VTK's buffers free their memory by a function that gets nothing but the address. This remembers
/// whose memory it is.
class Owners
{
public:
  static Owners& instance()
  {
    static Owners* const owners = new Owners; // never destroyed: arrays may outlive statics
    return *owners;
  }

  void add(void* address, std::shared_ptr<const void> owner)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    owners_.emplace(address, std::move(owner));
  }

  static void release(void* address)
  {
    Owners& self = instance();
    std::shared_ptr<const void> last; // goes after the lock
    const std::lock_guard<std::mutex> lock(self.mutex_);
    const auto found = self.owners_.find(address);
    if (found != self.owners_.end())
    {
      last = std::move(found->second);
      self.owners_.erase(found);
    }
  }

private:
  std::mutex mutex_;
  std::multimap<void*, std::shared_ptr<const void>> owners_;
};

template <class Array, class Value>
vtkSmartPointer<vtkDataArray> share(const Value* values, int components, std::size_t tuples,
  std::shared_ptr<const void> owner, const std::string& name)
{
  auto array = vtkSmartPointer<RangedArray<Array>>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  if (tuples > 0)
  {
    auto* address = const_cast<Value*>(values);
    Owners::instance().add(address, std::move(owner));
    array->SetArray(address, static_cast<vtkIdType>(tuples) * components, 0,
      vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
    array->SetArrayFreeFunction(&Owners::release);
  }
  return array;
}

// ---------------------------------------------------------------------------- fingerprint

/// Four independent multiply-and-rotate lanes of 64 bits, so that it runs at the speed of memory.
class Hash
{
public:
  void add(vtkTypeUInt64 word)
  {
    vtkTypeUInt64& lane = lanes_[count_++ & 3u];
    lane = (lane ^ word) * 0x9e3779b97f4a7c15ull;
    lane = (lane << 31) | (lane >> 33);
  }

  void add(double value)
  {
    value += 0.0; // -0 is 0
    vtkTypeUInt64 word;
    std::memcpy(&word, &value, sizeof word);
    this->add(word);
  }

  vtkTypeUInt64 result() const
  {
    vtkTypeUInt64 sum = count_;
    for (vtkTypeUInt64 lane : lanes_)
    {
      sum = (sum ^ lane) * 0xbf58476d1ce4e5b9ull;
      sum ^= sum >> 31;
    }
    return sum;
  }

private:
  vtkTypeUInt64 lanes_[4] = { 0x243f6a8885a308d3ull, 0x13198a2e03707344ull, 0xa4093822299f31d0ull,
    0x082efa98ec4e6c89ull };
  vtkTypeUInt64 count_ = 0;
};

template <class Array, class Body>
void forEachCell(Array* offsets, Array* corners, vtkIdType count, Body&& body)
{
  const auto* begin = offsets->GetPointer(0);
  const auto* corner = corners->GetPointer(0);
  std::vector<vtkIdType> points;
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    points.assign(corner + begin[cell], corner + begin[cell + 1]);
    body(static_cast<vtkIdType>(points.size()), points.data());
  }
}

/// Straight from the arrays: VTK's iterator takes as long as all the rest.
template <class Body>
void forEachCell(vtkCellArray* cells, Body&& body)
{
  const vtkIdType count = cells->GetNumberOfCells();
  if (count == 0)
  {
    return;
  }
  if (cells->IsStorage64Bit())
  {
    forEachCell(cells->GetOffsetsArray64(), cells->GetConnectivityArray64(), count, body);
  }
  else
  {
    forEachCell(cells->GetOffsetsArray32(), cells->GetConnectivityArray32(), count, body);
  }
}

void addCells(Hash& hash, vtkCellArray* cells)
{
  hash.add(static_cast<vtkTypeUInt64>(cells->GetNumberOfCells()));
  forEachCell(cells,
    [&hash](vtkIdType size, const vtkIdType* points)
    {
      hash.add(static_cast<vtkTypeUInt64>(size));
      for (vtkIdType k = 0; k < size; ++k)
      {
        hash.add(static_cast<vtkTypeUInt64>(points[k]));
      }
    });
}

void addPoints(Hash& hash, vtkPoints* points)
{
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  hash.add(static_cast<vtkTypeUInt64>(count));
  if (auto* doubles = vtkDoubleArray::SafeDownCast(points ? points->GetData() : nullptr))
  {
    const double* values = doubles->GetPointer(0);
    for (vtkIdType k = 0; k < 3 * count; ++k)
    {
      hash.add(values[k]);
    }
    return;
  }
  for (vtkIdType p = 0; p < count; ++p)
  {
    double x[3];
    points->GetPoint(p, x);
    hash.add(x[0]);
    hash.add(x[1]);
    hash.add(x[2]);
  }
}

// ---------------------------------------------------------------------------- from VTK

/// Collects the triangles of an input, each with the cell it comes from.
class Triangulator
{
public:
  explicit Triangulator(vtkPolyData* input) : input_(input)
  {
    if (input->GetNumberOfPoints() > std::numeric_limits<std::int32_t>::max())
    {
      throw TooLarge("The input has " + std::to_string(input->GetNumberOfPoints()) +
        " points; a mesh leaf holds at most 2147483647. Decimate it first.");
    }
    vtkIdType cell = input->GetNumberOfVerts() + input->GetNumberOfLines();
    forEachCell(input->GetPolys(),
      [&](vtkIdType size, const vtkIdType* points) { this->addPolygon(cell++, size, points); });
    forEachCell(input->GetStrips(),
      [&](vtkIdType size, const vtkIdType* points) { this->addStrip(cell++, size, points); });
  }

  std::vector<Triangle> triangles;
  std::vector<vtkIdType> cells;
  std::size_t fans = 0; ///< polygons that had to be cut without regard to their shape

private:
  void add(vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c)
  {
    triangles.push_back(
      { static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c) });
    cells.push_back(cell);
  }

  void addStrip(vtkIdType cell, vtkIdType size, const vtkIdType* points)
  {
    for (vtkIdType k = 2; k < size; ++k)
    {
      const vtkIdType odd = k % 2;
      this->add(cell, points[k - 2 + odd], points[k - 1 - odd], points[k]);
    }
  }

  void addPolygon(vtkIdType cell, vtkIdType size, const vtkIdType* points)
  {
    if (size == 3)
    {
      this->add(cell, points[0], points[1], points[2]);
    }
    else if (size > 3 && !this->cutEars(cell, size, points))
    {
      ++fans;
      for (vtkIdType k = 2; k < size; ++k)
      {
        this->add(cell, points[0], points[k - 1], points[k]);
      }
    }
  }

  bool cutEars(vtkIdType cell, vtkIdType size, const vtkIdType* points)
  {
    polygon_->PointIds->SetNumberOfIds(size);
    polygon_->Points->SetNumberOfPoints(size);
    outline_.resize(static_cast<std::size_t>(size));
    for (vtkIdType k = 0; k < size; ++k)
    {
      Vec3& x = outline_[static_cast<std::size_t>(k)];
      input_->GetPoint(points[k], x.data());
      polygon_->PointIds->SetId(k, k);
      polygon_->Points->SetPoint(k, x.data());
    }
    if (size > 4 && this->hasBridges() && this->cutInPlane(cell, points))
    {
      return true;
    }
    if (!polygon_->Triangulate(0, corners_, unused_) ||
      corners_->GetNumberOfIds() != 3 * (size - 2))
    {
      return false;
    }
    for (vtkIdType k = 0; k < corners_->GetNumberOfIds(); k += 3)
    {
      this->add(cell, points[corners_->GetId(k)], points[corners_->GetId(k + 1)],
        points[corners_->GetId(k + 2)]);
    }
    return true;
  }

  /// Whether corners of the polygon have equal coordinates: VTK takes them for faults.
  bool hasBridges()
  {
    if (!std::all_of(outline_.begin(), outline_.end(), [](const Vec3& x) { return x.allFinite(); }))
    {
      return false; // told by the repair
    }
    sorted_ = outline_;
    std::sort(sorted_.begin(), sorted_.end(),
      [](const Vec3& a, const Vec3& b)
      { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end()); });
    return std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end();
  }

  /// Cuts the polygon as it is seen along the axis nearest to its normal, which leaves coordinates
  /// as they are. \returns whether all triangles are the right way round and cover it.
  bool cutInPlane(vtkIdType cell, const vtkIdType* points)
  {
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < outline_.size(); ++k)
    {
      normal += (outline_[k] - outline_[0]).cross(outline_[k + 1] - outline_[0]);
    }
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const bool mirrored = !(normal[axis] > 0.0);
    std::vector<Vec2> outline;
    for (const Vec3& x : outline_)
    {
      const double u = x[(axis + 1) % 3];
      outline.emplace_back(mirrored ? -u : u, x[(axis + 2) % 3]);
    }
    const std::vector<Triangle> cut = triangulatePolygon(outline);
    double area = 0.0;
    for (const auto& [a, b, c] : cut)
    {
      const Vec2 ab = outline[b] - outline[a];
      const Vec2 ac = outline[c] - outline[a];
      const double twice = ab.x() * ac.y() - ab.y() * ac.x();
      if (twice < -1e-9 * std::abs(normal[axis]))
      {
        return false;
      }
      area += twice;
    }
    if (cut.size() + 2 != outline.size() ||
      std::abs(area - std::abs(normal[axis])) > 1e-9 * std::abs(normal[axis]))
    {
      return false;
    }
    for (const auto& [a, b, c] : cut)
    {
      this->add(cell, points[a], points[b], points[c]);
    }
    return true;
  }

  vtkPolyData* input_;
  vtkNew<vtkPolygon> polygon_;
  vtkNew<vtkIdList> corners_;
  vtkNew<vtkPoints> unused_;
  std::vector<Vec3> outline_, sorted_;
};

/// Returns the number of the cell after the last one.
vtkIdType requirePointsOf(vtkCellArray* cells, vtkIdType cell, vtkIdType points)
{
  forEachCell(cells,
    [&](vtkIdType size, const vtkIdType* ids)
    {
      const auto bad =
        std::find_if(ids, ids + size, [points](vtkIdType id) { return id < 0 || id >= points; });
      if (bad != ids + size)
      {
        throw InvalidGeometry("Cell " + std::to_string(cell) + " refers to point " +
          std::to_string(*bad) + ", but the input has " + std::to_string(points) +
          " points, counted from 0. Mend the filter or file it comes from.");
      }
      ++cell;
    });
  return cell;
}

void requirePolygons(vtkPolyData* input)
{
  if (input->GetNumberOfPolys() > 0 || input->GetNumberOfStrips() > 0)
  {
    return;
  }
  requirePoints(input);
  if (input->GetNumberOfLines() > 0)
  {
    throw InvalidGeometry("The input has " + std::to_string(input->GetNumberOfLines()) +
      " lines and no polygons. Apply HybridTree Curve Skeletons to it first.");
  }
  throw InvalidGeometry("The input is a point set: it has " +
    std::to_string(input->GetNumberOfPoints()) +
    " points and no polygons. Apply HybridTree Surface Reconstruction to it first.");
}

std::vector<Vec3> pointsOf(vtkPolyData* input)
{
  std::vector<Vec3> points(static_cast<std::size_t>(input->GetNumberOfPoints()));
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    input->GetPoint(static_cast<vtkIdType>(k), points[k].data());
  }
  return points;
}

// ---------------------------------------------------------------------------- to VTK

/// With indices of 64 bits, a copy: those of 32 could be shared, but VTK and ParaView read them
/// through copies of each cell, which costs many times as much whenever they are drawn.
vtkSmartPointer<vtkCellArray> trianglesOf(const TriangleMesh& mesh)
{
  constexpr std::size_t grain = 1 << 15;
  const std::size_t count = mesh.triangles.size();
  vtkNew<vtkTypeInt64Array> offsets;
  vtkNew<vtkTypeInt64Array> corners;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(count) + 1);
  corners->SetNumberOfValues(static_cast<vtkIdType>(3 * count));
  vtkTypeInt64* const offset = offsets->GetPointer(0);
  vtkTypeInt64* const corner = corners->GetPointer(0);
  offset[0] = 0;
  parallelFor(count, grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        offset[t + 1] = static_cast<vtkTypeInt64>(3 * (t + 1));
        std::copy(mesh.triangles[t].begin(), mesh.triangles[t].end(), corner + 3 * t);
      }
    });
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, corners);
  return cells;
}

} // namespace

vtkSmartPointer<vtkDataArray> sharedArray(const double* values, int components, std::size_t tuples,
  std::shared_ptr<const void> owner, const std::string& name)
{
  return share<vtkDoubleArray>(values, components, tuples, std::move(owner), name);
}

vtkSmartPointer<vtkDataArray> sharedArray(const std::int32_t* values, int components,
  std::size_t tuples, std::shared_ptr<const void> owner, const std::string& name)
{
  return share<vtkTypeInt32Array>(values, components, tuples, std::move(owner), name);
}

vtkTypeUInt64 fingerprint(vtkPolyData* mesh)
{
  Hash hash;
  addPoints(hash, mesh->GetPoints());
  addCells(hash, mesh->GetPolys());
  addCells(hash, mesh->GetStrips());
  return hash.result();
}

void requireValidCells(vtkPolyData* input)
{
  vtkIdType cell = 0;
  for (vtkCellArray* cells :
    { input->GetVerts(), input->GetLines(), input->GetPolys(), input->GetStrips() })
  {
    cell = requirePointsOf(cells, cell, input->GetNumberOfPoints());
  }
}

ConvertedMesh toMesh(vtkPolyData* input)
{
  requirePolygons(input);
  requireValidCells(input);
  const Triangulator made(input);
  ConvertedMesh converted;
  converted.repaired = repairMesh(pointsOf(input), made.triangles);
  converted.cells.reserve(converted.repaired.triangleMap.size());
  for (std::int32_t triangle : converted.repaired.triangleMap)
  {
    converted.cells.push_back(made.cells[static_cast<std::size_t>(triangle)]);
  }
  if (made.fans > 0)
  {
    converted.repaired.warnings.push_back(std::to_string(made.fans) +
      " polygons are flat lines or cross themselves and were cut into fans.");
  }
  return converted;
}

void toPolyData(const MeshPtr& mesh, bool withNormals, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(VTK_DOUBLE);
  if (!mesh->points.empty())
  {
    points->SetData(
      sharedArray(mesh->points.front().data(), 3, mesh->points.size(), mesh, "Points"));
  }
  output->SetPoints(points);
  output->SetPolys(trianglesOf(*mesh));
  if (withNormals && !mesh->normals.empty())
  {
    output->GetPointData()->SetNormals(
      sharedArray(mesh->normals.front().data(), 3, mesh->normals.size(), mesh, "Normals"));
  }
  if (!mesh->sourceLeaf.empty())
  {
    output->GetCellData()->AddArray(
      sharedArray(mesh->sourceLeaf.data(), 1, mesh->sourceLeaf.size(), mesh, "SourceId"));
  }
}

} // namespace hybridtree
