// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/Bernstein.h"

#include "core/base/Error.h"

#include <string>

namespace hybridtree
{
namespace
{

constexpr int kLargest = BernsteinVolume::kLargestSize;

// Bernstein polynomials of one degree and their derivatives at one place.
struct Basis
{
  std::array<double, kLargest> value;
  std::array<double, kLargest> slope;

  Basis(int size, double at)
  {
    const double rest = 1.0 - at;
    value[0] = 1.0;
    for (int degree = 1; degree < size; ++degree)
    {
      if (degree == size - 1)
      {
        this->setSlopes(degree);
      }
      value[degree] = at * value[degree - 1];
      for (int i = degree - 1; i > 0; --i)
      {
        value[i] = rest * value[i] + at * value[i - 1];
      }
      value[0] *= rest;
    }
    if (size == 1)
    {
      slope[0] = 0.0;
    }
  }

private:
  // From the values of one degree lower: B'_i = d (B_{i-1} - B_i).
  void setSlopes(int degree)
  {
    slope[0] = -degree * value[0];
    for (int i = 1; i < degree; ++i)
    {
      slope[i] = degree * (value[i - 1] - value[i]);
    }
    slope[degree] = degree * value[degree - 1];
  }
};

// Coefficients along a line, over [low, high] instead of [0, 1]: each new one is the blossom with
// some arguments low and the others high.
void restrictLine(Vec3* line, int size, double low, double high)
{
  // Keep [low, 1], then what is [0, scaled high] of that.
  for (int round = 1; round < size; ++round)
  {
    for (int i = 0; i < size - round; ++i)
    {
      line[i] = (1.0 - low) * line[i] + low * line[i + 1];
    }
  }
  const double end = low < 1.0 ? (high - low) / (1.0 - low) : 0.0;
  for (int round = 1; round < size; ++round)
  {
    for (int i = size - 1; i >= round; --i)
    {
      line[i] = (1.0 - end) * line[i - 1] + end * line[i];
    }
  }
}

} // namespace

BernsteinVolume::BernsteinVolume(const std::array<int, 3>& sizes, std::vector<Vec3> coefficients)
  : sizes_(sizes), coefficients_(std::move(coefficients))
{
  std::size_t expected = 1;
  for (const int size : sizes_)
  {
    if (size < 1 || size > kLargest)
    {
      throw InvalidParameter("The number of coefficients along an axis", size,
        "between 1 and " + std::to_string(kLargest));
    }
    expected *= static_cast<std::size_t>(size);
  }
  if (coefficients_.size() != expected)
  {
    throw InvalidParameter("The number of coefficients", std::to_string(coefficients_.size()),
      "the product of the sizes, " + std::to_string(expected));
  }
}

Vec3 BernsteinVolume::evaluate(const Vec3& at) const
{
  const Basis s(sizes_[0], at[0]);
  const Basis t(sizes_[1], at[1]);
  const Basis u(sizes_[2], at[2]);
  Vec3 value = Vec3::Zero();
  const Vec3* c = coefficients_.data();
  for (int k = 0; k < sizes_[2]; ++k)
  {
    Vec3 plane = Vec3::Zero();
    for (int j = 0; j < sizes_[1]; ++j)
    {
      Vec3 line = Vec3::Zero();
      for (int i = 0; i < sizes_[0]; ++i)
      {
        line += s.value[i] * *c++;
      }
      plane += t.value[j] * line;
    }
    value += u.value[k] * plane;
  }
  return value;
}

Vec3 BernsteinVolume::evaluate(const Vec3& at, Mat3& derivative) const
{
  const Basis s(sizes_[0], at[0]);
  const Basis t(sizes_[1], at[1]);
  const Basis u(sizes_[2], at[2]);
  Vec3 value = Vec3::Zero();
  derivative.setZero();
  const Vec3* c = coefficients_.data();
  for (int k = 0; k < sizes_[2]; ++k)
  {
    Vec3 plane = Vec3::Zero();
    Vec3 planeS = Vec3::Zero();
    Vec3 planeT = Vec3::Zero();
    for (int j = 0; j < sizes_[1]; ++j)
    {
      Vec3 line = Vec3::Zero();
      Vec3 lineS = Vec3::Zero();
      for (int i = 0; i < sizes_[0]; ++i, ++c)
      {
        line += s.value[i] * *c;
        lineS += s.slope[i] * *c;
      }
      plane += t.value[j] * line;
      planeS += t.value[j] * lineS;
      planeT += t.slope[j] * line;
    }
    value += u.value[k] * plane;
    derivative.col(0) += u.value[k] * planeS;
    derivative.col(1) += u.value[k] * planeT;
    derivative.col(2) += u.slope[k] * plane;
  }
  return value;
}

BernsteinVolume BernsteinVolume::derivative(int axis) const
{
  if (sizes_[axis] == 1)
  {
    return { sizes_, std::vector<Vec3>(coefficients_.size(), Vec3::Zero()) };
  }
  std::array<int, 3> sizes = sizes_;
  --sizes[axis];
  const std::size_t stride = axis == 0 ? 1
    : axis == 1                        ? sizes_[0]
                                       : std::size_t(sizes_[0]) * sizes_[1];
  std::vector<Vec3> result;
  result.reserve(std::size_t(sizes[0]) * sizes[1] * sizes[2]);
  for (int k = 0; k < sizes[2]; ++k)
  {
    for (int j = 0; j < sizes[1]; ++j)
    {
      for (int i = 0; i < sizes[0]; ++i)
      {
        const std::size_t at = i + std::size_t(sizes_[0]) * (j + std::size_t(sizes_[1]) * k);
        result.push_back(sizes[axis] * (coefficients_[at + stride] - coefficients_[at]));
      }
    }
  }
  return { sizes, std::move(result) };
}

BernsteinVolume BernsteinVolume::restricted(const Box3& part) const
{
  std::vector<Vec3> result = coefficients_;
  std::array<Vec3, kLargest> line;
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t size = sizes_[axis];
    for (std::size_t start = 0; start < result.size(); ++start)
    {
      if (start / stride % size != 0)
      {
        continue;
      }
      for (std::size_t i = 0; i < size; ++i)
      {
        line[i] = result[start + i * stride];
      }
      restrictLine(line.data(), sizes_[axis], part.min()[axis], part.max()[axis]);
      for (std::size_t i = 0; i < size; ++i)
      {
        result[start + i * stride] = line[i];
      }
    }
    stride *= size;
  }
  return { sizes_, std::move(result) };
}

Box3 BernsteinVolume::bounds() const
{
  Box3 box;
  for (const Vec3& coefficient : coefficients_)
  {
    box.extend(coefficient);
  }
  return box;
}

} // namespace hybridtree
