// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/Expansion.h"

#include "core/boolean/TwoSum.h"

#include <cmath>
#include <cstddef>

namespace hybridtree
{

Expansion Expansion::difference(double a, double b)
{
  const TwoDoubles sum = twoSum(a, -b);
  Expansion result;
  result.push(sum.low);
  result.push(sum.high);
  return result;
}

// Grow-expansion with zero elimination (Shewchuk 1997, figure 6).
void Expansion::grow(double value)
{
  double total = value;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k)
  {
    const TwoDoubles sum = twoSum(total, parts_[k]);
    total = sum.high;
    if (sum.low != 0.0)
    {
      parts_[kept++] = sum.low;
    }
  }
  parts_.resize(kept);
  this->push(total);
}

// The same number in as few doubles as can be (Shewchuk 1997, figure 15).
void Expansion::compress()
{
  if (parts_.size() < 2)
  {
    return;
  }
  std::size_t bottom = parts_.size() - 1;
  double total = parts_[bottom];
  for (std::size_t k = bottom; k-- > 0;)
  {
    const TwoDoubles sum = fastTwoSum(total, parts_[k]);
    total = sum.high;
    if (sum.low != 0.0)
    {
      parts_[bottom--] = sum.high;
      total = sum.low;
    }
  }
  parts_[bottom] = total;
  std::size_t top = 0;
  for (std::size_t k = bottom + 1; k < parts_.size(); ++k)
  {
    const TwoDoubles sum = fastTwoSum(parts_[k], total);
    total = sum.high;
    if (sum.low != 0.0)
    {
      parts_[top++] = sum.low;
    }
  }
  parts_.resize(top);
  this->push(total);
}

Expansion Expansion::combined(const Expansion& other, double sign) const
{
  Expansion result = *this;
  for (const double part : other.parts_)
  {
    result.grow(sign * part);
  }
  result.compress();
  return result;
}

Expansion Expansion::operator*(const Expansion& other) const
{
  Expansion result;
  for (const double a : parts_)
  {
    for (const double b : other.parts_)
    {
      const double high = a * b;
      const double low = std::fma(a, b, -high);
      if (low != 0.0)
      {
        result.grow(low);
      }
      result.grow(high);
    }
  }
  result.compress();
  return result;
}

double Expansion::value() const
{
  double sum = 0.0;
  for (const double part : parts_)
  {
    sum += part;
  }
  return sum;
}

} // namespace hybridtree
