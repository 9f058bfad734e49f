// SPDX-License-Identifier: BSD-3-Clause
// Private: one input of an operator, read as a node.
#ifndef vtkHybridTreeOperand_h
#define vtkHybridTreeOperand_h

#include "core/nodes/Node.h"
#include "vtkHybridTreeConvert.h"
#include "vtkHybridTreeLeaves.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace hybridtree
{

/// What arrives over one input connection. Remembers what it has read, so that an input that
/// arrives again as it was gives the same node with all that the node has computed.
class Operand
{
public:
  /// Reads the input: its tree where one belongs to it, else a mesh leaf. `newWarnings` gets what
  /// the user should know about a node that was not there before. \throws InvalidGeometry,
  /// InvalidText, TooLarge.
  void read(vtkPolyData* input, std::vector<std::string>& newWarnings);

  /// As read(), but takes the input as a mesh whatever tree it has.
  void readMesh(vtkPolyData* input, std::vector<std::string>& newWarnings);

  const NodePtr& node() const { return node_; }

  /// Arrays of the mesh leaves below.
  const LeafArrays& arrays() const { return arrays_; }

private:
  NodePtr node_;
  LeafArrays arrays_;

  vtkTypeUInt64 fingerprint_ = 0; ///< of the input that node_ was made from, unless it came live
  std::string text_;              ///< that node_ was parsed from
  ConvertedMesh mesh_;            ///< that node_ is a leaf over
};

} // namespace hybridtree

#endif
