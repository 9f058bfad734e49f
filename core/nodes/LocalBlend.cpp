// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/LocalBlend.h"

#include "core/base/Scratch.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/BooleanSource.h"
#include "core/nodes/DerivedNodes.h"
#include "core/nodes/FlatSolids.h"
#include "core/nodes/Membership.h"
#include "core/nodes/Operator.h"

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
    askFields({ { a_.get(), value }, { b_.get(), b.data() }, { region_.get(), c.data() } }, points);
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
    askFieldsAndGradients({ { a_.get(), value, gradient }, { b_.get(), b.data(), gradientB },
                            { region_.get(), c.data(), gradientC } },
      points);
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

  Interval range(const Box3& box) const override
  {
    if (!box_.isEmpty() && box.min() == box_.min() && box.max() == box_.max())
    {
      return range_;
    }
    const Interval a = rangeOf(a_.get(), box);
    const Interval b = b_ == a_ ? a : rangeOf(b_.get(), box);
    return mixed(a, b, region_ == a_ ? a : region_ == b_ ? b : rangeOf(region_.get(), box));
  }

  FieldSourcePtr restrictedTo(const Box3& box) const override
  {
    const FieldSourcePtr a = restrictionOf(a_.get(), box);
    const FieldSourcePtr b = b_ == a_ ? a : restrictionOf(b_.get(), box);
    if (!a && !b)
    {
      return nullptr;
    }
    const FieldSourcePtr region = region_ == a_ ? a
      : region_ == b_                           ? b
                                                : restrictionOf(region_.get(), box);
    const Interval rangeC = rangeOf(region.get(), box);
    if (rangeC.max <= 0.0)
    {
      return booleanSource(kUnion, kSmooth, a, b, box);
    }
    const Interval rangeA = rangeOf(a.get(), box);
    const Interval rangeB = b == a ? rangeA : rangeOf(b.get(), box);
    // Sum and union of one field and nothing are that field, unless it is negative.
    if ((!a && rangeB.min >= 0.0) || (!b && rangeA.min >= 0.0))
    {
      return a ? a : b;
    }
    auto restricted = std::make_shared<LocalBlendSource>(a, b, region);
    restricted->box_ = box;
    restricted->range_ = mixed(rangeA, rangeB, rangeC);
    return restricted;
  }

private:
  static double mixed(double sum, double united, double weight)
  {
    return weight * sum + (1.0 - weight) * united;
  }

  // Linear in c, and rising with sum and union.
  static Interval mixed(Interval a, Interval b, Interval c)
  {
    const Interval sum = a + b;
    const Interval united = booleanRange(kUnion, kSmooth, a, b);
    const double low = std::clamp(c.min, 0.0, 1.0);
    const double high = std::clamp(c.max, 0.0, 1.0);
    return { std::min(mixed(sum.min, united.min, low), mixed(sum.min, united.min, high)),
      std::max(mixed(sum.max, united.max, low), mixed(sum.max, united.max, high)) };
  }

  FieldSourcePtr a_;
  FieldSourcePtr b_;
  FieldSourcePtr region_;
  Box3 box_;       ///< where the range is known, as in BooleanSource
  Interval range_; ///< over that box
};

/// The same object for the same two, so that a region that moves leaves its mesh alone.
NodePtr unionOf(const NodePtr& a, const NodePtr& b)
{
  static auto* const unions = new DerivedNodes; // outlives all statics
  return unions->of({ { a, 0.0, 0 }, { b, 0.0, 1 } }, Affine3::Identity(),
    [&] { return makeBoolean(kUnion, a, b, kSmooth); });
}

class LocalBlend final : public Operator
{
public:
  LocalBlend(NodePtr a, NodePtr b, NodePtr region, const BlendOptions& options)
    : Operator({ std::move(a), std::move(b), std::move(region) })
    , a_(this->child(0).get())
    , b_(this->child(1).get())
    , region_(this->child(2).get())
    , options_(options)
    , source_(this->child(0), this->child(1), this->child(2))
    , union_(unionOf(this->child(0), this->child(1)))
  {
    negative_ = a_->isNegative() && b_->isNegative();
    influence_ = this->findInfluenceBounds();
    surface_ = this->findSurfaceBounds();
  }

  void field(PointBatch points, double* value) const override { source_.field(points, value); }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    source_.fieldAndGradient(points, value, gradient);
  }
  Interval range(const Box3& box) const override
  {
    return box.intersects(influence_) ? source_.range(box) : Interval{ 0.0, 0.0 };
  }
  FieldSourcePtr restrictedTo(const Box3& box) const override
  {
    return box.intersects(influence_) ? source_.restrictedTo(box) : nullptr;
  }

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
      if (a_ == b_)
      {
        break; // the union is A
      }
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
    askFields({ { a_, a.data() }, { b_, b.data() }, { region_, c.data() } }, points);
    std::fill_n(leaf, count, -1);
    const auto blended = [&](std::size_t k) { return c[k] > 0.0 && a[k] != 0.0 && b[k] != 0.0; };
    sourceLeafWhere(
      *a_, points, [&](std::size_t k) { return !blended(k) && a[k] > b[k]; }, 0, leaf);
    sourceLeafWhere(
      *b_, points, [&](std::size_t k) { return !blended(k) && b[k] > a[k]; }, a_->leafCount(),
      leaf);
  }

  Box3 influenceBounds() const override { return influence_; }
  Box3 surfaceBounds() const override { return surface_; }
  bool isNegative() const override { return negative_; }

  const char* kind() const override { return "localBlend"; }
  double sampleCost(double below, double) const override { return below; }
  Parameters parameters() const override
  {
    Parameters parameters;
    describeBlendOptions(options_, parameters);
    return parameters;
  }

  std::vector<std::string> warnings() const override { return meshWarnings_.all(); }

  std::optional<PointwiseLaw> pointwiseLaw() const override { return PointwiseLaw{ 1, false }; }
  void visitOperands(const Box3&, const std::function<void(const Operand&)>& visit) const override
  {
    visit({ a_ });
    visit({ b_, a_->leafCount() });
    visit({ region_, 0, 1, false });
  }

protected:
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override
  {
    BlendMeshReport report;
    TriangleMesh mesh =
      localBlendMesh(*this, this->meshParts(), options_, edgeLength, report, progress);
    meshWarnings_.add(report.warning);
    for (const std::string& warning : warningsOfFlatCuts(this->children()))
    {
      meshWarnings_.add(warning);
    }
    return mesh;
  }

  MeshPtr findOtherMesh(
    double edgeLength, const Deformation& by, const Progress& progress) const override
  {
    const BlendMesher mesher(*this, this->meshParts(), options_, edgeLength);
    return blendMeshToDeform(
      mesher, by, meshWarnings_,
      [&](const auto& make) { return this->keptOtherMesh(edgeLength, nullptr, make); }, progress);
  }

  NodePtr withChildren(std::vector<NodePtr> children) const override
  {
    return makeLocalBlend(children[0], children[1], children[2], options_);
  }

  // The children are so already.
  NodePtr makeUnderBlend() const override { return this->shared_from_this(); }

private:
  LocalBlendParts meshParts() const { return { a_, b_, region_, union_.get() }; }

  Box3 findInfluenceBounds() const
  {
    Box3 box;
    for (const Node* operand : { a_, b_ })
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
    for (const Node* operand : { a_, b_ })
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

  const Node* a_;
  const Node* b_;
  const Node* region_;
  BlendOptions options_;
  LocalBlendSource source_;
  NodePtr union_; ///< what this is outside of the region
  MeshWarnings meshWarnings_;
  Box3 influence_;
  Box3 surface_;
  bool negative_ = false;
};

} // namespace

NodePtr makeLocalBlend(NodePtr a, NodePtr b, NodePtr region, const BlendOptions& options)
{
  checkBlendOptions(options);
  const std::vector<NodePtr> children = childrenUnderBlend({ a, b, region });
  return std::make_shared<LocalBlend>(children[0], children[1], children[2], options);
}

NodePtr localBlendFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  requireChildren("localBlend", children, 3);
  return makeLocalBlend(children[0], children[1], children[2], blendOptionsFrom(parameters));
}

} // namespace hybridtree
