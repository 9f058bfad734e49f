// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FreeFormWarp.h"

#include <limits>

namespace hybridtree
{
namespace
{

// Cells of boundsByCells() get this many times smaller; fewer for lattices that are slow to
// evaluate.
int depthFor(const BernsteinVolume& volume)
{
  const std::size_t points = volume.coefficients().size();
  return points <= 125 ? 5 : points <= 1000 ? 4 : 3;
}

// The cube with the margin that counts as inside.
Box3 cubeWithMargin()
{
  return Box3(Vec3::Constant(-BernsteinDeformation::kMargin),
    Vec3::Constant(1.0 + BernsteinDeformation::kMargin));
}

Box3 around(const Vec3& center, const Vec3& reach)
{
  return Box3(Vec3(center - reach), Vec3(center + reach));
}

} // namespace

FreeFormWarp::FreeFormWarp(
  std::shared_ptr<const BernsteinDeformation> deformation, const Affine3& frame)
  : deformation_(std::move(deformation)), frame_(frame), frameInverse_(frame.inverse())
{
}

void FreeFormWarp::forward(PointBatch points, VectorBatch image) const
{
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const Vec3 p = points[k];
    const Vec3 x = frameInverse_ * p;
    const bool moves = !deformation_->isIdentity() && BernsteinDeformation::isInside(x);
    image.set(k, moves ? Vec3(p + frame_.linear() * deformation_->displacement().evaluate(x)) : p);
  }
}

void FreeFormWarp::inverse(PointBatch points, VectorBatch preimage) const
{
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const Vec3 p = points[k];
    const Vec3 y = frameInverse_ * p;
    const std::optional<Vec3> x = deformation_->inverse(y);
    if (!x)
    {
      preimage.set(k, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    }
    else
    {
      preimage.set(k, p + frame_.linear() * (*x - y)); // at rest, bit for bit
    }
  }
}

void FreeFormWarp::pullBack(PointBatch preimages, VectorBatch gradient) const
{
  const Mat3 toFrame = frame_.linear().transpose();
  const Mat3 fromFrame = frameInverse_.linear().transpose();
  for (std::size_t k = 0; k < preimages.size; ++k)
  {
    const Vec3 x = frameInverse_ * preimages[k];
    if (deformation_->isIdentity() || !BernsteinDeformation::isInside(x))
    {
      continue;
    }
    const Mat3 inverse = deformation_->jacobian(x).inverse();
    const Vec3 pulled = fromFrame * (inverse.transpose() * (toFrame * gradient[k]));
    gradient.set(k, pulled.allFinite() ? pulled : Vec3::Zero());
  }
}

Box3 FreeFormWarp::preimageBounds(const Box3& box) const
{
  if (box.isEmpty() || deformation_->isIdentity())
  {
    return box;
  }
  const Box3 local = transformed(box, frameInverse_);
  Box3 bounds;
  if (!cubeWithMargin().contains(local))
  {
    bounds = box; // what is at rest
  }
  const BernsteinDeformation::Preimage preimage = deformation_->preimageOf(local);
  if (!preimage.box.isEmpty())
  {
    Box3 inside = transformed(preimage.box, frame_);
    if (preimage.center)
    {
      const Vec3 reach = preimage.inverseJacobian.between(frame_.linear(), frameInverse_.linear())
                           .extent(0.5 * box.sizes()) +
        frame_.linear().cwiseAbs() * preimage.slack;
      inside = inside.intersection(around(frame_ * *preimage.center, reach));
    }
    bounds.extend(inside);
  }
  return widened(bounds);
}

Box3 FreeFormWarp::imageBounds(const Box3& box) const
{
  if (box.isEmpty() || deformation_->isIdentity())
  {
    return box;
  }
  const Box3 local = transformed(box, frameInverse_);
  const Box3 inside = local.intersection(cubeWithMargin());
  Box3 bounds;
  if (!inside.isEmpty())
  {
    bounds = boundsByCells(
      inside,
      [&](const Box3& cell)
      {
        const Vec3 center = frame_ * deformation_->forward(cell.center());
        const MatrixInterval jacobian =
          deformation_->jacobianOver(cell).between(frame_.linear(), Mat3::Identity());
        return CellImage{ center, around(center, jacobian.extent(0.5 * cell.sizes())) };
      },
      depthFor(deformation_->displacement()));
  }
  if (!cubeWithMargin().contains(local))
  {
    bounds.extend(box);
  }
  return bounds;
}

} // namespace hybridtree
