// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"

#include <vector>

namespace hybridtree
{

/// Angle between vectors of unit length, radians; not a number where one of them is none.
double angleBetween(const Vec3& a, const Vec3& b);

/// Outward normals of a field at places on a way through space, one after the other: whether they
/// turn by and by or at once.
class NormalsOnWay
{
public:
  /// The first place, where the normal is known: unit length.
  NormalsOnWay(const Vec3& place, const Vec3& normal) : stops_{ { place, normal, true } } {}

  ///@{
  /// The next place, and its normal where that is known.
  void add(const Vec3& place) { stops_.push_back({ place, Vec3::Zero(), false }); }
  void add(const Vec3& place, const Vec3& normal) { stops_.push_back({ place, normal, true }); }
  ///@}

  /// Adds the middle of each step by which the normal turns by more than this, radians.
  /// \pre askForNormals() came before.
  void halveAbove(double turn);

  /// The largest turn of one step, radians; not a number where the field has no direction.
  /// \pre as of halveAbove().
  double mostTurn() const;

private:
  friend void askForNormals(const FieldSource& field, std::vector<NormalsOnWay>& ways);

  struct Stop
  {
    Vec3 place;
    Vec3 normal;
    bool known;
  };

  std::vector<Stop> stops_;
};

/// Those that are not known, of all ways in one question.
void askForNormals(const FieldSource& field, std::vector<NormalsOnWay>& ways);

} // namespace hybridtree
