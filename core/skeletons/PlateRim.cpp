// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/PlateRim.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

// Corners that turn less are passed over smoothly.
constexpr double kSharp = 25.0 * EIGEN_PI / 180.0;
constexpr double kStraight = 1e-9;

double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

Vec2 turned(const Vec2& v, double angle)
{
  return Eigen::Rotation2Dd(angle) * v;
}

double distanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b)
{
  const Vec2 edge = b - a;
  const double squared = edge.squaredNorm();
  const double foot = squared > 0.0 ? std::clamp((p - a).dot(edge) / squared, 0.0, 1.0) : 0.0;
  return (p - a - foot * edge).norm();
}

// Of segments that do not cross.
double distanceOfSegments(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
  return std::min({ distanceToSegment(a, c, d), distanceToSegment(b, c, d),
    distanceToSegment(c, a, b), distanceToSegment(d, a, b) });
}

bool cross2(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 &&
    cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

} // namespace

PlateRim::PlateRim(const std::vector<Vec2>& corners)
{
  const std::size_t count = corners.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec2 edge = corners[(k + 1) % count] - corners[k];
    const Vec2 direction = edge.normalized();
    sides_.push_back({ direction, Vec2(direction.y(), -direction.x()), edge.norm() });
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    const Side& before = sides_[(k + count - 1) % count];
    const Side& after = sides_[k];
    const double turn =
      std::atan2(cross(before.direction, after.direction), before.direction.dot(after.direction));
    const bool reflex = turn < -kStraight;
    corners_.push_back({ corners[k], turn, reflex ? std::tan(-0.5 * turn) : 0.0,
      turned(before.normal, 0.5 * turn), reflex || turn >= kSharp });
  }
  this->chooseBreaks();
}

void PlateRim::chooseBreaks()
{
  corners_.front().isBreak = true; // rings and the outline start with the same corner
  const auto breaks =
    std::count_if(corners_.begin(), corners_.end(), [](const Corner& c) { return c.isBreak; });
  if (breaks >= 3)
  {
    return;
  }
  // A smooth outline: a few places, evenly.
  const std::size_t parts = std::min<std::size_t>(4, corners_.size());
  for (std::size_t k = 0; k < parts; ++k)
  {
    corners_[k * corners_.size() / parts].isBreak = true;
  }
}

int PlateRim::after(int corner) const
{
  return corner + 1 == static_cast<int>(corners_.size()) ? 0 : corner + 1;
}

int PlateRim::nextBreak(int corner) const
{
  do
  {
    corner = this->after(corner);
  } while (!corners_[corner].isBreak);
  return corner;
}

double PlateRim::length() const
{
  double sum = 0.0;
  for (const Side& side : sides_)
  {
    sum += side.length;
  }
  return sum;
}

double PlateRim::startOf(int side, double distance) const
{
  return distance * corners_[side].mitre;
}

double PlateRim::endOf(int side, double distance) const
{
  return sides_[side].length - distance * corners_[this->after(side)].mitre;
}

PlateRim::Point PlateRim::onSide(int side, double at) const
{
  const Side& s = sides_[side];
  return { corners_[side].place + at * s.direction, s.normal, s.normal };
}

PlateRim::Point PlateRim::onArc(int corner, double share) const
{
  const Corner& c = corners_[corner];
  const Vec2 outward = turned(c.bisector, (share - 0.5) * std::max(0.0, c.turn));
  return { c.place, outward, outward };
}

PlateRim::Point PlateRim::onMitre(int corner) const
{
  const Corner& c = corners_[corner];
  const double cosine = std::cos(0.5 * c.turn);
  return { c.place, c.bisector / cosine, c.bisector * cosine };
}

PlateRim::Ring PlateRim::outline(const std::vector<int>& counts) const
{
  Ring ring;
  for (int first = 0; first < static_cast<int>(corners_.size()); ++first)
  {
    if (!corners_[first].isBreak)
    {
      continue;
    }
    Chain chain;
    const int last = this->nextBreak(first);
    int side = first;
    do
    {
      const double turn = std::max(0.0, corners_[side].turn);
      chain.end.angle += side == first ? 0.5 * turn : turn;
      const double step = sides_[side].length / counts[side];
      for (int k = 0; k < counts[side]; ++k)
      {
        chain.points.push_back(this->onSide(side, step * k));
        chain.middles.push_back({ chain.end.along + step * (k + 0.5), chain.end.angle });
      }
      chain.end.along += sides_[side].length;
      side = this->after(side);
    } while (side != last);
    chain.end.angle += 0.5 * std::max(0.0, corners_[last].turn);
    chain.points.push_back(this->onSide(last, 0.0));
    ring.push_back(std::move(chain));
  }
  return ring;
}

PlateRim::Chain PlateRim::chain(int first, double distance, double spacing) const
{
  // Its parts one after the other: half an arc, a side, an arc, a side, ..., half an arc.
  struct Part
  {
    bool isArc;
    int at; // side, or corner of an arc
    double begin, end;
    double length;
    double along, angle; // before it
    double turn;
  };
  std::vector<Part> parts;
  double total = 0.0;
  double along = 0.0;
  double angle = 0.0;
  const auto addArc = [&](int corner, double begin, double end)
  {
    const double turn = std::max(0.0, corners_[corner].turn) * (end - begin);
    parts.push_back({ true, corner, begin, end, distance * turn, along, angle, turn });
    total += distance * turn;
    angle += turn;
  };
  const int last = this->nextBreak(first);
  int side = first;
  do
  {
    addArc(side, side == first ? 0.5 : 0.0, 1.0);
    const double begin = this->startOf(side, distance);
    const double end = this->endOf(side, distance);
    parts.push_back({ false, side, begin, end, end - begin, along, angle, 0.0 });
    total += end - begin;
    along += sides_[side].length;
    side = this->after(side);
  } while (side != last);
  addArc(last, 0.0, 0.5);

  int count = std::max(1, static_cast<int>(std::ceil(total / spacing - 1e-9)));
  // A point in the middle, so that no two edges of neighbouring curves face each other there: their
  // diagonal would be no mirror image of itself.
  count += count >= 3 ? count % 2 : 0;
  Chain chain;
  chain.points.reserve(static_cast<std::size_t>(count) + 1);
  chain.middles.reserve(static_cast<std::size_t>(count));
  chain.end = { along - distance * corners_[last].mitre, angle };
  std::size_t k = 0;
  double before = 0.0; // length of the parts before part k
  for (int half = 0; half <= 2 * count; ++half)
  {
    const double t = total * half / (2 * count);
    while (k + 1 < parts.size() && t > before + parts[k].length)
    {
      before += parts[k++].length;
    }
    const Part& part = parts[k];
    const double share = part.length > 0.0 ? std::clamp((t - before) / part.length, 0.0, 1.0)
                                           : double(half == 2 * count);
    const double at = part.begin + share * (part.end - part.begin);
    if (half % 2 == 0)
    {
      chain.points.push_back(part.isArc ? this->onArc(part.at, at) : this->onSide(part.at, at));
    }
    else
    {
      chain.middles.push_back(part.isArc ? Place{ part.along, part.angle + share * part.turn }
                                         : Place{ part.along + at, part.angle });
    }
  }
  // The ends bit for bit where the neighbouring chain has them.
  const auto atBreak = [this](int corner)
  { return corners_[corner].mitre > 0.0 ? this->onMitre(corner) : this->onArc(corner, 0.5); };
  chain.points.front() = atBreak(first);
  chain.points.back() = atBreak(last);
  return chain;
}

PlateRim::Ring PlateRim::curve(double distance, double spacing) const
{
  Ring ring;
  for (int first = 0; first < static_cast<int>(corners_.size()); ++first)
  {
    if (corners_[first].isBreak)
    {
      ring.push_back(this->chain(first, distance, spacing));
    }
  }
  return ring;
}

bool PlateRim::isSimple(double distance) const
{
  for (int k = 0; k < static_cast<int>(corners_.size()); ++k)
  {
    if (!this->sideIsClear(k, distance) || !this->arcIsClear(k, distance))
    {
      return false;
    }
  }
  return true;
}

// Whether the moved side is no nearer than `distance` to any other side.
bool PlateRim::sideIsClear(int side, double distance) const
{
  const double begin = this->startOf(side, distance);
  const double end = this->endOf(side, distance);
  if (end - begin <= 1e-6 * sides_[side].length)
  {
    return false; // swallowed by the mitres
  }
  const Vec2& from = corners_[side].place;
  const Vec2 outward = distance * sides_[side].normal;
  const Vec2 a = from + begin * sides_[side].direction + outward;
  const Vec2 b = from + end * sides_[side].direction + outward;
  for (int other = 0; other < static_cast<int>(sides_.size()); ++other)
  {
    const Vec2& c = corners_[other].place;
    const Vec2& d = corners_[this->after(other)].place;
    if (other != side &&
      (cross2(a, b, c, d) || distanceOfSegments(a, b, c, d) < distance * (1.0 - 1e-9)))
    {
      return false;
    }
  }
  return true;
}

// The same of the arc around a convex corner; its ends are those of sides.
bool PlateRim::arcIsClear(int corner, double distance) const
{
  const Corner& c = corners_[corner];
  if (c.turn <= kStraight)
  {
    return true;
  }
  const int count = static_cast<int>(corners_.size());
  const Vec2& firstNormal = sides_[(corner + count - 1) % count].normal;
  const Vec2& lastNormal = sides_[corner].normal;
  for (int other = 0; other < count; ++other)
  {
    Vec2 a = corners_[other].place - c.place;
    Vec2 b = corners_[this->after(other)].place - c.place;
    // Only what is seen between the normals can be nearest to the inside of the arc.
    bool seen = true;
    for (const Vec2& edge :
      { Vec2(-firstNormal.y(), firstNormal.x()), Vec2(lastNormal.y(), -lastNormal.x()) })
    {
      const double u = edge.dot(a);
      const double v = edge.dot(b);
      if (u <= 0.0 && v <= 0.0)
      {
        seen = false;
        break;
      }
      if (u < 0.0)
      {
        a += (b - a) * (u / (u - v));
      }
      else if (v < 0.0)
      {
        b += (a - b) * (v / (v - u));
      }
    }
    const bool own = other == corner || this->after(other) == corner;
    if (seen && !own && distanceToSegment(Vec2::Zero(), a, b) < 2.0 * distance * (1.0 - 1e-9))
    {
      return false;
    }
  }
  return true;
}

} // namespace hybridtree
