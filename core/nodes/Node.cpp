// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Node.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <sstream>

namespace hybridtree
{
namespace
{

// Enough for a drag back and forth between two levels of detail, without hoarding.
constexpr std::size_t kKeptMeshes = 4;

// Squares and cubes of lengths between these neither overflow nor vanish.
constexpr double kLargestCoordinate = 1e100;
constexpr double kSmallestSize = 1e-100;

// A shape smaller than this share of its distance from the origin has too few digits left for a
// mesh: 1 % of it would be some ten units in the last place.
constexpr double kSmallestShare = 1e3 * std::numeric_limits<double>::epsilon();

std::string text(double value)
{
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

// \throws InvalidGeometry when numbers of double precision cannot hold a mesh of a shape there.
void requireRepresentable(const Box3& surface)
{
  // A box of no extent bounds no surface: what two solids share that touch in a point.
  if (surface.isEmpty() || surface.sizes().maxCoeff() == 0.0)
  {
    return;
  }
  const double largest = surface.min().cwiseAbs().cwiseMax(surface.max().cwiseAbs()).maxCoeff();
  if (!(largest <= kLargestCoordinate)) // also NaN
  {
    throw InvalidGeometry("The shape reaches out to a coordinate of " + text(largest) +
      "; at most " + text(kLargestCoordinate) +
      " can be meshed. Make its lengths and positions smaller.");
  }
  const double size = surface.sizes().maxCoeff();
  if (size < kSmallestShare * largest)
  {
    throw InvalidGeometry("The shape is " + text(size) + " in size at a coordinate of " +
      text(largest) + ", too far from the origin for double precision; its size must be at least " +
      text(kSmallestShare * largest) + " there. Move it towards the origin or enlarge it.");
  }
  if (size < kSmallestSize)
  {
    throw InvalidGeometry("The shape is " + text(size) + " in size; at least " +
      text(kSmallestSize) + " is needed for a mesh. Enlarge it.");
  }
}

} // namespace

struct Node::Meshes
{
  std::mutex mutex;
  std::vector<std::pair<double, MeshPtr>> kept; // by edge length
};

Node::~Node()
{
  delete meshes_.load();
}

Node::Meshes& Node::meshes() const
{
  Meshes* meshes = meshes_.load();
  if (!meshes)
  {
    auto made = std::make_unique<Meshes>();
    if (meshes_.compare_exchange_strong(meshes, made.get()))
    {
      meshes = made.release();
    }
  }
  return *meshes;
}

void Node::signedDistance(PointBatch points, double* distance) const
{
  std::fill_n(distance, points.size, std::numeric_limits<double>::quiet_NaN());
}

double Node::defaultEdgeLength() const
{
  const Box3 box = this->surfaceBounds();
  return box.isEmpty() ? 1.0 : std::max(box.diagonal().norm() / 100.0, 1e-300);
}

MeshPtr Node::mesh(double edgeLength, const Progress& progress) const
{
  if (!std::isfinite(edgeLength) || edgeLength < 0.0)
  {
    throw InvalidParameter(
      "EdgeLength", edgeLength, "a finite length > 0, or 0 for the bounding diagonal / 100");
  }
  requireRepresentable(this->surfaceBounds());
  const double length = edgeLength > 0.0 ? edgeLength : this->defaultEdgeLength();
  // Held while meshing: a second thread that wants the same mesh waits for it instead of making it
  // again. Children lock their own mutex, and a tree has no cycles.
  Meshes& meshes = this->meshes();
  const std::lock_guard<std::mutex> lock(meshes.mutex);
  for (const auto& [kept, mesh] : meshes.kept)
  {
    if (kept == length)
    {
      return mesh;
    }
  }
  this->prepare(progress);
  auto mesh = std::make_shared<const TriangleMesh>(this->makeMesh(length, progress));
  if (meshes.kept.size() == kKeptMeshes)
  {
    meshes.kept.erase(meshes.kept.begin());
  }
  meshes.kept.emplace_back(length, mesh);
  return mesh;
}

NodePtr Node::affine(const Affine3& map) const
{
  if (!map.matrix().allFinite())
  {
    throw InvalidParameter("The affine map", "not finite", "made of finite numbers");
  }
  const double scale = map.linear().norm();
  if (!(std::abs(map.linear().determinant()) > 1e-15 * scale * scale * scale))
  {
    throw InvalidParameter("The scale of the affine map", "0 in some direction",
      "other than 0 in every direction, or the shape would be flat");
  }
  if (map.matrix() == Affine3::Identity().matrix())
  {
    return this->shared_from_this();
  }
  return this->makeAffine(map);
}

} // namespace hybridtree
