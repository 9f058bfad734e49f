// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MeshUnion.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hybridtree
{
namespace
{

// A union of some of the operands.
struct Part
{
  std::shared_ptr<const MeshOperand> operand;
  std::vector<std::int32_t> sourceOperand;
  std::vector<std::int32_t> sourceTriangle;

  std::size_t size() const { return operand->mesh().triangles.size(); }
  bool meets(const Part& other) const
  {
    return operand->tree().bounds().meets(other.operand->tree().bounds());
  }
};

Part partOf(const std::shared_ptr<const MeshOperand>& operand, std::size_t index)
{
  Part part{ operand, {}, {} };
  part.sourceOperand.assign(part.size(), std::int32_t(index));
  part.sourceTriangle.assign(part.size(), -1);
  std::iota(part.sourceTriangle.begin(),
    part.sourceTriangle.begin() + std::ptrdiff_t(operand->original()->triangles.size()), 0);
  return part;
}

// Empty where they cannot be united.
Part united(const Part& a, const Part& b, const Progress& progress, MeshUnionResult& result)
{
  MeshBooleanResult both = meshBoolean(MeshOperation::Union, *a.operand, *b.operand, progress);
  result.warnings.insert(result.warnings.end(), both.warnings.begin(), both.warnings.end());
  result.usable = both.usable;
  Part part;
  for (std::size_t t = 0; t < both.mesh.triangles.size(); ++t)
  {
    const Part& from = both.sourceOperand[t] == 0 ? a : b;
    const std::int32_t source = both.sourceTriangle[t];
    // Where one was closed, its triangles have no source: any of its own names the operand.
    const std::size_t named = source < 0 ? 0 : std::size_t(source);
    part.sourceOperand.push_back(from.sourceOperand[named]);
    part.sourceTriangle.push_back(source < 0 ? -1 : from.sourceTriangle[named]);
  }
  part.operand =
    std::make_shared<const MeshOperand>(std::make_shared<const TriangleMesh>(std::move(both.mesh)));
  return part;
}

// Those that are left do not meet.
void gather(const std::vector<Part>& parts, MeshUnionResult& result)
{
  for (const Part& part : parts)
  {
    const TriangleMesh& mesh = part.operand->mesh();
    const std::int32_t shift = std::int32_t(result.mesh.points.size());
    result.mesh.points.insert(result.mesh.points.end(), mesh.points.begin(), mesh.points.end());
    for (const Triangle& c : mesh.triangles)
    {
      result.mesh.triangles.push_back({ c[0] + shift, c[1] + shift, c[2] + shift });
    }
    result.sourceOperand.insert(
      result.sourceOperand.end(), part.sourceOperand.begin(), part.sourceOperand.end());
    result.sourceTriangle.insert(
      result.sourceTriangle.end(), part.sourceTriangle.begin(), part.sourceTriangle.end());
  }
}

} // namespace

MeshUnionResult meshUnion(
  const std::vector<std::shared_ptr<const MeshOperand>>& operands, const Progress& progress)
{
  MeshUnionResult result;
  std::vector<Part> parts;
  for (std::size_t k = 0; k < operands.size(); ++k)
  {
    if (!operands[k]->mesh().empty())
    {
      parts.push_back(partOf(operands[k], k));
    }
  }
  for (bool changed = true; changed;)
  {
    changed = false;
    std::stable_sort(
      parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.size() < b.size(); });
    std::vector<Part> next;
    std::vector<bool> taken(parts.size(), false);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      std::size_t j = taken[i] ? parts.size() : i + 1;
      while (j < parts.size() && (taken[j] || !parts[i].meets(parts[j])))
      {
        ++j;
      }
      if (j < parts.size())
      {
        taken[j] = changed = true;
        next.push_back(united(parts[i], parts[j], ProgressPart(progress, 0.0, 0.0), result));
        if (!result.usable)
        {
          return result;
        }
      }
      else if (!taken[i])
      {
        next.push_back(std::move(parts[i]));
      }
    }
    parts = std::move(next);
    progress.report(parts.empty() ? 1.0 : 1.0 / double(parts.size()));
  }
  gather(parts, result);
  return result;
}

} // namespace hybridtree
