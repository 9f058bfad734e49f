// SPDX-License-Identifier: BSD-3-Clause
// Private: how a filter asks its producers for FIELD or MESH, and what keeps that right.
//
// The request is a key on the information that producer and consumer share. Such a key outlives the
// update that set it and says nothing of who else looks at the same output, so three rules go with
// it:
// - Every update starts from MESH: a producer sets its own key back whenever its modification time
// is
//   asked for, which is how each update begins.
// - FIELD is asked only where nobody but takers of trees can see the output in the same update.
// - Data made as MESH also serves a later request for FIELD.
#ifndef vtkHybridTreeFormulation_h
#define vtkHybridTreeFormulation_h

class vtkAlgorithm;
class vtkInformation;
class vtkInformationIntegerRequestKey;
class vtkInformationVector;

namespace hybridtree
{

enum class Formulation
{
  Mesh = 0, ///< a tree and its mesh; the default wherever nothing is asked
  Field = 1 ///< a tree; the mesh stays empty
};

/// The one key of this kind.
vtkInformationIntegerRequestKey* formulationKey();

/// For RequestUpdateExtent of a consumer: asks each producer at this port for FIELD where the port
/// takes trees and the rules allow it, else for MESH; and for the whole data as one piece, since no
/// node can be made of part of its operands.
void askProducers(vtkAlgorithm* consumer, int port, vtkInformationVector** inputs);

/// For RequestUpdateExtent of a consumer whose input is no operand: says that it wants the mesh.
void askMesh(vtkInformation* input);

/// For ComputePipelineMTime of a producer: takes back what an earlier update has asked of this
/// output, also from the pass-through filters behind it.
void forgetRequest(vtkInformation* output);

/// What is asked of this output in the update under way.
Formulation requested(vtkInformation* output);

/// True unless another piece than the first is asked of this output: the first has everything.
bool isFirstPiece(vtkInformation* output);

} // namespace hybridtree

#endif
