// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Meridian.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

MeridianPoint pointOnAxis(const MeridianPoint& point, bool start)
{
  const double height = point.normal.y();
  const double up = height > 0.0 || (height == 0.0 && !start) ? 1.0 : -1.0;
  return { Vec2(0.0, point.position.y()), Vec2(0.0, up) };
}

} // namespace

double angleBetween(const Vec2& a, const Vec2& b)
{
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

void Meridian::addLine(const Vec2& from, const Vec2& to)
{
  const Vec2 along = to - from;
  const double length = along.stableNorm();
  if (length > 0.0)
  {
    const Vec2 normal = Vec2(along.y(), -along.x()) / length;
    this->addCurve(length,
      [=](double s) {
        return MeridianPoint{ from + (s / length) * along, normal };
      });
  }
}

void Meridian::addArc(const Vec2& center, double radius, double from, double to)
{
  // In parts of at most a right angle: a mesh coarser than the arc keeps a point of each.
  const int parts =
    std::max(1, static_cast<int>(std::ceil(std::abs(to - from) * 2.0 / kPi - 1e-9)));
  const double side = to > from ? 1.0 : -1.0;
  for (int part = 0; part < parts; ++part)
  {
    const double begin = from + (to - from) * part / parts;
    const double turn = (to - from) / parts;
    const double length = radius * std::abs(turn);
    this->addCurve(length,
      [=](double s)
      {
        const double angle = begin + turn * (s / length);
        const Vec2 outward(std::cos(angle), std::sin(angle));
        return MeridianPoint{ center + radius * outward, side * outward };
      });
  }
}

void Meridian::addCurve(double length, std::function<MeridianPoint(double)> at)
{
  if (length > 0.0)
  {
    const double turn = angleBetween(at(0.0).normal, at(length).normal);
    pieces_.push_back({ this->length(), length, turn, std::move(at) });
  }
}

double Meridian::length() const
{
  return pieces_.empty() ? 0.0 : pieces_.back().start + pieces_.back().length;
}

MeridianPoint Meridian::at(double s) const
{
  const std::size_t last = pieces_.size() - 1;
  const bool atStart = s <= 0.0;
  if (atStart || s >= this->length())
  {
    const Piece& piece = atStart ? pieces_.front() : pieces_.back();
    return this->loop() ? this->joint(last, 0)
                        : pointOnAxis(piece.at(atStart ? 0.0 : piece.length), atStart);
  }
  const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), s,
    [](double value, const Piece& piece) { return value < piece.start; });
  const std::size_t k = static_cast<std::size_t>(next - pieces_.begin()) - 1;
  return s == pieces_[k].start ? this->joint(k - 1, k) : pieces_[k].at(s - pieces_[k].start);
}

MeridianPoint Meridian::joint(std::size_t before, std::size_t after) const
{
  const MeridianPoint end = pieces_[before].at(pieces_[before].length);
  const MeridianPoint begin = pieces_[after].at(0.0);
  const Vec2 sum = end.normal + begin.normal;
  const double length = sum.norm();
  return { begin.position, length > 1e-9 ? Vec2(sum / length) : begin.normal };
}

} // namespace hybridtree
