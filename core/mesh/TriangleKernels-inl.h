// SPDX-License-Identifier: BSD-3-Clause
// Distance of points to triangles in SIMD, float to sort out and double to count. Included once per
// instruction set, as Highway's foreach_target has it; so no #pragma once.
#if defined(HYBRIDTREE_TRIANGLE_KERNELS) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDTREE_TRIANGLE_KERNELS
#undef HYBRIDTREE_TRIANGLE_KERNELS
#else
#define HYBRIDTREE_TRIANGLE_KERNELS
#endif

#include "core/mesh/MeshBvh.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// Points that go down the hierarchy together.
constexpr std::size_t kPacket = 16;
constexpr std::size_t kWidth = MeshBvh::kWidth;

// Float rounding of anything computed in local space, per unit of coordinate: sixteen units in the
// last place. What lies this much beyond the best so far may still be nearer in double.
constexpr double kRounding = 0x1p-20;

using Floats = hn::CappedTag<float, kPacket>; // over points
using Eight = hn::CappedTag<float, kWidth>;   // over children and triangles
using Doubles = hn::CappedTag<double, kWidth>;

constexpr double kUnlimited = 3e38; // a float
constexpr double kFarthest = 1e15;

// Squared distance of a float point to a triangle in its frame, good to kRounding in the distance.
template <typename V>
struct FrameVectors
{
  V origin[3], u[3], v[3], normal[3], length[3], direction[2][2];
};

template <class D, typename V = hn::Vec<D>>
HWY_INLINE V squaredToFrame(D d, const FrameVectors<V>& f, V px, V py, V pz)
{
  const V zero = hn::Zero(d);
  const V wx = hn::Sub(px, f.origin[0]);
  const V wy = hn::Sub(py, f.origin[1]);
  const V wz = hn::Sub(pz, f.origin[2]);
  const V x = hn::MulAdd(wx, f.u[0], hn::MulAdd(wy, f.u[1], hn::Mul(wz, f.u[2])));
  const V y = hn::MulAdd(wx, f.v[0], hn::MulAdd(wy, f.v[1], hn::Mul(wz, f.v[2])));
  const V z = hn::MulAdd(wx, f.normal[0], hn::MulAdd(wy, f.normal[1], hn::Mul(wz, f.normal[2])));
  // Edge 0-1.
  const V r0 = hn::Sub(x, hn::Min(hn::Max(x, zero), f.length[0]));
  V squared = hn::MulAdd(r0, r0, hn::Mul(y, y));
  // Edge 1-2: the inside is on its left.
  const V x1 = hn::Sub(x, f.length[0]);
  const V ax = f.direction[0][0];
  const V ay = f.direction[0][1];
  const V t1 = hn::Min(hn::Max(hn::MulAdd(x1, ax, hn::Mul(y, ay)), zero), f.length[1]);
  const V r1x = hn::NegMulAdd(t1, ax, x1);
  const V r1y = hn::NegMulAdd(t1, ay, y);
  squared = hn::Min(squared, hn::MulAdd(r1x, r1x, hn::Mul(r1y, r1y)));
  const V left1 = hn::NegMulAdd(ay, x1, hn::Mul(ax, y));
  // Edge 0-2: the inside is on its right.
  const V bx = f.direction[1][0];
  const V by = f.direction[1][1];
  const V t2 = hn::Min(hn::Max(hn::MulAdd(x, bx, hn::Mul(y, by)), zero), f.length[2]);
  const V r2x = hn::NegMulAdd(t2, bx, x);
  const V r2y = hn::NegMulAdd(t2, by, y);
  squared = hn::Min(squared, hn::MulAdd(r2x, r2x, hn::Mul(r2y, r2y)));
  const V right2 = hn::NegMulAdd(bx, y, hn::Mul(by, x));
  // Inside: all three on the inner side.
  const V least = hn::Min(y, hn::Min(left1, right2));
  squared = hn::IfThenZeroElse(hn::Ge(least, zero), squared);
  return hn::MulAdd(z, z, squared);
}

HWY_INLINE FrameVectors<hn::Vec<Floats>> frameOfOne(const MeshBvh::Frame& frame, std::size_t k)
{
  const Floats d;
  FrameVectors<hn::Vec<Floats>> f;
  for (int axis = 0; axis < 3; ++axis)
  {
    f.origin[axis] = hn::Set(d, frame.origin[axis][k]);
    f.u[axis] = hn::Set(d, frame.u[axis][k]);
    f.v[axis] = hn::Set(d, frame.v[axis][k]);
    f.normal[axis] = hn::Set(d, frame.normal[axis][k]);
    f.length[axis] = hn::Set(d, frame.length[axis][k]);
  }
  for (int edge = 0; edge < 2; ++edge)
  {
    f.direction[edge][0] = hn::Set(d, frame.direction[edge][0][k]);
    f.direction[edge][1] = hn::Set(d, frame.direction[edge][1][k]);
  }
  return f;
}

HWY_INLINE FrameVectors<hn::Vec<Eight>> framesFrom(const MeshBvh::Frame& frame, std::size_t k)
{
  const Eight d;
  FrameVectors<hn::Vec<Eight>> f;
  for (int axis = 0; axis < 3; ++axis)
  {
    f.origin[axis] = hn::LoadU(d, frame.origin[axis] + k);
    f.u[axis] = hn::LoadU(d, frame.u[axis] + k);
    f.v[axis] = hn::LoadU(d, frame.v[axis] + k);
    f.normal[axis] = hn::LoadU(d, frame.normal[axis] + k);
    f.length[axis] = hn::LoadU(d, frame.length[axis] + k);
  }
  for (int edge = 0; edge < 2; ++edge)
  {
    f.direction[edge][0] = hn::LoadU(d, frame.direction[edge][0] + k);
    f.direction[edge][1] = hn::LoadU(d, frame.direction[edge][1] + k);
  }
  return f;
}

// A triangle in double, one per lane or one for all: the same operations in the same order either
// way, so that a distance is the same bits whichever way it was found. As nearestOnTriangle().
class ExactTriangle
{
public:
  using V = hn::Vec<Doubles>;

  HWY_INLINE ExactTriangle(const V (&corner)[3][3])
  {
    const Doubles d;
    V squaredEdge[3];
    for (int k = 0; k < 3; ++k)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        corner_[k][axis] = corner[k][axis];
        edge_[k][axis] = hn::Sub(corner[(k + 1) % 3][axis], corner[k][axis]);
      }
      squaredEdge[k] = dot(edge_[k], edge_[k]);
      inverseEdge_[k] = hn::Div(hn::Set(d, 1.0), squaredEdge[k]);
    }
    cross(edge_[0], edge_[1], normal_);
    const V squaredNormal = dot(normal_, normal_);
    inverseNormal_ = hn::Div(hn::Set(d, 1.0), squaredNormal);
    const V longest = hn::Max(squaredEdge[0], hn::Max(squaredEdge[1], squaredEdge[2]));
    wide_ = hn::Gt(squaredNormal, hn::Mul(hn::Mul(hn::Set(d, 1e-16), longest), longest));
    for (int k = 0; k < 3; ++k)
    {
      cross(normal_, edge_[k], inward_[k]);
    }
  }

  HWY_INLINE V squaredDistance(V px, V py, V pz) const
  {
    const Doubles d;
    const V zero = hn::Zero(d);
    const V one = hn::Set(d, 1.0);
    auto inside = wide_;
    V squared = zero;
    V height = zero;
    for (int k = 0; k < 3; ++k)
    {
      const V w[3] = { hn::Sub(px, corner_[k][0]), hn::Sub(py, corner_[k][1]),
        hn::Sub(pz, corner_[k][2]) };
      const V along = hn::Mul(dot(w, edge_[k]), inverseEdge_[k]);
      const V t = hn::Min(hn::Max(along, zero), one);
      const V r[3] = { hn::NegMulAdd(t, edge_[k][0], w[0]), hn::NegMulAdd(t, edge_[k][1], w[1]),
        hn::NegMulAdd(t, edge_[k][2], w[2]) };
      const V toEdge = dot(r, r);
      squared = k == 0 ? toEdge : hn::Min(squared, toEdge);
      inside = hn::And(inside, hn::Gt(dot(inward_[k], w), zero));
      if (k == 0)
      {
        height = dot(normal_, w);
      }
    }
    return hn::IfThenElse(inside, hn::Mul(hn::Mul(height, height), inverseNormal_), squared);
  }

private:
  static HWY_INLINE V dot(const V (&a)[3], const V (&b)[3])
  {
    return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
  }
  static HWY_INLINE void cross(const V (&a)[3], const V (&b)[3], V (&result)[3])
  {
    result[0] = hn::NegMulAdd(a[2], b[1], hn::Mul(a[1], b[2]));
    result[1] = hn::NegMulAdd(a[0], b[2], hn::Mul(a[2], b[0]));
    result[2] = hn::NegMulAdd(a[1], b[0], hn::Mul(a[0], b[1]));
  }

  V corner_[3][3];
  V edge_[3][3];
  V inward_[3][3];
  V normal_[3];
  V inverseEdge_[3];
  V inverseNormal_;
  hn::Mask<Doubles> wide_;
};

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();
#endif
