// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MeshBoolean.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/boolean/Assemble.h"
#include "core/boolean/BackToBack.h"
#include "core/boolean/CleanResult.h"
#include "core/boolean/CutCurves.h"
#include "core/boolean/CutFaces.h"
#include "core/boolean/MeshSides.h"
#include "core/boolean/PerturbedPredicates.h"
#include "core/boolean/SelfCrossing.h"
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
constexpr std::array<double, 3> kSwellings = { 1.0, 2.0, 4.0 }; // of what counts as one
constexpr double kDoubled = 1e-12; // of the operands' area: less without thickness does not count

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

  // Adds triangles that cross another one that is in one plane with it but for rounding.
  bool addNearlyCoincident(
    const CutCurves& curves, std::array<std::vector<std::int32_t>, 2>& triangles) const
  {
    bool any = false;
    for (const Segment& segment : curves.segments)
    {
      const Vec3 one = areaNormal(a_.mesh(), std::size_t(segment.triangle[0]));
      const Vec3 other = areaNormal(b_.mesh(), std::size_t(segment.triangle[1]));
      if (!(one.cross(other).norm() > kCoplanar * one.norm() * other.norm()))
      {
        any = true;
        triangles[0].push_back(segment.triangle[0]);
        triangles[1].push_back(segment.triangle[1]);
      }
    }
    return any;
  }

  // Surfaces that coincide but for rounding leave gaps and sheets without thickness, which the next
  // cut would cut again. Where there are some, the second operand is moved beyond rounding the way
  // that the perturbation moves it, so that what touches merges; its points are taken back after.
  MeshBooleanResult once(std::uint64_t seed) const
  {
    std::array<std::vector<std::int32_t>, 2> coincident;
    MeshBooleanResult result = this->cutBy(b_, seed, progress_, coincident);
    if (coincident[0].empty() || !result.usable)
    {
      return result;
    }
    const double least = kDoubled * (areaOf(a_.mesh()) + areaOf(b_.mesh()));
    double doubled = this->doubledArea(result, coincident);
    for (std::size_t k = 0; k < kSwellings.size() && doubled > least; ++k)
    {
      const double done = 0.8 + 0.06 * double(k);
      MeshBooleanResult swollen =
        this->swollenOnce(kSwellings[k], seed, ProgressPart(progress_, done, done + 0.06));
      const double now = this->doubledArea(swollen, coincident);
      if (swollen.usable && now < doubled)
      {
        result = std::move(swollen);
        doubled = now;
      }
    }
    return result;
  }

  // Not usable where that fails: nothing is lost then, as the other result is closed, too.
  MeshBooleanResult swollenOnce(double swelling, std::uint64_t seed, const Progress& progress) const
  {
    try
    {
      std::array<std::vector<std::int32_t>, 2> coincident;
      return this->cutBy(
        b_.swollen(swelling * swell_ * this->rounding()), seed, progress, coincident);
    }
    catch (const InvalidGeometry&)
    {
      MeshBooleanResult none;
      none.usable = false;
      return none;
    }
  }

  double rounding() const { return std::max(a_.rounding(), b_.rounding()); }

  double doubledArea(const MeshBooleanResult& result,
    const std::array<std::vector<std::int32_t>, 2>& coincident) const
  {
    return backToBackArea(
      result, { &a_.mesh(), &b_.mesh() }, coincident, keep_[1].flip, 2.0 * this->rounding());
  }

  static double areaOf(const TriangleMesh& mesh)
  {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      area += 0.5 * areaNormal(mesh, t).norm();
    }
    return area;
  }

  // \param b the second operand, or that swollen.
  MeshBooleanResult cutBy(const MeshOperand& b, std::uint64_t seed, const Progress& progress,
    std::array<std::vector<std::int32_t>, 2>& coincident) const
  {
    const PerturbedPredicates predicates(
      [this, &b](std::int32_t vertex) { return Vec3(swell_ * b.outward(vertex)); }, seed);
    const std::array<const MeshOperand*, 2> operands = { &a_, &b };

    TriangleCrossings met = triangleCrossings(a_, b, predicates, ProgressPart(progress, 0.0, 0.4));
    coincident = std::move(met.touching);
    const CutCurves curves = cutCurves(a_, b, predicates, std::move(met.segments));
    const bool crossesCoincident = this->addNearlyCoincident(curves, coincident);
    progress.check();
    progress.report(0.5);
    const MeshSides sides = meshSides(a_, b, predicates, curves, this->tolerance());
    progress.check();
    progress.report(0.7);
    MeshBooleanResult result;
    result.usable = !sides.contradictory;
    if (result.usable)
    {
      std::array<CutFaces, 2> faces;
      for (std::size_t mesh = 0; mesh < 2; ++mesh)
      {
        faces[mesh] = cutFaces(*operands[mesh], int(mesh), keep_[mesh], curves, sides);
        progress.check();
      }
      progress.report(0.8);
      result = assemble(operands, keep_, curves, sides, faces);
      if (&b != &b_)
      {
        this->takeBack(result);
      }
      cleanResult(result, crossesCoincident || &b != &b_);
    }
    return result;
  }

  // Points of the second operand to where they are when it is not swollen.
  void takeBack(MeshBooleanResult& result) const
  {
    const std::vector<Vec3>& points = b_.mesh().points;
    for (std::size_t k = result.firstOfB; k < result.firstCut; ++k)
    {
      if (result.sourcePoint[k] >= 0)
      {
        result.mesh.points[k] = points[std::size_t(result.sourcePoint[k])];
      }
    }
    for (std::size_t k = 0; k < result.cutPoints.size(); ++k)
    {
      CutPoint& cut = result.cutPoints[k];
      if (cut.operand == 1 && cut.low >= 0)
      {
        cut.position =
          pointOnEdge(points[std::size_t(cut.low)], points[std::size_t(cut.high)], cut.parameter);
        result.mesh.points[result.firstCut + k] = cut.position;
      }
    }
  }

  const std::array<Keep, 2> keep_;
  const double swell_; // what touches merges, A - A is empty, A & A is A
  const MeshOperand& a_;
  const MeshOperand& b_;
  const Progress& progress_;
};

// Of both operands, where their triangles cross.
std::string tellOfSelfCrossing(const MeshOperand& a, const MeshOperand& b)
{
  const std::string first = tellOfSelfCrossing(a, "The first operand");
  const std::string second = tellOfSelfCrossing(b, "The second operand");
  return first.empty() || second.empty() ? first + second : first + " " + second;
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
    const std::string crossing = tellOfSelfCrossing(a, b);
    result.warnings.push_back(!crossing.empty()
        ? crossing
        : "An operand is inside out where it meets the other, or covers itself there: its surface "
          "does not tell what is inside.");
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
    try
    {
      result = Cut(operation, a, b, progress).run();
    }
    catch (const InvalidGeometry&)
    {
      const std::string crossing = tellOfSelfCrossing(a, b);
      if (crossing.empty())
      {
        throw;
      }
      throw InvalidGeometry(crossing);
    }
  }
  tell(a, b, result);
  progress.report(1.0);
  return result;
}

} // namespace hybridtree
