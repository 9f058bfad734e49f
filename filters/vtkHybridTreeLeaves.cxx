// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeLeaves.h"

#include "core/mesh/ContentHash.h"
#include "core/tree/Serialize.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkHybridTreeLeafColumns.h"
#include "vtkHybridTreeLeafPlaces.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <unordered_map>

namespace hybridtree
{
namespace
{

const std::string kPoints = "HybridTreePoints:";
const std::string kTriangles = "HybridTreeTriangles:";
const std::string kPointData = "HybridTreePointData:";
const std::string kCellData = "HybridTreeCellData:";
const std::string kActive = "HybridTreeActive:";
const std::string kNames = "SourceNames";

bool startsWith(const std::string& text, const std::string& start)
{
  return text.compare(0, start.size(), start) == 0;
}

std::string nameOf(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

InvalidText damaged(const std::string& hash, const std::string& what)
{
  return InvalidText("The mesh leaf " + hash + " that the tree refers to is damaged: " + what +
    ". Save the file again in binary form from the filter that made it.");
}

// ---------------------------------------------------------------------------- leaves

std::string kindName(const Node& leaf)
{
  const Parameters parameters = leaf.parameters();
  std::string name =
    parameters.has("skeleton") ? parameters.getString("skeleton") : std::string(leaf.kind());
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

/// A leaf of that name without its number.
Leaf leafOf(const Node& node)
{
  Leaf leaf;
  leaf.name = kindName(node);
  leaf.mesh = node.leafMesh();
  leaf.hash = leaf.mesh ? contentHashText(leaf.mesh) : "";
  return leaf;
}

/// One for each path to a leaf, or part of one that counts as several; what is known of a leaf
/// itself is found once.
void appendLeaves(
  const Node& node, std::unordered_map<const Node*, Leaf>& known, std::vector<Leaf>& leaves)
{
  const std::vector<NodePtr> children = node.children();
  for (const NodePtr& child : children)
  {
    appendLeaves(*child, known, leaves);
  }
  if (children.empty())
  {
    auto found = known.find(&node);
    if (found == known.end())
    {
      found = known.emplace(&node, leafOf(node)).first;
    }
    for (int part = 0; part < node.leafCount(); ++part)
    {
      leaves.push_back(found->second);
      leaves.back().name += " " + std::to_string(leaves.size() - 1);
    }
  }
}

// ---------------------------------------------------------------------------- arrays of an input

/// What every output has of its own, or what means nothing on a part of a mesh.
bool staysBehind(vtkDataSetAttributes* data, vtkAbstractArray* array)
{
  const std::string name = nameOf(array);
  return name.empty() || name == "Normals" || name == "SourceId" ||
    name == vtkDataSetAttributes::GhostArrayName() || array == data->GetNormals() ||
    array == data->GetGlobalIds();
}

/// The rows of an array, and no value where a row is -1.
void takeRows(vtkAbstractArray* from, const std::vector<vtkIdType>& rows, vtkAbstractArray* to)
{
  vtkNew<vtkIdList> sources;
  vtkNew<vtkIdList> targets;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    if (rows[k] >= 0)
    {
      sources->InsertNextId(rows[k]);
      targets->InsertNextId(static_cast<vtkIdType>(k));
    }
  }
  to->SetNumberOfTuples(static_cast<vtkIdType>(rows.size()));
  if (sources->GetNumberOfIds() < to->GetNumberOfTuples())
  {
    fillWithNothing(to);
  }
  to->InsertTuples(targets, sources, from);
}

/// Arrays that do not have all `count` values are told of in `warnings` and left out, and so are
/// variants, with which VTK's readers crash.
void gather(vtkDataSetAttributes* data, vtkIdType count, const std::vector<vtkIdType>& rows,
  const std::string& prefix, LeafArrays& to, std::vector<std::string>& warnings)
{
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = data->GetAbstractArray(k);
    if (array->GetNumberOfTuples() < count)
    {
      warnings.push_back("The array \"" + nameOf(array) + "\" has " +
        std::to_string(array->GetNumberOfTuples()) + " values for " + std::to_string(count) +
        " points or cells of the input: it is left out.");
    }
    else if (staysBehind(data, array))
    {
      continue;
    }
    else if (array->GetDataType() == VTK_VARIANT)
    {
      warnings.push_back("The array \"" + nameOf(array) +
        "\" holds variants, which do not go through files: it is left out. Make it one of numbers "
        "or of strings.");
    }
    else
    {
      const std::string name = prefix + nameOf(array);
      const auto part = arrayLike(array, name);
      takeRows(array, rows, part);
      to[name] = part;
    }
  }
}

// What is active of each kind goes on to be so: all kinds but those that stay behind.
constexpr int kActiveKinds[] = { vtkDataSetAttributes::SCALARS, vtkDataSetAttributes::VECTORS,
  vtkDataSetAttributes::TCOORDS, vtkDataSetAttributes::TENSORS };

/// The names of the active arrays, by kind, "" where there is none.
void gatherActive(vtkDataSetAttributes* data, const std::string& key, LeafArrays& to)
{
  vtkNew<vtkStringArray> names;
  names->SetName(key.c_str());
  bool any = false;
  for (const int kind : kActiveKinds)
  {
    vtkAbstractArray* active = data->GetAbstractAttribute(kind);
    const std::string name = active ? nameOf(active) : "";
    names->InsertNextValue(name);
    any = any || !name.empty();
  }
  if (any)
  {
    to[key] = names;
  }
}

/// Makes active what is so on the first leaf that says; scalars only where all of the output has
/// them, or views would color by them and show the rest as missing.
void passActive(const LeafArrays& arrays, const std::vector<Leaf>& leaves,
  const std::string& suffix, const std::set<std::string>& complete, vtkDataSetAttributes* data)
{
  for (const Leaf& leaf : leaves)
  {
    const auto found = leaf.mesh ? arrays.find(kActive + leaf.hash + suffix) : arrays.end();
    auto* names = found == arrays.end() ? nullptr : vtkStringArray::SafeDownCast(found->second);
    for (int k = 0; names && k < static_cast<int>(std::size(kActiveKinds)); ++k)
    {
      const std::string name = k < names->GetNumberOfValues() ? names->GetValue(k) : "";
      const bool fits =
        kActiveKinds[k] != vtkDataSetAttributes::SCALARS || complete.count(name) > 0;
      if (!name.empty() && fits && !data->GetAbstractAttribute(kActiveKinds[k]))
      {
        data->SetActiveAttribute(name.c_str(), kActiveKinds[k]);
      }
    }
  }
}

/// Per point of the leaf, the first point of the input that became it.
std::vector<vtkIdType> pointRows(const ConvertedMesh& leaf)
{
  const RepairedMesh& repaired = leaf.repaired;
  std::vector<vtkIdType> rows(repaired.mesh->points.size());
  for (std::size_t k = repaired.pointMap.size(); k-- > 0;)
  {
    if (repaired.pointMap[k] >= 0)
    {
      rows[static_cast<std::size_t>(repaired.pointMap[k])] = static_cast<vtkIdType>(k);
    }
  }
  auto added = rows.end() - static_cast<std::ptrdiff_t>(leaf.addedFrom.size());
  for (const std::int32_t point : leaf.addedFrom)
  {
    *added++ = rows[static_cast<std::size_t>(point)];
  }
  return rows;
}

bool sameContent(vtkAbstractArray* a, vtkAbstractArray* b)
{
  if (a == b)
  {
    return true;
  }
  if (a->GetDataType() != b->GetDataType() || a->GetNumberOfValues() != b->GetNumberOfValues())
  {
    return false;
  }
  for (vtkIdType k = 0; k < a->GetNumberOfValues(); ++k)
  {
    if (a->GetVariantValue(k) != b->GetVariantValue(k))
    {
      return false;
    }
  }
  return true;
}

// ---------------------------------------------------------------------------- arrays of an output

using Columns = std::map<std::string, LeafColumn>;

Columns columnsOf(
  const LeafArrays& arrays, const std::vector<Leaf>& leaves, const std::string& prefix)
{
  Columns columns;
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
  {
    if (!leaves[leaf].mesh)
    {
      continue;
    }
    const std::string start = prefix + leaves[leaf].hash + ":";
    for (auto entry = arrays.lower_bound(start);
         entry != arrays.end() && startsWith(entry->first, start); ++entry)
    {
      const std::string name = entry->first.substr(start.size());
      const TriangleMesh& mesh = *leaves[leaf].mesh;
      const std::size_t rows = prefix == kPointData ? mesh.points.size() : mesh.triangles.size();
      if (entry->second->GetNumberOfTuples() != static_cast<vtkIdType>(rows))
      {
        throw damaged(leaves[leaf].hash,
          "its array \"" + name + "\" has " + std::to_string(entry->second->GetNumberOfTuples()) +
            " rows in place of " + std::to_string(rows));
      }
      const auto column = columns.emplace(name, leaves.size()).first;
      column->second.sources[leaf] = entry->second;
    }
  }
  return columns;
}

// ---------------------------------------------------------------------------- meshes

/// Points and triangles as the arrays beside the tree give them; null when they are not there.
MeshPtr readMesh(vtkFieldData* data, const std::string& hash)
{
  vtkDataArray* points = data->GetArray((kPoints + hash).c_str());
  vtkDataArray* triangles = data->GetArray((kTriangles + hash).c_str());
  if (!points || !triangles)
  {
    return nullptr;
  }
  if (points->GetNumberOfComponents() != 3 || triangles->GetNumberOfComponents() != 3)
  {
    throw damaged(hash, "its arrays do not have three components");
  }
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->points.resize(static_cast<std::size_t>(points->GetNumberOfTuples()));
  for (std::size_t k = 0; k < mesh->points.size(); ++k)
  {
    points->GetTuple(static_cast<vtkIdType>(k), mesh->points[k].data());
  }
  mesh->triangles.resize(static_cast<std::size_t>(triangles->GetNumberOfTuples()));
  for (std::size_t k = 0; k < mesh->triangles.size(); ++k)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const double index = triangles->GetComponent(static_cast<vtkIdType>(k), corner);
      if (!(0.0 <= index && index < static_cast<double>(mesh->points.size())))
      {
        throw damaged(hash, "triangle " + std::to_string(k) + " has a corner that does not exist");
      }
      mesh->triangles[k][static_cast<std::size_t>(corner)] = static_cast<std::int32_t>(index);
    }
  }
  if (contentHashText(*mesh) != hash)
  {
    throw damaged(hash, "its numbers are not those that were saved");
  }
  return mesh;
}

} // namespace

// ---------------------------------------------------------------------------- leaves

std::vector<Leaf> leavesOf(const Node& tree)
{
  std::vector<Leaf> leaves;
  std::unordered_map<const Node*, Leaf> known;
  appendLeaves(tree, known, leaves);
  return leaves;
}

void putNames(const std::vector<Leaf>& leaves, vtkFieldData* data)
{
  vtkNew<vtkStringArray> names;
  names->SetName(kNames.c_str());
  for (const Leaf& leaf : leaves)
  {
    names->InsertNextValue(leaf.name);
  }
  data->AddArray(names);
}

void removeLeaves(vtkFieldData* data)
{
  for (int k = data->GetNumberOfArrays() - 1; k >= 0; --k)
  {
    const std::string name = nameOf(data->GetAbstractArray(k));
    if (name == "HybridTree" || name == kNames || startsWith(name, kPoints) ||
      startsWith(name, kTriangles) || startsWith(name, kPointData) || startsWith(name, kCellData) ||
      startsWith(name, kActive))
    {
      data->RemoveArray(k);
    }
  }
}

void putMeshes(const Node& tree, vtkFieldData* data)
{
  for (const auto& [hash, mesh] : meshesOf(tree))
  {
    data->AddArray(
      sharedArray(mesh->points.front().data(), 3, mesh->points.size(), mesh, kPoints + hash));
    data->AddArray(sharedArray(
      mesh->triangles.front().data(), 3, mesh->triangles.size(), mesh, kTriangles + hash));
  }
}

MeshLookup meshesIn(vtkFieldData* data)
{
  return [data](const std::string& hash) { return readMesh(data, hash); };
}

// ---------------------------------------------------------------------------- arrays

LeafArrays arraysOf(
  vtkPolyData* input, const ConvertedMesh& leaf, std::vector<std::string>& warnings)
{
  const std::string hash = contentHashText(leaf.repaired.mesh) + ":";
  LeafArrays arrays;
  gather(input->GetPointData(), input->GetNumberOfPoints(), pointRows(leaf), kPointData + hash,
    arrays, warnings);
  gather(input->GetCellData(), input->GetNumberOfCells(), leaf.cells, kCellData + hash, arrays,
    warnings);
  gatherActive(input->GetPointData(), kActive + hash + "points", arrays);
  gatherActive(input->GetCellData(), kActive + hash + "cells", arrays);
  return arrays;
}

LeafArrays arraysIn(vtkFieldData* data)
{
  LeafArrays arrays;
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = data->GetAbstractArray(k);
    const std::string name = nameOf(array);
    if (startsWith(name, kPointData) || startsWith(name, kCellData) || startsWith(name, kActive))
    {
      arrays[name] = array;
    }
  }
  return arrays;
}

std::vector<std::string> mergeArrays(const LeafArrays& from, LeafArrays& to)
{
  std::vector<std::string> differing;
  for (const auto& [name, array] : from)
  {
    const auto [entry, isNew] = to.emplace(name, array);
    if (!isNew && !startsWith(name, kActive) && !sameContent(entry->second, array))
    {
      differing.push_back("Two inputs are the same mesh with different values of \"" +
        name.substr(name.find(':', name.find(':') + 1) + 1) + "\"; those of the first are passed.");
    }
  }
  return differing;
}

void putArrays(const LeafArrays& arrays, const std::vector<Leaf>& leaves, vtkFieldData* data)
{
  for (const auto& [name, array] : arrays)
  {
    const std::size_t begin = name.find(':') + 1;
    const std::string hash = name.substr(begin, name.find(':', begin) - begin);
    const auto isOwner = [&hash](const Leaf& leaf) { return leaf.mesh && leaf.hash == hash; };
    if (std::any_of(leaves.begin(), leaves.end(), isOwner))
    {
      data->AddArray(array);
    }
  }
}

std::vector<std::string> passArrays(const LeafArrays& arrays, const Node& tree,
  const std::vector<Leaf>& leaves, const TriangleMesh& mesh, vtkPolyData* output)
{
  if (arrays.empty())
  {
    return {};
  }
  const LeafPlacesOfMesh places = placesOnLeaves(tree, mesh);
  std::vector<std::string> untold;
  std::set<std::string> completePoints;
  std::set<std::string> completeCells;
  for (auto& [name, column] : columnsOf(arrays, leaves, kPointData))
  {
    const auto result = startColumn(name, column, mesh.points.size(), untold);
    if (fillPoints(places.points, leaves, column, result))
    {
      completePoints.insert(name);
    }
    output->GetPointData()->AddArray(result);
  }
  for (auto& [name, column] : columnsOf(arrays, leaves, kCellData))
  {
    const auto result = startColumn(name, column, mesh.triangles.size(), untold);
    if (fillCells(places.triangles, column, result))
    {
      completeCells.insert(name);
    }
    output->GetCellData()->AddArray(result);
  }
  passActive(arrays, leaves, ":points", completePoints, output->GetPointData());
  passActive(arrays, leaves, ":cells", completeCells, output->GetCellData());
  return untold;
}

} // namespace hybridtree
