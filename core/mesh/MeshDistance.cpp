// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshDistance.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/geometry/PointTriangle.h"
#include "core/mesh/KnownSides.h"
#include "core/mesh/MeshBvh.h"
#include "core/mesh/MeshSide.h"
#include "core/mesh/NearestKernels.h"
#include "core/mesh/PointOrder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <unordered_map>

namespace hybridtree
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kParallelGrain = 1024;
constexpr std::size_t kMostRoots = 8;
constexpr std::size_t kUnordered = 16; // points that go down the hierarchy as they come

struct Hit
{
  double squared = kInfinity;
  std::int32_t triangle = -1;
};

struct Entry
{
  double squared;
  std::uint32_t ref;
};

double squaredDistance(
  const MeshBvh::Node& node, std::size_t k, const Vec3& lower, const Vec3& upper)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double below = double(node.lower[axis][k]) - upper[axis];
    const double above = lower[axis] - double(node.upper[axis][k]);
    const double gap = std::max({ below, above, 0.0 });
    sum += gap * gap;
  }
  return sum;
}

// One point at a time; spares the few callers that have but one the arrays.
Hit nearestOf(const TriangleMesh& mesh, const MeshBvh& bvh, const Vec3& p)
{
  Hit hit;
  const PointBatch one{ &p.x(), &p.y(), &p.z(), 1 };
  findNearest({ &mesh, &bvh, nullptr, one, nullptr, 1, kInfinity }, &hit.squared, &hit.triangle);
  return hit;
}

NearestOnTriangle nearestPoint(const TriangleMesh& mesh, const Vec3& p, std::int32_t triangle)
{
  const Triangle& c = mesh.triangles[std::size_t(triangle)];
  return nearestOnTriangle(p, mesh.points[std::size_t(c[0])], mesh.points[std::size_t(c[1])],
    mesh.points[std::size_t(c[2])]);
}

} // namespace

MeshDistance::MeshDistance(MeshPtr mesh) : mesh_(std::move(mesh))
{
  if (!mesh_ || mesh_->empty())
  {
    throw InvalidGeometry("The mesh has no triangles: there is nothing to measure a distance to.");
  }
  bounds_ = mesh_->bounds();
  bvh_ = std::make_unique<const MeshBvh>(*mesh_);
  side_ = std::make_unique<const MeshSide>(*mesh_, *bvh_);
}

MeshDistance::~MeshDistance() = default;

// Squared distances and triangles of all points, sixteen neighbours at a time.
void MeshDistance::find(PointBatch points, double maxDistance, const MeshPart* part,
  double* squared, std::int32_t* triangle) const
{
  NearestQuery query{ mesh_.get(), bvh_.get(), part ? &part->roots : nullptr, points, nullptr, 0,
    maxDistance };
  if (points.size <= kUnordered)
  {
    query.count = points.size;
    findNearest(query, squared, triangle);
    return;
  }
  std::vector<std::uint32_t> order;
  orderAlongCurve(points, order);
  parallelFor(points.size, kParallelGrain,
    [&](std::size_t begin, std::size_t end)
    {
      NearestQuery mine = query;
      mine.order = order.data() + begin;
      mine.count = end - begin;
      findNearest(mine, squared, triangle);
    });
}

void MeshDistance::distance(
  PointBatch points, double maxDistance, double* distance, const MeshPart* part) const
{
  if (points.size == 1)
  {
    std::int32_t triangle;
    this->find(points, maxDistance, part, distance, &triangle);
    *distance = std::sqrt(*distance);
    return;
  }
  std::vector<std::int32_t> triangle(points.size);
  this->find(points, maxDistance, part, distance, triangle.data());
  for (std::size_t k = 0; k < points.size; ++k)
  {
    distance[k] = std::sqrt(distance[k]);
  }
}

void MeshDistance::nearest(PointBatch points, double maxDistance, double* distance,
  std::int32_t* triangle, VectorBatch nearestPoint, const MeshPart* part) const
{
  this->find(points, maxDistance, part, distance, triangle);
  parallelFor(points.size, kParallelGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        distance[k] = std::sqrt(distance[k]);
        nearestPoint.set(k,
          triangle[k] >= 0 ? hybridtree::nearestPoint(*mesh_, points[k], triangle[k]).point
                           : Vec3(kNaN, kNaN, kNaN));
      }
    });
}

// Where no triangle is within reach. The ball around p is made as large as it can be: it may answer
// for many.
int MeshDistance::sideFarAway(const Vec3& p, KnownSides& known) const
{
  if (this->isClosed() && !bounds_.contains(p))
  {
    return -1;
  }
  int side = known.find(p);
  if (side == 0)
  {
    double winding = 0.0;
    side = side_->side(p, &winding);
    known.add(p, std::sqrt(nearestOf(*mesh_, *bvh_, p).squared), side, winding);
  }
  return side;
}

void MeshDistance::signedDistance(PointBatch points, double maxDistance, double* distance,
  VectorBatch gradient, const MeshPart* part) const
{
  std::vector<std::int32_t> triangle(points.size);
  this->find(points, maxDistance, part, distance, triangle.data());
  parallelFor(points.size, kParallelGrain,
    [&](std::size_t begin, std::size_t end)
    {
      KnownSides known(*side_);
      for (std::size_t k = begin; k < end; ++k)
      {
        const Vec3 p = points[k];
        Vec3 direction = Vec3::Zero();
        if (triangle[k] < 0)
        {
          distance[k] = this->sideFarAway(p, known) > 0 ? -kInfinity : kInfinity;
        }
        else
        {
          const NearestOnTriangle nearest = hybridtree::nearestPoint(*mesh_, p, triangle[k]);
          distance[k] = std::sqrt(distance[k]);
          int side = side_->isCostly() ? known.find(p) : 0;
          if (side == 0)
          {
            double winding = 0.0;
            side = side_->side(p, triangle[k], nearest, &winding);
            if (side_->isCostly())
            {
              known.add(p, distance[k], side, winding);
            }
          }
          distance[k] *= -side;
          direction = side_->gradient(p, side, triangle[k], nearest);
        }
        if (gradient.x)
        {
          gradient.set(k, direction);
        }
      }
    });
}

void MeshDistance::side(PointBatch points, std::int8_t* side) const
{
  std::vector<double> squared(points.size);
  std::vector<std::int32_t> triangle(points.size);
  this->find(points, kInfinity, nullptr, squared.data(), triangle.data());
  parallelFor(points.size, kParallelGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        const Vec3 p = points[k];
        const int found = triangle[k] < 0
          ? side_->side(p)
          : side_->side(p, triangle[k], nearestPoint(*mesh_, p, triangle[k]));
        side[k] = std::int8_t(found);
      }
    });
}

Interval MeshDistance::range(const Box3& box) const
{
  const Vec3 center = box.center();
  const double half = 0.5 * box.diagonal().norm();
  const double middle = std::sqrt(nearestOf(*mesh_, *bvh_, center).squared);
  const double slack = 1e-12 * (middle + half);
  return { std::max(0.0, middle - half - slack), middle + half + slack };
}

Interval MeshDistance::signedRange(const Box3& box) const
{
  const Vec3 center = box.center();
  const double half = 0.5 * box.diagonal().norm();
  const Hit hit = nearestOf(*mesh_, *bvh_, center);
  const double middle = std::sqrt(hit.squared);
  const double reach = half + 1e-12 * (middle + half);
  bool oneSide = this->isClosed();
  bool inside = false;
  if (oneSide)
  {
    inside = side_->side(center, hit.triangle, nearestPoint(*mesh_, center, hit.triangle)) > 0;
  }
  else if (middle > reach)
  {
    const double winding = side_->windingNumber(center);
    inside = winding > 0.5;
    oneSide = std::abs(winding - 0.5) >
      reach * side_->windingSlope(middle - reach) + MeshSide::kWindingError;
  }
  if (!oneSide)
  {
    return { -middle - reach, middle + reach };
  }
  const double signedMiddle = inside ? -middle : middle;
  return { signedMiddle - reach, signedMiddle + reach };
}

MeshPart MeshDistance::restrictedTo(const Box3& box, double maxDistance) const
{
  return this->within(box, std::min(maxDistance, this->range(box).max));
}

MeshPart MeshDistance::within(const Box3& box, double maxDistance) const
{
  const double limit = maxDistance * bvh_->scale() * (1.0 + 1e-6);
  const Vec3 lower = bvh_->toLocal(box.min());
  const Vec3 upper = bvh_->toLocal(box.max());
  const double margin =
    1e-6 * (1.0 + std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff()));
  const double squaredLimit = (limit + margin) * (limit + margin);
  std::vector<Entry> open{ { 0.0, 0 } };
  std::vector<Entry> leaves;
  // Breadth first, so that a box far away, to which much is almost equally near, stays cheap.
  for (std::size_t next = 0; next < open.size(); ++next)
  {
    if (leaves.size() + (open.size() - next) > kMostRoots)
    {
      leaves.insert(leaves.end(), open.begin() + std::ptrdiff_t(next), open.end());
      break;
    }
    const MeshBvh::Node& node = bvh_->nodes()[open[next].ref];
    for (std::size_t k = 0; k < MeshBvh::kWidth && node.child[k] != MeshBvh::kNone; ++k)
    {
      const double squared = squaredDistance(node, k, lower, upper);
      if (squared <= squaredLimit)
      {
        (node.child[k] & MeshBvh::kLeafBit ? leaves : open).push_back({ squared, node.child[k] });
      }
    }
  }
  std::sort(leaves.begin(), leaves.end(),
    [](const Entry& a, const Entry& b) { return a.squared < b.squared; });
  MeshPart part;
  for (const Entry& entry : leaves)
  {
    part.roots.push_back(entry.ref);
  }
  return part;
}

bool MeshDistance::isClosed() const
{
  return side_->isClosed();
}

const std::vector<Vec3>& MeshDistance::vertexNormals() const
{
  return side_->vertexNormals();
}

std::vector<std::string> MeshDistance::warnings() const
{
  if (this->isClosed())
  {
    return {};
  }
  const HalfEdges& edges = side_->edges();
  return { "The mesh is not a closed surface (" + std::to_string(edges.openEdges) +
    " open edges, " + std::to_string(edges.nonManifoldEdges) +
    " edges of more than two triangles, " + std::to_string(edges.flippedEdges) +
    " edges whose triangles disagree): its inside is found by the winding number, and the field "
    "jumps across the holes." };
}

std::shared_ptr<const MeshDistance> sharedMeshDistance(const MeshPtr& mesh)
{
  struct Kept
  {
    std::mutex mutex; // held while building: who wants the same hierarchy waits for it
    std::weak_ptr<const TriangleMesh> mesh;
    std::weak_ptr<const MeshDistance> distance;
  };
  static std::mutex mutex;
  static std::unordered_map<const TriangleMesh*, std::shared_ptr<Kept>> cache;

  std::shared_ptr<Kept> kept;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    for (auto entry = cache.begin(); entry != cache.end();)
    {
      entry = entry->second->mesh.expired() ? cache.erase(entry) : std::next(entry);
    }
    std::shared_ptr<Kept>& slot = cache[mesh.get()];
    if (!slot)
    {
      slot = std::make_shared<Kept>();
      slot->mesh = mesh;
    }
    kept = slot;
  }
  const std::lock_guard<std::mutex> lock(kept->mutex);
  std::shared_ptr<const MeshDistance> distance = kept->distance.lock();
  if (!distance)
  {
    distance = std::make_shared<const MeshDistance>(mesh);
    kept->distance = distance;
  }
  return distance;
}

} // namespace hybridtree
