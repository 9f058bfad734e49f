// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceCage.h"

#include "core/subdivision/SheetTriangles.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr double kReach = 1.6;  // of an axis, in radii
constexpr double kShift = 0.25; // of a base that is outside, at a time, in radii
constexpr int kMaxShifts = 8;
constexpr double kInside = 1.02 * kThreshold; // where axes may begin

/// Where the axes of each fan begin; not finite where the sheet has no inside.
std::vector<Vec3> findBases(
  const SheetTriangles& sheet, const SheetFans& fans, const PlacedField& field)
{
  std::vector<Vec3> bases(fans.fans.size());
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < bases.size(); ++k)
  {
    bases[k] = sheet.points[fans.fans[k].point];
    open.push_back(k);
  }
  for (int shift = 0; shift <= kMaxShifts && !open.empty(); ++shift)
  {
    std::vector<PlacedPoint> asked;
    for (const std::size_t k : open)
    {
      const SheetFan& fan = fans.fans[k];
      const Vec3 way = fan.inner - sheet.points[fan.point];
      const double length = way.norm();
      const double wanted = shift * kShift * sheet.radii[fan.point];
      bases[k] = sheet.points[fan.point] + std::min(1.0, wanted / length) * way;
      asked.push_back({ bases[k], fan.element });
    }
    const std::vector<double> values = fieldAt(field, asked);
    std::vector<std::size_t> stillOpen;
    for (std::size_t n = 0; n < open.size(); ++n)
    {
      if (!(values[n] >= kInside))
      {
        stillOpen.push_back(open[n]);
      }
    }
    open = std::move(stillOpen);
  }
  for (const std::size_t k : open)
  {
    bases[k].setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return bases;
}

/// Leaves out triangles at fans that have no inside. \return whether there were any.
bool dropOutside(SheetTriangles& sheet, const SheetFans& fans, const std::vector<Vec3>& bases)
{
  std::vector<Triangle> kept;
  std::vector<std::int32_t> elements;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
  {
    const auto& corners = fans.fanOf[t];
    if (std::all_of(corners.begin(), corners.end(), [&](auto k) { return bases[k].allFinite(); }))
    {
      kept.push_back(sheet.triangles[t]);
      elements.push_back(sheet.elements[t]);
    }
  }
  const bool dropped = kept.size() < sheet.triangles.size();
  sheet.triangles = std::move(kept);
  sheet.elements = std::move(elements);
  return dropped;
}

class Maker
{
public:
  Maker(const SheetTriangles& sheet, const SheetFans& fans, const std::vector<Vec3>& bases)
    : sheet_(sheet), fans_(fans)
  {
    for (std::size_t k = 0; k < fans.fans.size(); ++k)
    {
      const SheetFan& fan = fans.fans[k];
      const auto add = [&](const Vec3& direction)
      { return addAxis(bases[k], direction, sheet.radii[fan.point], fan.element); };
      vertices_.push_back({ add(fan.normal), add(-fan.normal), -1 });
      if (fan.atBorder)
      {
        vertices_.back().rim = add(fan.outward);
      }
    }
  }

  PieceCage make()
  {
    for (std::size_t t = 0; t < sheet_.triangles.size(); ++t)
    {
      cage_.triangles.push_back({ above(t, 0), above(t, 1), above(t, 2) });
      cage_.triangles.push_back({ below(t, 0), below(t, 2), below(t, 1) });
      cage_.elements.resize(cage_.triangles.size(), sheet_.elements[t]);
    }
    for (const auto& [t, begin] : fans_.borders)
    {
      const int end = (begin + 1) % 3;
      const std::int32_t rimBegin = vertices_[fans_.fanOf[t][begin]].rim;
      const std::int32_t rimEnd = vertices_[fans_.fanOf[t][end]].rim;
      cage_.triangles.push_back({ above(t, end), above(t, begin), rimBegin });
      cage_.triangles.push_back({ above(t, end), rimBegin, rimEnd });
      cage_.triangles.push_back({ below(t, begin), below(t, end), rimEnd });
      cage_.triangles.push_back({ below(t, begin), rimEnd, rimBegin });
      cage_.elements.resize(cage_.triangles.size(), sheet_.elements[t]);
    }
    return std::move(cage_);
  }

private:
  struct Vertices
  {
    std::int32_t along; // the normal of the fan
    std::int32_t against;
    std::int32_t rim;
  };

  std::int32_t addAxis(const Vec3& base, const Vec3& direction, double radius, std::int32_t element)
  {
    cage_.axes.push_back(
      { base, direction, 0.5 * radius, 0.0, kReach * radius, 0.5 * radius, element });
    cage_.radii.push_back(radius);
    return std::int32_t(cage_.axes.size() - 1);
  }

  // On the side to which the triangle's own normal points, and on the other.
  std::int32_t above(std::size_t t, int corner) const
  {
    const Vertices& fan = vertices_[fans_.fanOf[t][corner]];
    return fans_.flipped[t][corner] ? fan.against : fan.along;
  }
  std::int32_t below(std::size_t t, int corner) const
  {
    const Vertices& fan = vertices_[fans_.fanOf[t][corner]];
    return fans_.flipped[t][corner] ? fan.along : fan.against;
  }

  const SheetTriangles& sheet_;
  const SheetFans& fans_;
  std::vector<Vertices> vertices_;
  PieceCage cage_;
};

} // namespace

PieceCage surfaceCage(
  const SurfacePiece& piece, const RefinedSkeleton& refined, int level, const PlacedField& field)
{
  SheetTriangles sheet = sheetOf(piece, refined, level);
  SheetFans fans = findFans(sheet);
  std::vector<Vec3> bases = findBases(sheet, fans, field);
  while (dropOutside(sheet, fans, bases))
  {
    fans = findFans(sheet);
    bases = findBases(sheet, fans, field);
  }
  return Maker(sheet, fans, bases).make();
}

} // namespace hybridtree
