// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/polygonize/FieldSource.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// An edge or a triangle of a mesh whose middle may be far from the surface.
struct NotchSite
{
  /// Corners of the two triangles at the edge or of the triangle, counter-clockwise, and the
  /// normals of the mesh there. An edge is that from the first to the third one.
  std::array<Vec3, 4> rim;
  std::array<Vec3, 4> normals;
  int count = 4; ///< of the corners: 4 or 3

  bool isEdge() const { return count == 4; }
  Vec3 middle() const;
  Vec3 middleNormal() const; ///< unit length; 0 where it is not known
  /// Of a surface over the middle that is curved evenly, by the normals; negative in a hollow.
  double smoothHeight() const;
  double distance(const Vec3& p) const;
};

/// The point of the surface over a site.
struct NotchPoint
{
  double off = 0.0;    ///< of the middle of the site from the surface, to first order
  double height = 0.0; ///< of the point over the site; 0 where there is no notch
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero(); ///< in the middle of those of the faces that meet there, unit length
};

/// Looks at sites that cut something off. Where the planes that touch the field on the way to the
/// corners meet, asked again nearer and nearer around that (as in CreasePoints.h), there is a
/// crease; otherwise the surface is looked for along the normal. No notch is what is lower than
/// a fifth of a cell under a crease, and than two fifths under what is merely curved.
///
/// The same for any number of threads. \throws Cancelled.
std::vector<NotchPoint> findNotchPoints(const FieldSource& field, double cellSize,
  const std::vector<NotchSite>& sites, const Progress& progress);

} // namespace hybridtree
