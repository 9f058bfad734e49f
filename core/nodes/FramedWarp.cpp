// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FramedWarp.h"

namespace hybridtree
{

template <typename Map>
FramedWarp<Map>::FramedWarp(const Map& map, const Affine3& frame)
  : map_(map), frame_(frame), frameInverse_(frame.inverse())
{
}

template <typename Map>
void FramedWarp<Map>::forward(PointBatch points, VectorBatch image) const
{
  for (std::size_t k = 0; k < points.size; ++k)
  {
    image.set(k, frame_ * map_.forward(frameInverse_ * points[k]));
  }
}

template <typename Map>
void FramedWarp<Map>::inverse(PointBatch points, VectorBatch preimage) const
{
  for (std::size_t k = 0; k < points.size; ++k)
  {
    preimage.set(k, frame_ * map_.inverse(frameInverse_ * points[k]));
  }
}

template <typename Map>
void FramedWarp<Map>::pullBack(PointBatch preimages, VectorBatch gradient) const
{
  const Mat3 toFrame = frame_.linear().transpose();
  const Mat3 fromFrame = frameInverse_.linear().transpose();
  for (std::size_t k = 0; k < preimages.size; ++k)
  {
    const Mat3 j = map_.jacobianInverse(frameInverse_ * preimages[k]);
    gradient.set(k, fromFrame * (j.transpose() * (toFrame * gradient[k])));
  }
}

template <typename Map>
Box3 FramedWarp<Map>::preimageBounds(const Box3& box) const
{
  if (box.isEmpty())
  {
    return box;
  }
  const Box3 local = transformed(box, frameInverse_);
  Box3 bounds = transformed(map_.inverseExtent(local), frame_);
  if (const std::optional<MatrixInterval> jacobian = map_.inverseJacobianOver(local))
  {
    // Mean value theorem about the centre, entry by entry.
    const Vec3 center = frame_ * map_.inverse(frameInverse_ * box.center());
    const Vec3 reach =
      jacobian->between(frame_.linear(), frameInverse_.linear()).extent(0.5 * box.sizes());
    bounds = bounds.intersection(Box3(Vec3(center - reach), Vec3(center + reach)));
  }
  return widened(bounds);
}

template <typename Map>
Box3 FramedWarp<Map>::imageBounds(const Box3& box) const
{
  return boundsByCells(box,
    [&](const Box3& cell)
    {
      const Vec3 center = frame_ * map_.forward(frameInverse_ * cell.center());
      const Box3 local = transformed(cell, frameInverse_);
      const Vec3 reach = map_.jacobianOver(local)
                           .between(frame_.linear(), frameInverse_.linear())
                           .extent(0.5 * cell.sizes());
      const Box3 byRate(Vec3(center - reach), Vec3(center + reach));
      const Box3 extent = widened(transformed(map_.forwardExtent(local), frame_));
      return CellImage{ center, byRate.intersection(extent) };
    });
}

template class FramedWarp<TwistMap>;
template class FramedWarp<TaperMap>;
template class FramedWarp<BendMap>;

} // namespace hybridtree
