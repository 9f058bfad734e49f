// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceCage.h"

#include "core/subdivision/CurvePath.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybridtree
{
namespace
{

const double kPi = std::acos(-1.0);
constexpr int kAround = 6;
constexpr double kReach = 1.6;   // of an axis, in radii: bulges where pieces meet are within
constexpr double kCap = 0.45;    // from the last ring to the pole, in radii
constexpr double kSamples = 4.0; // of the field along the curve, per radius

/// A part of the curve that is inside; its ends are poles.
struct Run
{
  double begin;
  double end;
  bool round = false; // a closed curve, inside all around
};

class Maker
{
public:
  Maker(const CurvePath& path, const PlacedField& field) : path_(path), field_(field) {}

  PieceCage make()
  {
    for (const Run& run : runs())
    {
      addRun(run);
    }
    return std::move(cage_);
  }

private:
  /// Where the curve changes from outside to inside and back, and how far it can go beyond its
  /// ends.
  std::vector<Run> runs() const;
  std::vector<double> sampleLengths() const;
  PlacedPoint placed(double s) const { return { path_.point(s), path_.element(s) }; }
  double crossing(double inside, double outside) const;
  void addRun(const Run& run);
  std::vector<double> ringLengths(double from, double to, bool round) const;
  void addAxis(double s, const Vec3& direction, double radius);
  void addRing(
    double s, const Vec3& across, const Vec3& tangent, double radius, double tilt, double turn);
  void addStrip(std::int32_t ring, std::int32_t next, bool nextIsTurned, double middle);
  void addCap(std::int32_t ring, std::int32_t pole, bool atEnd, double s);
  void setElements(double s) { cage_.elements.resize(cage_.triangles.size(), path_.element(s)); }

  const CurvePath& path_;
  const PlacedField& field_;
  PieceCage cage_;
};

std::vector<double> Maker::sampleLengths() const
{
  std::vector<double> result;
  const double reach = path_.closed() ? 0.0 : 1.0;
  double s = -reach * path_.radius(0.0);
  const double last = path_.length() + reach * path_.radius(path_.length());
  while (s < last)
  {
    result.push_back(s);
    requirePieceSize(kAround / kSamples * double(result.size()));
    s += path_.radius(s) / kSamples;
  }
  result.push_back(last);
  return result;
}

// Three halvings at a time: the seven places that they may ask for, as a heap, in one batch.
double Maker::crossing(double inside, double outside) const
{
  struct Half
  {
    double inside, outside;
  };
  for (int step = 0; step < 12; step += 3)
  {
    std::array<Half, 7> halves;
    halves[0] = { inside, outside };
    std::vector<PlacedPoint> points;
    for (std::size_t k = 0; k < halves.size(); ++k)
    {
      const double middle = 0.5 * (halves[k].inside + halves[k].outside);
      points.push_back(placed(middle));
      if (2 * k + 2 < halves.size())
      {
        halves[2 * k + 1] = { middle, halves[k].outside };
        halves[2 * k + 2] = { halves[k].inside, middle };
      }
    }
    const std::vector<double> values = fieldAt(field_, points);
    for (std::size_t k = 0; k < halves.size();)
    {
      const double middle = 0.5 * (halves[k].inside + halves[k].outside);
      const bool isInside = values[k] > kThreshold;
      (isInside ? inside : outside) = middle;
      k = 2 * k + (isInside ? 1 : 2);
    }
  }
  return inside;
}

std::vector<Run> Maker::runs() const
{
  const std::vector<double> lengths = sampleLengths();
  std::vector<PlacedPoint> points;
  for (const double s : lengths)
  {
    points.push_back(placed(s));
  }
  const std::vector<double> values = fieldAt(field_, points);
  std::vector<Run> result;
  bool inside = false;
  for (std::size_t k = 0; k < lengths.size(); ++k)
  {
    const bool here = values[k] > kThreshold;
    if (here && !inside)
    {
      result.push_back({ k == 0 ? lengths[0] : crossing(lengths[k], lengths[k - 1]), 0.0 });
    }
    if (inside && !here)
    {
      result.back().end = crossing(lengths[k - 1], lengths[k]);
    }
    inside = here;
  }
  if (inside)
  {
    result.back().end = lengths.back();
  }
  if (path_.closed() && !result.empty() && result.front().begin == 0.0 &&
    result.back().end == path_.length())
  {
    if (result.size() == 1)
    {
      result.front().round = true;
    }
    else
    {
      // The one that passes the seam.
      result.back().end += result.front().end;
      result.erase(result.begin());
    }
  }
  // What lies beyond the ends alone belongs to other pieces.
  result.erase(std::remove_if(result.begin(), result.end(),
                 [&](const Run& run)
                 { return !path_.closed() && (run.end <= 0.0 || run.begin >= path_.length()); }),
    result.end());
  return result;
}

std::vector<double> Maker::ringLengths(double from, double to, bool round) const
{
  // One radius apart, in a measure in which the radius is 1.
  constexpr int kParts = 64;
  const double middle = 0.5 * (from + to);
  std::vector<double> measure{ 0.0 };
  for (int k = 0; k < kParts; ++k)
  {
    const double s = from + (k + 0.5) / kParts * (to - from);
    measure.push_back(measure.back() + (to - from) / kParts / path_.radius(s));
  }
  int count = std::max(round ? 3 : 0, int(std::lround(measure.back())));
  count += round ? count % 2 : 0; // turned and unturned rings in turn
  if (count == 0)
  {
    return { middle };
  }
  std::vector<double> result;
  for (int k = 0; k < count + (round ? 0 : 1); ++k)
  {
    const double wanted = measure.back() * k / count;
    const auto above = std::upper_bound(measure.begin() + 1, measure.end() - 1, wanted);
    const double before = *(above - 1);
    const double share =
      double(above - 1 - measure.begin()) + (wanted - before) / (*above - before);
    result.push_back(from + share / kParts * (to - from));
  }
  return result;
}

void Maker::addAxis(double s, const Vec3& direction, double radius)
{
  const auto [base, element] = placed(s);
  cage_.axes.push_back(
    { base, direction, 0.5 * radius, 0.0, kReach * radius, 0.5 * radius, element });
  cage_.radii.push_back(radius);
}

void Maker::addRing(
  double s, const Vec3& across, const Vec3& tangent, double radius, double tilt, double turn)
{
  const Vec3 other = tangent.cross(across);
  for (int k = 0; k < kAround; ++k)
  {
    const double angle = 2.0 * kPi / kAround * (k + turn);
    const Vec3 outward = std::cos(angle) * across + std::sin(angle) * other;
    addAxis(s, std::cos(tilt) * outward + std::sin(tilt) * tangent, radius);
  }
}

/// \param middle between the two.
void Maker::addStrip(std::int32_t ring, std::int32_t next, bool nextIsTurned, double middle)
{
  for (int k = 0; k < kAround; ++k)
  {
    const std::int32_t a = ring + k;
    const std::int32_t b = ring + (k + 1) % kAround;
    const std::int32_t c = next + k;
    const std::int32_t d = next + (k + 1) % kAround;
    // The vertex of the ring that is turned lies between two of the other.
    if (nextIsTurned)
    {
      cage_.triangles.push_back({ a, b, c });
      cage_.triangles.push_back({ b, d, c });
    }
    else
    {
      cage_.triangles.push_back({ a, d, c });
      cage_.triangles.push_back({ a, b, d });
    }
  }
  setElements(middle);
}

void Maker::addCap(std::int32_t ring, std::int32_t pole, bool atEnd, double s)
{
  for (int k = 0; k < kAround; ++k)
  {
    const std::int32_t a = ring + k;
    const std::int32_t b = ring + (k + 1) % kAround;
    cage_.triangles.push_back(atEnd ? Triangle{ a, b, pole } : Triangle{ b, a, pole });
  }
  setElements(s);
}

/// Rings along a run, and at its ends caps. Frames are carried along without turning; on a closed
/// curve what they have turned by in the end is spread over the rings.
void Maker::addRun(const Run& run)
{
  const double first = path_.radius(std::clamp(run.begin, 0.0, path_.length()));
  const double last = path_.radius(std::clamp(run.end, 0.0, path_.length()));
  double from = run.begin;
  double to = run.end;
  if (!run.round)
  {
    // A pole beyond the end of the curve belongs to what it runs into.
    from = path_.closed() ? from : std::max(from, -kCap * first);
    to = path_.closed() ? to : std::min(to, path_.length() + kCap * last);
    const double middle = 0.5 * (from + to);
    from = std::min(from + kCap * first, middle);
    to = std::max(to - kCap * last, middle);
  }
  const std::vector<double> lengths = ringLengths(from, to, run.round);
  std::vector<Vec3> tangents;
  std::vector<Vec3> across;
  for (const double s : lengths)
  {
    const Vec3 tangent = path_.tangent(s, path_.radius(s));
    const Vec3 turned = across.empty()
      ? tangent.unitOrthogonal()
      : Vec3(Eigen::Quaterniond::FromTwoVectors(tangents.back(), tangent) * across.back());
    across.push_back((turned - turned.dot(tangent) * tangent).normalized());
    tangents.push_back(tangent);
  }
  double twist = 0.0; // per ring
  if (run.round)
  {
    const Vec3 arrived =
      Eigen::Quaterniond::FromTwoVectors(tangents.back(), tangents.front()) * across.back();
    const double full =
      std::atan2(across.front().cross(arrived).dot(tangents.front()), across.front().dot(arrived));
    twist = -full / double(lengths.size()) * kAround / (2.0 * kPi);
  }
  const auto begin = std::int32_t(cage_.axes.size());
  const auto count = std::int32_t(lengths.size());
  for (std::int32_t k = 0; k < count; ++k)
  {
    const double s = lengths[k];
    addRing(s, across[k], tangents[k], path_.radius(s), 0.0, 0.5 * (k % 2) + twist * k);
    if (k > 0)
    {
      addStrip(
        begin + (k - 1) * kAround, begin + k * kAround, k % 2 == 1, 0.5 * (lengths[k - 1] + s));
    }
  }
  if (run.round)
  {
    addStrip(
      begin + (count - 1) * kAround, begin, count % 2 == 1, 0.5 * (lengths.back() + run.end));
    return;
  }
  for (const bool atEnd : { false, true })
  {
    const std::int32_t ring = atEnd ? count - 1 : 0;
    const double outward = atEnd ? 1.0 : -1.0;
    const double s = lengths[ring];
    const auto tilted = std::int32_t(cage_.axes.size());
    addRing(s, across[ring], tangents[ring], atEnd ? last : first, outward * 0.25 * kPi,
      0.5 * ((ring + 1) % 2) + twist * ring);
    addAxis(s, outward * tangents[ring], atEnd ? last : first);
    const std::int32_t own = begin + ring * kAround;
    addStrip(atEnd ? own : tilted, atEnd ? tilted : own, (atEnd ? ring + 1 : ring) % 2 == 1, s);
    addCap(tilted, tilted + kAround, atEnd, s);
  }
}

} // namespace

PieceCage curveCage(
  const CurvePiece& piece, const RefinedSkeleton& refined, int level, const PlacedField& field)
{
  const CurvePath path(piece, refined, level);
  return Maker(path, field).make();
}

} // namespace hybridtree
