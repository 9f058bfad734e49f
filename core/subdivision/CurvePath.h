// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/SkeletonPieces.h"

#include <vector>

namespace hybridtree
{

/// A refined curve piece by its arc length s, 0 to length(). Beyond its ends it goes on straight; a
/// closed one goes round.
class CurvePath
{
public:
  CurvePath(const CurvePiece& piece, const RefinedSkeleton& refined, int level);

  double length() const { return length_.back(); }
  bool closed() const { return closed_; }
  Vec3 point(double s) const;
  /// The coarse segment it is on; beyond an end the last.
  std::int32_t element(double s) const { return elements_[place(s).segment]; }
  double radius(double s) const;
  /// Across the bisecting plane: from `reach` before to `reach` behind.
  Vec3 tangent(double s, double reach) const;

private:
  struct Place
  {
    std::size_t segment;
    double share; // outside of [0, 1] beyond an open end
  };
  Place place(double s) const;

  std::vector<Vec3> points_;
  std::vector<double> radii_;
  std::vector<std::int32_t> elements_; // coarse segments, per refined one
  std::vector<double> length_;         // up to each point
  bool closed_;
};

} // namespace hybridtree
