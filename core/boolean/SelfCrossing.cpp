// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/SelfCrossing.h"

#include "core/base/DisjointSets.h"
#include "core/mesh/Crossings.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace hybridtree
{
namespace
{

double meanEdge(const TriangleMesh& mesh)
{
  double sum = 0.0;
  for (const Triangle& c : mesh.triangles)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      sum += (mesh.points[std::size_t(c[k])] - mesh.points[std::size_t(c[(k + 1) % 3])]).norm();
    }
  }
  return sum / (3.0 * double(mesh.triangles.size()));
}

// Of triangles that hang together by points.
DisjointSets shellsOf(const TriangleMesh& mesh)
{
  DisjointSets shells(mesh.points.size());
  for (const Triangle& c : mesh.triangles)
  {
    shells.join(std::size_t(c[0]), std::size_t(c[1]));
    shells.join(std::size_t(c[0]), std::size_t(c[2]));
  }
  return shells;
}

} // namespace

std::string tellOfSelfCrossing(const MeshOperand& operand, const std::string& name)
{
  const TriangleMesh& mesh = operand.mesh();
  if (mesh.empty())
  {
    return {};
  }
  const std::vector<std::pair<std::size_t, std::size_t>> pairs =
    newCrossings(mesh, 0, {}, meanEdge(mesh));
  if (pairs.empty())
  {
    return {};
  }
  DisjointSets shells = shellsOf(mesh);
  const bool ofShells = std::all_of(pairs.begin(), pairs.end(),
    [&](const auto& pair)
    {
      return shells.find(std::size_t(mesh.triangles[pair.first][0])) !=
        shells.find(std::size_t(mesh.triangles[pair.second][0]));
    });
  const std::string what = ofShells ? "shells of it overlap" : "its surface runs through itself";
  const bool isOpen = operand.addedTriangles() > 0;
  const std::string mending =
    ofShells && !isOpen ? "Take its shells apart and unite them first." : "Repair it.";
  return name + " crosses itself: " + what + ", " + std::to_string(pairs.size()) +
    (pairs.size() == 1 ? " pair of triangles lies" : " pairs of triangles lie") +
    " across each other (the first: triangles " + std::to_string(pairs.front().first) + " and " +
    std::to_string(pairs.front().second) + "). What is inside is not told there. " + mending;
}

} // namespace hybridtree
