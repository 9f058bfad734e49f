// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/LimbKernels.h"

#include <algorithm>
#include <cmath>

// Compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/convolution/LimbKernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, as Highway wants it.
#include "core/geometry/SkeletonKernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridtree
{
namespace HWY_NAMESPACE
{

// One vector of points. What pieces see is normalised by the sum of all fields, so that its power
// stays a number.
class LimbVector
{
public:
  HWY_INLINE LimbVector(const LimbBlock& block, std::size_t at) : block_(block), at_(at) {}

  HWY_INLINE void find(double* value, const VectorBatch* gradient)
  {
    const D d;
    this->findReached();
    const V zero = hn::Zero(d);
    inverse_ = hn::IfThenElseZero(hn::Gt(sum_, zero), hn::Div(set(1.0), sum_));
    this->findSights();
    this->findWeights();
    const V inverse = hn::IfThenElseZero(hn::Gt(total_, zero), hn::Div(set(1.0), total_));
    mean_ = hn::Mul(mean_, inverse);
    hn::StoreU(block_.areLosses ? hn::Sub(sum_, mean_) : mean_, d, value + at_);
    if (gradient)
    {
      this->findCoefficients();
      this->addGradients(inverse, *gradient);
    }
  }

private:
  enum Row
  {
    kField,  // close to each other
    kSight,  // H_c
    kPower,  // its 20th power, normalised
    kShared, // of the shares: the sum with the fields
    kCoefficient
  };

  HWY_INLINE const double* integrals(std::size_t piece) const
  {
    return block_.fields + piece * block_.stride + at_;
  }
  HWY_INLINE double* row(std::size_t piece, Row row) const
  {
    return block_.work + row * block_.rowSize + piece * kRowStep + at_;
  }
  HWY_INLINE V load(std::size_t piece, Row of) const
  {
    return hn::LoadU(D(), this->row(piece, of));
  }
  HWY_INLINE std::uint32_t* strong() const { return block_.reached + block_.count; }

  // The pieces with fields, and their sum.
  HWY_INLINE void findReached()
  {
    const D d;
    sum_ = hn::Zero(d);
    for (std::size_t k = 0; k < block_.count; ++k)
    {
      const std::uint32_t piece = block_.pieces[k];
      const V own = hn::LoadU(d, this->integrals(piece));
      hn::StoreU(own, d, this->row(piece, kField));
      hn::StoreU(hn::Zero(d), d, this->row(piece, kCoefficient));
      if (!hn::AllTrue(d, hn::Eq(own, hn::Zero(d))))
      {
        sum_ = hn::Add(sum_, own);
        block_.reached[reachedCount_++] = piece;
      }
    }
  }

  // Of the rows of kTogether pieces, which do not wait for each other. Each in its own order.
  static constexpr std::size_t kTogether = 4;

  HWY_INLINE void findProducts(
    const PieceRows& rows, const std::uint32_t* pieces, std::size_t count, Row to) const
  {
    const D d;
    std::size_t k = 0;
    for (; k + kTogether <= count; k += kTogether)
    {
      const PieceWeight* next[kTogether];
      std::size_t left[kTogether];
      V sum[kTogether];
      for (std::size_t n = 0; n < kTogether; ++n)
      {
        next[n] = rows.weights + rows.begin[pieces[k + n]];
        left[n] = rows.begin[pieces[k + n] + 1] - rows.begin[pieces[k + n]];
        sum[n] = hn::Zero(d);
      }
      const std::size_t common = std::min(std::min(left[0], left[1]), std::min(left[2], left[3]));
      for (std::size_t of = 0; of < common; ++of)
      {
        for (std::size_t n = 0; n < kTogether; ++n)
        {
          sum[n] = this->added(next[n][of], sum[n]);
        }
      }
      for (std::size_t n = 0; n < kTogether; ++n)
      {
        for (std::size_t of = common; of < left[n]; ++of)
        {
          sum[n] = this->added(next[n][of], sum[n]);
        }
        hn::StoreU(sum[n], d, this->row(pieces[k + n], to));
      }
    }
    for (; k < count; ++k)
    {
      V sum = hn::Zero(d);
      for (std::uint32_t of = rows.begin[pieces[k]]; of < rows.begin[pieces[k] + 1]; ++of)
      {
        sum = this->added(rows.weights[of], sum);
      }
      hn::StoreU(sum, d, this->row(pieces[k], to));
    }
  }
  HWY_INLINE V added(const PieceWeight& of, V sum) const
  {
    return hn::MulAdd(set(of.weight), this->load(of.piece, kField), sum);
  }

  // H_c.
  HWY_INLINE void findSights()
  {
    const D d;
    for (std::size_t k = 0; k < block_.centerCount; ++k)
    {
      const std::uint32_t piece = block_.centers[k];
      this->strong()[strongCount_] = piece;
      const V own = this->load(piece, kField);
      strongCount_ += hn::AllTrue(d, hn::Eq(own, hn::Zero(d))) ? 0 : 1;
    }
    this->findProducts(block_.sights, this->strong(), strongCount_, kSight);
    mostSight_ = hn::Zero(d);
    for (std::size_t k = 0; k < strongCount_; ++k)
    {
      mostSight_ = hn::Max(mostSight_, this->load(this->strong()[k], kSight));
    }
  }

  // w_c, and the sum of w_c times what they share.
  HWY_INLINE void findWeights()
  {
    const D d;
    const V least = hn::Mul(set(kLeastSight), mostSight_);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < strongCount_; ++k)
    {
      const std::uint32_t piece = this->strong()[k];
      this->strong()[kept] = piece;
      kept += hn::AllFalse(d, hn::Gt(this->load(piece, kSight), least)) ? 0 : 1;
    }
    strongCount_ = kept;
    this->findProducts(block_.shares, this->strong(), strongCount_, kShared);
    total_ = hn::Zero(d);
    mean_ = hn::Zero(d);
    for (std::size_t k = 0; k < strongCount_; ++k)
    {
      const std::uint32_t piece = this->strong()[k];
      const V sight = this->load(piece, kSight);
      const V relative = hn::Mul(inverse_, sight);
      const V second = hn::Mul(relative, relative);
      const V fourth = hn::Mul(second, second);
      const V fifth = hn::Mul(fourth, relative);
      const V tenth = hn::Mul(fifth, fifth);
      const V power = hn::IfThenElseZero(hn::Gt(sight, least), hn::Mul(tenth, tenth));
      const V weight = hn::Mul(power, this->load(piece, kField));
      hn::StoreU(power, d, this->row(piece, kPower));
      total_ = hn::Add(total_, weight);
      mean_ = hn::MulAdd(weight, this->load(piece, kShared), mean_);
    }
  }

  HWY_INLINE void addProducts(const PieceRows& rows, std::size_t piece, V factor) const
  {
    const D d;
    const PieceWeight* end = rows.weights + rows.begin[piece + 1];
    for (const PieceWeight* of = rows.weights + rows.begin[piece]; of != end; ++of)
    {
      double* to = this->row(of->piece, kCoefficient);
      hn::StoreU(hn::MulAdd(set(of->weight), factor, hn::LoadU(d, to)), d, to);
    }
  }

  // Of the mean, by the fields of pieces; times the sum of all weights.
  HWY_INLINE void findCoefficients()
  {
    const D d;
    for (std::size_t k = 0; k < strongCount_; ++k)
    {
      const std::uint32_t piece = this->strong()[k];
      const V power = this->load(piece, kPower);
      const V weight = hn::Mul(power, this->load(piece, kField));
      const V excess = hn::Sub(this->load(piece, kShared), mean_);
      double* own = this->row(piece, kCoefficient);
      hn::StoreU(hn::MulAdd(power, excess, hn::LoadU(d, own)), d, own);
      this->addProducts(block_.shares, piece, weight);
      const V sight = this->load(piece, kSight);
      const V change = hn::Mul(hn::Mul(set(20.0), weight), excess);
      const auto counts = hn::Gt(sight, hn::Zero(d));
      if (!hn::AllTrue(d, hn::Eq(change, hn::Zero(d))))
      {
        this->addProducts(block_.sights, piece, hn::IfThenElseZero(counts, hn::Div(change, sight)));
      }
    }
  }

  HWY_INLINE void addGradients(V inverse, const VectorBatch& gradient) const
  {
    const D d;
    V slope[3] = { hn::Zero(d), hn::Zero(d), hn::Zero(d) };
    for (std::size_t k = 0; k < reachedCount_; ++k)
    {
      const std::uint32_t piece = block_.reached[k];
      const V of = hn::Mul(inverse, this->load(piece, kCoefficient));
      const V coefficient = block_.areLosses ? hn::Sub(set(1.0), of) : of;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        slope[axis] = hn::MulAdd(
          coefficient, hn::LoadU(d, this->integrals(piece) + (1 + axis) * kRowStep), slope[axis]);
      }
    }
    hn::StoreU(slope[0], d, gradient.x + at_);
    hn::StoreU(slope[1], d, gradient.y + at_);
    hn::StoreU(slope[2], d, gradient.z + at_);
  }

  const LimbBlock& block_;
  std::size_t at_;
  std::size_t reachedCount_ = 0;
  std::size_t strongCount_ = 0;
  V sum_, inverse_, mostSight_, total_, mean_;
};

void findMeans(const LimbBlock& block, double* value, const VectorBatch* gradient)
{
  for (std::size_t at = 0; at < kRowStep; at += hn::Lanes(D()))
  {
    LimbVector(block, at).find(value, gradient);
  }
}

std::uint64_t findInside(const ElementBall& ball, PointBatch points)
{
  const D d;
  std::uint64_t inside = 0;
  for (std::size_t at = 0; at < points.size; at += hn::Lanes(d))
  {
    const V x = hn::Sub(hn::LoadU(d, points.x + at), set(ball.center.x()));
    const V y = hn::Sub(hn::LoadU(d, points.y + at), set(ball.center.y()));
    const V z = hn::Sub(hn::LoadU(d, points.z + at), set(ball.center.z()));
    const V squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Lt(squared, set(ball.squaredRadius)), bits);
    inside |= std::uint64_t(bits[0]) << at;
  }
  return inside;
}

HWY_INLINE V cauchy(V t)
{
  const V u = hn::MulAdd(hn::Mul(set(4.0), t), t, set(1.0));
  return hn::Div(set(1.0), hn::Mul(u, u));
}

HWY_INLINE V outside(const double* center, double middle, double half)
{
  const V way = hn::Abs(hn::Sub(hn::LoadU(D(), center), set(middle)));
  return hn::Max(hn::Zero(D()), hn::Sub(way, set(half)));
}

// Kernel times measure, per measure, from t on is at most 1 / u^2 + slope t / u^2, u = 1 + 4 t^2.
void findMost(const FarBounds& bounds, const Box3& box, double* most)
{
  const D d;
  const Vec3 middle = box.center();
  const Vec3 half = 0.5 * box.sizes();
  const double steepest = std::sqrt(1.0 / 12.0); // where t / u^2 is largest
  for (std::size_t k = 0; k < bounds.size; k += hn::Lanes(d))
  {
    const V x = outside(bounds.x + k, middle.x(), half.x());
    const V y = outside(bounds.y + k, middle.y(), half.y());
    const V z = outside(bounds.z + k, middle.z(), half.z());
    const V way = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
    const V t = hn::Mul(hn::Max(hn::Zero(d), hn::Sub(way, hn::LoadU(d, bounds.radius + k))),
      hn::LoadU(d, bounds.inverseReach + k));
    const V far = hn::Max(t, set(steepest));
    const V value =
      hn::MulAdd(hn::LoadU(d, bounds.slope + k), hn::Mul(far, cauchy(far)), cauchy(t));
    hn::StoreU(hn::Mul(hn::LoadU(d, bounds.measure + k), value), d, most + k);
  }
}

const LimbKernels* kernels()
{
  static const LimbKernels kernels = { &findMeans, &findInside, &findMost };
  return &kernels;
}

} // namespace HWY_NAMESPACE
} // namespace hybridtree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridtree
{

HWY_EXPORT(kernels);

const LimbKernels& limbKernels()
{
  static const LimbKernels* const best = HWY_DYNAMIC_DISPATCH(kernels)();
  return *best;
}

} // namespace hybridtree
#endif
