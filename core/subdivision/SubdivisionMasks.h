// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace hybridtree
{

/// Weights of a point and of its ring of neighbours; they sum to 1.
struct RingMask
{
  double center = 0.0;
  std::vector<double> ring;
};

/// How the last neighbour of a sector follows the first around a point on a sharp edge.
enum class SectorShape
{
  Straight, ///< the sharp edge passes: the limit has one tangent line there
  Corner    ///< two sharp edges meet: the limit has a corner, as if of a right angle
};

/// Loop 1987: each neighbour of an inner point of valence n >= 3 gets this weight when the point
/// moves, and the point itself the rest. [SUB] 3.1.
double loopNeighbourWeight(std::size_t n);

/// Biermann, Levin, Zorin 2000: weight of the far end of an inner edge that starts at a point on a
/// sharp edge, in a sector of k triangles; both wings have 1/8, the point itself the rest. Loop's
/// own 3/8 where k = 3. With it the limit has a tangent plane along borders for every k, which
/// Loop's weight lacks for k > 3 at corners and k != 3 at borders.
double loopSectorWeight(std::size_t k, SectorShape shape);

/// Zorin, Schroeder, Sweldens 1996: new point on the edge to neighbour 0 of an inner point of
/// valence n >= 3. ([SUB] 3.2 prints the general row for k > 5 only; it holds from 5 on, and the
/// point itself has 3/4.)
RingMask butterflyRingMask(std::size_t n);

/// New point on the edge to neighbour i, 0 < i < k, of a point on a sharp edge with k triangles in
/// this sector. Built from what it has to reproduce: eigenvalue 1/2 for linear functions, at most
/// 1/4 for all others that vanish on the sharp edges (for Straight: Zorin's crease mask).
RingMask butterflySectorMask(std::size_t k, std::size_t i, SectorShape shape);

} // namespace hybridtree
