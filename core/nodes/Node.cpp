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

// The meshes made last, by whatever tells them apart.
template <typename Key>
class RecentMeshes
{
public:
  // Held while meshing: a second thread that wants the same mesh waits for it instead of making it
  // again. Children lock their own mutex, and a tree has no cycles. Null where none is made.
  template <typename Make>
  MeshPtr of(const Key& key, const Make& make)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [known, mesh] : kept_)
    {
      if (known == key)
      {
        return mesh;
      }
    }
    MeshPtr mesh = make();
    if (mesh && kept_.size() == kKeptMeshes)
    {
      kept_.erase(kept_.begin());
    }
    if (mesh)
    {
      kept_.emplace_back(key, mesh);
    }
    return mesh;
  }

private:
  std::mutex mutex_;
  std::vector<std::pair<Key, MeshPtr>> kept_;
};

} // namespace

struct Node::Meshes
{
  RecentMeshes<double> plain;                      // by edge length
  RecentMeshes<std::pair<double, MeshPtr>> others; // and by the mesh they are made from
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
  return this->meshes().plain.of(length,
    [&]
    {
      this->prepare(progress);
      return std::make_shared<const TriangleMesh>(this->makeMesh(length, progress));
    });
}

MeshPtr Node::meshToDeform(double edgeLength, const Deformation& by, const Progress& progress) const
{
  const MeshPtr other = this->otherMeshToDeform(edgeLength, by, progress);
  return other ? other : this->mesh(edgeLength, progress);
}

MeshPtr Node::otherMeshToDeform(
  double edgeLength, const Deformation& by, const Progress& progress) const
{
  requireEdgeLength(edgeLength);
  requireRepresentable(this->surfaceBounds());
  this->prepare(progress);
  return this->findOtherMesh(
    edgeLength > 0.0 ? edgeLength : this->defaultEdgeLength(), by, progress);
}

MeshPtr Node::findOtherMesh(double, const Deformation&, const Progress&) const
{
  return nullptr;
}

MeshPtr Node::keptOtherMesh(double edgeLength, const MeshPtr& from,
  const std::function<std::optional<TriangleMesh>()>& make) const
{
  return this->meshes().others.of({ edgeLength, from },
    [&]() -> MeshPtr
    {
      std::optional<TriangleMesh> mesh = make();
      return mesh ? std::make_shared<const TriangleMesh>(std::move(*mesh)) : nullptr;
    });
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
