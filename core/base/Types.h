// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace hybridtree
{

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Box3 = Eigen::AlignedBox3d;
using Affine3 = Eigen::Affine3d;

/// Threshold of every surface: S = { p | f(p) = T }, inside is f(p) > T ([HT] 3).
inline constexpr double kThreshold = 0.5;

/// Closed interval of reals, used for conservative bounds.
struct Interval
{
  double min = 0.0;
  double max = 0.0;

  bool contains(double value) const { return min <= value && value <= max; }
};

inline Interval operator+(Interval a, Interval b)
{
  return { a.min + b.min, a.max + b.max };
}

/// Points as a structure of arrays: point k is (x[k], y[k], z[k]), k < size.
/// A view: it owns nothing and has no alignment requirement.
struct PointBatch
{
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;
  std::size_t size = 0;

  Vec3 operator[](std::size_t k) const { return { x[k], y[k], z[k] }; }
  PointBatch slice(std::size_t begin, std::size_t count) const
  {
    return { x + begin, y + begin, z + begin, count };
  }
};

/// Vectors to be written, laid out as PointBatch; its size is that of the points beside it.
struct VectorBatch
{
  double* x = nullptr;
  double* y = nullptr;
  double* z = nullptr;

  Vec3 operator[](std::size_t k) const { return { x[k], y[k], z[k] }; }
  void set(std::size_t k, const Vec3& v) const
  {
    x[k] = v.x();
    y[k] = v.y();
    z[k] = v.z();
  }
  VectorBatch slice(std::size_t begin) const { return { x + begin, y + begin, z + begin }; }
};

/// Scale s of a similarity (rotation or reflection times s, plus translation); empty when the
/// linear part stretches directions differently by more than 1e-12 relative.
std::optional<double> similarityScale(const Affine3& map);

/// Axis-aligned bounds of the image of a box; empty stays empty.
Box3 transformed(const Box3& box, const Affine3& map);

} // namespace hybridtree
