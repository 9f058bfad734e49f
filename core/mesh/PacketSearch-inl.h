// SPDX-License-Identifier: BSD-3-Clause
// Nearest triangles to the points of a packet.
// Included once per instruction set, as Highway's foreach_target has it; so no #pragma once.
#if defined(HYBRIDTREE_PACKET_SEARCH) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDTREE_PACKET_SEARCH
#undef HYBRIDTREE_PACKET_SEARCH
#else
#define HYBRIDTREE_PACKET_SEARCH
#endif

#include "core/mesh/NearestSearch-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// Below this many points a node on average, a packet costs more than its points one by one.
constexpr std::size_t kCompany = 3;

// Sixteen points that lie together: SIMD over points, after culling by their common box.
class PacketSearch : public Search
{
public:
  using Search::Search;

  /// \param take indices of the points, `count` <= kPacket of them.
  /// \param warm a triangle that was nearest to a point nearby, or -1; updated.
  void run(const std::uint32_t* take, std::size_t count, std::int32_t& warm)
  {
    this->load(take, count);
    if (warm >= 0)
    {
      this->measure(warm);
    }
    Stack stack;
    this->start(stack);
    while (!stack.empty())
    {
      const Entry entry = stack.pop();
      const std::size_t near = entry.squared > limit_ ? 0 : this->pointsNear(entry.slot);
      if (near == 0)
      {
        continue;
      }
      ++visits_;
      visitors_ += near;
      if (entry.ref & MeshBvh::kLeafBit)
      {
        this->visit(leaves_[entry.ref & ~MeshBvh::kLeafBit]);
      }
      else
      {
        this->expand(entry.ref, lower_, upper_, limit_, stack);
      }
    }
    warm = triangle_[kPacket / 2] >= 0 ? this->triangle(kPacket / 2) : warm;
  }

  /// Whether these points had so little in common that each had better gone by itself.
  bool wereApart() const { return visitors_ < kCompany * visits_; }

  double squared(std::size_t k) const
  {
    return triangle_[k] < 0 ? std::numeric_limits<double>::infinity() : best_[k];
  }
  std::int32_t triangle(std::size_t k) const { return std::int32_t(triangle_[k]); }

private:
  // Short packets repeat their last point.
  void load(const std::uint32_t* take, std::size_t count)
  {
    const Vec3& center = query_.bvh->center();
    const double scale = query_.bvh->scale();
    const double* axes[3] = { query_.points.x, query_.points.y, query_.points.z };
    double reach = 0.0;
    double squaredRadius = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      float low = std::numeric_limits<float>::max();
      float high = -low;
      for (std::size_t k = 0; k < kPacket; ++k)
      {
        const double value = axes[axis][take[std::min(k, count - 1)]];
        point_[axis][k] = value;
        const double exact = (value - center[axis]) * scale;
        const float local = kept(exact);
        reach = std::max(reach, std::abs(exact));
        local_[axis][k] = local;
        low = std::min(low, local);
        high = std::max(high, local);
      }
      lower_[axis] = low;
      upper_[axis] = high;
      middle_[axis] = 0.5f * (low + high);
      squaredRadius += 0.25 * (double(high) - low) * (double(high) - low);
    }
    margin_ = kRounding * (1.0 + reach);
    radius_ = float((std::sqrt(squaredRadius) + margin_) * (1.0 + 1e-6));
    const double limit = this->squaredLimit();
    limit_ = this->threshold(limit, margin_);
    std::fill_n(best_, kPacket, limit);
    std::fill_n(triangle_, kPacket, std::int64_t(-1));
    std::fill_n(threshold_, kPacket, limit_);
    visits_ = 0;
    visitors_ = 0;
  }

  HWY_INLINE void visit(const MeshBvh::Leaf& leaf)
  {
    // No point of the packet is farther than radius_ from its middle.
    const Eight d;
    const double reach = std::sqrt(double(limit_)) + radius_;
    const float squaredReach = float(std::min(reach * reach * (1.0 + 1e-6), kUnlimited));
    alignas(32) float squared[kWidth];
    for (std::size_t k = 0; k < kWidth; k += hn::Lanes(d))
    {
      hn::Store(squaredToFrame(d, framesFrom(leaf.frame, k), hn::Set(d, middle_[0]),
                  hn::Set(d, middle_[1]), hn::Set(d, middle_[2])),
        d, squared + k);
    }
    for (std::size_t k = 0; k < leaf.count; ++k)
    {
      if (squared[k] <= squaredReach && this->anyNear(leaf.frame, k))
      {
        this->measure(leaf.triangle[k]);
      }
    }
  }

  // How many points may be nearer to a box than to the best so far. The box that they all have in
  // common is much nearer to it than any of them may be.
  HWY_INLINE std::size_t pointsNear(std::uint32_t slot) const
  {
    if (slot == MeshBvh::kNone)
    {
      return kPacket;
    }
    std::size_t near = 0;
    const Floats d;
    const MeshBvh::Node& node = nodes_[slot / kWidth];
    const std::size_t k = slot % kWidth;
    for (std::size_t lane = 0; lane < kPacket; lane += hn::Lanes(d))
    {
      auto sum = hn::Zero(d);
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto p = hn::Load(d, local_[axis] + lane);
        const auto below = hn::Sub(hn::Set(d, node.lower[axis][k]), p);
        const auto above = hn::Sub(p, hn::Set(d, node.upper[axis][k]));
        const auto gap = hn::Max(hn::Max(below, above), hn::Zero(d));
        sum = hn::MulAdd(gap, gap, sum);
      }
      near += hn::CountTrue(d, hn::Le(sum, hn::Load(d, threshold_ + lane)));
    }
    return near;
  }

  HWY_INLINE bool anyNear(const MeshBvh::Frame& frame, std::size_t k) const
  {
    const Floats d;
    const auto vectors = frameOfOne(frame, k);
    for (std::size_t lane = 0; lane < kPacket; lane += hn::Lanes(d))
    {
      const auto squared = squaredToFrame(d, vectors, hn::Load(d, local_[0] + lane),
        hn::Load(d, local_[1] + lane), hn::Load(d, local_[2] + lane));
      if (!hn::AllFalse(d, hn::Le(squared, hn::Load(d, threshold_ + lane))))
      {
        return true;
      }
    }
    return false;
  }

  // The distances that count.
  HWY_INLINE void measure(std::int32_t triangle)
  {
    const Doubles d;
    const hn::RebindToSigned<Doubles> wide;
    hn::Vec<Doubles> corner[3][3];
    for (int which = 0; which < 3; ++which)
    {
      const double* from = this->corner(triangle, which);
      for (int axis = 0; axis < 3; ++axis)
      {
        corner[which][axis] = hn::Set(d, from[axis]);
      }
    }
    const ExactTriangle exact(corner);
    bool better = false;
    for (std::size_t lane = 0; lane < kPacket; lane += hn::Lanes(d))
    {
      const auto squared = exact.squaredDistance(hn::Load(d, point_[0] + lane),
        hn::Load(d, point_[1] + lane), hn::Load(d, point_[2] + lane));
      const auto best = hn::Load(d, best_ + lane);
      const auto nearer = hn::Lt(squared, best);
      if (hn::AllFalse(d, nearer))
      {
        continue;
      }
      better = true;
      hn::Store(hn::IfThenElse(nearer, squared, best), d, best_ + lane);
      const auto held = hn::Load(wide, triangle_ + lane);
      hn::Store(
        hn::IfThenElse(hn::RebindMask(wide, nearer), hn::Set(wide, std::int64_t(triangle)), held),
        wide, triangle_ + lane);
    }
    if (better)
    {
      this->tighten();
    }
  }

  HWY_INLINE void tighten()
  {
    const Doubles d;
    const hn::Rebind<float, Doubles> narrow;
    const auto scale = hn::Set(d, squaredScale_);
    const auto margin = hn::Set(d, margin_);
    auto largest = hn::Zero(d);
    for (std::size_t lane = 0; lane < kPacket; lane += hn::Lanes(d))
    {
      const auto length = hn::Add(hn::Sqrt(hn::Mul(hn::Load(d, best_ + lane), scale)), margin);
      const auto squared =
        hn::Min(hn::Mul(hn::Mul(length, length), hn::Set(d, 1.0 + 1e-6)), hn::Set(d, kUnlimited));
      largest = hn::Max(largest, squared);
      hn::Store(hn::DemoteTo(narrow, squared), narrow, threshold_ + lane);
    }
    limit_ = float(hn::GetLane(hn::MaxOfLanes(d, largest)));
  }

  alignas(64) double point_[3][kPacket];
  alignas(64) double best_[kPacket];
  alignas(64) float local_[3][kPacket];
  alignas(64) float threshold_[kPacket];
  alignas(64) std::int64_t triangle_[kPacket]; // as wide as the lanes of best_
  float lower_[3];
  float upper_[3];
  float middle_[3];
  float radius_;
  float limit_;
  double margin_;
  std::size_t visits_;   // of nodes and leaves
  std::size_t visitors_; // points that each was near enough to, added up
};

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();
#endif
