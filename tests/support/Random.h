// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cmath>
#include <random>
#include <vector>

namespace hybridtree::test
{

/// Seeded random numbers that are the same with every standard library.
class Random
{
public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * this->unit(); }
  /// In [low, high], both included.
  int integer(int low, int high)
  {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double probability) { return this->unit() < probability; }
  std::uint64_t bits() { return engine_(); }

  Vec3 inBox(const Box3& box)
  {
    return box.min() +
      Vec3(this->unit(), this->unit(), this->unit()).cwiseProduct(Vec3(box.max() - box.min()));
  }
  /// Of length 1, all directions alike.
  Vec3 direction()
  {
    for (;;)
    {
      const Vec3 v(this->uniform(-1.0, 1.0), this->uniform(-1.0, 1.0), this->uniform(-1.0, 1.0));
      const double length = v.norm();
      if (length > 0.1 && length <= 1.0)
      {
        return v / length;
      }
    }
  }
  Mat3 rotation()
  {
    return Eigen::AngleAxisd(this->uniform(0.0, 2.0 * std::acos(-1.0)), this->direction())
      .toRotationMatrix();
  }

private:
  std::mt19937_64 engine_;
};

/// Points that own their memory, in the layout the queries take.
class PointList
{
public:
  PointList() = default;
  explicit PointList(const std::vector<Vec3>& points)
  {
    for (const Vec3& point : points)
    {
      this->add(point);
    }
  }

  void add(const Vec3& point)
  {
    x_.push_back(point.x());
    y_.push_back(point.y());
    z_.push_back(point.z());
  }
  std::size_t size() const { return x_.size(); }
  Vec3 operator[](std::size_t k) const { return { x_[k], y_[k], z_[k] }; }
  PointBatch batch() const { return { x_.data(), y_.data(), z_.data(), x_.size() }; }
  operator PointBatch() const { return this->batch(); }

private:
  std::vector<double> x_, y_, z_;
};

inline PointList randomPoints(Random& random, const Box3& box, std::size_t count)
{
  PointList points;
  for (std::size_t k = 0; k < count; ++k)
  {
    points.add(random.inBox(box));
  }
  return points;
}

/// Vectors that own their memory, to be written by a query.
class VectorList
{
public:
  explicit VectorList(std::size_t size) : x_(size), y_(size), z_(size) {}
  Vec3 operator[](std::size_t k) const { return { x_[k], y_[k], z_[k] }; }
  VectorBatch batch() { return { x_.data(), y_.data(), z_.data() }; }
  operator VectorBatch() { return this->batch(); }

private:
  std::vector<double> x_, y_, z_;
};

} // namespace hybridtree::test
