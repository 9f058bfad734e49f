// SPDX-License-Identifier: BSD-3-Clause
// Private: arrays of an output that are put together from those of the mesh leaves its vertices and
// triangles lie on.
#ifndef vtkHybridTreeLeafColumns_h
#define vtkHybridTreeLeafColumns_h

#include "vtkHybridTreeLeaves.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkAbstractArray;

namespace hybridtree
{

/// One array of the output: per leaf the array it comes from, or null.
struct LeafColumn
{
  explicit LeafColumn(std::size_t leaves) : sources(leaves, nullptr) {}

  std::vector<vtkAbstractArray*> sources;
  std::vector<vtkSmartPointer<vtkAbstractArray>> converted; ///< keeps those that changed type
};

/// An array of the type of another, empty. Never an implicit one, which no file could hold.
vtkSmartPointer<vtkAbstractArray> arrayLike(vtkAbstractArray* other, const std::string& name);

/// Fills an array with what stands for "no value": NaN, 0 or "".
void fillWithNothing(vtkAbstractArray* array);

/// An array for the column, of the type of its first source, holding nothing but what stands for
/// "no value"; the other sources are brought to that type, or left out and told.
vtkSmartPointer<vtkAbstractArray> startColumn(
  const std::string& name, LeafColumn& column, std::size_t rows, std::vector<std::string>& untold);

/// Values at the vertices that have a place on a leaf: interpolated where they are real numbers,
/// else those of the nearest corner. Returns whether all vertices have one.
bool fillPoints(const std::vector<VertexOrigin>& places, const std::vector<Leaf>& leaves,
  const LeafColumn& column, vtkAbstractArray* result);

/// Values of the triangles that have a place on one of a leaf. Returns whether all have.
bool fillCells(
  const std::vector<VertexOrigin>& places, const LeafColumn& column, vtkAbstractArray* result);

} // namespace hybridtree

#endif
