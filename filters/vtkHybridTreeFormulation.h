// SPDX-License-Identifier: BSD-3-Clause
// Private: how a filter asks its producers for FIELD or MESH, and what keeps that right.
//
// The request is a key on the information that a producer shares with all its consumers. A key that
// stayed there would speak for consumers that never asked, and for updates to come. So it says
// FIELD only while the request of a taker of trees travels up that one connection, and MESH at all
// other times (FormulationRequest). A view, a writer or a foreign filter never finds anything but
// MESH, and an output made as FIELD is made again for it. Data made as MESH also serves a later
// FIELD.
#ifndef vtkHybridTreeFormulation_h
#define vtkHybridTreeFormulation_h

#include <set>
#include <utility>
#include <vector>

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

/// What a consumer asks of its producers while one request travels upstream: FIELD at ports that
/// take trees, where a node filter is (seen through pass-through filters) whose mesh nobody else
/// needs in the same update; MESH elsewhere.
/// Used in vtkAlgorithm::ModifyRequest, and not in an executive of our own, since ParaView gives
/// every filter an executive of its choice.
class FormulationRequest
{
public:
  void send(vtkAlgorithm* consumer);
  /// Leaves the key as it was before send().
  void takeBack();

private:
  void ask(
    vtkAlgorithm* consumer, int port, int connection, const std::set<vtkInformation*>& meshUsers);

  std::vector<std::pair<vtkInformation*, int>> before_;
};

/// For RequestUpdateExtent of a consumer: asks at this port for the whole data as one piece, since
/// no node can be made of part of its operands.
void askWhole(int port, vtkInformationVector** inputs);

/// What is asked of this output in the update under way.
Formulation requested(vtkInformation* output);

/// True unless another piece than the first is asked of this output: the first has everything.
bool isFirstPiece(vtkInformation* output);

/// Gives an output the time steps and the time range of all inputs together; by default it has
/// those of the first input only, and follows no other through time.
void mergeTimes(int ports, vtkInformationVector** inputs, vtkInformation* output);

} // namespace hybridtree

#endif
