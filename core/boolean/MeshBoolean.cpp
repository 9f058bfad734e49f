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

#include <algorithm>
#include <array>
#include <cstdint>

namespace hybridtree
{
namespace
{

constexpr std::uint64_t kSeed = 0x9b1d7f4a3c25e681ull;
constexpr int kAttempts = 3;
// By how much an operand may cross itself: of the smaller one's size, but never less than so much
// of the largest coordinate, since that is what rounding does.
constexpr double kCrossing = 0x1p-22;
constexpr double kRounding = 0x1p-44;
constexpr double kCoplanar = 1e-6; // sine of the angle between triangles

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

class Cut
{
public:
  Cut(MeshOperation operation, const MeshOperand& a, const MeshOperand& b, const Progress& progress)
    : keep_(keptBy(operation))
    , swell_(operation == MeshOperation::Intersection ? -1.0 : 1.0)
    , a_(a)
    , b_(b)
    , progress_(progress)
  {
  }

  MeshBooleanResult run() const
  {
    for (int attempt = 1;; ++attempt)
    {
      try
      {
        return this->once(kSeed * std::uint64_t(attempt));
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

private:
  double tolerance() const
  {
    const Box3 boundsA = a_.mesh().bounds();
    const Box3 boundsB = b_.mesh().bounds();
    const Box3 both = boundsA.merged(boundsB);
    const double largest = both.min().cwiseAbs().cwiseMax(both.max().cwiseAbs()).maxCoeff();
    return std::max(
      kRounding * largest, kCrossing * std::min(boundsA.sizes().norm(), boundsB.sizes().norm()));
  }

  // Whether triangles cross that are in one plane but for rounding.
  bool nearlyCoincide(const CutCurves& curves) const
  {
    return std::any_of(curves.segments.begin(), curves.segments.end(),
      [this](const Segment& segment)
      {
        const Vec3 one = areaNormal(a_.mesh(), std::size_t(segment.triangle[0]));
        const Vec3 other = areaNormal(b_.mesh(), std::size_t(segment.triangle[1]));
        return !(one.cross(other).norm() > kCoplanar * one.norm() * other.norm());
      });
  }

  MeshBooleanResult once(std::uint64_t seed) const
  {
    const PerturbedPredicates predicates(
      [this](std::int32_t vertex) { return Vec3(swell_ * b_.outward(vertex)); }, seed);
    const std::array<const MeshOperand*, 2> operands = { &a_, &b_ };

    const CutCurves curves = cutCurves(
      a_, b_, predicates, triangleCrossings(a_, b_, predicates, ProgressPart(progress_, 0.0, 0.4)));
    progress_.check();
    progress_.report(0.5);
    const MeshSides sides = meshSides(a_, b_, predicates, curves, this->tolerance());
    progress_.check();
    progress_.report(0.7);
    MeshBooleanResult result;
    result.usable = !sides.contradictory;
    if (result.usable)
    {
      std::array<CutFaces, 2> faces;
      for (std::size_t mesh = 0; mesh < 2; ++mesh)
      {
        faces[mesh] = cutFaces(*operands[mesh], int(mesh), keep_[mesh], curves, sides);
        progress_.check();
      }
      progress_.report(0.8);
      result = assemble(operands, keep_, curves, sides, faces);
      cleanResult(result, this->nearlyCoincide(curves));
    }
    return result;
  }

  const std::array<Keep, 2> keep_;
  const double swell_; // what touches merges, A - A is empty, A & A is A
  const MeshOperand& a_;
  const MeshOperand& b_;
  const Progress& progress_;
};

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
    result = Cut(operation, a, b, progress).run();
  }
  tell(a, b, result);
  progress.report(1.0);
  return result;
}

} // namespace hybridtree
