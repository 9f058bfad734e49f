// SPDX-License-Identifier: BSD-3-Clause
// Distance to real scans beside Embree's point queries ([HT] Fig. 7): 100^3 lattice points in the
// unit box, for several radii of influence; scattered single points; building the hierarchy. Both
// sides run one after the other in one process, each the median of a few rounds, on the same
// threads. Then on one thread, by fewer points, CGAL's AABB tree and vtkImplicitPolyDataDistance;
// and ours on two threads beside one.
//
//   MeshDistanceBenchmark [threads, default 1] [rounds, default 3]

#include "benchmarks/support/BenchmarkMesh.h"
#include "benchmarks/support/PeerDistances.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshBvh.h"
#include "core/mesh/MeshDistance.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
int rounds = 3;

template <typename Work>
double seconds(const Work& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> times)
{
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

// Embree as its point query tutorial has it: the caller computes point to triangle.
class EmbreeDistance
{
public:
  EmbreeDistance(const TriangleMesh& mesh, int threads)
  {
    device_ = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
    for (const Vec3& p : mesh.points)
    {
      points_.insert(points_.end(), { float(p.x()), float(p.y()), float(p.z()) });
    }
    points_.push_back(0.0f); // Embree reads 16 bytes at the last point
    for (const Triangle& c : mesh.triangles)
    {
      indices_.insert(indices_.end(), { unsigned(c[0]), unsigned(c[1]), unsigned(c[2]) });
    }
    pointCount_ = mesh.points.size();
  }
  ~EmbreeDistance()
  {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void build()
  {
    if (scene_)
    {
      rtcReleaseScene(scene_);
    }
    scene_ = rtcNewScene(device_);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
      points_.data(), 0, 3 * sizeof(float), pointCount_);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
      indices_.data(), 0, 3 * sizeof(unsigned), indices_.size() / 3);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }

  void distance(PointBatch points, double maxDistance, double* distance) const
  {
    parallelFor(points.size, 4096,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t k = begin; k < end; ++k)
        {
          distance[k] = this->single(points[k], maxDistance);
        }
      });
  }

private:
  using Float3 = Eigen::Vector3f;

  struct Best
  {
    const EmbreeDistance* self;
    float squared;
  };

  // Ericson 2005, 5.1.5, as in Embree's tutorial.
  static Float3 closest(const Float3& p, const Float3& a, const Float3& b, const Float3& c)
  {
    const Float3 ab = b - a, ac = c - a, ap = p - a;
    const float d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.f && d2 <= 0.f)
      return a;
    const Float3 bp = p - b;
    const float d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.f && d4 <= d3)
      return b;
    const Float3 cp = p - c;
    const float d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.f && d5 <= d6)
      return c;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.f && d1 >= 0.f && d3 <= 0.f)
      return a + d1 / (d1 - d3) * ab;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.f && d2 >= 0.f && d6 <= 0.f)
      return a + d2 / (d2 - d6) * ac;
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.f && d4 - d3 >= 0.f && d5 - d6 >= 0.f)
      return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    const float denominator = 1.f / (va + vb + vc);
    return a + vb * denominator * ab + vc * denominator * ac;
  }

  static bool visit(RTCPointQueryFunctionArguments* arguments)
  {
    Best& best = *static_cast<Best*>(arguments->userPtr);
    const EmbreeDistance& self = *best.self;
    const unsigned* c = &self.indices_[3 * arguments->primID];
    const auto at = [&](unsigned k) { return Float3(&self.points_[3 * c[k]]); };
    const Float3 p(arguments->query->x, arguments->query->y, arguments->query->z);
    const float squared = (p - closest(p, at(0), at(1), at(2))).squaredNorm();
    if (squared < best.squared)
    {
      best.squared = squared;
      arguments->query->radius = std::sqrt(squared);
      return true;
    }
    return false;
  }

  double single(const Vec3& p, double maxDistance) const
  {
    RTCPointQuery query;
    query.x = float(p.x());
    query.y = float(p.y());
    query.z = float(p.z());
    query.radius = float(maxDistance);
    query.time = 0.0f;
    Best best{ this, query.radius * query.radius };
    const float limit = best.squared;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &query, &context, visit, &best);
    return best.squared < limit ? std::sqrt(double(best.squared)) : kInfinity;
  }

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::vector<float> points_;
  std::vector<unsigned> indices_;
  std::size_t pointCount_ = 0;
};

struct Cloud
{
  std::vector<double> x, y, z;
  PointBatch batch() const { return { x.data(), y.data(), z.data(), x.size() }; }
};

Cloud lattice(const Box3& box, int side)
{
  Cloud cloud;
  for (int k = 0; k < side * side * side; ++k)
  {
    cloud.x.push_back(box.min().x() + box.sizes().x() * (k % side) / (side - 1));
    cloud.y.push_back(box.min().y() + box.sizes().y() * (k / side % side) / (side - 1));
    cloud.z.push_back(box.min().z() + box.sizes().z() * (k / side / side) / (side - 1));
  }
  return cloud;
}

Cloud scattered(const Box3& box, int count)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Cloud cloud;
  for (int k = 0; k < count; ++k)
  {
    cloud.x.push_back(box.min().x() + box.sizes().x() * unit(random));
    cloud.y.push_back(box.min().y() + box.sizes().y() * unit(random));
    cloud.z.push_back(box.min().z() + box.sizes().z() * unit(random));
  }
  return cloud;
}

void report(const std::string& what, double ours, double peer, double count, double worst,
  const char* peerName = "Embree")
{
  std::printf("  %-34s ours %9.3f us  %s %9.3f us  ratio %6.2f", what.c_str(), 1e6 * ours / count,
    peerName, 1e6 * peer / count, peer / ours);
  if (worst >= 0.0)
  {
    std::printf("  largest difference %.1e", worst);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void queries(const std::string& what, const MeshDistance& ours, const EmbreeDistance& peer,
  PointBatch points, double radius, bool oneByOne)
{
  std::vector<double> mine(points.size), theirs(points.size), myTimes, theirTimes;
  for (int round = 0; round < rounds; ++round)
  {
    myTimes.push_back(seconds(
      [&]
      {
        for (std::size_t k = 0; oneByOne && k < points.size; ++k)
        {
          ours.distance(points.slice(k, 1), radius, &mine[k]);
        }
        if (!oneByOne)
        {
          ours.distance(points, radius, mine.data());
        }
      }));
    theirTimes.push_back(seconds([&] { peer.distance(points, radius, theirs.data()); }));
  }
  double worst = 0.0;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const bool both = std::isfinite(mine[k]) && std::isfinite(theirs[k]);
    const double beyond = std::isfinite(mine[k]) ? mine[k] : theirs[k];
    worst = std::max(worst,
      both                     ? std::abs(mine[k] - theirs[k])
        : mine[k] == theirs[k] ? 0.0
                               : std::abs(beyond - radius)); // one of them at the rim
  }
  report(what, median(myTimes), median(theirTimes), double(points.size), worst);
}

// Every 199th lattice point for the slower peers; ours has the whole lattice, as its users do.
void slowerPeers(const MeshDistance& ours, PointBatch points)
{
  Cloud few;
  for (std::size_t k = 0; k < points.size; k += 199)
  {
    few.x.push_back(points.x[k]);
    few.y.push_back(points.y[k]);
    few.z.push_back(points.z[k]);
  }
  std::vector<double> mine(points.size), theirs(few.x.size());
  const struct
  {
    const char* name;
    hybridtree::benchmark::PeerDistance distance;
  } peers[] = { { "CGAL", hybridtree::benchmark::cgalDistance(*ours.mesh()) },
    { "VTK", hybridtree::benchmark::vtkDistance(*ours.mesh()) } };
  hybridtree::setThreadCount(1);
  for (const auto& peer : peers)
  {
    std::vector<double> myTimes, theirTimes;
    for (int round = 0; round < rounds; ++round)
    {
      myTimes.push_back(seconds([&] { ours.distance(points, kInfinity, mine.data()); }));
      theirTimes.push_back(seconds([&] { peer.distance(few.batch(), theirs.data()); }));
    }
    double worst = 0.0;
    for (std::size_t k = 0; k < theirs.size(); ++k)
    {
      worst = std::max(worst, std::abs(std::abs(theirs[k]) - mine[199 * k]));
    }
    const double perPoint = double(points.size) / double(few.x.size());
    report("unbounded, 1 thread", median(myTimes), perPoint * median(theirTimes),
      double(points.size), worst, peer.name);
  }
}

void twoThreads(const MeshDistance& ours, PointBatch points)
{
  std::vector<double> distance(points.size), times[2];
  for (int round = 0; round < rounds; ++round)
  {
    for (int threads = 1; threads <= 2; ++threads)
    {
      hybridtree::setThreadCount(threads);
      times[threads - 1].push_back(
        seconds([&] { ours.distance(points, kInfinity, distance.data()); }));
    }
  }
  report("unbounded, 2 threads", median(times[1]), median(times[0]), double(points.size), -1.0,
    "1 thread");
}

void compare(const char* name, const std::string& file, std::size_t triangles, int threads)
{
  const MeshPtr mesh = hybridtree::benchmark::benchmarkMesh(file, triangles);
  std::printf("%s: %zu triangles, %d thread%s\n", name, mesh->triangles.size(), threads,
    threads == 1 ? "" : "s");
  const MeshDistance ours(mesh);
  const Cloud grid = lattice(mesh->bounds(), 100);
  // First: an Embree device caps oneTBB's threads for the whole process as long as it lives.
  twoThreads(ours, grid.batch());
  hybridtree::setThreadCount(threads);
  EmbreeDistance peer(*mesh, threads);
  std::vector<double> myBuild, theirBuild;
  for (int round = 0; round < rounds; ++round)
  {
    myBuild.push_back(seconds([&] { const MeshBvh bvh(*mesh); }));
    theirBuild.push_back(seconds([&] { peer.build(); }));
  }
  report("build, whole", median(myBuild), median(theirBuild), 1.0, -1.0);

  queries("100^3, unbounded", ours, peer, grid.batch(), kInfinity, false);
  for (const double radius : { 0.05, 0.1, 0.25 })
  {
    char what[40];
    std::snprintf(what, sizeof what, "100^3, R = %.2f", radius);
    queries(what, ours, peer, grid.batch(), radius, false);
  }
  const Cloud cloud = scattered(mesh->bounds(), 100000);
  queries("scattered, one batch", ours, peer, cloud.batch(), kInfinity, false);
  queries("scattered, one call each", ours, peer, cloud.batch(), kInfinity, true);
  slowerPeers(ours, grid.batch());
}

} // namespace

int main(int argc, char** argv)
{
  const int threads = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1;
  rounds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 3;
  hybridtree::setThreadCount(threads);
  compare("Bunny", "stanford_bunny.obj", 69451, threads);
  compare("Igea", "igea.ply", 268686, threads);
  return 0;
}
