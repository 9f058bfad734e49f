// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hybridtree
{

/// Which parts of a skeleton add their fields up ([SUB] 5). The others are united: the stronger
/// field counts.
enum class BlendingKind
{
  All,        ///< every element with every other
  Neighbours, ///< those near each other along the skeleton
  Paper       ///< immediate neighbours, fading with the parameter u, as [SUB]
};

struct BlendingControl
{
  BlendingKind kind = BlendingKind::All;
  /// Neighbours: up to which distance along the skeleton, in units of R, places on it blend fully.
  /// From there their share falls to 0 over one R.
  /// The default is more than the way between two places of a gentle skeleton that reach one point,
  /// which is 2.
  double distance = 2.25;
};

/// \throws InvalidParameter for a value out of its range.
void validate(const BlendingControl& control);

/// What the field of an element at this distance along the skeleton counts: 1 at first, 0 in the
/// end, with two continuous derivatives between.
class BlendShare
{
public:
  explicit BlendShare(const BlendingControl& control)
    : begin_(control.kind == BlendingKind::Paper ? 0.0 : control.distance), end_(begin_ + 1.0)
  {
  }

  double begin() const { return begin_; } ///< last distance with the share 1
  double end() const { return end_; }     ///< first with the share 0

  double operator()(double distance) const
  {
    const double x = this->clamped(distance);
    return 1.0 - x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
  }
  double slope(double distance) const
  {
    const double x = this->clamped(distance);
    return -30.0 * x * x * (1.0 - x) * (1.0 - x);
  }
  static constexpr double kSteepest = 1.875;

private:
  double clamped(double distance) const
  {
    const double x = distance - begin_;
    return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x;
  }

  double begin_;
  double end_;
};

} // namespace hybridtree
