// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/EstimateNormals.h"

#include "reconstruction/ParallelSort.h"
#include "reconstruction/PointCloud.h"

#include "core/base/Parallel.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace hybridtree
{
namespace
{

constexpr int kNeighbors = 12;
constexpr std::size_t kGrain = 1024;

Vec3 fittedNormal(const std::vector<Vec3>& points, std::size_t point, const std::int32_t* neighbors)
{
  Vec3 center = points[point];
  for (int k = 0; k < kNeighbors; ++k)
  {
    center += points[neighbors[k]];
  }
  center /= kNeighbors + 1;
  const Vec3 own = points[point] - center;
  Mat3 spread = own * own.transpose();
  for (int k = 0; k < kNeighbors; ++k)
  {
    const Vec3 other = points[neighbors[k]] - center;
    spread += other * other.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(0); // of the least spread
}

/// Two neighbours and how far their planes are from parallel, 0 to 1.
struct Bend
{
  float size;
  std::int32_t a;
  std::int32_t b;
  bool operator<(const Bend& other) const
  {
    return std::tie(size, a, b) < std::tie(other.size, other.a, other.b);
  }
};

/// Disjoint sets whose members know whether they are turned against their set's first.
class TurnedSets
{
public:
  explicit TurnedSets(std::size_t size) : parent_(size), turned_(size, 0)
  {
    std::iota(parent_.begin(), parent_.end(), std::int32_t(0));
  }

  bool isTurned(std::int32_t member) { return this->rootOf(member).second; }

  /// Joins the sets of a and b such that the two are turned against each other, or alike.
  void join(std::int32_t a, std::int32_t b, bool against)
  {
    const auto [rootA, turnedA] = this->rootOf(a);
    const auto [rootB, turnedB] = this->rootOf(b);
    if (rootA != rootB)
    {
      parent_[std::max(rootA, rootB)] = std::min(rootA, rootB);
      turned_[std::max(rootA, rootB)] = turnedA != turnedB ? !against : against;
    }
  }

private:
  std::pair<std::int32_t, bool> rootOf(std::int32_t member)
  {
    bool turned = false;
    while (parent_[member] != member)
    {
      const std::int32_t parent = parent_[member];
      turned_[member] = turned_[member] != turned_[parent]; // of the grandparent
      parent_[member] = parent_[parent];
      turned = turned != bool(turned_[member]);
      member = parent_[member];
    }
    return { member, turned };
  }

  std::vector<std::int32_t> parent_;
  std::vector<std::uint8_t> turned_; ///< against the parent
};

std::vector<Bend> bendsOf(
  const std::vector<Vec3>& normals, const std::vector<std::int32_t>& neighbors)
{
  std::vector<Bend> bends(neighbors.size());
  parallelFor(normals.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin * kNeighbors; k < end * kNeighbors; ++k)
      {
        const auto a = static_cast<std::int32_t>(k / kNeighbors);
        const std::int32_t b = neighbors[k];
        const double size = 1.0 - std::abs(normals[a].dot(normals[b]));
        bends[k] = { static_cast<float>(size), std::min(a, b), std::max(a, b) };
      }
    });
  return bends;
}

void chooseSide(const std::vector<Vec3>& points, std::vector<Vec3>& normals)
{
  constexpr double kTelling = 0.2; // share of the points' distances from their middle
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : points)
  {
    middle += p / double(points.size());
  }
  double outward = 0.0;
  double reach = 0.0;
  Vec3 way = Vec3::Zero();
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Vec3 arm = points[k] - middle;
    outward += normals[k].dot(arm);
    reach += arm.norm();
    way += normals[k];
  }
  int axis = 0;
  way.cwiseAbs().maxCoeff(&axis);
  const double side = std::abs(outward) > kTelling * reach ? outward : way[axis];
  for (Vec3& normal : normals)
  {
    normal = side < 0.0 ? Vec3(-normal) : normal;
  }
}

} // namespace

std::vector<Vec3> estimateNormals(const std::vector<Vec3>& points, const Progress& progress)
{
  if (points.size() <= static_cast<std::size_t>(kNeighbors))
  {
    return {};
  }
  const std::vector<std::int32_t> neighbors =
    nearestNeighbors(points, kNeighbors, ProgressPart(progress, 0.0, 0.5));
  std::vector<Vec3> normals(points.size());
  parallelFor(points.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        normals[k] = fittedNormal(points, k, neighbors.data() + k * kNeighbors);
      }
    });
  std::vector<Bend> bends = bendsOf(normals, neighbors);
  parallelSort(bends, progress);
  TurnedSets sets(points.size());
  for (const Bend& bend : bends)
  {
    sets.join(bend.a, bend.b, normals[bend.a].dot(normals[bend.b]) < 0.0);
  }
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    normals[k] = sets.isTurned(static_cast<std::int32_t>(k)) ? Vec3(-normals[k]) : normals[k];
  }
  chooseSide(points, normals);
  return normals;
}

} // namespace hybridtree
