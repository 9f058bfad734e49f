// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace hybridtree
{

/// The triangulation of a loop of n points, without others, that costs least: dynamic programming
/// over all of them (Klincsek 1980), n^3 / 6 costs. Keeps its memory from loop to loop.
class BestTriangulation
{
public:
  using Corners = std::array<std::size_t, 3>;
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// \param cost of the triangle of points i < k < j, 0 or more; kNever where it is not allowed.
  /// \param joins whether i < j, not neighbours, may be joined. \return whether there is any
  /// allowed triangulation. Of equal ones it is always the same.
  template <class Cost, class Joins>
  bool find(std::size_t n, const Cost& cost, const Joins& joins)
  {
    triangles.clear();
    cost_.assign(n * n, 0.0);
    split_.assign(n * n, 0);
    for (std::size_t length = 2; length < n; ++length)
    {
      for (std::size_t i = 0; i + length < n; ++i)
      {
        const std::size_t j = i + length;
        const bool isSide = length == n - 1;
        cost_[i * n + j] = isSide || joins(i, j) ? this->best(n, i, j, cost) : kNever;
      }
    }
    if (n < 3 || !(cost_[n - 1] < kNever))
    {
      return false;
    }
    this->collect(n);
    return true;
  }

  std::vector<Corners> triangles;

private:
  template <class Cost>
  double best(std::size_t n, std::size_t i, std::size_t j, const Cost& cost)
  {
    double least = kNever;
    for (std::size_t k = i + 1; k < j; ++k)
    {
      const double sides = cost_[i * n + k] + cost_[k * n + j];
      const double sum = sides < least ? sides + cost(i, k, j) : kNever;
      if (sum < least)
      {
        least = sum;
        split_[i * n + j] = std::uint32_t(k);
      }
    }
    return least;
  }

  void collect(std::size_t n)
  {
    std::vector<std::array<std::size_t, 2>> waiting{ { 0, n - 1 } };
    while (!waiting.empty())
    {
      const auto [i, j] = waiting.back();
      waiting.pop_back();
      if (j > i + 1)
      {
        const std::size_t k = split_[i * n + j];
        triangles.push_back({ i, k, j });
        waiting.push_back({ k, j });
        waiting.push_back({ i, k });
      }
    }
  }

  std::vector<double> cost_; ///< of the part from i to j, at i n + j
  std::vector<std::uint32_t> split_;
};

} // namespace hybridtree
