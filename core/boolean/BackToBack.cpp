// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/BackToBack.h"

#include "core/boolean/BoxTree.h"
#include "core/boolean/LocalPart.h"
#include "core/geometry/PointTriangle.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kOpposed = -0.99; // cosine between normals

// Looks for triangles on the back of others.
class Backs
{
public:
  Backs(const TriangleMesh& mesh, double distance)
    : mesh_(mesh), distance_(distance), tree_(mesh, distance)
  {
  }

  bool isBacked(std::size_t t) const
  {
    const Triangle& c = mesh_.triangles[t];
    const Vec3 middle = (mesh_.points[std::size_t(c[0])] + mesh_.points[std::size_t(c[1])] +
                          mesh_.points[std::size_t(c[2])]) /
      3.0;
    BoxTree::Box box = BoxTree::Box::nothing();
    box.extend(middle);
    return this->visit(tree_.root(), box, middle, areaNormal(mesh_, t));
  }

private:
  bool visit(
    const BoxTree::Node& node, const BoxTree::Box& box, const Vec3& p, const Vec3& normal) const
  {
    bool found = false;
    if (node.level > 0)
    {
      tree_.forEachChild(node, box,
        [&](const BoxTree::Node& child) { found = found || this->visit(child, box, p, normal); });
      return found;
    }
    return std::any_of(tree_.begin(node), tree_.end(node),
      [&](std::int32_t t)
      {
        const Vec3 other = areaNormal(mesh_, std::size_t(t));
        const Triangle& c = mesh_.triangles[std::size_t(t)];
        return other.dot(normal) < kOpposed * other.norm() * normal.norm() &&
          nearestOnTriangle(p, mesh_.points[std::size_t(c[0])], mesh_.points[std::size_t(c[1])],
            mesh_.points[std::size_t(c[2])])
            .squaredDistance <= distance_ * distance_;
      });
  }

  const TriangleMesh& mesh_;
  const double distance_;
  const BoxTree tree_;
};

} // namespace

double backToBackArea(const MeshBooleanResult& result,
  const std::array<const TriangleMesh*, 2>& operands,
  const std::array<std::vector<std::int32_t>, 2>& among, bool turnsSecond, double distance)
{
  std::array<std::vector<char>, 2> isAmong;
  for (std::size_t operand = 0; operand < 2; ++operand)
  {
    isAmong[operand].assign(operands[operand]->triangles.size(), 0);
    for (const std::int32_t t : among[operand])
    {
      isAmong[operand][std::size_t(t)] = 1;
    }
  }
  double area = 0.0;
  std::vector<Triangle> others;
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
  {
    const std::size_t operand = std::size_t(result.sourceOperand[t]);
    const std::int32_t source = result.sourceTriangle[t];
    if (source < 0 || isAmong[operand][std::size_t(source)] == 0)
    {
      continue;
    }
    const Vec3 normal = areaNormal(result.mesh, t);
    const double along = normal.dot(areaNormal(*operands[operand], std::size_t(source)));
    if (operand == 1 && turnsSecond ? along > 0.0 : along < 0.0)
    {
      area += 0.5 * normal.norm();
    }
    else
    {
      others.push_back(result.mesh.triangles[t]);
    }
  }
  if (others.empty())
  {
    return area;
  }
  LocalPart part(others);
  TriangleMesh mesh;
  mesh.triangles = std::move(part.triangles);
  for (const std::int32_t point : part.pointOf)
  {
    mesh.points.push_back(result.mesh.points[std::size_t(point)]);
  }
  const Backs backs(mesh, distance);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area += backs.isBacked(t) ? 0.5 * areaNormal(mesh, t).norm() : 0.0;
  }
  return area;
}

} // namespace hybridtree
