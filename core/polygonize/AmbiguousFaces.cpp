// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/AmbiguousFaces.h"

#include "core/base/Scratch.h"
#include "core/polygonize/EdgeRoots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr int kSteps = 4; // of the finer grid along a side
constexpr int kSide = kSteps + 1;
constexpr int kPlaces = kSide * kSide;
constexpr double kLeast = 1e-9; // so that a corner on the surface has a side

/// f - T at the points of the finer grid.
using FaceValues = std::array<double, kPlaces>;

void placePoints(
  const Lattice& lattice, const AmbiguousFace& face, std::size_t first, const VectorBatch& points)
{
  const unsigned u = (face.axis + 1) % 3;
  const unsigned v = (face.axis + 2) % 3;
  const Vec3 low = lattice.point(face.low);
  for (int k = 0; k < kPlaces; ++k)
  {
    Vec3 point = low;
    point[u] += lattice.cellSize * (k % kSide) / kSteps;
    point[v] += lattice.cellSize * (k / kSide) / kSteps;
    points.set(first + static_cast<std::size_t>(k), point);
  }
}

/// Sets of points that are joined.
class Groups
{
public:
  Groups() { std::iota(parent_.begin(), parent_.end(), 0); }

  int rootOf(int k) const
  {
    while (parent_[k] != k)
    {
      k = parent_[k];
    }
    return k;
  }
  void join(int a, int b) { parent_[this->rootOf(a)] = this->rootOf(b); }

private:
  std::array<int, kPlaces> parent_;
};

/// Joins the inside points of a small square, its corners given in rows.
void joinSquare(const FaceValues& value, const std::array<int, 4>& k, Groups& groups)
{
  const auto inside = [&](int n) { return hybridtree::isInside(value[k[n]]); };
  for (const auto& [a, b] : { std::make_pair(0, 1), { 0, 2 }, { 1, 3 }, { 2, 3 } })
  {
    if (inside(a) && inside(b))
    {
      groups.join(k[a], k[b]);
    }
  }
  // At the saddle of the bilinear function the value has the sign of this, times that of the sum of
  // the first diagonal less the second (Nielson and Hamann 1991).
  const double saddle = value[k[0]] * value[k[3]] - value[k[1]] * value[k[2]];
  if (inside(0) && inside(3) && !inside(1) && !inside(2) && saddle >= 0.0)
  {
    groups.join(k[0], k[3]);
  }
  if (inside(1) && inside(2) && !inside(0) && !inside(3) && saddle <= 0.0)
  {
    groups.join(k[1], k[2]);
  }
}

bool joinsInside(const FaceValues& value, bool lowInside)
{
  Groups groups;
  for (int v = 0; v < kSteps; ++v)
  {
    for (int u = 0; u < kSteps; ++u)
    {
      const int k = v * kSide + u;
      joinSquare(value, { k, k + 1, k + kSide, k + kSide + 1 }, groups);
    }
  }
  return lowInside ? groups.rootOf(0) == groups.rootOf(kPlaces - 1)
                   : groups.rootOf(kSteps) == groups.rootOf(kPlaces - kSide);
}

} // namespace

std::vector<std::uint8_t> joinsInside(
  const FieldSource& field, const Lattice& lattice, const std::vector<AmbiguousFace>& faces)
{
  ScratchVectors points(faces.size() * kPlaces);
  ScratchArray values(faces.size() * kPlaces);
  for (std::size_t n = 0; n < faces.size(); ++n)
  {
    placePoints(lattice, faces[n], n * kPlaces, points.batch());
  }
  field.field(points.points(), values.data());
  std::vector<std::uint8_t> joined;
  for (std::size_t n = 0; n < faces.size(); ++n)
  {
    FaceValues value;
    for (int k = 0; k < kPlaces; ++k)
    {
      value[k] = values[n * kPlaces + static_cast<std::size_t>(k)] - kThreshold;
    }
    // The sides of the corners are decided already.
    const double diagonal = faces[n].lowInside ? 1.0 : -1.0;
    for (const auto& [corner, sign] :
      { std::make_pair(0, 1.0), { kSteps, -1.0 }, { kPlaces - kSide, -1.0 }, { kPlaces - 1, 1.0 } })
    {
      value[corner] = std::copysign(std::max(std::abs(value[corner]), kLeast), sign * diagonal);
    }
    joined.push_back(joinsInside(value, faces[n].lowInside) ? 1 : 0);
  }
  return joined;
}

} // namespace hybridtree
