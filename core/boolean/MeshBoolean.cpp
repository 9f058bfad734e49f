// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MeshBoolean.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/boolean/Assemble.h"
#include "core/boolean/CleanResult.h"
#include "core/boolean/CutCurves.h"
#include "core/boolean/CutFaces.h"
#include "core/boolean/MeshSides.h"
#include "core/boolean/PerturbedPredicates.h"
#include "core/boolean/TriangleCrossings.h"

#include <array>
#include <cstdint>

namespace hybridtree
{
namespace
{

constexpr std::uint64_t kSeed = 0x9b1d7f4a3c25e681ull;
constexpr int kAttempts = 3;

std::array<Keep, 2> keptBy(MeshOperation operation)
{
  const bool outside = operation != MeshOperation::Intersection;
  const bool difference = operation == MeshOperation::Difference;
  return { Keep{ outside, false }, Keep{ operation == MeshOperation::Union, difference } };
}

// All of one operand, or nothing.
MeshBooleanResult whole(const MeshOperand* operand, int index)
{
  MeshBooleanResult result;
  if (operand == nullptr)
  {
    return result;
  }
  const TriangleMesh& mesh = operand->mesh();
  const std::size_t points = mesh.points.size();
  result.mesh.points = mesh.points;
  result.mesh.triangles = mesh.triangles;
  result.firstOfB = index == 0 ? points : 0;
  result.firstCut = points;
  for (std::size_t k = 0; k < points; ++k)
  {
    result.sourcePoint.push_back(k < operand->original()->points.size() ? std::int32_t(k) : -1);
  }
  result.sourceOperand.assign(mesh.triangles.size(), std::int8_t(index));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    result.sourceTriangle.push_back(
      t < operand->original()->triangles.size() ? std::int32_t(t) : -1);
  }
  return result;
}

bool isSame(const TriangleMesh& a, const TriangleMesh& b)
{
  return &a == &b || (a.triangles == b.triangles && a.points == b.points);
}

MeshBooleanResult cut(MeshOperation operation, const MeshOperand& a, const MeshOperand& b,
  std::uint64_t seed, const Progress& progress)
{
  // B swells, or shrinks for an intersection: what touches merges, A - A is empty, A & A is A.
  const double swell = operation == MeshOperation::Intersection ? -1.0 : 1.0;
  const PerturbedPredicates predicates(
    [&b, swell](std::int32_t vertex) { return Vec3(swell * b.outward(vertex)); }, seed);
  const std::array<Keep, 2> keep = keptBy(operation);
  const std::array<const MeshOperand*, 2> operands = { &a, &b };

  const CutCurves curves = cutCurves(
    a, b, predicates, triangleCrossings(a, b, predicates, ProgressPart(progress, 0.0, 0.4)));
  progress.check();
  progress.report(0.5);
  const MeshSides sides = meshSides(a, b, predicates, curves);
  progress.check();
  progress.report(0.7);
  bool contradictory = sides.contradictory;
  std::array<CutFaces, 2> faces;
  for (std::size_t mesh = 0; mesh < 2; ++mesh)
  {
    faces[mesh] = cutFaces(*operands[mesh], int(mesh), keep[mesh], curves, sides, contradictory);
    progress.check();
  }
  progress.report(0.8);
  if (contradictory)
  {
    MeshBooleanResult nothing;
    nothing.usable = false;
    return nothing;
  }
  MeshBooleanResult result = assemble(operands, keep, curves, sides, faces);
  cleanResult(result);
  return result;
}

MeshBooleanResult cutOrRetry(
  MeshOperation operation, const MeshOperand& a, const MeshOperand& b, const Progress& progress)
{
  for (int attempt = 1;; ++attempt)
  {
    try
    {
      return cut(operation, a, b, kSeed * std::uint64_t(attempt), progress);
    }
    catch (const InvalidGeometry&)
    {
      if (attempt == kAttempts)
      {
        throw;
      }
    }
  }
}

void tell(const MeshOperand& a, const MeshOperand& b, MeshBooleanResult& result)
{
  for (const MeshOperand* operand : { &a, &b })
  {
    if (operand->addedTriangles() > 0)
    {
      result.warnings.push_back("The " + std::string(operand == &a ? "first" : "second") +
        " operand is not closed: " + std::to_string(operand->addedTriangles()) +
        " triangles close its holes.");
    }
  }
  if (!result.usable)
  {
    result.warnings.push_back(
      "An operand crosses itself where it meets the other, or is inside out "
      "there: its surface does not tell what is inside.");
  }
}

} // namespace

MeshBooleanResult meshBoolean(
  MeshOperation operation, const MeshOperand& a, const MeshOperand& b, const Progress& progress)
{
  MeshBooleanResult result;
  const std::array<Keep, 2> keep = keptBy(operation);
  if (a.mesh().empty() || b.mesh().empty())
  {
    const int other = a.mesh().empty() ? 1 : 0;
    result = whole(keep[std::size_t(other)].outside ? (other == 0 ? &a : &b) : nullptr, other);
  }
  else if (isSame(a.mesh(), b.mesh()))
  {
    result = whole(operation == MeshOperation::Difference ? nullptr : &a, 0);
  }
  else
  {
    result = cutOrRetry(operation, a, b, progress);
  }
  tell(a, b, result);
  progress.report(1.0);
  return result;
}

} // namespace hybridtree
