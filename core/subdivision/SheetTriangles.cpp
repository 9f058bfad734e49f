// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SheetTriangles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr double kEdge = 1.5; // of the cage, in radii
constexpr int kMaxHalvings = 3;

// Corner of a triangle of an earlier step: the first corner of the last of its descendants there.
std::int32_t ancestorCorner(
  const RefinedSkeleton& refined, std::int32_t triangle, int corner, int stepsBefore)
{
  if (stepsBefore == 0)
  {
    return refined.triangles[triangle][corner];
  }
  return refined.triangles[std::size_t(4 * triangle + corner) << (2 * (stepsBefore - 1))][0];
}

double edgePerRadius(const SheetTriangles& sheet)
{
  double length = 0.0;
  double radius = 0.0;
  for (const Triangle& t : sheet.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      length += (sheet.points[t[(k + 1) % 3]] - sheet.points[t[k]]).norm();
      radius += sheet.radii[t[k]];
    }
  }
  return length / radius;
}

SheetTriangles atStep(
  const SurfacePiece& piece, const RefinedSkeleton& refined, int level, int step)
{
  SheetTriangles sheet;
  const auto coarseSegments = std::int32_t(refined.segments.size() >> level);
  std::map<std::int32_t, std::int32_t> number;
  for (const std::int32_t coarse : piece.triangles)
  {
    for (std::int32_t n = 0; n < 1 << (2 * step); ++n)
    {
      Triangle triangle;
      for (int corner = 0; corner < 3; ++corner)
      {
        const std::int32_t point =
          ancestorCorner(refined, (coarse << (2 * step)) + n, corner, level - step);
        const auto [found, isNew] = number.try_emplace(point, std::int32_t(sheet.points.size()));
        if (isNew)
        {
          sheet.points.push_back(refined.points[point]);
          sheet.radii.push_back(refined.radii[point]);
        }
        triangle[corner] = found->second;
      }
      sheet.triangles.push_back(triangle);
      sheet.elements.push_back(coarseSegments + coarse);
    }
  }
  return sheet;
}

SheetTriangles halved(const SheetTriangles& coarse)
{
  SheetTriangles fine{ coarse.points, coarse.radii, {}, {} };
  std::map<std::array<std::int32_t, 2>, std::int32_t> number;
  const auto middle = [&](std::int32_t a, std::int32_t b)
  {
    const std::array<std::int32_t, 2> key{ std::min(a, b), std::max(a, b) };
    const auto [found, isNew] = number.try_emplace(key, std::int32_t(fine.points.size()));
    if (isNew)
    {
      fine.points.push_back(0.5 * (coarse.points[a] + coarse.points[b]));
      fine.radii.push_back(0.5 * (coarse.radii[a] + coarse.radii[b]));
    }
    return found->second;
  };
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t)
  {
    const auto& [a, b, c] = coarse.triangles[t];
    fine.elements.insert(fine.elements.end(), 4, coarse.elements[t]);
    const std::int32_t ab = middle(a, b);
    const std::int32_t bc = middle(b, c);
    const std::int32_t ca = middle(c, a);
    fine.triangles.insert(
      fine.triangles.end(), { { a, ab, ca }, { b, bc, ab }, { c, ca, bc }, { ab, bc, ca } });
  }
  return fine;
}

/// Which corners belong together, and whether their triangles face the same way.
class CornerSets
{
public:
  explicit CornerSets(std::size_t corners) : parent_(corners), turned_(corners, false)
  {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  struct Root
  {
    std::size_t corner;
    bool turned; // against the root
  };

  Root find(std::size_t corner) const
  {
    bool turned = false;
    while (parent_[corner] != corner)
    {
      turned = turned != turned_[corner];
      corner = parent_[corner];
    }
    return { corner, turned };
  }

  void join(std::size_t a, std::size_t b, bool turned)
  {
    const Root rootA = find(a);
    const Root rootB = find(b);
    if (rootA.corner != rootB.corner)
    {
      parent_[rootB.corner] = rootA.corner;
      turned_[rootB.corner] = turned != (rootA.turned != rootB.turned);
    }
  }

private:
  std::vector<std::size_t> parent_;
  std::vector<bool> turned_;
};

struct EdgeSide
{
  std::int32_t triangle;
  int corner; // where it begins
};

using EdgeSides = std::map<std::array<std::int32_t, 2>, std::vector<EdgeSide>>;

EdgeSides edgeSides(const SheetTriangles& sheet)
{
  EdgeSides sides;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = sheet.triangles[t][k];
      const std::int32_t b = sheet.triangles[t][(k + 1) % 3];
      sides[{ std::min(a, b), std::max(a, b) }].push_back({ std::int32_t(t), k });
    }
  }
  return sides;
}

CornerSets joinedCorners(const SheetTriangles& sheet, const EdgeSides& sides)
{
  CornerSets sets(3 * sheet.triangles.size());
  for (const auto& [ends, both] : sides)
  {
    if (both.size() != 2)
    {
      continue;
    }
    const auto corner = [&](const EdgeSide& side, int offset)
    { return std::size_t(3 * side.triangle + (side.corner + offset) % 3); };
    const auto begin = [&](const EdgeSide& side)
    { return sheet.triangles[side.triangle][side.corner]; };
    const bool turned = begin(both[0]) == begin(both[1]);
    sets.join(corner(both[0], 0), corner(both[1], turned ? 0 : 1), turned);
    sets.join(corner(both[0], 1), corner(both[1], turned ? 1 : 0), turned);
  }
  return sets;
}

} // namespace

SheetTriangles sheetOf(const SurfacePiece& piece, const RefinedSkeleton& refined, int level)
{
  SheetTriangles sheet = atStep(piece, refined, level, 0);
  for (int step = 1; step <= level && edgePerRadius(sheet) > kEdge; ++step)
  {
    sheet = atStep(piece, refined, level, step);
  }
  for (int k = 0; k < kMaxHalvings && edgePerRadius(sheet) > kEdge; ++k)
  {
    sheet = halved(sheet);
  }
  return sheet;
}

SheetFans findFans(const SheetTriangles& sheet)
{
  SheetFans result;
  const EdgeSides sides = edgeSides(sheet);
  const CornerSets sets = joinedCorners(sheet, sides);
  std::map<std::size_t, std::int32_t> number;
  std::vector<int> count;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
  {
    const Triangle& triangle = sheet.triangles[t];
    const auto at = [&](int k) -> const Vec3& { return sheet.points[triangle[k % 3]]; };
    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    result.fanOf.emplace_back();
    result.flipped.emplace_back();
    for (int k = 0; k < 3; ++k)
    {
      const CornerSets::Root root = sets.find(3 * t + std::size_t(k));
      const auto [found, isNew] = number.try_emplace(root.corner, std::int32_t(result.fans.size()));
      if (isNew)
      {
        result.fans.push_back({ triangle[k], sheet.elements[t] });
        count.push_back(0);
      }
      const Vec3 u = (at(k + 1) - at(k)).normalized();
      const Vec3 v = (at(k + 2) - at(k)).normalized();
      SheetFan& fan = result.fans[found->second];
      fan.normal += (root.turned ? -1.0 : 1.0) * std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
      fan.inner += (at(0) + at(1) + at(2)) / 3.0;
      ++count[found->second];
      result.fanOf[t][k] = found->second;
      result.flipped[t][k] = root.turned;
    }
  }
  for (const auto& [ends, both] : sides)
  {
    if (both.size() == 1)
    {
      const auto [t, k] = both.front();
      const Triangle& triangle = sheet.triangles[t];
      const Vec3 edge = sheet.points[triangle[(k + 1) % 3]] - sheet.points[triangle[k]];
      const Vec3 other = sheet.points[triangle[(k + 2) % 3]] - sheet.points[triangle[k]];
      const Vec3 outward = edge.cross(edge.cross(other)).normalized();
      for (const std::int32_t fan : { result.fanOf[t][k], result.fanOf[t][(k + 1) % 3] })
      {
        result.fans[fan].outward += outward;
        result.fans[fan].atBorder = true;
      }
      result.borders.push_back({ t, k });
    }
  }
  for (std::size_t k = 0; k < result.fans.size(); ++k)
  {
    result.fans[k].normal.normalize();
    result.fans[k].outward.normalize();
    result.fans[k].inner /= double(count[k]);
  }
  return result;
}

} // namespace hybridtree
