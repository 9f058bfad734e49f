// SPDX-License-Identifier: BSD-3-Clause
// Private: meshes across the border between VTK and the core.
#ifndef vtkHybridTreeConvert_h
#define vtkHybridTreeConvert_h

#include "core/mesh/RepairMesh.h"
#include "core/mesh/TriangleMesh.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace hybridtree
{

/// 64-bit hash over the coordinates (by value, whatever their type) and the polygons and strips of
/// a mesh; arrays do not count. Tells whether a mesh is still the one a tree was put on.
vtkTypeUInt64 fingerprint(vtkPolyData* mesh);

/// \throws InvalidGeometry when a cell uses a point that is not there, which VTK reads
/// nevertheless.
void requireValidCells(vtkPolyData* input);

/// A polydata as a mesh leaf takes it.
struct ConvertedMesh
{
  RepairedMesh repaired;
  /// Per triangle of repaired.mesh: the cell of the input it is part of, -1 where it closes a hole.
  std::vector<vtkIdType> cells;
  /// Per point that closes a hole, which come last: another point of the mesh, which it is like.
  std::vector<std::int32_t> addedFrom;
};

/// Triangulates polygons and strips and repairs the outcome (exactly equal points become one, ...).
/// Vertices and lines beside them do not count.
/// \throws InvalidGeometry when there are no polygons or strips, as requireValidCells() does, or
/// when repairMesh() finds no way.
ConvertedMesh toMesh(vtkPolyData* input);

/// Gives `output` the points, triangles, Normals (if asked for) and SourceId of a mesh. All but the
/// triangles without copying: the arrays keep the mesh alive. Points are doubles.
void toPolyData(const MeshPtr& mesh, bool withNormals, vtkPolyData* output);

///@{
/// `tuples` tuples of `components` values that lie at `values`, as an array that shares them and
/// keeps their owner alive, itself and in shallow copies. Nobody may write through it.
vtkSmartPointer<vtkDataArray> sharedArray(const double* values, int components, std::size_t tuples,
  std::shared_ptr<const void> owner, const std::string& name);
vtkSmartPointer<vtkDataArray> sharedArray(const std::int32_t* values, int components,
  std::size_t tuples, std::shared_ptr<const void> owner, const std::string& name);
///@}

} // namespace hybridtree

#endif
