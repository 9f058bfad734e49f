// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FieldCost.h"

#include "core/nodes/DeformedMeshNode.h"
#include "core/nodes/Primitive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace hybridtree
{
namespace
{

using KindCost = std::pair<std::string_view, double>;

constexpr double kSimpleSkeleton = 0.023;
constexpr std::array<KindCost, 3> kSkeletons = { { { "spline", 0.22 }, { "revolution", 0.1 },
  { "ellipsoid", 0.05 } } };

// On top of what is below.
constexpr std::array<KindCost, 5> kOperators = { { { "twist", 0.1 }, { "bend", 0.12 },
  { "taper", 0.04 }, { "freeForm", 1.4 }, { "boolean", 0.02 } } };

constexpr double kSubdivisionSkeleton = 0.16;

// Of a mesh: to find where to look, and more where many triangles are near.
constexpr double kMesh = 0.25;
constexpr double kMeshDensity = 0.61; // for the root of triangles per squared cell

// Operands that reach a brick, where there are many.
constexpr std::size_t kFewOperands = 2;

template <std::size_t Count>
double costOf(std::string_view kind, const std::array<KindCost, Count>& table, double otherwise)
{
  const auto found = std::find_if(
    table.begin(), table.end(), [&](const KindCost& entry) { return entry.first == kind; });
  return found == table.end() ? otherwise : found->second;
}

double meshCost(const Node& node, const TriangleMesh& mesh, double edgeLength)
{
  const Box3 box = node.surfaceBounds();
  if (box.isEmpty())
  {
    return kMesh;
  }
  const Vec3 side = box.sizes();
  const double area = side.x() * side.y() + side.y() * side.z() + side.z() * side.x();
  const double squares = std::max(area / (edgeLength * edgeLength), 1.0);
  return kMesh + kMeshDensity * std::sqrt(static_cast<double>(mesh.triangles.size()) / squares);
}

class FieldCosts
{
public:
  explicit FieldCosts(double edgeLength) : edgeLength_(edgeLength) {}

  double of(const Node& node)
  {
    if (const auto* primitive = dynamic_cast<const Primitive*>(&node))
    {
      return costOf(primitive->skeleton().kind(), kSkeletons, kSimpleSkeleton);
    }
    if (const MeshPtr mesh = node.leafMesh())
    {
      return meshCost(node, *mesh, edgeLength_);
    }
    if (dynamic_cast<const DeformedMeshNode*>(&node))
    {
      return kMesh + kMeshDensity; // its triangles are about as long as the edges
    }
    const auto [known, isNew] = known_.emplace(&node, 0.0);
    if (isNew)
    {
      const double cost = this->ofOperator(node);
      known_[&node] = cost;
      return cost;
    }
    return known->second;
  }

private:
  double ofOperator(const Node& node)
  {
    const std::vector<NodePtr> children = node.children();
    if (children.empty())
    {
      return kSubdivisionSkeleton;
    }
    double sum = 0.0;
    for (const NodePtr& child : children)
    {
      sum += this->of(*child);
    }
    const auto count = static_cast<double>(children.size());
    const auto near = static_cast<double>(std::min(children.size(), kFewOperands));
    return sum * near / count + costOf(node.kind(), kOperators, 0.0);
  }

  const double edgeLength_;
  std::unordered_map<const Node*, double> known_; // a chain of shared nodes has many paths
};

} // namespace

double fieldCost(const Node& node, double edgeLength)
{
  return FieldCosts(edgeLength).of(node);
}

} // namespace hybridtree
