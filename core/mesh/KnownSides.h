// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"
#include "core/mesh/MeshSide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hybridtree
{

/// Sides of a mesh in balls that hold nothing of it, each found at some point and as good for all
/// of its ball: next to a ray or a winding number for every point this costs nothing.
///
/// Closed meshes: their winding number is constant in such a ball, so the answer for a point does
/// not depend on what was asked before. Open ones: it changes by MeshSide::windingSlope() at most,
/// and a ball only answers as far as that cannot bring it to 1/2.
/// Not for sharing among threads.
class KnownSides
{
public:
  /// \pre side outlives this.
  explicit KnownSides(const MeshSide& side) : side_(side) {}

  /// 1 inside, -1 outside, 0 not known.
  int find(const Vec3& p) const
  {
    for (std::size_t k = 0; k < size_; ++k)
    {
      const Ball& ball = balls_[(next_ + kMost - 1 - k) % kMost]; // the latest first
      const double squared = (p - ball.center).squaredNorm();
      if (squared < ball.squaredRadius && this->covers(ball, squared))
      {
        return ball.side;
      }
    }
    return 0;
  }

  /// \param distance of p to the mesh, or less. \param side as MeshSide has it at p, without regard
  /// to the nearest point; 0 is not kept. \param winding the winding number at p, for open meshes.
  void add(const Vec3& p, double distance, int side, double winding)
  {
    const double radius = distance * (1.0 - 1e-9); // rounding
    if (side == 0 || !(radius > 0.0))
    {
      return;
    }
    const double clear = side_.isClosed() ? 0.0 : std::abs(winding - 0.5);
    balls_[next_] = { p, radius, radius * radius, clear, side };
    next_ = (next_ + 1) % kMost;
    size_ = std::min(size_ + 1, kMost);
  }

private:
  static constexpr std::size_t kMost = 32;

  struct Ball
  {
    Vec3 center;
    double radius;
    double squaredRadius;
    double clear; // of the winding number from 1/2 at the centre, for open meshes
    int side;
  };

  bool covers(const Ball& ball, double squared) const
  {
    if (side_.isClosed())
    {
      return true;
    }
    const double way = std::sqrt(squared);
    return ball.clear > way * side_.windingSlope(ball.radius - way) + MeshSide::kWindingError;
  }

  const MeshSide& side_;
  std::array<Ball, kMost> balls_;
  std::size_t next_ = 0;
  std::size_t size_ = 0;
};

} // namespace hybridtree
