// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/Predicates.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace hybridtree
{
namespace
{

constexpr double kEpsilon = 0x1p-53;
constexpr double kFilter3d = (7.0 + 56.0 * kEpsilon) * kEpsilon; // Shewchuk 1997, section 4.4
constexpr double kFilter2d = (3.0 + 16.0 * kEpsilon) * kEpsilon;

// A sum of non-overlapping doubles, smallest first: a number of arbitrary precision.
template <std::size_t Capacity>
struct Expansion
{
  std::array<double, Capacity> part;
  std::size_t size = 0;

  void push(double value)
  {
    if (value != 0.0)
    {
      part[size++] = value;
    }
  }

  // Grow-expansion with zero elimination (Shewchuk 1997, figure 6).
  void add(double value)
  {
    double sum = value;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < size; ++k)
    {
      const double old = part[k];
      const double total = sum + old;
      const double rounded = total - sum;
      const double rest = (sum - (total - rounded)) + (old - rounded);
      sum = total;
      if (rest != 0.0)
      {
        part[kept++] = rest;
      }
    }
    size = kept;
    this->push(sum);
  }

  int sign() const { return size == 0 ? 0 : part[size - 1] > 0.0 ? 1 : -1; }
};

Expansion<2> difference(double a, double b)
{
  const double high = a - b;
  const double virtualB = a - high;
  const double low = (a - (high + virtualB)) + (virtualB - b);
  Expansion<2> result;
  result.push(low);
  result.push(high);
  return result;
}

template <std::size_t N, std::size_t M>
Expansion<2 * N * M> product(const Expansion<N>& a, const Expansion<M>& b)
{
  Expansion<2 * N * M> result;
  for (std::size_t i = 0; i < a.size; ++i)
  {
    for (std::size_t j = 0; j < b.size; ++j)
    {
      const double high = a.part[i] * b.part[j];
      result.add(std::fma(a.part[i], b.part[j], -high));
      result.add(high);
    }
  }
  return result;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> combine(const Expansion<N>& a, const Expansion<M>& b, double signOfB)
{
  Expansion<N + M> result;
  for (std::size_t k = 0; k < a.size; ++k)
  {
    result.push(a.part[k]);
  }
  for (std::size_t k = 0; k < b.size; ++k)
  {
    result.add(signOfB * b.part[k]);
  }
  return result;
}

int exactOrientation3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const auto term = [&](const Vec3& p, const Vec3& q, const Vec3& r)
  {
    const auto minor = combine(product(difference(p.x(), d.x()), difference(q.y(), d.y())),
      product(difference(q.x(), d.x()), difference(p.y(), d.y())), -1.0);
    return product(minor, difference(r.z(), d.z()));
  };
  return combine(combine(term(a, b, c), term(b, c, a), 1.0), term(c, a, b), 1.0).sign();
}

} // namespace

int orientation3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 ad = a - d;
  const Vec3 bd = b - d;
  const Vec3 cd = c - d;
  const double abxy = ad.x() * bd.y();
  const double baxy = bd.x() * ad.y();
  const double bcxy = bd.x() * cd.y();
  const double cbxy = cd.x() * bd.y();
  const double caxy = cd.x() * ad.y();
  const double acxy = ad.x() * cd.y();
  const double determinant =
    cd.z() * (abxy - baxy) + ad.z() * (bcxy - cbxy) + bd.z() * (caxy - acxy);
  const double permanent = std::abs(cd.z()) * (std::abs(abxy) + std::abs(baxy)) +
    std::abs(ad.z()) * (std::abs(bcxy) + std::abs(cbxy)) +
    std::abs(bd.z()) * (std::abs(caxy) + std::abs(acxy));
  if (std::abs(determinant) > kFilter3d * permanent)
  {
    return determinant > 0.0 ? 1 : -1;
  }
  return exactOrientation3d(a, b, c, d);
}

int orientation2d(double ax, double ay, double bx, double by, double cx, double cy)
{
  const double left = (ax - cx) * (by - cy);
  const double right = (ay - cy) * (bx - cx);
  const double determinant = left - right;
  if (std::abs(determinant) > kFilter2d * (std::abs(left) + std::abs(right)))
  {
    return determinant > 0.0 ? 1 : -1;
  }
  return combine(product(difference(ax, cx), difference(by, cy)),
    product(difference(ay, cy), difference(bx, cx)), -1.0)
    .sign();
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return orientation2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y()) == 0 &&
    orientation2d(a.y(), a.z(), b.y(), b.z(), c.y(), c.z()) == 0 &&
    orientation2d(a.z(), a.x(), b.z(), b.x(), c.z(), c.x()) == 0;
}

} // namespace hybridtree
