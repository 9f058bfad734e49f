// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/LocalBlend.h"

#include "core/base/Scratch.h"
#include "core/nodes/BooleanSource.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/Membership.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr BooleanOperation kUnion = BooleanOperation::Union;
constexpr BooleanForm kSmooth = BooleanForm::Smooth;

// f = c (fA + fB) + (1 - c) union(fA, fB) over three sources, each of which may be null: 0.
class LocalBlendSource final : public FieldSource
{
public:
  LocalBlendSource(FieldSourcePtr a, FieldSourcePtr b, FieldSourcePtr region)
    : a_(std::move(a)), b_(std::move(b)), region_(std::move(region))
  {
  }

  void field(PointBatch points, double* value) const override
  {
    const std::size_t count = points.size;
    ScratchArray b(count), c(count), united(count);
    fieldOf(a_.get(), points, value);
    fieldOf(b_.get(), points, b.data());
    fieldOf(region_.get(), points, c.data());
    booleanField(kUnion, kSmooth, value, b.data(), united.data(), count);
    for (std::size_t k = 0; k < count; ++k)
    {
      value[k] = mixed(value[k] + b[k], united[k], std::clamp(c[k], 0.0, 1.0));
    }
  }

  // grad f = c (grad fA + grad fB) + (1 - c) grad union + (fA + fB - union) grad c, and grad c is 0
  // where fC is clamped.
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    const std::size_t count = points.size;
    ScratchArray b(count), c(count);
    ScratchVectors vectorsB(count), vectorsC(count);
    const VectorBatch gradientB = vectorsB.batch();
    const VectorBatch gradientC = vectorsC.batch();
    fieldAndGradientOf(a_.get(), points, value, gradient);
    fieldAndGradientOf(b_.get(), points, b.data(), gradientB);
    fieldAndGradientOf(region_.get(), points, c.data(), gradientC);
    for (std::size_t k = 0; k < count; ++k)
    {
      const BooleanValue united = booleanValue(kUnion, kSmooth, value[k], b[k]);
      const double sum = value[k] + b[k];
      const double weight = std::clamp(c[k], 0.0, 1.0);
      const double byA = weight + (1.0 - weight) * united.byA;
      const double byB = weight + (1.0 - weight) * united.byB;
      const double byC = weight == c[k] ? sum - united.value : 0.0;
      value[k] = mixed(sum, united.value, weight);
      gradient.set(k, byA * gradient[k] + byB * gradientB[k] + byC * gradientC[k]);
    }
  }

  // Linear in c, and rising with sum and union.
  Interval range(const Box3& box) const override
  {
    const Interval a = rangeOf(a_.get(), box);
    const Interval b = rangeOf(b_.get(), box);
    const Interval c = rangeOf(region_.get(), box);
    const Interval sum = a + b;
    const Interval united = booleanRange(kUnion, kSmooth, a, b);
    const double low = std::clamp(c.min, 0.0, 1.0);
    const double high = std::clamp(c.max, 0.0, 1.0);
    return { std::min(mixed(sum.min, united.min, low), mixed(sum.min, united.min, high)),
      std::max(mixed(sum.max, united.max, low), mixed(sum.max, united.max, high)) };
  }

  FieldSourcePtr restrictedTo(const Box3& box) const override
  {
    return LocalBlendSource::make(restrictionOf(a_.get(), box), restrictionOf(b_.get(), box),
      restrictionOf(region_.get(), box), box);
  }

  static FieldSourcePtr make(
    FieldSourcePtr a, FieldSourcePtr b, FieldSourcePtr region, const Box3& box)
  {
    if (!a && !b)
    {
      return nullptr;
    }
    if (rangeOf(region.get(), box).max <= 0.0)
    {
      return booleanSource(kUnion, kSmooth, std::move(a), std::move(b), box);
    }
    // Sum and union of one field and nothing are that field, unless it is negative.
    if (!a || !b)
    {
      FieldSourcePtr& alone = a ? a : b;
      if (rangeOf(alone.get(), box).min >= 0.0)
      {
        return std::move(alone);
      }
    }
    return std::make_shared<LocalBlendSource>(std::move(a), std::move(b), std::move(region));
  }

private:
  static double mixed(double sum, double united, double weight)
  {
    return weight * sum + (1.0 - weight) * united;
  }

  FieldSourcePtr a_;
  FieldSourcePtr b_;
  FieldSourcePtr region_;
};

class LocalBlend final : public Node
{
public:
  LocalBlend(NodePtr a, NodePtr b, NodePtr region, const BlendOptions& options)
    : a_(std::move(a))
    , b_(std::move(b))
    , region_(std::move(region))
    , options_(options)
    , source_(a_, b_, region_)
  {
    const std::int64_t leaves =
      std::int64_t(a_->leafCount()) + b_->leafCount() + region_->leafCount();
    leafCount_ = static_cast<int>(std::min<std::int64_t>(leaves, std::numeric_limits<int>::max()));
    influence_ = this->findInfluenceBounds();
    surface_ = this->findSurfaceBounds();
  }

  void field(PointBatch points, double* value) const override { source_.field(points, value); }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    source_.fieldAndGradient(points, value, gradient);
  }
  Interval range(const Box3& box) const override { return source_.range(box); }
  FieldSourcePtr restrictedTo(const Box3& box) const override { return source_.restrictedTo(box); }

  // [HT] 4.3: outside the region the union decides by its operands alone, inside it the field.
  void membership(PointBatch points, std::int8_t* side) const override
  {
    const Box3 inRegion = region_->influenceBounds();
    const Box3 reachA = a_->influenceBounds();
    const Box3 reachB = b_->influenceBounds();
    const auto blended = [&](std::size_t k)
    {
      const Vec3 point = points[k];
      return inRegion.contains(point) && reachA.contains(point) && reachB.contains(point);
    };
    a_->membership(points, side);
    std::array<std::int8_t, 256> sideB;
    for (std::size_t begin = 0; begin < points.size; begin += sideB.size())
    {
      const std::size_t count = std::min(sideB.size(), points.size - begin);
      b_->membership(points.slice(begin, count), sideB.data());
      for (std::size_t k = 0; k < count; ++k)
      {
        side[begin + k] = std::max(side[begin + k], sideB[k]);
      }
    }
    forPointsWhere(points, blended,
      [&](PointBatch chosen, const std::size_t* index)
      {
        ScratchArray value(chosen.size);
        this->field(chosen, value.data());
        for (std::size_t k = 0; k < chosen.size; ++k)
        {
          side[index[k]] = sideOf(value[k]);
        }
      });
  }

  // Both operands make the field where both reach into the region; elsewhere it is the one on whose
  // surface the union's surface is.
  void sourceLeaf(PointBatch points, std::int32_t* leaf) const override
  {
    const std::size_t count = points.size;
    ScratchArray a(count), b(count), c(count);
    a_->field(points, a.data());
    b_->field(points, b.data());
    region_->field(points, c.data());
    std::fill_n(leaf, count, -1);
    const auto blended = [&](std::size_t k) { return c[k] > 0.0 && a[k] != 0.0 && b[k] != 0.0; };
    sourceLeafWhere(
      *a_, points, [&](std::size_t k) { return !blended(k) && a[k] > b[k]; }, 0, leaf);
    sourceLeafWhere(
      *b_, points, [&](std::size_t k) { return !blended(k) && b[k] > a[k]; }, a_->leafCount(),
      leaf);
  }

  int leafCount() const override { return leafCount_; }
  Box3 influenceBounds() const override { return influence_; }
  Box3 surfaceBounds() const override { return surface_; }
  bool isNegative() const override { return a_->isNegative() && b_->isNegative(); }

  // The children are so already.
  NodePtr underBlend() const override { return this->shared_from_this(); }

  const char* kind() const override { return "localBlend"; }
  Parameters parameters() const override
  {
    Parameters parameters;
    describeBlendOptions(options_, parameters);
    return parameters;
  }
  std::vector<NodePtr> children() const override { return { a_, b_, region_ }; }

protected:
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override
  {
    return latticeMesh(*this, edgeLength, progress);
  }

  NodePtr makeAffine(const Affine3& map) const override
  {
    return makeLocalBlend(a_->affine(map), b_->affine(map), region_->affine(map), options_);
  }

  NodePtr withChildren(std::vector<NodePtr> children) const override
  {
    return makeLocalBlend(children[0], children[1], children[2], options_);
  }

private:
  Box3 findInfluenceBounds() const
  {
    Box3 box;
    for (const NodePtr& operand : { a_, b_ })
    {
      // What only carves counts as 0 in the union: it is felt in the region alone.
      const Box3 reach = operand->influenceBounds();
      const Box3 felt =
        operand->isNegative() ? reach.intersection(region_->influenceBounds()) : reach;
      box = felt.isEmpty() ? box : box.merged(felt);
    }
    return box;
  }

  // The union's surface, and in the region what lies where both reach.
  Box3 findSurfaceBounds() const
  {
    Box3 box;
    for (const NodePtr& operand : { a_, b_ })
    {
      if (!operand->isNegative())
      {
        box.extend(operand->surfaceBounds());
      }
    }
    if (!a_->isNegative() && !b_->isNegative())
    {
      const Box3 both = a_->influenceBounds()
                          .intersection(b_->influenceBounds())
                          .intersection(region_->influenceBounds());
      box = both.isEmpty() ? box : box.merged(both);
    }
    return box;
  }

  NodePtr a_;
  NodePtr b_;
  NodePtr region_;
  BlendOptions options_;
  LocalBlendSource source_;
  Box3 influence_;
  Box3 surface_;
  int leafCount_ = 0;
};

} // namespace

NodePtr makeLocalBlend(NodePtr a, NodePtr b, NodePtr region, const BlendOptions& options)
{
  checkBlendOptions(options);
  const std::vector<NodePtr> children =
    childrenUnderBlend({ std::move(a), std::move(b), std::move(region) }, "local blend");
  return std::make_shared<LocalBlend>(children[0], children[1], children[2], options);
}

NodePtr localBlendFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  requireChildren("localBlend", children, 3);
  return makeLocalBlend(children[0], children[1], children[2], blendOptionsFrom(parameters));
}

} // namespace hybridtree
