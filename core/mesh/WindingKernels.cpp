// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/WindingKernels.h"

#include "core/mesh/SolidAngle.h"

#include <cmath>

// Compiled once per instruction set; three of them cover the field.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mesh/WindingKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kWidth = MeshBvh::kWidth;
using Lanes = hn::CappedTag<double, kWidth>;
using V = hn::Vec<Lanes>;

constexpr double kTurn = 0.5 * kFullSolidAngle;

struct Vectors
{
  V x, y, z;

  HWY_INLINE V dot(const Vectors& b) const
  {
    return hn::MulAdd(x, b.x, hn::MulAdd(y, b.y, hn::Mul(z, b.z)));
  }
  HWY_INLINE Vectors cross(const Vectors& b) const
  {
    return { hn::NegMulAdd(z, b.y, hn::Mul(y, b.z)), hn::NegMulAdd(x, b.z, hn::Mul(z, b.x)),
      hn::NegMulAdd(y, b.x, hn::Mul(x, b.y)) };
  }
};

// AngleSum, one per lane.
class AngleSums
{
public:
  HWY_INLINE AngleSums()
    : real_(hn::Set(Lanes(), 1.0)), imaginary_(hn::Zero(Lanes())), turns_(hn::Zero(Lanes()))
  {
  }

  HWY_INLINE void add(V sine, V cosine)
  {
    const Lanes d;
    const V zero = hn::Zero(d);
    const auto none = hn::Eq(sine, zero);
    cosine = hn::IfThenElse(none, hn::Set(d, 1.0), cosine);
    V real = hn::NegMulAdd(imaginary_, sine, hn::Mul(real_, cosine));
    V imaginary = hn::MulAdd(real_, sine, hn::Mul(imaginary_, cosine));
    const V size = hn::Add(hn::Abs(real), hn::Abs(imaginary));
    const auto usual =
      hn::And(hn::Ge(size, hn::Set(d, kSmall)), hn::Le(size, hn::Set(d, 1.0 / kSmall)));
    if (HWY_UNLIKELY(!hn::AllTrue(d, usual)))
    {
      this->scale(sine, cosine, size, real, imaginary);
    }
    // Angles of two signs never pass the negative real axis. What lies on it counts as +pi.
    const auto wasBelow = hn::Lt(imaginary_, zero);
    const auto below = hn::Lt(imaginary, zero);
    const auto onAxis = hn::And(hn::Eq(imaginary, zero), hn::Lt(real, zero));
    const auto up = hn::And(hn::AndNot(wasBelow, below), hn::Gt(sine, zero));
    const auto down =
      hn::And(hn::And(wasBelow, hn::Or(hn::Gt(imaginary, zero), onAxis)), hn::Lt(sine, zero));
    const V one = hn::Set(d, 1.0);
    turns_ = hn::Add(turns_, hn::IfThenElseZero(up, one));
    turns_ = hn::Sub(turns_, hn::IfThenElseZero(down, one));
    real_ = real;
    imaginary_ = imaginary;
  }

  double sum() const
  {
    const Lanes d;
    alignas(64) double real[kWidth];
    alignas(64) double imaginary[kWidth];
    hn::Store(real_, d, real);
    hn::Store(imaginary_, d, imaginary);
    AngleSum total;
    double apart = apart_ + kTurn * hn::GetLane(hn::SumOfLanes(d, turns_));
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
    {
      total.add(imaginary[k], real[k]);
      apart += imaginary[k] == 0.0 && real[k] < 0.0 ? 0.5 * kTurn : 0.0;
    }
    return total.sum() + apart;
  }

private:
  // Products far from 1 are scaled back; those that overflow or lose digits are left out and their
  // angles added by themselves.
  HWY_NOINLINE void scale(V& sine, V cosine, V size, V& real, V& imaginary)
  {
    const Lanes d;
    alignas(64) double s[kWidth], c[kWidth], length[kWidth], re[kWidth], im[kWidth];
    alignas(64) double oldRe[kWidth], oldIm[kWidth];
    hn::Store(sine, d, s);
    hn::Store(cosine, d, c);
    hn::Store(size, d, length);
    hn::Store(real, d, re);
    hn::Store(imaginary, d, im);
    hn::Store(real_, d, oldRe);
    hn::Store(imaginary_, d, oldIm);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
    {
      if (!(length[k] >= kLeast && length[k] <= 1.0 / kLeast))
      {
        apart_ += std::atan2(s[k], c[k]);
        re[k] = oldRe[k];
        im[k] = oldIm[k];
        s[k] = 0.0;
      }
      const double whole = std::abs(re[k]) + std::abs(im[k]);
      re[k] /= whole;
      im[k] /= whole;
    }
    sine = hn::Load(d, s);
    real = hn::Load(d, re);
    imaginary = hn::Load(d, im);
  }

  static constexpr double kSmall = 1e-60;
  static constexpr double kLeast = 1e-280;

  V real_;
  V imaginary_;
  V turns_;
  double apart_ = 0.0;
};

class WindingSum
{
public:
  WindingSum(const WindingTree& tree, const Vec3& p) : tree_(tree), p_(p), far_(hn::Zero(Lanes()))
  {
  }

  double run()
  {
    this->visit(0);
    return hn::GetLane(hn::SumOfLanes(Lanes(), far_)) + 2.0 * angles_.sum();
  }

private:
  void visit(std::uint32_t node)
  {
    const Lanes d;
    const WindingDipoles& dipoles = tree_.dipoles[node];
    const auto& child = tree_.bvh->nodes()[node].child;
    for (std::size_t k = 0; k < kWidth && child[k] != MeshBvh::kNone; k += hn::Lanes(d))
    {
      const Vectors toward = { hn::Sub(hn::Load(d, dipoles.center[0] + k), hn::Set(d, p_.x())),
        hn::Sub(hn::Load(d, dipoles.center[1] + k), hn::Set(d, p_.y())),
        hn::Sub(hn::Load(d, dipoles.center[2] + k), hn::Set(d, p_.z())) };
      const Vectors normal = { hn::Load(d, dipoles.normal[0] + k),
        hn::Load(d, dipoles.normal[1] + k), hn::Load(d, dipoles.normal[2] + k) };
      const V squared = toward.dot(toward);
      const auto isFar = hn::Gt(squared, hn::Load(d, dipoles.squaredFar + k));
      const V angle = hn::Div(normal.dot(toward), hn::Mul(squared, hn::Sqrt(squared)));
      far_ = hn::Add(far_, hn::IfThenElseZero(isFar, angle));
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, isFar, bits);
      for (std::size_t j = 0; j < hn::Lanes(d) && child[k + j] != MeshBvh::kNone; ++j)
      {
        if (bits[0] & (1u << j))
        {
          continue;
        }
        if (child[k + j] & MeshBvh::kLeafBit)
        {
          this->addLeaf(child[k + j] & ~MeshBvh::kLeafBit);
        }
        else
        {
          this->visit(child[k + j]);
        }
      }
    }
  }

  void addLeaf(std::uint32_t number)
  {
    const MeshBvh::Leaf& leaf = tree_.bvh->leaves()[number];
    if (tree_.corners.empty())
    {
      this->add(LeafCorners::of(*tree_.mesh, leaf), leaf.count);
      return;
    }
    this->add(tree_.corners[number], leaf.count);
  }

  HWY_INLINE void add(const LeafCorners& corners, std::size_t count)
  {
    const Lanes d;
    const auto& to = corners.at;
    const Vectors p = { hn::Set(d, p_.x()), hn::Set(d, p_.y()), hn::Set(d, p_.z()) };
    for (std::size_t k = 0; k < count; k += hn::Lanes(d))
    {
      const auto at = [&](std::size_t c) -> Vectors
      {
        return { hn::Sub(hn::Load(d, to[c][0] + k), p.x), hn::Sub(hn::Load(d, to[c][1] + k), p.y),
          hn::Sub(hn::Load(d, to[c][2] + k), p.z) };
      };
      const Vectors u = at(0);
      const Vectors v = at(1);
      const Vectors w = at(2);
      const V lu = hn::Sqrt(u.dot(u));
      const V lv = hn::Sqrt(v.dot(v));
      const V lw = hn::Sqrt(w.dot(w));
      const V cosine = hn::MulAdd(
        hn::MulAdd(lu, lv, u.dot(v)), lw, hn::MulAdd(v.dot(w), lu, hn::Mul(w.dot(u), lv)));
      // The last triangle fills the leaf up.
      const V sine = hn::IfThenElseZero(hn::FirstN(d, count - k), u.dot(v.cross(w)));
      angles_.add(sine, cosine);
    }
  }

  const WindingTree& tree_;
  const Vec3 p_;
  V far_;
  AngleSums angles_;
};

double solidAngleOfMesh(const WindingTree& tree, const Vec3& p)
{
  return WindingSum(tree, p).run();
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(solidAngleOfMesh);

LeafCorners LeafCorners::of(const TriangleMesh& mesh, const MeshBvh::Leaf& leaf)
{
  LeafCorners corners;
  for (std::size_t k = 0; k < MeshBvh::kWidth; ++k)
  {
    const Triangle& corner = mesh.triangles[std::size_t(leaf.triangle[k])];
    for (std::size_t c = 0; c < 3; ++c)
    {
      const Vec3& point = mesh.points[std::size_t(corner[c])];
      for (int axis = 0; axis < 3; ++axis)
      {
        corners.at[c][axis][k] = point[axis];
      }
    }
  }
  return corners;
}

double solidAngleOfMesh(const WindingTree& tree, const Vec3& p)
{
  return HWY_DYNAMIC_DISPATCH(solidAngleOfMesh)(tree, p);
}

} // namespace hybridtree
#endif
