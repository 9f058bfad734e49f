// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshSide.h"

#include "core/geometry/Predicates.h"
#include "core/mesh/SolidAngle.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hybridtree
{
namespace
{

// The pseudonormal decides where the point is clearly off the tangent plane and clearly off the
// mesh; within these, relative to the distance and to the size of the mesh, the ray does.
constexpr double kClearAngle = 1e-3;
constexpr double kClearDistance = 1e-9;
constexpr double kNoDirection = 1e-13; // relative to the size: the offset is all rounding
constexpr double kSliver = 1e-6;       // height over length
constexpr double kFold = 0.25;         // cosine between the normals of a vertex and of its faces

Vec3 unit(const Vec3& v)
{
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : Vec3::Zero();
}

double angleAt(const Vec3& apex, const Vec3& a, const Vec3& b)
{
  const Vec3 u = a - apex;
  const Vec3 v = b - apex;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

// p in a triangle whose plane holds it, exactly: by a projection in which the triangle has area.
bool holds(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto turn = [&](const Vec3& i, const Vec3& j, const Vec3& k)
    { return orientation2d(i[u], i[v], j[u], j[v], k[u], k[v]); };
    const int whole = turn(a, b, c);
    if (whole != 0)
    {
      return turn(a, b, p) * whole >= 0 && turn(b, c, p) * whole >= 0 && turn(c, a, p) * whole >= 0;
    }
  }
  return false;
}

enum class Crossing
{
  No,
  Yes,
  Touches, // the segment meets the border of the triangle or ends on its plane: ask another way
  OnTriangle
};

Crossing cross(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, const Vec3& q)
{
  const int atP = orientation3d(a, b, c, p);
  if (atP == 0)
  {
    if (holds(a, b, c, p))
    {
      return Crossing::OnTriangle;
    }
    return orientation3d(a, b, c, q) == 0 ? Crossing::Touches : Crossing::No;
  }
  const int atQ = orientation3d(a, b, c, q);
  if (atQ == 0)
  {
    return Crossing::Touches;
  }
  if (atQ == atP)
  {
    return Crossing::No;
  }
  const int ab = orientation3d(p, q, a, b);
  const int bc = orientation3d(p, q, b, c);
  const int ca = orientation3d(p, q, c, a);
  const bool positive = ab > 0 || bc > 0 || ca > 0;
  const bool negative = ab < 0 || bc < 0 || ca < 0;
  if (positive && negative)
  {
    return Crossing::No;
  }
  return ab != 0 && bc != 0 && ca != 0 ? Crossing::Yes : Crossing::Touches;
}

// Does a segment come near a child box? Generously: the answer only prunes.
class SegmentBoxTest
{
public:
  SegmentBoxTest(const Vec3& from, const Vec3& to)
    : from_(from), inverse_((to - from).cwiseInverse())
  {
  }

  bool operator()(const MeshBvh::Node& node, std::size_t k) const
  {
    constexpr double margin = 1e-5;
    double enter = 0.0;
    double leave = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double t0 = (double(node.lower[axis][k]) - margin - from_[axis]) * inverse_[axis];
      const double t1 = (double(node.upper[axis][k]) + margin - from_[axis]) * inverse_[axis];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave * (1.0 + 1e-9) + 1e-12;
  }

private:
  Vec3 from_;
  Vec3 inverse_;
};

// By the winding number, which the crossings with the segment p q add up to: 1 where it is
// positive, else -1, 0 when p is on the mesh; empty when the segment meets an edge or a vertex.
std::optional<int> sideBySegment(
  const TriangleMesh& mesh, const MeshBvh& bvh, const Vec3& p, const Vec3& q)
{
  const SegmentBoxTest near(bvh.toLocal(p), bvh.toLocal(q));
  int winding = 0;
  std::vector<std::uint32_t> stack{ 0 };
  while (!stack.empty())
  {
    const MeshBvh::Node& node = bvh.nodes()[stack.back()];
    stack.pop_back();
    for (std::size_t k = 0; k < MeshBvh::kWidth && node.child[k] != MeshBvh::kNone; ++k)
    {
      if (!near(node, k))
      {
        continue;
      }
      if (!(node.child[k] & MeshBvh::kLeafBit))
      {
        stack.push_back(node.child[k]);
        continue;
      }
      const MeshBvh::Leaf& leaf = bvh.leaves()[node.child[k] & ~MeshBvh::kLeafBit];
      for (std::size_t j = 0; j < leaf.count; ++j)
      {
        const Triangle& c = mesh.triangles[std::size_t(leaf.triangle[j])];
        const Vec3& first = mesh.points[std::size_t(c[0])];
        const Vec3& second = mesh.points[std::size_t(c[1])];
        const Vec3& third = mesh.points[std::size_t(c[2])];
        switch (cross(first, second, third, p, q))
        {
          case Crossing::No:
            break;
          case Crossing::Yes:
            winding += orientation3d(first, second, third, p);
            break;
          case Crossing::Touches:
            return std::nullopt;
          case Crossing::OnTriangle:
            return 0;
        }
      }
    }
  }
  return winding > 0 ? 1 : -1;
}

} // namespace

MeshSide::MeshSide(const TriangleMesh& mesh, const MeshBvh& bvh)
  : mesh_(mesh), bvh_(bvh), edges_(halfEdges(mesh.triangles)), bounds_(mesh.bounds())
{
  this->makeVertexNormals();
  overlapping_ = this->isClosed() && this->shellsMayOverlap();
  if (!this->isClosed())
  {
    winding_ = std::make_unique<const WindingNumber>(mesh, bvh);
    for (std::size_t half = 0; half < edges_.opposite.size(); ++half)
    {
      if (edges_.opposite[half] < 0)
      {
        const Triangle& c = mesh.triangles[half / 3];
        borderLength_ +=
          (mesh.points[std::size_t(c[half % 3])] - mesh.points[std::size_t(c[(half + 1) % 3])])
            .norm();
      }
    }
  }
}

bool MeshSide::shellsMayOverlap() const
{
  constexpr std::size_t most = 1000; // pairs are compared one by one
  std::vector<Box3> boxes;
  std::vector<char> seen(mesh_.triangles.size(), 0);
  std::vector<std::int32_t> open;
  for (std::size_t first = 0; first < mesh_.triangles.size(); ++first)
  {
    if (seen[first])
    {
      continue;
    }
    if (boxes.size() == most)
    {
      return true;
    }
    Box3 box;
    seen[first] = 1;
    open.push_back(std::int32_t(first));
    while (!open.empty())
    {
      const std::int32_t t = open.back();
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k)
      {
        box.extend(mesh_.points[std::size_t(mesh_.triangles[std::size_t(t)][k])]);
        const std::int32_t next = edges_.opposite[std::size_t(3 * t) + k] / 3;
        if (!seen[std::size_t(next)])
        {
          seen[std::size_t(next)] = 1;
          open.push_back(next);
        }
      }
    }
    for (const Box3& other : boxes)
    {
      if (box.intersects(other))
      {
        return true;
      }
    }
    boxes.push_back(box);
  }
  return false;
}

void MeshSide::makeVertexNormals()
{
  vertexNormals_.assign(mesh_.points.size(), Vec3::Zero());
  doubtful_.assign(mesh_.points.size(), 0);
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
  {
    const Triangle& corner = mesh_.triangles[t];
    const Vec3 normal = areaNormal(mesh_, t);
    const double area = normal.norm();
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Vec3& apex = mesh_.points[std::size_t(corner[k])];
      const Vec3& next = mesh_.points[std::size_t(corner[(k + 1) % 3])];
      const Vec3& last = mesh_.points[std::size_t(corner[(k + 2) % 3])];
      longest = std::max(longest, (next - apex).squaredNorm());
      if (area > 0.0)
      {
        vertexNormals_[std::size_t(corner[k])] += (angleAt(apex, next, last) / area) * normal;
      }
    }
    if (!(area > kSliver * longest))
    {
      for (const std::int32_t vertex : corner)
      {
        doubtful_[std::size_t(vertex)] = 1;
      }
    }
  }
  for (Vec3& normal : vertexNormals_)
  {
    normal = unit(normal);
  }
  this->doubtFolds();
}

// Where a surface crosses itself it is folded hard, or has been: beside a blade's edge whose two
// faces have passed through each other the nearest point is seen from the wrong side.
void MeshSide::doubtFolds()
{
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
  {
    const Vec3 normal = unit(areaNormal(mesh_, t));
    for (const std::int32_t vertex : mesh_.triangles[t])
    {
      if (normal.dot(vertexNormals_[std::size_t(vertex)]) < kFold)
      {
        doubtful_[std::size_t(vertex)] = 1;
      }
    }
  }
}

Vec3 MeshSide::pseudonormal(std::int32_t triangle, int feature) const
{
  if (feature < 3)
  {
    return vertexNormals_[std::size_t(
      mesh_.triangles[std::size_t(triangle)][std::size_t(feature)])];
  }
  const Vec3 own = unit(areaNormal(mesh_, std::size_t(triangle)));
  if (feature == NearestOnTriangle::kFace)
  {
    return own;
  }
  const std::int32_t other = edges_.opposite[std::size_t(3 * triangle + feature - 3)];
  return other < 0 ? own : unit(own + unit(areaNormal(mesh_, std::size_t(other / 3))));
}

Vec3 MeshSide::gradient(
  const Vec3& p, int side, std::int32_t triangle, const NearestOnTriangle& nearest) const
{
  const Vec3 offset = p - nearest.point;
  const double distance = offset.norm();
  const double size = 1.0 / bvh_.scale() + p.cwiseAbs().maxCoeff();
  if (side == 0 || !(distance > kNoDirection * size))
  {
    return this->pseudonormal(triangle, nearest.feature);
  }
  return side > 0 ? Vec3(-offset / distance) : Vec3(offset / distance);
}

int MeshSide::side(
  const Vec3& p, std::int32_t triangle, const NearestOnTriangle& nearest, double* winding) const
{
  if (!this->isClosed())
  {
    return nearest.squaredDistance == 0.0 ? 0 : this->sideByWinding(p, winding);
  }
  if (!bounds_.contains(p))
  {
    return -1;
  }
  const Triangle& corner = mesh_.triangles[std::size_t(triangle)];
  const bool doubtful = doubtful_[std::size_t(corner[0])] || doubtful_[std::size_t(corner[1])] ||
    doubtful_[std::size_t(corner[2])];
  const Vec3 offset = p - nearest.point;
  const double distance = offset.norm();
  const double above = offset.dot(this->pseudonormal(triangle, nearest.feature));
  const double size = 1.0 / bvh_.scale() + p.cwiseAbs().maxCoeff();
  if (!doubtful && !overlapping_ && distance > kClearDistance * size &&
    std::abs(above) > kClearAngle * distance)
  {
    return above > 0.0 ? -1 : 1;
  }
  return this->sideByRay(p);
}

int MeshSide::side(const Vec3& p, double* winding) const
{
  return this->isClosed() ? this->sideByRay(p) : this->sideByWinding(p, winding);
}

int MeshSide::sideByWinding(const Vec3& p, double* winding) const
{
  const double number = winding_->at(p);
  if (winding)
  {
    *winding = number;
  }
  return number > 0.5 ? 1 : -1;
}

int MeshSide::sideByRay(const Vec3& p) const
{
  if (!bounds_.contains(p))
  {
    return -1;
  }
  // Directions without a pattern, so that rays seldom run along edges of modelled meshes. The
  // nearest way out first, as [HT] 4.2 has it, would meet axis-aligned faces edge on.
  const double length = 4.0 * bounds_.diagonal().norm();
  for (int attempt = 0; attempt < 32; ++attempt)
  {
    const double azimuth = 2.399963229728653 * (attempt + 0.31830988618379);
    const double height = std::sin(1.6180339887498949 * (attempt + 0.5772156649));
    const double ring = std::sqrt(1.0 - height * height);
    const Vec3 direction(ring * std::cos(azimuth), ring * std::sin(azimuth), height);
    if (const std::optional<int> answer = sideBySegment(mesh_, bvh_, p, p + length * direction))
    {
      return *answer;
    }
  }
  // Only reached when 32 rays each meet an edge or a vertex exactly.
  double angle = 0.0;
  for (const Triangle& c : mesh_.triangles)
  {
    angle += solidAngle(mesh_.points[std::size_t(c[0])], mesh_.points[std::size_t(c[1])],
      mesh_.points[std::size_t(c[2])], p);
  }
  return angle > 0.5 * kFullSolidAngle ? 1 : -1;
}

double MeshSide::windingSlope(double distance) const
{
  return borderLength_ == 0.0 ? 0.0 : borderLength_ / (kFullSolidAngle * distance * distance);
}

} // namespace hybridtree
