// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeOperand.h"

#include "core/base/Error.h"
#include "core/nodes/MeshNode.h"
#include "core/tree/Serialize.h"
#include "vtkHybridTreeArray.h"
#include "vtkPolyData.h"

#include <unordered_set>

namespace hybridtree
{
namespace
{

/// I and n of a plain mesh: f rises from T on the mesh to 2 T inside.
constexpr double kPlainMaximumField = 2.0 * kThreshold;
constexpr int kPlainExponent = 2;

void requireData(vtkPolyData* input)
{
  if (!input)
  {
    throw InvalidGeometry("There is no data. Check the filter it comes from.");
  }
}

void append(const std::vector<std::string>& from, std::vector<std::string>& to)
{
  to.insert(to.end(), from.begin(), from.end());
}

/// Of each node once, however many paths lead to it.
void appendAllWarnings(
  const Node& node, std::unordered_set<const Node*>& seen, std::vector<std::string>& to)
{
  if (!seen.insert(&node).second)
  {
    return;
  }
  append(node.warnings(), to);
  for (const NodePtr& child : node.children())
  {
    appendAllWarnings(*child, seen, to);
  }
}

} // namespace

void Operand::read(vtkPolyData* input, std::vector<std::string>& newWarnings)
{
  requireData(input);
  const CarriedTree carried = carriedTree(input);
  if (!carried.belongs)
  {
    this->readMesh(input, newWarnings);
    return;
  }
  if (carried.live)
  {
    node_ = carried.live;
    text_.clear();
  }
  else if (!node_ || text_ != carried.text)
  {
    node_ = fromText(carried.text, meshesIn(input->GetFieldData()));
    text_ = carried.text;
    std::unordered_set<const Node*> seen;
    appendAllWarnings(*node_, seen, newWarnings);
  }
  mesh_ = {};
  arrays_.clear();
  mergeArrays(arraysIn(input->GetFieldData()), arrays_);
}

void Operand::readMesh(vtkPolyData* input, std::vector<std::string>& newWarnings)
{
  requireData(input);
  const vtkTypeUInt64 print = fingerprint(input);
  if (!mesh_.repaired.mesh || print != fingerprint_)
  {
    node_ = nullptr;
    text_.clear();
    mesh_ = toMesh(input);
    fingerprint_ = print;
    append(mesh_.repaired.warnings, newWarnings);
  }
  if (!node_)
  {
    const MeshPtr& mesh = mesh_.repaired.mesh;
    node_ = makeMeshNode(mesh, kPlainMaximumField, defaultInfluenceRadius(*mesh), kPlainExponent);
    append(node_->warnings(), newWarnings);
  }
  arrays_ = arraysOf(input, mesh_);
}

} // namespace hybridtree
