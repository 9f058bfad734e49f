// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BooleanMesh.h"

#include "core/base/Error.h"
#include "core/boolean/MeshBoolean.h"
#include "core/boolean/OperandCache.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/CutProjection.h"
#include "core/nodes/LeafPlace.h"

#include <array>

namespace hybridtree
{
namespace
{

MeshOperation operationOf(BooleanOperation operation)
{
  switch (operation)
  {
    case BooleanOperation::Union:
      return MeshOperation::Union;
    case BooleanOperation::Intersection:
      return MeshOperation::Intersection;
    case BooleanOperation::Difference:
      break;
  }
  return MeshOperation::Difference;
}

// Weights of the corners of a triangle at a point of its plane.
Vec3 weightsAt(const TriangleMesh& mesh, std::size_t triangle, const Vec3& p)
{
  const Triangle& c = mesh.triangles[triangle];
  const Vec3& a = mesh.points[std::size_t(c[0])];
  const Vec3 u = mesh.points[std::size_t(c[1])] - a;
  const Vec3 v = mesh.points[std::size_t(c[2])] - a;
  const Vec3 normal = u.cross(v);
  const double size = normal.squaredNorm();
  if (!(size > 0.0))
  {
    return { 1.0, 0.0, 0.0 };
  }
  const double s = (p - a).cross(v).dot(normal) / size;
  const double t = u.cross(p - a).dot(normal) / size;
  Vec3 weights(1.0 - s - t, s, t);
  weights = weights.cwiseMax(0.0);
  return weights / weights.sum();
}

// Normals and provenance of the result, after those of the children's meshes.
class Attributes
{
public:
  Attributes(std::array<const TriangleMesh*, 2> child, const Node& a, const Node& b,
    bool turnsSecond, MeshBooleanResult& result)
    : child_(child)
    , leafShift_{ 0, a.leafCount() }
    , places_{ LeafPlaces(a), LeafPlaces(b) }
    , turnsSecond_(turnsSecond)
    , result_(result)
    , mesh_(result.mesh)
  {
  }

  void fill()
  {
    this->fillTriangles();
    this->copyPoints();
    this->makeCutNormals();
    this->makeMissingNormals();
    this->placeCutPoints();
  }

private:
  bool hasOrigins() const
  {
    return !child_[0]->vertexOrigin.empty() || !child_[1]->vertexOrigin.empty();
  }

  void fillTriangles()
  {
    const bool hasTriangles =
      !child_[0]->sourceTriangle.empty() || !child_[1]->sourceTriangle.empty();
    mesh_.sourceLeaf.resize(mesh_.triangles.size());
    mesh_.sourceTriangle.assign(hasTriangles ? mesh_.triangles.size() : 0, -1);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const std::size_t operand = std::size_t(result_.sourceOperand[t]);
      const std::int32_t source = result_.sourceTriangle[t];
      const TriangleMesh& child = *child_[operand];
      const std::int32_t leaf =
        source < 0 || child.sourceLeaf.empty() ? -1 : child.sourceLeaf[std::size_t(source)];
      mesh_.sourceLeaf[t] = leaf < 0 ? -1 : leaf + leafShift_[operand];
      if (source >= 0 && !child.sourceTriangle.empty())
      {
        mesh_.sourceTriangle[t] = child.sourceTriangle[std::size_t(source)];
      }
    }
  }

  Vec3 normalOf(std::size_t operand, std::int32_t point) const
  {
    const Vec3& normal = child_[operand]->normals[std::size_t(point)];
    return operand == 1 && turnsSecond_ ? Vec3(-normal) : normal;
  }

  void copyPoints()
  {
    mesh_.normals.assign(mesh_.points.size(), Vec3::Zero());
    mesh_.vertexOrigin.assign(this->hasOrigins() ? mesh_.points.size() : 0, VertexOrigin());
    for (std::size_t k = 0; k < result_.firstCut; ++k)
    {
      const std::size_t operand = k < result_.firstOfB ? 0 : 1;
      const std::int32_t source = result_.sourcePoint[k];
      if (source < 0)
      {
        continue;
      }
      mesh_.normals[k] = this->normalOf(operand, source);
      if (!child_[operand]->vertexOrigin.empty())
      {
        mesh_.vertexOrigin[k] =
          this->shifted(operand, child_[operand]->vertexOrigin[std::size_t(source)]);
      }
    }
  }

  VertexOrigin shifted(std::size_t operand, VertexOrigin origin) const
  {
    origin.leaf += origin.leaf < 0 ? 0 : leafShift_[operand];
    return origin;
  }

  bool isOriginal(std::size_t operand, std::int32_t point) const
  {
    return std::size_t(point) < child_[operand]->points.size();
  }

  // How much of the normal of a cut point is that of A, how much that of B. A crease has two and a
  // point but one, so on one side the shading runs over a whole triangle: on that of the smaller
  // triangles, where these are much smaller.
  std::array<double, 2> normalWeights() const
  {
    constexpr double kMuchLarger = 2.0;
    std::array<double, 2> area{ 0.0, 0.0 };
    std::array<double, 2> count{ 0.0, 0.0 };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const Triangle& corner = mesh_.triangles[t];
      const std::size_t operand = std::size_t(result_.sourceOperand[t]);
      const std::int32_t source = result_.sourceTriangle[t];
      const bool atCut = std::any_of(corner.begin(), corner.end(),
        [&](std::int32_t point) { return std::size_t(point) >= result_.firstCut; });
      if (atCut && source >= 0)
      {
        area[operand] += areaNormal(*child_[operand], std::size_t(source)).norm();
        count[operand] += 1.0;
      }
    }
    const double a = area[0] * count[1];
    const double b = area[1] * count[0];
    return { b > kMuchLarger * a ? 0.0 : 1.0, a > kMuchLarger * b ? 0.0 : 1.0 };
  }

  void makeCutNormals()
  {
    const std::array<double, 2> weight = this->normalWeights();
    for (std::size_t k = 0; k < result_.cutPoints.size(); ++k)
    {
      const CutPoint& cut = result_.cutPoints[k];
      const std::size_t point = result_.firstCut + k;
      const std::size_t edgeOf = std::size_t(cut.operand);
      Vec3 normal = Vec3::Zero();
      if (cut.low >= 0 && this->isOriginal(edgeOf, cut.low) && this->isOriginal(edgeOf, cut.high))
      {
        normal += weight[edgeOf] *
          ((1.0 - cut.parameter) * this->normalOf(edgeOf, cut.low) +
            cut.parameter * this->normalOf(edgeOf, cut.high))
            .stableNormalized();
      }
      const TriangleMesh& other = *child_[1 - edgeOf];
      if (cut.triangle >= 0 && std::size_t(cut.triangle) < other.triangles.size())
      {
        const Vec3 weights = weightsAt(other, std::size_t(cut.triangle), mesh_.points[point]);
        Vec3 across = Vec3::Zero();
        for (int c = 0; c < 3; ++c)
        {
          across += weights[c] *
            this->normalOf(1 - edgeOf, other.triangles[std::size_t(cut.triangle)][std::size_t(c)]);
        }
        normal += weight[1 - edgeOf] * across.stableNormalized();
      }
      const double length = normal.norm();
      mesh_.normals[point] = length > 1e-6 ? Vec3(normal / length) : Vec3::Zero();
    }
  }

  // Of points that no child has, or whose normals cancel: by the triangles around.
  void makeMissingNormals()
  {
    std::vector<Vec3> sum(mesh_.points.size(), Vec3::Zero());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      for (const std::int32_t point : mesh_.triangles[t])
      {
        if (mesh_.normals[std::size_t(point)].isZero(0.0))
        {
          sum[std::size_t(point)] += areaNormal(mesh_, t);
        }
      }
    }
    for (std::size_t k = 0; k < sum.size(); ++k)
    {
      if (mesh_.normals[k].isZero(0.0))
      {
        const double length = sum[k].stableNorm();
        mesh_.normals[k] = length > 0.0 ? Vec3(sum[k] / length) : Vec3::UnitZ();
      }
    }
  }

  // On a leaf of either operand, by a triangle of it that the point lies in; or, where that is of
  // no mesh leaf, by another one there.
  void placeCutPoints()
  {
    if (!this->hasOrigins())
    {
      return;
    }
    for (std::size_t k = 0; k < result_.cutPoints.size(); ++k)
    {
      const std::size_t point = result_.firstCut + k;
      this->place(0, result_.cutPoints[k].home[0], point);
      this->place(1, result_.cutPoints[k].home[1], point);
    }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      for (const std::int32_t point : mesh_.triangles[t])
      {
        if (std::size_t(point) >= result_.firstCut)
        {
          this->place(
            std::size_t(result_.sourceOperand[t]), result_.sourceTriangle[t], std::size_t(point));
        }
      }
    }
  }

  void place(std::size_t operand, std::int32_t source, std::size_t point)
  {
    if (source >= 0 && mesh_.vertexOrigin[point].leaf < 0)
    {
      mesh_.vertexOrigin[point] = this->placed(operand, source, mesh_.points[point]);
    }
  }

  VertexOrigin placed(std::size_t operand, std::int32_t source, const Vec3& p) const
  {
    const TriangleMesh& child = *child_[operand];
    if (child.sourceTriangle.empty() || child.vertexOrigin.empty() ||
      child.sourceTriangle[std::size_t(source)] < 0)
    {
      return {};
    }
    const std::int32_t leaf = child.sourceLeaf[std::size_t(source)];
    const std::int32_t onLeaf = child.sourceTriangle[std::size_t(source)];
    const Vec3 weights = weightsAt(child, std::size_t(source), p);
    VertexOrigin result{ leaf, onLeaf, 0.0, 0.0 };
    for (std::size_t c = 0; c < 3; ++c)
    {
      const std::int32_t corner = child.triangles[std::size_t(source)][c];
      VertexOrigin origin = child.vertexOrigin[std::size_t(corner)];
      if (!places_[operand].moveTo(leaf, onLeaf, origin))
      {
        return {};
      }
      result.u += weights[int(c)] * origin.u;
      result.v += weights[int(c)] * origin.v;
    }
    return this->shifted(operand, result);
  }

  std::array<const TriangleMesh*, 2> child_;
  std::array<int, 2> leafShift_;
  std::array<LeafPlaces, 2> places_;
  bool turnsSecond_;
  MeshBooleanResult& result_;
  TriangleMesh& mesh_;
};

} // namespace

BooleanMesh booleanMesh(BooleanOperation operation, const Node& a, const Node& b,
  FacetMerging merging, double edgeLength, const Progress& progress)
{
  const MeshPtr meshA = a.mesh(edgeLength, ProgressPart(progress, 0.0, 0.4));
  const MeshPtr meshB = b.mesh(edgeLength, ProgressPart(progress, 0.4, 0.8));
  BooleanMesh made;
  MeshBooleanResult result;
  try
  {
    result = meshBoolean(operationOf(operation), *meshOperand(meshA), *meshOperand(meshB),
      ProgressPart(progress, 0.8, 0.95));
  }
  catch (const InvalidGeometry& error)
  {
    made.warnings.push_back(error.what());
    return made;
  }
  made.warnings = result.warnings;
  if (!result.usable)
  {
    return made;
  }
  const std::array<Facets, 2> facets = { facetsOf(a, edgeLength, progress),
    facetsOf(b, edgeLength, progress) };
  const std::array<std::size_t, 2> counts = { meshA->triangles.size(), meshB->triangles.size() };
  if (merging != FacetMerging::None)
  {
    mergeFacets(result, facetsOf(result, facets, counts));
  }
  projectCut(operation, { &a, &b }, { meshA.get(), meshB.get() }, edgeLength, result);
  Attributes({ meshA.get(), meshB.get() }, a, b, operation == BooleanOperation::Difference, result)
    .fill();
  made.facets = facetsOf(result, facets, counts);
  made.curves = result.curves;
  for (int operand = 0; operand < 2; ++operand)
  {
    const PointChains carried = carriedCurves(curvesOf(operand == 0 ? a : b, edgeLength, progress),
      (operand == 0 ? meshA : meshB)->points.size(), operand, result);
    made.curves.insert(made.curves.end(), carried.begin(), carried.end());
  }
  made.mesh = std::move(result.mesh);
  return made;
}

} // namespace hybridtree
