// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Node.h"

#include "core/base/Error.h"
#include "core/nodes/MeshLimits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace hybridtree
{
namespace
{

// Enough for a drag back and forth between two levels of detail, without hoarding.
constexpr std::size_t kKeptMeshes = 4;

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
  // In steps: a part that is dragged past the others' bounds does not change the lattice each time.
  constexpr double kStepsPerDoubling = 8.0;
  const Box3 box = this->surfaceBounds();
  const double length = box.isEmpty() ? 1.0 : box.diagonal().norm() / 100.0;
  return length > 1e-300
    ? std::exp2(std::round(kStepsPerDoubling * std::log2(length)) / kStepsPerDoubling)
    : 1e-300;
}

MeshPtr Node::mesh(double edgeLength, const Progress& progress) const
{
  requireEdgeLength(edgeLength);
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
