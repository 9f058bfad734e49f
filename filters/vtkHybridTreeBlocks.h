// SPDX-License-Identifier: BSD-3-Clause
// Private: what arrives over one input connection, whole: the blocks of composite data, and what
// several processes hold a part of each.
#ifndef vtkHybridTreeBlocks_h
#define vtkHybridTreeBlocks_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkInformation;
class vtkPolyData;

namespace hybridtree
{

/// A data set of an input, and how to call it: nothing for an input that is no composite, else the
/// name of the block, or its place when it has none.
struct Block
{
  std::string name;
  vtkSmartPointer<vtkDataSet> data;
};

/// The data sets that an input consists of: itself, or of composite data all blocks that hold
/// points, in their order. Partitions and pieces of one data set are one block. Ghost cells are
/// left out.
///
/// Under MPI every process must call it, in the same order of inputs: whatever is not the same in
/// all of them is a part of the whole in each, so the parts are joined, and everybody gets the
/// same. Inputs with a tree of their own are the same everywhere and are not compared.
/// \param input may be null, which gives no blocks.
/// \throws InvalidGeometry as requireGeometry().
HYBRIDTREEFILTERS_EXPORT std::vector<Block> blocksOf(vtkDataObject* input);

/// \throws InvalidGeometry for a table and whatever else is neither a data set nor composite data,
/// with what to do about it.
HYBRIDTREEFILTERS_EXPORT void requireGeometry(vtkDataObject* data);

/// All blocks as one data set, with those arrays that all of them have: the data set itself where
/// there is one, else a polydata where all are, else an unstructured grid. Null without blocks.
HYBRIDTREEFILTERS_EXPORT vtkSmartPointer<vtkDataSet> joined(const std::vector<Block>& blocks);

/// The data set as a mesh. \throws InvalidGeometry that says how to make one of it.
HYBRIDTREEFILTERS_EXPORT vtkPolyData* requireMesh(vtkDataSet* data);

/// \throws InvalidGeometry when there are no points, as after an error of the filter before.
void requirePoints(vtkPolyData* input);

/// Lets an input port take composite data as well, whole instead of block by block; and data of
/// every kind, so that requireMesh() and requireGeometry() can say more of those that are no mesh
/// than VTK would.
HYBRIDTREEFILTERS_EXPORT void takeComposite(vtkInformation* port);

} // namespace hybridtree

#endif
