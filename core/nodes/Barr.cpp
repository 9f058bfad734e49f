// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Barr.h"

#include "core/base/Error.h"
#include "core/nodes/FramedWarp.h"
#include "core/nodes/MeshLimits.h"
#include "core/nodes/WarpedNode.h"

#include <cmath>
#include <sstream>

namespace hybridtree
{
namespace
{

// What differs between the kinds beyond the map itself: names, and which amounts are allowed.
template <typename Map>
struct Kind;

template <>
struct Kind<TwistMap>
{
  static constexpr const char* kName = "twist";
  static constexpr const char* kAmount = "angle";
  static double amount(const TwistMap& map) { return map.angle; }
  static void check(double angle)
  {
    if (!std::isfinite(angle) || std::abs(angle) > kLargestTwist)
    {
      throw InvalidParameter("The twist angle (in radians)", angle,
        "between -6283 and 6283 (a thousand turns); chain two twists for more");
    }
  }
  static std::vector<std::string> warnings(const TwistMap&, const Box3&) { return {}; }
};

template <>
struct Kind<TaperMap>
{
  static constexpr const char* kName = "taper";
  static constexpr const char* kAmount = "factor";
  static double amount(const TaperMap& map) { return map.factor; }
  static void check(double factor)
  {
    if (!std::isfinite(factor) || factor <= 0.0)
    {
      throw InvalidParameter("The taper factor", factor,
        "a finite number > 0 (a small one, such as 0.01, comes close to a point)");
    }
  }
  static std::vector<std::string> warnings(const TaperMap&, const Box3&) { return {}; }
};

template <>
struct Kind<BendMap>
{
  static constexpr const char* kName = "bend";
  static constexpr const char* kAmount = "angle";
  static double amount(const BendMap& map) { return map.angle; }
  static void check(double angle)
  {
    if (!std::isfinite(angle) || std::abs(angle) > kLargestBend)
    {
      throw InvalidParameter("The bend angle (in radians)", angle,
        "between -4.5 and 4.5 (about 258 degrees), because the straight ends overlap beyond; chain "
        "two bends for more");
    }
  }
  static std::vector<std::string> warnings(const BendMap& map, const Box3& surface)
  {
    if (map.isOneToOneOver(surface))
    {
      return {};
    }
    std::ostringstream text;
    text << "The shape may reach past the centre line of the bend, "
         << (map.end - map.begin) / std::abs(map.angle)
         << " from the axis (in lengths of the frame), where it would overlap itself: what "
            "overlaps is cut off. Lower the angle, lengthen the range, or move the origin.";
    return { text.str() };
  }
};

template <typename Map>
class BarrNode final : public WarpedNode
{
public:
  BarrNode(NodePtr child, std::shared_ptr<const FramedWarp<Map>> warp)
    : WarpedNode(std::move(child), warp), framed_(std::move(warp))
  {
  }

  const char* kind() const override { return Kind<Map>::kName; }

  Parameters parameters() const override
  {
    Parameters parameters;
    parameters.set("frame", framed_->frame());
    parameters.set("begin", framed_->map().begin);
    parameters.set("end", framed_->map().end);
    parameters.set(Kind<Map>::kAmount, Kind<Map>::amount(framed_->map()));
    return parameters;
  }

  std::vector<std::string> warnings() const override
  {
    const Box3 local = transformed(this->child()->surfaceBounds(), framed_->frameInverse());
    return Kind<Map>::warnings(framed_->map(), local);
  }

protected:
  // A o w_F o A^-1 = w_{A F}, so every affine map passes on to the child.
  NodePtr makeImage(const Affine3& map) const override
  {
    return std::make_shared<const BarrNode>(this->child()->affine(map),
      std::make_shared<const FramedWarp<Map>>(framed_->map(), map * framed_->frame()));
  }

  NodePtr withChildren(std::vector<NodePtr> children) const override
  {
    return std::make_shared<const BarrNode>(std::move(children.front()), framed_);
  }

private:
  std::shared_ptr<const FramedWarp<Map>> framed_;
};

void requireFinite(const char* name, const Vec3& value)
{
  if (!value.allFinite())
  {
    throw InvalidParameter(name, "not finite", "made of finite numbers");
  }
}

void checkRange(double begin, double end)
{
  if (!std::isfinite(begin) || !std::isfinite(end))
  {
    throw InvalidParameter(
      "The range", std::isfinite(begin) ? end : begin, "made of finite numbers");
  }
  if (!std::isfinite(end - begin))
  {
    throw InvalidParameter("The length of the range", end - begin, "finite");
  }
  if (!(begin < end))
  {
    throw InvalidParameter("The begin of the range", begin,
      "less than its end, " + std::to_string(end) + "; swap the two, or reverse the axis");
  }
}

Affine3 matrixOf(const BarrFrame& frame)
{
  requireFinite("The origin", frame.origin);
  requireFinite("The axis", frame.axis);
  requireFinite("The normal", frame.normal);
  if (!(frame.axis.stableNorm() > 0.0))
  {
    throw InvalidParameter("The axis", "of length 0", "a direction, such as (0, 0, 1)");
  }
  if (!(frame.normal.stableNorm() > 0.0))
  {
    throw InvalidParameter("The normal", "of length 0", "a direction across the axis");
  }
  const Vec3 axis = frame.axis.stableNormalized();
  const Vec3 direction = frame.normal.stableNormalized();
  const Vec3 across = direction - direction.dot(axis) * axis;
  if (!(across.norm() > 1e-8))
  {
    throw InvalidParameter("The normal", "parallel to the axis", "a direction across the axis");
  }
  Affine3 matrix = Affine3::Identity();
  matrix.linear().col(0) = across.normalized();
  matrix.linear().col(2) = axis;
  matrix.linear().col(1) = axis.cross(across).normalized();
  matrix.translation() = frame.origin;
  return matrix;
}

// In coordinates of a frame that is too far away the shape loses its digits.
void checkDistance(const char* kind, const Node& child, const Affine3& frame)
{
  const Box3 box = transformed(child.influenceBounds(), frame.inverse());
  if (!box.isEmpty() && !holdsDigits(box))
  {
    const double size = box.sizes().maxCoeff();
    std::ostringstream text;
    text
      << "at most " << size / kSmallestShare
      << " (in lengths of the axis), as double precision leaves too few digits of a shape of size "
      << size << " beyond; move the origin towards the shape";
    throw InvalidParameter("The distance of the shape from the origin of the " + std::string(kind),
      largestCoordinate(box), text.str());
  }
}

template <typename Map>
NodePtr make(NodePtr child, const Affine3& frame, double begin, double end, double amount)
{
  checkRange(begin, end);
  Kind<Map>::check(amount);
  checkDistance(Kind<Map>::kName, *child, frame);
  return std::make_shared<const BarrNode<Map>>(
    std::move(child), std::make_shared<const FramedWarp<Map>>(Map{ begin, end, amount }, frame));
}

template <typename Map>
NodePtr fromParameters(const Parameters& parameters, const std::vector<NodePtr>& children)
{
  requireChildren(Kind<Map>::kName, children, 1);
  const Affine3 frame = parameters.getAffine("frame");
  if (!frame.matrix().allFinite() || frame.linear().determinant() == 0.0)
  {
    throw InvalidParameter(std::string("The frame of the ") + Kind<Map>::kName, "not invertible",
      "three finite directions that span space, and an origin");
  }
  return make<Map>(children.front(), frame, parameters.getDouble("begin"),
    parameters.getDouble("end"), parameters.getDouble(Kind<Map>::kAmount));
}

} // namespace

NodePtr makeTwist(NodePtr child, const BarrFrame& frame, double angle)
{
  return make<TwistMap>(std::move(child), matrixOf(frame), frame.begin, frame.end, angle);
}

NodePtr makeTaper(NodePtr child, const BarrFrame& frame, double factor)
{
  return make<TaperMap>(std::move(child), matrixOf(frame), frame.begin, frame.end, factor);
}

NodePtr makeBend(NodePtr child, const BarrFrame& frame, double angle)
{
  return make<BendMap>(std::move(child), matrixOf(frame), frame.begin, frame.end, angle);
}

NodePtr twistFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  return fromParameters<TwistMap>(parameters, children);
}

NodePtr taperFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  return fromParameters<TaperMap>(parameters, children);
}

NodePtr bendFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup&)
{
  return fromParameters<BendMap>(parameters, children);
}

} // namespace hybridtree
