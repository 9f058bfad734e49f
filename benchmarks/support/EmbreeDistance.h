// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Parallel.h"
#include "core/mesh/TriangleMesh.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace hybridtree::benchmark
{

/// Embree as its point query tutorial has it: the caller computes point to triangle. Holds oneTBB
/// to its own number of threads while it lives.
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
    return best.squared < limit ? std::sqrt(double(best.squared))
                                : std::numeric_limits<double>::infinity();
  }

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::vector<float> points_;
  std::vector<unsigned> indices_;
  std::size_t pointCount_ = 0;
};

} // namespace hybridtree::benchmark
