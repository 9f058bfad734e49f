// SPDX-License-Identifier: BSD-3-Clause
// Private: one input of an operator, read as nodes.
#ifndef vtkHybridTreeOperand_h
#define vtkHybridTreeOperand_h

#include "core/base/Progress.h"
#include "core/nodes/BooleanNest.h"
#include "core/nodes/Node.h"
#include "vtkHybridTreeBlocks.h"
#include "vtkHybridTreeConvert.h"
#include "vtkHybridTreeLeaves.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace hybridtree
{

/// A polydata read as a node. Remembers what it has read, so that an input that arrives again as it
/// was gives the same node with all that the node has computed.
class OperandBlock
{
public:
  /// Reads the input: its tree where one belongs to it, else a mesh leaf. `newWarnings` gets what
  /// the user should know about a node that was not there before. Reports only where something is
  /// new. \throws InvalidGeometry, InvalidText, TooLarge, Cancelled.
  void read(vtkPolyData* input, std::vector<std::string>& newWarnings, const Progress& progress);

  /// As read(), but takes the input as a mesh whatever tree it has, with its holes closed or as it
  /// is.
  void readMesh(vtkPolyData* input, bool closesHoles, std::vector<std::string>& newWarnings,
    const Progress& progress);

  const NodePtr& node() const { return node_; }

  /// Arrays of the mesh leaves below.
  const LeafArrays& arrays() const { return arrays_; }

  /// It is a mesh, without a tree, that is not closed.
  bool isPatch() const;

private:
  void readTree(
    vtkPolyData* input, std::vector<std::string>& newWarnings, const Progress& progress);
  void readTriangles(vtkPolyData* input, bool closesHoles, std::vector<std::string>& newWarnings,
    const Progress& progress);

  NodePtr node_;
  LeafArrays arrays_;

  vtkMTimeType time_ = 0;         ///< of the input that was read last; no other data has it
  vtkTypeUInt64 fingerprint_ = 0; ///< of the input that node_ was made from, unless it came live
  std::string text_;              ///< that node_ was parsed from
  ConvertedMesh mesh_;            ///< that node_ is a leaf over
  bool closesHoles_ = false;      ///< of mesh_
};

/// What arrives over one input connection. Of composite data each block is a shape; but blocks that
/// are open meshes are taken for patches of one mesh, as CAD files have them.
class Operand
{
public:
  /// Reads each block as OperandBlock does. \throws as it does, with the name of the block.
  void read(const std::vector<Block>& blocks, std::vector<std::string>& newWarnings,
    const Progress& progress);

  /// Takes all blocks together for one mesh, whatever trees they have, with its holes closed or as
  /// it is.
  void readMesh(const std::vector<Block>& blocks, bool closesHoles,
    std::vector<std::string>& newWarnings, const Progress& progress);

  /// One node for each shape; not empty once read.
  const std::vector<NodePtr>& nodes() const { return nodes_; }

  /// All shapes united. The same object as long as the shapes are.
  NodePtr node();

  /// Arrays of the mesh leaves below.
  const LeafArrays& arrays() const { return arrays_; }

private:
  void take(const OperandBlock& block);

  std::vector<OperandBlock> blocks_;
  OperandBlock patches_; ///< open meshes as one, or all
  std::vector<NodePtr> nodes_;
  LeafArrays arrays_;
  BooleanNest union_;
};

} // namespace hybridtree

#endif
