// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeOperand.h"

#include "core/base/Error.h"
#include "core/mesh/CloseHoles.h"
#include "core/mesh/MeshChecks.h"
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

/// Share of the time that a mesh takes to read after which it is converted and repaired.
constexpr double kConverted = 0.5;

void requireData(bool there)
{
  if (!there)
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

/// Tells what stays open. \throws Cancelled
void closeHolesOf(ConvertedMesh& leaf, std::vector<std::string>& warnings, const Progress& progress)
{
  auto mesh = std::make_shared<TriangleMesh>(*leaf.repaired.mesh);
  ClosedHoles closed = closeHoles(*mesh, progress);
  if (closed.left > 0)
  {
    warnings.push_back(std::to_string(closed.left) +
      " holes stay open: they are slits without area, or lie where more than two triangles meet.");
  }
  if (closed.holes > 0)
  {
    leaf.cells.resize(mesh->triangles.size(), -1);
    leaf.addedFrom = std::move(closed.addedFrom);
    leaf.repaired.mesh = std::move(mesh);
  }
}

vtkPolyData* meshOf(const Block& block)
{
  requireData(block.data != nullptr);
  return requireMesh(block.data);
}

void readBlock(const Block& from, OperandBlock& to, std::vector<std::string>& newWarnings,
  const Progress& progress)
{
  try
  {
    to.read(meshOf(from), newWarnings, progress);
  }
  catch (const InvalidGeometry& error)
  {
    const std::string which = from.name.empty() ? "" : "Block " + from.name + ": ";
    throw InvalidGeometry(which + error.what());
  }
}

} // namespace

void OperandBlock::read(
  vtkPolyData* input, std::vector<std::string>& newWarnings, const Progress& progress)
{
  if (time_ != input->GetMTime()) // that of points, cells and arrays, too
  {
    time_ = 0;
    this->readTree(input, newWarnings, progress);
    time_ = input->GetMTime();
  }
}

void OperandBlock::readMesh(vtkPolyData* input, bool closesHoles,
  std::vector<std::string>& newWarnings, const Progress& progress)
{
  if (time_ != input->GetMTime() || closesHoles != closesHoles_)
  {
    time_ = 0;
    this->readTriangles(input, closesHoles, newWarnings, progress);
    time_ = input->GetMTime();
  }
}

void OperandBlock::readTree(
  vtkPolyData* input, std::vector<std::string>& newWarnings, const Progress& progress)
{
  const CarriedTree carried = carriedTree(input);
  if (!carried.belongs)
  {
    this->readTriangles(input, false, newWarnings, progress);
    return;
  }
  if (carried.live)
  {
    node_ = carried.live;
    text_.clear();
  }
  else if (!node_ || text_ != carried.text)
  {
    progress.report(0.0);
    node_ = fromText(carried.text, meshesIn(input->GetFieldData()));
    text_ = carried.text;
    std::unordered_set<const Node*> seen;
    appendAllWarnings(*node_, seen, newWarnings);
  }
  mesh_ = {};
  arrays_.clear();
  mergeArrays(arraysIn(input->GetFieldData()), arrays_);
}

void OperandBlock::readTriangles(vtkPolyData* input, bool closesHoles,
  std::vector<std::string>& newWarnings, const Progress& progress)
{
  const vtkTypeUInt64 print = fingerprint(input);
  if (!mesh_.repaired.mesh || print != fingerprint_ || closesHoles != closesHoles_)
  {
    progress.report(0.0);
    progress.check();
    node_ = nullptr;
    text_.clear();
    mesh_ = toMesh(input);
    fingerprint_ = print;
    closesHoles_ = closesHoles;
    append(mesh_.repaired.warnings, newWarnings);
    if (closesHoles)
    {
      closeHolesOf(mesh_, newWarnings, ProgressPart(progress, 0.0, kConverted));
    }
  }
  if (!node_)
  {
    progress.report(kConverted);
    progress.check();
    const MeshPtr& mesh = mesh_.repaired.mesh;
    node_ = makeMeshNode(mesh, kPlainMaximumField, defaultInfluenceRadius(*mesh), kPlainExponent);
    const std::size_t before = newWarnings.size();
    append(node_->warnings(), newWarnings); // builds the hierarchy of the mesh
    if (newWarnings.size() > before && !closesHoles && this->isPatch())
    {
      newWarnings.back() += " CloseHoles of HybridTree Mesh Field closes them.";
    }
    progress.report(1.0);
  }
  arrays_ = arraysOf(input, mesh_, newWarnings);
}

bool OperandBlock::isPatch() const
{
  return mesh_.repaired.mesh && !checkMesh(*mesh_.repaired.mesh).closed();
}

void Operand::read(
  const std::vector<Block>& blocks, std::vector<std::string>& newWarnings, const Progress& progress)
{
  requireData(!blocks.empty());
  blocks_.resize(blocks.size());
  nodes_.clear();
  arrays_.clear();
  std::vector<Block> patches;
  for (std::size_t k = 0; k < blocks.size(); ++k)
  {
    OperandBlock& block = blocks_[k];
    std::vector<std::string> warnings;
    const double share = 1.0 / double(blocks.size());
    readBlock(
      blocks[k], block, warnings, ProgressPart(progress, share * double(k), share * double(k + 1)));
    if (blocks.size() > 1 && block.isPatch())
    {
      patches.push_back(blocks[k]);
      continue;
    }
    append(warnings, newWarnings);
    this->take(block);
  }
  if (!patches.empty())
  {
    patches_.readMesh(vtkPolyData::SafeDownCast(joined(patches)), false, newWarnings, progress);
    this->take(patches_);
  }
}

void Operand::readMesh(const std::vector<Block>& blocks, bool closesHoles,
  std::vector<std::string>& newWarnings, const Progress& progress)
{
  requireData(!blocks.empty());
  nodes_.clear();
  arrays_.clear();
  const Block whole{ "", joined(blocks) };
  patches_.readMesh(meshOf(whole), closesHoles, newWarnings, progress);
  this->take(patches_);
}

void Operand::take(const OperandBlock& block)
{
  nodes_.push_back(block.node());
  mergeArrays(block.arrays(), arrays_);
}

NodePtr Operand::node()
{
  return union_.make(BooleanOperation::Union, nodes_);
}

} // namespace hybridtree
