// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Blend.h"

#include "core/base/Error.h"
#include "core/base/Scratch.h"
#include "core/nodes/BlendHierarchy.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/BlendSource.h"
#include "core/nodes/EnumNames.h"
#include "core/nodes/FlatSolids.h"
#include "core/nodes/Membership.h"
#include "core/nodes/Operator.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

namespace hybridtree
{
namespace
{

// Points that are evaluated together: few enough that their box is small where points come in
// order.
constexpr std::size_t kSlice = 256;
// Whose box is small against a radius of influence, mostly; and where values take long, of meshes.
constexpr std::size_t kNearPoints = 128;
constexpr std::size_t kFewPoints = 32;

// A nested blend's terms are taken over up to this many: a chain of blends of shared children has
// exponentially many.
constexpr std::size_t kMostTerms = 1 << 16;

// More terms than this, and the surface bounds don't look at pairs.
constexpr std::size_t kMostPaired = 4096;

const EnumNames<BlendMethod, 4> kMethods = { "Method", "method",
  { "automatic", "nodeBased", "primitiveBased", "global" } };

Box3 boundsOf(PointBatch points)
{
  Box3 box;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    box.extend(points[k]);
  }
  return box;
}

class Blend final : public SummedField<Operator>
{
  using Term = BlendHierarchy::Term;

public:
  Blend(std::vector<NodePtr> children, const BlendOptions& options)
    : SummedField(std::move(children))
    , options_(options)
    , hierarchy_(Blend::flatTerms(this->children()))
  {
    for (const NodePtr& child : this->children())
    {
      negative_ = negative_ && child->isNegative();
      influence_.extend(child->influenceBounds());
    }
    surface_ = this->findSurfaceBounds();
  }

  void addField(PointBatch points, double* sum) const override
  {
    Blend::forEachSlice(points,
      [&](std::size_t begin, PointBatch slice)
      {
        hierarchy_.visit(boundsOf(slice),
          [&](const Term& term) { addMultiple(*term.node, term.count, slice, sum + begin); });
      });
  }

  void addFieldAndGradient(PointBatch points, double* sum, VectorBatch gradientSum) const override
  {
    Blend::forEachSlice(points,
      [&](std::size_t begin, PointBatch slice)
      {
        hierarchy_.visit(boundsOf(slice),
          [&](const Term& term)
          { addMultiple(*term.node, term.count, slice, sum + begin, gradientSum.slice(begin)); });
      });
  }

  Interval range(const Box3& box) const override
  {
    Interval sum;
    hierarchy_.visit(
      box, [&](const Term& term) { sum = sum + multiple(term.node->range(box), term.count); });
    return sum;
  }

  FieldSourcePtr restrictedTo(const Box3& box) const override
  {
    std::vector<BlendSource::Term> kept;
    hierarchy_.visit(box,
      [&](const Term& term)
      {
        if (FieldSourcePtr restricted = term.node->restrictedTo(box))
        {
          kept.push_back({ std::move(restricted), term.count });
        }
      });
    return BlendSource::of(std::move(kept));
  }

  void membership(PointBatch points, std::int8_t* side) const override
  {
    Blend::forEachSlice(points,
      [&](std::size_t begin, PointBatch slice) { this->sliceMembership(slice, side + begin); });
  }

  void sourceLeaf(PointBatch points, std::int32_t* leaf) const override
  {
    Blend::forEachSlice(points,
      [&](std::size_t begin, PointBatch slice) { this->sliceSourceLeaf(slice, leaf + begin); });
  }

  Box3 influenceBounds() const override { return influence_; }
  Box3 surfaceBounds() const override { return surface_; }
  bool isNegative() const override { return negative_; }

  const char* kind() const override { return "blend"; }
  double sampleCost(double below, double) const override { return below; }
  Parameters parameters() const override
  {
    Parameters parameters;
    describeBlendOptions(options_, parameters);
    return parameters;
  }

  std::vector<std::string> warnings() const override { return meshWarnings_.all(); }

  std::optional<PointwiseLaw> pointwiseLaw() const override { return PointwiseLaw{ 0, true }; }
  void visitOperands(
    const Box3& box, const std::function<void(const Operand&)>& visit) const override
  {
    hierarchy_.visit(box,
      [&](const Term& term) {
        visit({ term.node, term.firstLeaf, term.count });
      });
  }

protected:
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override
  {
    BlendMeshReport report;
    TriangleMesh mesh = blendMesh(*this, this->meshParts(), options_, edgeLength, report, progress);
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
    return makeBlend(std::move(children), options_);
  }

  // The children are so already.
  NodePtr makeUnderBlend() const override { return this->shared_from_this(); }

private:
  // Sums are associative: the terms of a nested blend are terms of this one. Equal ones become one
  // term that counts several times.
  static std::vector<Term> flatTerms(const std::vector<NodePtr>& children)
  {
    std::vector<Term> terms;
    std::unordered_map<const Node*, std::size_t> place;
    const auto add = [&](const Term& term, int leavesBefore)
    {
      const auto [known, isNew] = place.emplace(term.node, terms.size());
      if (isNew)
      {
        terms.push_back({ term.node, leavesBefore + term.firstLeaf, 0 });
      }
      terms[known->second].count += term.count;
    };
    int leavesBefore = 0;
    for (const NodePtr& child : children)
    {
      const auto* nested = dynamic_cast<const Blend*>(child.get());
      if (nested && terms.size() + nested->hierarchy_.terms().size() <= kMostTerms)
      {
        for (const Term& term : nested->hierarchy_.terms())
        {
          add(term, leavesBefore);
        }
      }
      else
      {
        add({ child.get(), 0, 1 }, leavesBefore);
      }
      leavesBefore += child->leafCount();
    }
    return terms;
  }

  // What a mesh is made of, by the method: the children, or what the leaves of nested blends are.
  std::vector<BlendPart> meshParts() const
  {
    std::vector<BlendPart> parts;
    if (options_.method != BlendMethod::NodeBased)
    {
      for (const Term& term : hierarchy_.terms())
      {
        parts.push_back({ term.node, term.firstLeaf, term.count });
      }
      return parts;
    }
    std::unordered_map<const Node*, std::size_t> place;
    int leavesBefore = 0;
    for (const NodePtr& child : this->children())
    {
      const auto [known, isNew] = place.emplace(child.get(), parts.size());
      if (isNew)
      {
        parts.push_back({ child.get(), leavesBefore, 0 });
      }
      parts[known->second].count += 1;
      leavesBefore += child->leafCount();
    }
    return parts;
  }

  template <typename Body>
  static void forEachSlice(PointBatch points, Body&& body)
  {
    for (std::size_t begin = 0; begin < points.size; begin += kSlice)
    {
      body(begin, points.slice(begin, std::min(kSlice, points.size - begin)));
    }
  }

  // Where only one positive term reaches, the surface is that term's; it can lie elsewhere only
  // where two overlap. Negative terms only take away.
  Box3 findSurfaceBounds() const
  {
    Box3 bounds;
    std::vector<Box3> influences;
    for (const Term& term : hierarchy_.terms())
    {
      if (!term.node->isNegative())
      {
        const Box3 influence = term.node->influenceBounds();
        bounds.extend(term.count == 1 ? term.node->surfaceBounds() : influence);
        influences.push_back(influence);
      }
    }
    for (std::size_t i = 0; i < influences.size(); ++i)
    {
      if (influences.size() > kMostPaired)
      {
        bounds.extend(influences[i]);
        continue;
      }
      for (std::size_t j = i + 1; j < influences.size() && !bounds.contains(influences[i]); ++j)
      {
        const Box3 overlap = influences[i].intersection(influences[j]);
        if (!overlap.isEmpty())
        {
          bounds.extend(overlap);
        }
      }
    }
    return bounds;
  }

  // [HT] 4.3 with its inequalities put right, boxes first: outside all positive boxes is outside,
  // in one box alone that child is asked, else the sum decides.
  void sliceMembership(PointBatch points, std::int8_t* side) const
  {
    std::vector<std::pair<Term, Box3>> near;
    hierarchy_.visit(boundsOf(points),
      [&](const Term& term) { near.emplace_back(term, term.node->influenceBounds()); });

    std::array<std::int32_t, kSlice> sole;
    for (std::size_t k = 0; k < points.size; ++k)
    {
      const Vec3 point = points[k];
      sole[k] = kNone;
      bool positive = false;
      for (std::size_t n = 0; n < near.size() && surface_.contains(point); ++n)
      {
        if (near[n].second.contains(point))
        {
          const bool first = sole[k] == kNone && near[n].first.count == 1;
          sole[k] = first ? static_cast<std::int32_t>(n) : kSeveral;
          positive = positive || !near[n].first.node->isNegative();
        }
      }
      sole[k] = positive ? sole[k] : kNone;
      side[k] = -1;
    }
    const auto pick = [&](std::int32_t wanted)
    { return [&sole, wanted](std::size_t k) { return sole[k] == wanted; }; };
    for (std::size_t n = 0; n < near.size(); ++n)
    {
      membershipWhere(*near[n].first.node, points, pick(static_cast<std::int32_t>(n)), side);
    }
    forPointsWhere(points, pick(kSeveral),
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

  static constexpr std::int32_t kNone = -1;
  static constexpr std::int32_t kSeveral = -2;

  /// A term that may reach some points, and the largest its field may be there.
  struct Reaching
  {
    std::int32_t term;
    Interval range;

    double strength() const { return range.max > -range.min ? range.max : -range.min; }
    bool isNowhereZero() const { return range.min > 0.0 || range.max < 0.0; }
  };

  /// Strongest first: these are the likeliest to reach all of the points.
  std::vector<Reaching> reachingTerms(const Box3& box) const
  {
    std::vector<Reaching> reaching;
    reaching.reserve(16);
    hierarchy_.visit(box,
      [&](const Term& term)
      {
        const Interval range = term.node->range(box);
        if (!(range.min == 0.0 && range.max == 0.0))
        {
          const auto index = &term - hierarchy_.terms().data();
          reaching.push_back({ static_cast<std::int32_t>(index), range });
        }
      });
    std::sort(reaching.begin(), reaching.end(),
      [](const Reaching& a, const Reaching& b) { return a.strength() > b.strength(); });
    return reaching;
  }

  /// What is 0 only where the field is. The bounds of a mesh tell that of many points at once.
  static void valuesOrSigns(const Node& node, PointBatch points, double* value)
  {
    if (!node.isFaceted())
    {
      node.field(points, value);
      return;
    }
    for (std::size_t begin = 0; begin < points.size; begin += kFewPoints)
    {
      const PointBatch few = points.slice(begin, std::min(kFewPoints, points.size - begin));
      const Interval range = node.range(boundsOf(few));
      if (range.min > 0.0 || range.max < 0.0 || (range.min == 0.0 && range.max == 0.0))
      {
        std::fill_n(value + begin, few.size, range.max);
        continue;
      }
      node.field(few, value + begin);
    }
  }

  /// sole[k]: the term whose field alone is not 0 at the point.
  /// \pre at most kNearPoints points
  void findSoleTerms(PointBatch points, std::int32_t* sole) const
  {
    // Full lengths throughout, for the compiler; what is behind the points counts as reached.
    std::array<double, kNearPoints> value;
    std::array<std::int32_t, kNearPoints> reached{}; // how often
    std::array<std::int32_t, kNearPoints> last;
    last.fill(kNone);
    for (const Reaching& reaching : this->reachingTerms(boundsOf(points)))
    {
      const Term& term = hierarchy_.terms()[static_cast<std::size_t>(reaching.term)];
      value.fill(1.0);
      if (!reaching.isNowhereZero())
      {
        Blend::valuesOrSigns(*term.node, points, value.data());
      }
      const std::int32_t often = std::min(term.count, 2);
      std::int32_t least = 2;
      for (std::size_t k = 0; k < kNearPoints; ++k)
      {
        reached[k] += value[k] != 0.0 ? often : 0;
        last[k] = value[k] != 0.0 ? reaching.term : last[k];
        least = std::min(least, reached[k]);
      }
      if (least == 2)
      {
        break; // whatever else reaches them
      }
    }
    for (std::size_t k = 0; k < points.size; ++k)
    {
      sole[k] = reached[k] > 1 ? kSeveral : last[k];
    }
  }

  void sliceSourceLeaf(PointBatch points, std::int32_t* leaf) const
  {
    std::array<std::int32_t, kSlice> sole;
    for (std::size_t begin = 0; begin < points.size; begin += kNearPoints)
    {
      this->findSoleTerms(
        points.slice(begin, std::min(kNearPoints, points.size - begin)), &sole[begin]);
    }
    std::vector<std::int32_t> found;
    for (std::size_t k = 0; k < points.size; ++k)
    {
      if (sole[k] >= 0 && (found.empty() || found.back() != sole[k]))
      {
        found.push_back(sole[k]);
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::fill_n(leaf, points.size, -1);
    for (const std::int32_t index : found)
    {
      const Term& term = hierarchy_.terms()[static_cast<std::size_t>(index)];
      sourceLeafWhere(
        *term.node, points, [&](std::size_t k) { return sole[k] == index; }, term.firstLeaf, leaf);
    }
  }

  BlendOptions options_;
  BlendHierarchy hierarchy_;
  MeshWarnings meshWarnings_;
  Box3 influence_;
  Box3 surface_;
  bool negative_ = true;
};

} // namespace

void checkBlendOptions(const BlendOptions& options)
{
  kMethods.check(options.method);
  if (!(options.overlapThreshold >= 0.0 && options.overlapThreshold <= 1.0))
  {
    throw InvalidParameter("OverlapThreshold", options.overlapThreshold, "in [0, 1]");
  }
}

void describeBlendOptions(const BlendOptions& options, Parameters& parameters)
{
  kMethods.describe(options.method, parameters);
  parameters.set("overlapThreshold", options.overlapThreshold);
}

BlendOptions blendOptionsFrom(const Parameters& parameters)
{
  BlendOptions options;
  options.method = kMethods.from(parameters);
  options.overlapThreshold = parameters.getDouble("overlapThreshold");
  return options;
}

std::vector<NodePtr> childrenUnderBlend(std::vector<NodePtr> children)
{
  for (NodePtr& child : children)
  {
    if (!child)
    {
      throw InvalidParameter("A child of the blend", "null", "a node");
    }
    child = child->underBlend();
  }
  return children;
}

NodePtr makeBlend(std::vector<NodePtr> children, const BlendOptions& options)
{
  checkBlendOptions(options);
  if (children.empty())
  {
    throw InvalidParameter("The number of children of the blend", "0", "at least 1");
  }
  if (children.size() == 1 && children.front())
  {
    return children.front();
  }
  return std::make_shared<Blend>(childrenUnderBlend(std::move(children)), options);
}

NodePtr blendFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  return makeBlend(children, blendOptionsFrom(parameters));
}

} // namespace hybridtree
