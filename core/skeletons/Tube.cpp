// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Tube.h"

#include "core/skeletons/Validate.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr int kSamples = 32; // per span

// Largest turn of the curve from ring to ring, in radians.
constexpr double kRingTurn = 0.5;

Vec3 reflected(const Vec3& v, const Vec3& across)
{
  const double squared = across.squaredNorm();
  return squared > 0.0 ? Vec3(v - 2.0 / squared * across.dot(v) * across) : v;
}

} // namespace

Tube::Tube(const std::vector<CubicSpan>& spans, bool closed, double radius, double edgeLength)
  : spans_(spans), closed_(closed), radius_(radius)
{
  this->sample(edgeLength);
  this->transport();
}

bool Tube::monotone() const
{
  return std::adjacent_find(y_.begin(), y_.end(), [](double a, double b) { return !(b > a); }) ==
    y_.end();
}

MeridianPoint Tube::place(double y) const
{
  const Station here = this->station(this->parameter(y));
  const double across = std::sqrt(1.0 - here.lean * here.lean);
  return { Vec2(here.center.radius * across, y), Vec2(across, here.lean) };
}

Tube::End Tube::end(bool last) const
{
  const Station& here = last ? stations_.back() : stations_.front();
  return { last ? along_.back() : 0.0, here.center.radius, std::asin(here.lean) };
}

RevolvedFrame Tube::bend(Ring& ring) const
{
  const double y = ring.place.position.y();
  const bool last = y >= this->to();
  if (!closed_ && (last || y <= this->from()))
  {
    const Station& here = last ? stations_.back() : stations_.front();
    ring.place.normal.normalize();
    ring.place.position = here.center.radius * ring.place.normal;
    return this->frame(last ? static_cast<double>(spans_.size()) : 0.0, here);
  }
  const double at = this->parameter(y);
  const Station here = this->station(at);
  ring.place.normal = Vec2(std::sqrt(1.0 - here.lean * here.lean), here.lean);
  ring.place.position = here.center.radius * ring.place.normal;
  return this->frame(at, here);
}

Tube::Station Tube::station(double at) const
{
  const auto index = std::min(static_cast<std::size_t>(std::max(at, 0.0)), spans_.size() - 1);
  const double t = std::clamp(at - static_cast<double>(index), 0.0, 1.0);
  ThickPoint center = spans_[index].at(t);
  center.radius += radius_;
  const ThickPoint slope = spans_[index].slope(t);
  const double speed = slope.at.norm();
  return { center, slope.at / speed, -slope.radius / speed };
}

void Tube::sample(double edgeLength)
{
  for (std::size_t k = 0; k <= spans_.size() * kSamples; ++k)
  {
    stations_.push_back(this->station(static_cast<double>(k) / kSamples));
    largest_ = std::max(largest_, stations_[k].center.radius);
  }
  along_ = { 0.0 };
  for (std::size_t k = 0; k + 1 < stations_.size(); ++k)
  {
    // Of one span: curvatures differ where two meet.
    const CubicSpan& span = spans_[k / kSamples];
    const double t = static_cast<double>(k % kSamples) / kSamples;
    growth_.push_back({ this->growth(span, t, edgeLength) / kSamples,
      this->growth(span, t + 1.0 / kSamples, edgeLength) / kSamples });
    along_.push_back(along_[k] + 0.5 * (growth_[k].first + growth_[k].second));
  }
  for (std::size_t k = 0; k < stations_.size(); ++k)
  {
    y_.push_back(along_[k] + stations_[k].center.radius * stations_[k].lean);
  }
}

// Of the outer length, by t.
double Tube::growth(const CubicSpan& span, double t, double edgeLength) const
{
  const Vec3 slope = span.slope(t).at;
  const double speed = slope.norm();
  const double curvature = slope.cross(span.bend(t).at).norm() / (speed * speed * speed);
  const double r = radius_ + span.at(t).radius;
  return speed * std::max(1.0 + curvature * r, curvature * edgeLength / kRingTurn);
}

void Tube::transport()
{
  side_.push_back(anyAcross(stations_.front().tangent));
  for (std::size_t k = 1; k < stations_.size(); ++k)
  {
    side_.push_back(this->transported(k - 1, stations_[k]));
  }
  if (closed_)
  {
    // Angle from the first side to the one that arrives.
    const Vec3& axis = stations_.front().tangent;
    twist_ =
      std::atan2(side_.front().cross(side_.back()).dot(axis), side_.front().dot(side_.back()));
  }
}

// The side at sample k, carried on by two reflections.
Vec3 Tube::transported(std::size_t k, const Station& to) const
{
  const Station& from = stations_[k];
  const Vec3 step = to.center.at - from.center.at;
  const Vec3 rest = to.tangent - reflected(from.tangent, step);
  const Vec3 side = reflected(reflected(side_[k], step), rest);
  return (side - to.tangent.dot(side) * to.tangent).normalized();
}

RevolvedFrame Tube::frame(double at, const Station& here) const
{
  const auto k = std::min(static_cast<std::size_t>(at * kSamples), y_.size() - 1);
  Vec3 side = this->transported(k, here);
  if (closed_)
  {
    const double turn = -twist_ * at / static_cast<double>(spans_.size());
    side = std::cos(turn) * side + std::sin(turn) * here.tangent.cross(side);
  }
  return { here.center.at, here.tangent, side };
}

// Between samples the growth of y is taken as linear, with its values at both if these are
// positive.
double Tube::parameter(double y) const
{
  const auto next = std::upper_bound(y_.begin(), y_.end(), y);
  const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
    next - y_.begin() - 1, 0, static_cast<std::ptrdiff_t>(y_.size()) - 2));
  const double step = y_[k + 1] - y_[k];
  const double part = std::clamp(y - y_[k], 0.0, step);
  // What the lean adds to the growth of the length is the same at both.
  const double lean = step - (along_[k + 1] - along_[k]);
  const double before = growth_[k].first + lean;
  const double after = growth_[k].second + lean;
  const double share = before > 0.0 && after > 0.0
    ? 2.0 * part / (before + std::sqrt(before * before + 2.0 * (after - before) * part))
    : part / step;
  return (static_cast<double>(k) + std::min(1.0, share)) / kSamples;
}

} // namespace hybridtree
