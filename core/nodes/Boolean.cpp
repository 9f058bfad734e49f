// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Boolean.h"

#include "core/base/Error.h"
#include "core/base/Scratch.h"
#include "core/mesh/Dust.h"
#include "core/nodes/BooleanMesh.h"
#include "core/nodes/BooleanSource.h"
#include "core/nodes/EnumNames.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/Membership.h"
#include "core/nodes/MeshLimits.h"
#include "core/nodes/Operator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>

namespace hybridtree
{
namespace
{

const EnumNames<BooleanOperation, 3> kOperations = { "Operation", "operation",
  { "union", "intersection", "difference" } };
const EnumNames<FacetMerging, 2> kMergings = { "MergeCoplanar", "merging", { "none", "parts" } };
const EnumNames<BooleanForm, 4> kForms = { "Form", "form",
  { "automatic", "minMax", "smooth", "paper" } };

// Share of the edge length below which what a cut leaves behind is nothing but the lattice's noise.
constexpr double kDust = 1e-4;

// As many as Node keeps meshes.
constexpr std::size_t kKeptCuts = 4;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Trees with more leaves are not compared: the paths to shared nodes may be many.
constexpr int kMostCompared = 1000;

bool isSameTree(const Node& a, const Node& b)
{
  if (&a == &b)
  {
    return true;
  }
  if (a.leafCount() != b.leafCount() || a.leafCount() > kMostCompared ||
    std::strcmp(a.kind(), b.kind()) != 0 ||
    !(a.influenceBounds().min() == b.influenceBounds().min()) ||
    a.parameters().entries() != b.parameters().entries())
  {
    return false;
  }
  const std::vector<NodePtr> childrenA = a.children();
  const std::vector<NodePtr> childrenB = b.children();
  return std::equal(childrenA.begin(), childrenA.end(), childrenB.begin(), childrenB.end(),
    [](const NodePtr& childA, const NodePtr& childB) { return isSameTree(*childA, *childB); });
}

// Signed distance to the union of two solids where their own distances tell it. Outside of both it
// is the lesser. Inside of A alone it is A's, if B is no nearer: A's nearest surface point then
// lies outside of B. Anything else needs more than two numbers.
double unionDistance(double a, double b)
{
  const double least = std::min(a, b);
  const double other = std::max(a, b);
  return least >= 0.0 || other >= -least ? least : kUnknown;
}

class Boolean final : public Operator
{
public:
  Boolean(BooleanOperation operation, NodePtr a, NodePtr b, BooleanForm form, FacetMerging merging)
    : Operator({ std::move(a), std::move(b) })
    , operation_(operation)
    , form_(form)
    , merging_(merging)
    , a_(this->child(0).get())
    , b_(this->child(1).get())
    , source_(operation, form == BooleanForm::Automatic ? BooleanForm::MinMax : form,
        this->child(0), this->child(1))
  {
    // Kept: asked often, and by walking the tree they would cost what it has leaves.
    negative_ = a_->isNegative() && b_->isNegative();
    // What only carves counts as 0.
    const auto kept = [](const Node& node, const Box3& box)
    { return node.isNegative() ? Box3() : box; };
    const bool reachesOut =
      form_ == BooleanForm::Paper && operation_ == BooleanOperation::Intersection;
    influence_ = combinedBounds(kept(*a_, a_->influenceBounds()), kept(*b_, b_->influenceBounds()),
      reachesOut ? BooleanOperation::Union : operation_);
    surface_ =
      combinedBounds(kept(*a_, a_->surfaceBounds()), kept(*b_, b_->surfaceBounds()), operation_);
    if (source_.isNothing())
    {
      influence_ = surface_ = Box3();
    }
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

  // B is asked only where A leaves the answer open.
  void membership(PointBatch points, std::int8_t* side) const override
  {
    const std::int8_t decided = operation_ == BooleanOperation::Union ? 1 : -1;
    constexpr std::size_t kPart = 256;
    std::array<std::int8_t, kPart> sideB;
    for (std::size_t begin = 0; begin < points.size; begin += kPart)
    {
      const PointBatch part = points.slice(begin, std::min(kPart, points.size - begin));
      std::int8_t* sideA = side + begin;
      a_->membership(part, sideA);
      if (a_ == b_)
      {
        std::copy_n(sideA, part.size, sideB.data());
      }
      else
      {
        membershipWhere(
          *b_, part, [&](std::size_t k) { return sideA[k] != decided; }, sideB.data());
      }
      for (std::size_t k = 0; k < part.size; ++k)
      {
        if (sideA[k] != decided)
        {
          sideA[k] = this->combined(sideA[k], sideB[k]);
        }
      }
    }
  }

  void signedDistance(PointBatch points, double* distance) const override
  {
    ScratchArray other(points.size);
    this->childDistance(*a_, points, distance);
    if (a_ == b_)
    {
      std::copy_n(distance, points.size, other.data());
    }
    else
    {
      this->childDistance(*b_, points, other.data());
    }
    for (std::size_t k = 0; k < points.size; ++k)
    {
      distance[k] = this->combinedDistance(distance[k], other[k]);
    }
  }

  void sourceLeaf(PointBatch points, std::int32_t* leaf) const override
  {
    ScratchArray a(points.size), b(points.size), value(points.size);
    askFields({ { a_, a.data() }, { b_, b.data() } }, points);
    booleanField(operation_, BooleanForm::MinMax, a.data(), b.data(), value.data(), points.size);
    std::fill_n(leaf, points.size, -1);
    const auto makes = [&](std::size_t k) { return value[k] > 0.0; };
    const auto byA = [&](std::size_t k) { return value[k] == std::max(a[k], 0.0); };
    sourceLeafWhere(
      *a_, points, [&](std::size_t k) { return makes(k) && byA(k); }, 0, leaf);
    sourceLeafWhere(
      *b_, points, [&](std::size_t k) { return makes(k) && !byA(k); }, a_->leafCount(), leaf);
  }

  Box3 influenceBounds() const override { return influence_; }
  Box3 surfaceBounds() const override { return surface_; }
  bool isNegative() const override { return negative_; }

  std::vector<std::string> warnings() const override
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return warnings_;
  }

  // As printed, a Boolean needs its operands even where they are 0.
  std::optional<PointwiseLaw> pointwiseLaw() const override
  {
    constexpr int kForms = 4;
    const int number = 2 + kForms * static_cast<int>(operation_) + static_cast<int>(form_);
    return form_ == BooleanForm::Paper ? std::nullopt
                                       : std::optional(PointwiseLaw{ number, false });
  }

  /// What is told of the mesh at an edge length; empty where it is that of the lattice.
  struct CutOf
  {
    double edgeLength = 0.0;
    PointChains curves;
    Facets facets;
  };
  CutOf cutAt(double edgeLength) const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = std::find_if(cuts_.rbegin(), cuts_.rend(),
      [&](const CutOf& kept) { return kept.edgeLength == edgeLength; });
    return found != cuts_.rend() ? *found : CutOf();
  }

  const char* kind() const override { return "boolean"; }
  double sampleCost(double below, double) const override { return below + 0.02; }
  Parameters parameters() const override
  {
    Parameters parameters;
    kOperations.describe(operation_, parameters);
    kForms.describe(form_, parameters);
    if (merging_ != FacetMerging::Parts)
    {
      kMergings.describe(merging_, parameters);
    }
    return parameters;
  }

protected:
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override
  {
    BooleanMesh made = source_.isNothing()
      ? BooleanMesh{ TriangleMesh(), {}, {}, {} }
      : booleanMesh(operation_, *a_, *b_, merging_, edgeLength, progress);
    if (!made.mesh)
    {
      made.warnings.push_back("The Boolean is made on a lattice of the edge length instead: its "
                              "sharp edges are notched.");
      made.mesh = this->meshOnLattice(edgeLength, progress);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    warnings_ = std::move(made.warnings);
    if (cuts_.size() == kKeptCuts)
    {
      cuts_.erase(cuts_.begin());
    }
    cuts_.push_back({ edgeLength, std::move(made.curves), std::move(made.facets) });
    return std::move(*made.mesh);
  }

  TriangleMesh meshOnLattice(double edgeLength, const Progress& progress) const
  {
    TriangleMesh mesh = latticeMesh(*this, edgeLength, progress);
    if (operation_ != BooleanOperation::Union)
    {
      dropDust(mesh, kDust * edgeLength);
    }
    return mesh;
  }

  NodePtr withChildren(std::vector<NodePtr> children) const override
  {
    return makeBoolean(operation_, children[0], children[1], form_, merging_);
  }

  NodePtr makeUnderBlend() const override
  {
    NodePtr a = a_->underBlend();
    NodePtr b = b_->underBlend();
    const BooleanForm form = form_ == BooleanForm::Automatic ? BooleanForm::Smooth : form_;
    if (a.get() == a_ && b.get() == b_ && form == form_)
    {
      return this->shared_from_this();
    }
    return makeBoolean(operation_, std::move(a), std::move(b), form, merging_);
  }

private:
  std::int8_t combined(std::int8_t a, std::int8_t b) const
  {
    switch (operation_)
    {
      case BooleanOperation::Union:
        return std::max(a, b);
      case BooleanOperation::Intersection:
        return std::min(a, b);
      case BooleanOperation::Difference:
        break;
    }
    return std::min(a, static_cast<std::int8_t>(-b));
  }

  // What only carves is an empty solid: infinitely far.
  void childDistance(const Node& child, PointBatch points, double* distance) const
  {
    if (child.isNegative())
    {
      std::fill_n(distance, points.size, std::numeric_limits<double>::infinity());
      return;
    }
    child.signedDistance(points, distance);
  }

  // Intersection and difference are unions of complements, whose distance is the negative.
  double combinedDistance(double a, double b) const
  {
    if (std::isnan(a) || std::isnan(b))
    {
      return kUnknown;
    }
    double distance = kUnknown;
    switch (operation_)
    {
      case BooleanOperation::Union:
        distance = unionDistance(a, b);
        break;
      case BooleanOperation::Intersection:
        distance = -unionDistance(-a, -b);
        break;
      case BooleanOperation::Difference:
        distance = -unionDistance(-a, b);
        break;
    }
    return std::isinf(distance) ? kUnknown : distance;
  }

  static Box3 combinedBounds(const Box3& a, const Box3& b, BooleanOperation operation)
  {
    Box3 box = a;
    switch (operation)
    {
      case BooleanOperation::Union:
        box = a.isEmpty() ? b : b.isEmpty() ? a : a.merged(b);
        break;
      case BooleanOperation::Intersection:
        box = a.intersection(b);
        box = Boolean::isSliver(box, a, b) ? Box3() : box;
        break;
      case BooleanOperation::Difference:
        break;
    }
    return box.isEmpty() ? Box3() : box;
  }

  // What two boxes share that touch up to rounding: too thin to be meshed, and nothing as a solid.
  static bool isSliver(const Box3& shared, const Box3& a, const Box3& b)
  {
    if (shared.isEmpty() || !holdsDigits(a) || !holdsDigits(b))
    {
      return false;
    }
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() *
      std::max(largestCoordinate(a), largestCoordinate(b));
    const double thinner = std::min(a.sizes().minCoeff(), b.sizes().minCoeff());
    return !holdsDigits(shared) || (shared.sizes().minCoeff() <= rounding && thinner > rounding);
  }

  BooleanOperation operation_;
  BooleanForm form_;
  FacetMerging merging_;
  const Node* a_;
  const Node* b_;
  BooleanSource source_;
  Box3 influence_;
  Box3 surface_;
  bool negative_ = false;
  mutable std::mutex mutex_;
  mutable std::vector<std::string> warnings_; ///< of the last mesh made
  mutable std::vector<CutOf> cuts_;           ///< of the last meshes made
};

} // namespace

NodePtr makeBoolean(
  BooleanOperation operation, NodePtr a, NodePtr b, BooleanForm form, FacetMerging merging)
{
  kOperations.check(operation);
  kForms.check(form);
  kMergings.check(merging);
  // Made twice, or read from two files: still one shape, whose difference is nothing.
  if (a && b && isSameTree(*a, *b))
  {
    b = a;
  }
  return std::make_shared<Boolean>(operation, std::move(a), std::move(b), form, merging);
}

namespace
{

Boolean::CutOf cutOf(const Node& node, double edgeLength, const Progress& progress)
{
  const auto* boolean = dynamic_cast<const Boolean*>(&node);
  if (!boolean)
  {
    return {};
  }
  node.mesh(edgeLength, progress);
  return boolean->cutAt(edgeLength > 0.0 ? edgeLength : node.defaultEdgeLength());
}

} // namespace

PointChains curvesOf(const Node& node, double edgeLength, const Progress& progress)
{
  return cutOf(node, edgeLength, progress).curves;
}

Facets facetsOf(const Node& node, double edgeLength, const Progress& progress)
{
  return cutOf(node, edgeLength, progress).facets;
}

std::vector<std::vector<Vec3>> intersectionCurves(
  const Node& node, double edgeLength, const Progress& progress)
{
  std::vector<std::vector<Vec3>> curves;
  const PointChains chains = curvesOf(node, edgeLength, progress);
  if (chains.empty())
  {
    return curves;
  }
  const MeshPtr mesh = node.mesh(edgeLength, progress);
  for (const std::vector<std::int32_t>& chain : chains)
  {
    std::vector<Vec3>& points = curves.emplace_back();
    for (const std::int32_t point : chain)
    {
      points.push_back(mesh->points[std::size_t(point)]);
    }
  }
  return curves;
}

NodePtr booleanFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  requireChildren("boolean", children, 2);
  return makeBoolean(kOperations.from(parameters), children[0], children[1],
    kForms.from(parameters),
    parameters.has(kMergings.parameter) ? kMergings.from(parameters) : FacetMerging::Parts);
}

} // namespace hybridtree
