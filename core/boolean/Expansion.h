// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace hybridtree
{

/// A number of arbitrary precision: a sum of doubles that do not overlap, smallest first (Shewchuk
/// 1997). Sums, differences and products are exact unless a product under- or overflows.
class Expansion
{
public:
  Expansion() = default; ///< zero
  explicit Expansion(double value) { this->push(value); }
  /// a - b, exactly.
  static Expansion difference(double a, double b);

  Expansion operator+(const Expansion& other) const { return this->combined(other, 1.0); }
  Expansion operator-(const Expansion& other) const { return this->combined(other, -1.0); }
  Expansion operator*(const Expansion& other) const;
  Expansion& operator+=(const Expansion& other) { return *this = *this + other; }

  /// -1, 0 or 1.
  int sign() const { return parts_.empty() ? 0 : parts_.back() > 0.0 ? 1 : -1; }
  bool isZero() const { return parts_.empty(); }
  /// Within a few roundings.
  double value() const;

private:
  void push(double value)
  {
    if (value != 0.0)
    {
      parts_.push_back(value);
    }
  }
  void grow(double value);
  void compress();
  Expansion combined(const Expansion& other, double sign) const;

  std::vector<double> parts_;
};

} // namespace hybridtree
