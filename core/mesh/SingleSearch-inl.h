// SPDX-License-Identifier: BSD-3-Clause
// Nearest triangle to one point.
// Included once per instruction set, as Highway's foreach_target has it; so no #pragma once.
#if defined(HYBRIDTREE_SINGLE_SEARCH) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDTREE_SINGLE_SEARCH
#undef HYBRIDTREE_SINGLE_SEARCH
#else
#define HYBRIDTREE_SINGLE_SEARCH
#endif

#include "core/mesh/NearestSearch-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// One point: SIMD over children and over the triangles of a leaf.
class SingleSearch : public Search
{
public:
  using Search::Search;

  void run(const Vec3& p, double& squared, std::int32_t& triangle)
  {
    const Vec3 local = query_.bvh->toLocal(p);
    const float point[3] = { kept(local[0]), kept(local[1]), kept(local[2]) };
    margin_ = kRounding * (1.0 + local.cwiseAbs().maxCoeff());
    best_ = this->squaredLimit();
    bestTriangle_ = -1;
    limit_ = this->threshold(best_, margin_);
    Stack stack;
    this->start(stack);
    while (!stack.empty())
    {
      const Entry entry = stack.pop();
      if (entry.squared > limit_)
      {
        continue;
      }
      if (entry.ref & MeshBvh::kLeafBit)
      {
        this->visit(leaves_[entry.ref & ~MeshBvh::kLeafBit], point, p);
      }
      else
      {
        this->expand(entry.ref, point, point, limit_, stack);
      }
    }
    squared = bestTriangle_ < 0 ? std::numeric_limits<double>::infinity() : best_;
    triangle = bestTriangle_;
  }

private:
  HWY_INLINE void visit(const MeshBvh::Leaf& leaf, const float* point, const Vec3& p)
  {
    const Eight d;
    bool near = false;
    for (std::size_t k = 0; k < kWidth; k += hn::Lanes(d))
    {
      const auto squared = squaredToFrame(d, framesFrom(leaf.frame, k), hn::Set(d, point[0]),
        hn::Set(d, point[1]), hn::Set(d, point[2]));
      near = near || !hn::AllFalse(d, hn::Le(squared, hn::Set(d, limit_)));
    }
    if (near)
    {
      this->measure(leaf, p);
    }
  }

  HWY_NOINLINE void measure(const MeshBvh::Leaf& leaf, const Vec3& p)
  {
    const Doubles d;
    alignas(64) double corner[3][3][kWidth];
    for (std::size_t k = 0; k < kWidth; ++k)
    {
      for (int which = 0; which < 3; ++which)
      {
        const double* from = this->corner(leaf.triangle[k], which);
        for (int axis = 0; axis < 3; ++axis)
        {
          corner[which][axis][k] = from[axis];
        }
      }
    }
    alignas(64) double squared[kWidth];
    for (std::size_t k = 0; k < kWidth; k += hn::Lanes(d))
    {
      hn::Vec<Doubles> loaded[3][3];
      for (int which = 0; which < 3; ++which)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          loaded[which][axis] = hn::Load(d, corner[which][axis] + k);
        }
      }
      hn::Store(
        ExactTriangle(loaded).squaredDistance(hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2])),
        d, squared + k);
    }
    for (std::size_t k = 0; k < leaf.count; ++k)
    {
      if (squared[k] < best_)
      {
        best_ = squared[k];
        bestTriangle_ = leaf.triangle[k];
        limit_ = this->threshold(best_, margin_);
      }
    }
  }

  double best_;
  double margin_;
  std::int32_t bestTriangle_;
  float limit_;
};

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();
#endif
