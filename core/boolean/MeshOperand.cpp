// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/MeshOperand.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/boolean/FlatTriangles.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <unordered_map>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 1 << 15;
constexpr double kLargest = 1e60; // six factors of it are still a double
constexpr double kUnit = double(1 << 20);
constexpr double kRounding = 0x1p-48;
constexpr double kFlat = 16.0;     // roundings that are the height of a triangle without one
constexpr double kSharpest = 1e-3; // of an error quadric's largest eigenvalue
constexpr double kFarthest = 8.0;

std::uint64_t mixed(std::uint64_t low, std::uint64_t high)
{
  std::uint64_t z = (low << 32 | high) * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 32)) * 0xd6e8feb86659fd93ull;
  return z ^ (z >> 32);
}

// Whether every edge is run along as often one way as the other: by the sum of a 64 bit hash of
// each edge, which another mesh has with a chance of one in 2^64.
bool isClosed(const std::vector<Triangle>& triangles)
{
  std::atomic<std::uint64_t> sum{ 0 };
  parallelFor(triangles.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      std::uint64_t part = 0;
      for (std::size_t t = begin; t < end; ++t)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          const std::uint64_t from = std::uint64_t(triangles[t][k]);
          const std::uint64_t to = std::uint64_t(triangles[t][(k + 1) % 3]);
          part += from < to ? mixed(from, to) : -mixed(to, from);
        }
      }
      sum += part;
    });
  return sum == 0;
}

using Edge = std::array<std::int32_t, 2>;

// The edges that run one way more often than the other, turned, as often as they are missing.
std::vector<Edge> missingEdges(const std::vector<Triangle>& triangles)
{
  struct Use
  {
    std::int32_t low, high, direction;
  };
  std::vector<Use> uses;
  uses.reserve(3 * triangles.size());
  for (const Triangle& corner : triangles)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int32_t from = corner[k];
      const std::int32_t to = corner[(k + 1) % 3];
      uses.push_back({ std::min(from, to), std::max(from, to), from < to ? 1 : -1 });
    }
  }
  const auto before = [](const Use& a, const Use& b)
  { return a.low != b.low ? a.low < b.low : a.high < b.high; };
  std::sort(uses.begin(), uses.end(), before);
  std::vector<Edge> missing;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
  {
    int sum = 0;
    for (; end < uses.size() && !before(uses[begin], uses[end]); ++end)
    {
      sum += uses[end].direction;
    }
    const Edge edge = sum > 0 ? Edge{ uses[begin].high, uses[begin].low }
                              : Edge{ uses[begin].low, uses[begin].high };
    missing.insert(missing.end(), std::size_t(std::abs(sum)), edge);
  }
  return missing;
}

// A boundary has none itself: as many edges leave a point as arrive, so they make loops. Each is
// cut off where it comes to a point for the second time.
std::vector<std::vector<std::int32_t>> loopsOf(const std::vector<Edge>& edges)
{
  std::unordered_map<std::int32_t, std::vector<std::int32_t>> leaving;
  for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge)
  {
    leaving[(*edge)[0]].push_back((*edge)[1]);
  }
  std::vector<std::vector<std::int32_t>> loops;
  for (const Edge& edge : edges)
  {
    std::vector<std::int32_t> way{ edge[0] };
    std::unordered_map<std::int32_t, std::size_t> place{ { edge[0], 0 } };
    for (std::int32_t at = edge[0]; !leaving[at].empty();)
    {
      std::vector<std::int32_t>& next = leaving[at];
      at = next.back();
      next.pop_back();
      const auto [met, isNew] = place.try_emplace(at, way.size());
      if (isNew)
      {
        way.push_back(at);
        continue;
      }
      const auto first = way.begin() + std::ptrdiff_t(met->second);
      loops.emplace_back(first, way.end());
      std::for_each(first + 1, way.end(), [&](std::int32_t point) { place.erase(point); });
      way.erase(first + 1, way.end());
    }
  }
  return loops;
}

MeshPtr closedMesh(const TriangleMesh& mesh)
{
  auto closed = std::make_shared<TriangleMesh>();
  closed->points = mesh.points;
  closed->triangles = mesh.triangles;
  for (const std::vector<std::int32_t>& loop : loopsOf(missingEdges(mesh.triangles)))
  {
    Vec3 middle = Vec3::Zero();
    double length = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      const Vec3& from = mesh.points[std::size_t(loop[k])];
      const Vec3& to = mesh.points[std::size_t(loop[(k + 1) % loop.size()])];
      middle += 0.5 * (from + to) * (to - from).norm();
      length += (to - from).norm();
    }
    const std::int32_t center = std::int32_t(closed->points.size());
    if (loop.size() == 3)
    {
      closed->triangles.push_back({ loop[0], loop[1], loop[2] });
      continue;
    }
    closed->points.push_back(length > 0.0 ? Vec3(middle / length) : mesh.points[loop[0]]);
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      closed->triangles.push_back({ center, loop[k], loop[(k + 1) % loop.size()] });
    }
  }
  return closed;
}

// Returns the largest.
double checkCoordinates(const TriangleMesh& mesh)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    const double size = mesh.points[k].cwiseAbs().maxCoeff();
    largest = std::max(largest, size);
    if (!(size <= kLargest))
    {
      throw InvalidGeometry("Point " + std::to_string(k) +
        " of an operand has a coordinate that is above 1e60 or not finite. Scale the model, or "
        "repair the point.");
    }
  }
  return largest;
}

} // namespace

MeshOperand::MeshOperand(MeshPtr mesh) : original_(std::move(mesh)), mesh_(original_)
{
  rounding_ = kRounding * checkCoordinates(*original_);
  if (!isClosed(original_->triangles))
  {
    mesh_ = closedMesh(*original_);
  }
  this->makeTree();
}

MeshOperand::MeshOperand(MeshPtr original, MeshPtr closed)
  : original_(std::move(original)), mesh_(std::move(closed))
{
  rounding_ = kRounding * checkCoordinates(*mesh_);
  this->makeTree();
}

// Boxes of surfaces that count as one are to meet.
void MeshOperand::makeTree()
{
  if (!mesh_->empty())
  {
    tree_ = std::make_unique<const BoxTree>(*mesh_, rounding_);
  }
}

// The way w with w n = 1 for all normals n around a point, or the nearest to that, as with the
// error quadrics of Garland and Heckbert: by the sums of n n^T and of n.
Vec3 wayOut(const Mat3& sum, const Vec3& right)
{
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(sum);
  Vec3 way = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 axis = solver.eigenvectors().col(k);
    const double value = solver.eigenvalues()[k];
    if (value > kSharpest * solver.eigenvalues()[2])
    {
      way += axis.dot(right) / value * axis;
    }
  }
  const double length = way.norm();
  return length > kFarthest ? Vec3(way * (kFarthest / length)) : way;
}

// The normals of flat triangles tell nothing: they are left out.
MeshOperand MeshOperand::swollen(double distance) const
{
  const auto forEachCorner = [this](auto&& visit)
  {
    for (const Triangle& c : mesh_->triangles)
    {
      const auto at = [&](std::size_t k) -> const Vec3&
      { return mesh_->points[std::size_t(c[k % 3])]; };
      if (isFlat(at(0), at(1), at(2), kFlat * rounding_))
      {
        continue;
      }
      const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      for (std::size_t k = 0; k < 3; ++k)
      {
        const Vec3 u = at(k + 1) - at(k);
        const Vec3 v = at(k + 2) - at(k);
        visit(std::size_t(c[k]), normal, std::atan2(u.cross(v).norm(), u.dot(v)));
      }
    }
  };
  std::vector<Mat3> normals(mesh_->points.size(), Mat3::Zero());
  std::vector<Vec3> way(mesh_->points.size(), Vec3::Zero());
  forEachCorner(
    [&](std::size_t point, const Vec3& normal, double angle)
    {
      way[point] += angle * normal;
      normals[point] += angle * normal * normal.transpose();
    });
  auto moved = std::make_shared<TriangleMesh>();
  moved->triangles = mesh_->triangles;
  moved->points = mesh_->points;
  for (std::size_t k = 0; k < way.size(); ++k)
  {
    moved->points[k] += distance * wayOut(normals[k], way[k]);
  }
  return MeshOperand(original_, std::move(moved));
}

Vec3 MeshOperand::outward(std::int32_t vertex) const
{
  std::call_once(once_, [this] { this->makeOutward(); });
  return outward_[std::size_t(vertex)];
}

void MeshOperand::makeOutward() const
{
  outward_.assign(mesh_->points.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh_->triangles.size(); ++t)
  {
    const Triangle& corner = mesh_->triangles[t];
    const Vec3 normal = areaNormal(*mesh_, t).normalized();
    if (!normal.allFinite())
    {
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Vec3& apex = mesh_->points[std::size_t(corner[k])];
      const Vec3 a = mesh_->points[std::size_t(corner[(k + 1) % 3])] - apex;
      const Vec3 b = mesh_->points[std::size_t(corner[(k + 2) % 3])] - apex;
      outward_[std::size_t(corner[k])] += std::atan2(a.cross(b).norm(), a.dot(b)) * normal;
    }
  }
  for (Vec3& n : outward_)
  {
    const double length = n.norm();
    n = length > 0.0 ? Vec3((n * (kUnit / length)).array().round()) : Vec3::Zero();
  }
}

} // namespace hybridtree
