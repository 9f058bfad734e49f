// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/WarpedNode.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/nodes/Deformation.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/WarpImage.h"
#include "core/nodes/WarpMesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace hybridtree
{
namespace
{

// Preimages of a batch. Points without one stand where another has its own, so that the child is
// asked only within its bounds; clearHoles() then sets their answers.
class Preimages
{
public:
  Preimages(const SpaceWarp& warp, PointBatch points)
    : vectors_(points.size), hole_(warp.mayHaveHoles() ? points.size : 0)
  {
    warp.inverse(points, vectors_.batch());
    if (hole_.size() > 0)
    {
      this->fillHoles();
    }
  }

  /// No point has a preimage.
  bool none() const { return none_; }
  PointBatch points() const { return vectors_.points(); }

  template <typename Value>
  void clearHoles(Value* value, Value nothing) const
  {
    for (std::size_t k = 0; k < hole_.size(); ++k)
    {
      if (hole_.data()[k] != 0.0)
      {
        value[k] = nothing;
      }
    }
  }

private:
  void fillHoles()
  {
    const VectorBatch q = vectors_.batch();
    std::size_t some = hole_.size();
    for (std::size_t k = 0; k < hole_.size(); ++k)
    {
      hole_[k] = std::isnan(q.x[k]) ? 1.0 : 0.0;
      some = hole_[k] == 0.0 && some == hole_.size() ? k : some;
    }
    none_ = some == hole_.size();
    for (std::size_t k = 0; k < hole_.size() && !none_; ++k)
    {
      if (hole_[k] != 0.0)
      {
        q.set(k, q[some]);
      }
    }
  }

  ScratchVectors vectors_;
  ScratchArray hole_; // 1 where a point has no preimage; of size 0 where every point has one
  bool none_ = false;
};

void warpedField(const FieldSource& child, const SpaceWarp& warp, PointBatch points, double* value)
{
  const Preimages preimages(warp, points);
  if (preimages.none())
  {
    std::fill_n(value, points.size, 0.0);
    return;
  }
  child.field(preimages.points(), value);
  preimages.clearHoles(value, 0.0);
}

void warpedFieldAndGradient(const FieldSource& child, const SpaceWarp& warp, PointBatch points,
  double* value, VectorBatch gradient)
{
  const Preimages preimages(warp, points);
  if (preimages.none())
  {
    std::fill_n(value, points.size, 0.0);
    for (double* component : { gradient.x, gradient.y, gradient.z })
    {
      std::fill_n(component, points.size, 0.0);
    }
    return;
  }
  child.fieldAndGradient(preimages.points(), value, gradient);
  warp.pullBack(preimages.points(), gradient);
  preimages.clearHoles(value, 0.0);
  for (double* component : { gradient.x, gradient.y, gradient.z })
  {
    preimages.clearHoles(component, 0.0);
  }
}

Interval warpedRange(const FieldSource& child, const SpaceWarp& warp, const Box3& box)
{
  const Box3 preimage = warp.preimageBounds(box);
  const Interval zero{ 0.0, 0.0 };
  if (preimage.isEmpty())
  {
    return zero;
  }
  const Interval range = child.range(preimage);
  return warp.mayHaveHoles() ? Interval{ std::min(range.min, 0.0), std::max(range.max, 0.0) }
                             : range;
}

FieldSourcePtr restrictedWarp(const FieldSource& child, const SpaceWarp& warp, const Box3& box);

// A warped field that has dropped what does not reach some box.
class WarpedField final : public FieldSource
{
public:
  WarpedField(FieldSourcePtr child, const SpaceWarp& warp) : child_(std::move(child)), warp_(warp)
  {
  }
  void field(PointBatch points, double* value) const override
  {
    warpedField(*child_, warp_, points, value);
  }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    warpedFieldAndGradient(*child_, warp_, points, value, gradient);
  }
  Interval range(const Box3& box) const override { return warpedRange(*child_, warp_, box); }
  FieldSourcePtr restrictedTo(const Box3& box) const override
  {
    return restrictedWarp(*child_, warp_, box);
  }

private:
  FieldSourcePtr child_;
  const SpaceWarp& warp_; // of the node, which outlives this
};

FieldSourcePtr restrictedWarp(const FieldSource& child, const SpaceWarp& warp, const Box3& box)
{
  const Box3 preimage = warp.preimageBounds(box);
  FieldSourcePtr restricted = preimage.isEmpty() ? nullptr : child.restrictedTo(preimage);
  return restricted ? std::make_shared<const WarpedField>(std::move(restricted), warp) : nullptr;
}

// Whether w^-1(w(q)) = q for all points, to within a share of the edge length.
bool isOneToOne(const SpaceWarp& warp, const std::vector<Vec3>& points,
  const std::vector<Vec3>& image, double edgeLength, const Progress& progress)
{
  constexpr std::size_t kGrain = 512;
  std::atomic<bool> good{ true };
  parallelFor(points.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      ScratchVectors back(end - begin);
      for (std::size_t k = begin; k < end; ++k)
      {
        back.batch().set(k - begin, image[k]);
      }
      warp.inverse(back.points(), back.batch());
      for (std::size_t k = begin; k < end; ++k)
      {
        if (!((back.batch()[k - begin] - points[k]).norm() <= 1e-3 * edgeLength))
        {
          good = false;
        }
      }
    });
  return good;
}

} // namespace

WarpedNode::WarpedNode(NodePtr child, SpaceWarpPtr warp)
  : Operator({ std::move(child) }), child_(this->child().get()), warp_(std::move(warp))
{
}

Box3 WarpedNode::influenceBounds() const
{
  std::call_once(
    influenceOnce_, [this] { influenceBounds_ = warp_->imageBounds(child_->influenceBounds()); });
  return influenceBounds_;
}

Box3 WarpedNode::surfaceBounds() const
{
  std::call_once(
    surfaceOnce_, [this] { surfaceBounds_ = warp_->imageBounds(child_->surfaceBounds()); });
  return surfaceBounds_;
}

void WarpedNode::field(PointBatch points, double* value) const
{
  warpedField(*child_, *warp_, points, value);
}

void WarpedNode::fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const
{
  warpedFieldAndGradient(*child_, *warp_, points, value, gradient);
}

Interval WarpedNode::range(const Box3& box) const
{
  if (!box.intersects(this->influenceBounds()))
  {
    return { 0.0, 0.0 };
  }
  return warpedRange(*child_, *warp_, box);
}

FieldSourcePtr WarpedNode::restrictedTo(const Box3& box) const
{
  if (!box.intersects(this->influenceBounds()))
  {
    return nullptr;
  }
  return restrictedWarp(*child_, *warp_, box);
}

void WarpedNode::membership(PointBatch points, std::int8_t* side) const
{
  const Preimages preimages(*warp_, points);
  if (preimages.none())
  {
    std::fill_n(side, points.size, std::int8_t(-1));
    return;
  }
  child_->membership(preimages.points(), side);
  preimages.clearHoles(side, std::int8_t(-1));
}

void WarpedNode::sourceLeaf(PointBatch points, std::int32_t* leaf) const
{
  const Preimages preimages(*warp_, points);
  if (preimages.none())
  {
    std::fill_n(leaf, points.size, -1);
    return;
  }
  child_->sourceLeaf(preimages.points(), leaf);
  preimages.clearHoles(leaf, -1);
}

TriangleMesh WarpedNode::makeMesh(double edgeLength, const Progress& progress) const
{
  const Deformation deformation(*warp_, Deformation::If::OneToOne);
  const MeshPtr source =
    child_->meshToDeform(edgeLength, deformation, ProgressPart(progress, 0.0, 0.5));
  return this->imageOfMesh(*source, edgeLength, ProgressPart(progress, 0.5, 1.0));
}

MeshPtr WarpedNode::findOtherMesh(
  double edgeLength, const Deformation& by, const Progress& progress) const
{
  const ProgressPart before(progress, 0.0, 0.5);
  const Deformation alone(*warp_, Deformation::If::OneToOne);
  const Deformation all(*warp_, Deformation::If::OneToOne, &by);
  const MeshPtr source = child_->otherMeshToDeform(edgeLength, all, before);
  if (source == child_->otherMeshToDeform(edgeLength, alone, before))
  {
    return nullptr;
  }
  const MeshPtr from = source ? source : child_->mesh(edgeLength, before);
  return this->keptOtherMesh(edgeLength, from,
    [&] { return this->imageOfMesh(*from, edgeLength, ProgressPart(progress, 0.5, 1.0)); });
}

TriangleMesh WarpedNode::imageOfMesh(
  const TriangleMesh& source, double edgeLength, const Progress& progress) const
{
  std::vector<Vec3> image = imageOf(*warp_, source.points, progress);
  if (!isOneToOne(*warp_, source.points, image, edgeLength, progress))
  {
    return latticeMesh(*this, edgeLength, progress);
  }
  return warpedMesh(source, std::move(image), *warp_, edgeLength, *child_, progress);
}

} // namespace hybridtree
