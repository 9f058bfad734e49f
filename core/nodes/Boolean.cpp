// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Boolean.h"

#include "core/base/Error.h"
#include "core/base/Scratch.h"
#include "core/nodes/BooleanSource.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/Membership.h"
#include "core/nodes/Operator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

const std::array<const char*, 3> kOperationNames = { "union", "intersection", "difference" };
const std::array<const char*, 4> kFormNames = { "automatic", "minMax", "smooth", "paper" };

template <typename Enum, std::size_t N>
Enum enumFrom(
  const Parameters& parameters, const char* name, const std::array<const char*, N>& names)
{
  const std::string text = parameters.getString(name);
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end())
  {
    std::string allowed;
    for (const char* candidate : names)
    {
      allowed += (allowed.empty() ? "" : ", ") + std::string(candidate);
    }
    throw InvalidText("Parameter \"" + std::string(name) + "\" is \"" + text +
      "\"; it must be one of: " + allowed + ".");
  }
  return static_cast<Enum>(found - names.begin());
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

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
  Boolean(BooleanOperation operation, NodePtr a, NodePtr b, BooleanForm form)
    : Operator({ std::move(a), std::move(b) })
    , operation_(operation)
    , form_(form)
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
  }

  void field(PointBatch points, double* value) const override { source_.field(points, value); }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    source_.fieldAndGradient(points, value, gradient);
  }
  Interval range(const Box3& box) const override { return source_.range(box); }
  FieldSourcePtr restrictedTo(const Box3& box) const override { return source_.restrictedTo(box); }

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

  const char* kind() const override { return "boolean"; }
  Parameters parameters() const override
  {
    Parameters parameters;
    parameters.set("operation", kOperationNames[static_cast<std::size_t>(operation_)]);
    parameters.set("form", kFormNames[static_cast<std::size_t>(form_)]);
    return parameters;
  }

protected:
  TriangleMesh makeMesh(double edgeLength, const Progress& progress) const override
  {
    return latticeMesh(*this, edgeLength, progress);
  }

  NodePtr withChildren(std::vector<NodePtr> children) const override
  {
    return makeBoolean(operation_, children[0], children[1], form_);
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
    return makeBoolean(operation_, std::move(a), std::move(b), form);
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
        break;
      case BooleanOperation::Difference:
        break;
    }
    return box.isEmpty() ? Box3() : box;
  }

  BooleanOperation operation_;
  BooleanForm form_;
  const Node* a_;
  const Node* b_;
  BooleanSource source_;
  Box3 influence_;
  Box3 surface_;
  bool negative_ = false;
};

} // namespace

NodePtr makeBoolean(BooleanOperation operation, NodePtr a, NodePtr b, BooleanForm form)
{
  return std::make_shared<Boolean>(operation, std::move(a), std::move(b), form);
}

NodePtr booleanFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  requireChildren("boolean", children, 2);
  return makeBoolean(enumFrom<BooleanOperation>(parameters, "operation", kOperationNames),
    children[0], children[1], enumFrom<BooleanForm>(parameters, "form", kFormNames));
}

} // namespace hybridtree
