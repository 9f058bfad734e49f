// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hybridtree::test
{

/// What may be wrong with the meshes of a tree.
enum class Fault
{
  Failed,     ///< an error
  Open,       ///< not a closed, consistently oriented 2-manifold
  Volume,     ///< off by more than 3 standard deviations of random points that are asked on which
              ///< side they are by membership, and what the flatness of triangles makes
  Side,       ///< such a point is on the wrong side, farther than half an edge length from the mesh
  OffSurface, ///< a vertex is farther than 1e-3 edge lengths from the surface
  Apart,      ///< the meshes of two methods are farther than half an edge length apart (Hausdorff)
  ///@{
  /// Side and Apart, all of it where parts of the solid or of what is around it are too thin for a
  /// lattice of that edge length (isThin() in TreeChecks.h). Meshes that are kept have them.
  ThinSide,
  ThinApart
  ///@}
};
constexpr std::size_t kFaults = 8;
extern const std::array<const char*, kFaults> kFaultNames;

/// A tree, meshed by all four methods of blending at one edge length.
struct TreeVerdict
{
  std::array<int, kFaults> count{};
  std::string text; ///< a line for each fault
  int meshes = 0;
  int warned = 0; ///< meshes with a warning

  int of(Fault fault) const { return count[std::size_t(fault)]; }
  void add(Fault fault, const std::string& what);
  /// Other than where it is thin.
  bool bad() const;
  /// As no shorter edge length excuses.
  bool broken() const { return this->of(Fault::Failed) > 0 || this->of(Fault::Open) > 0; }
};

/// The random tree of a seed, two to six nodes above each other, with one of three overlap
/// thresholds. A lattice does not see what is thinner than its cells: a tree that is bad, but not
/// broken, is judged once more at a half, a quarter and an eighth of the edge length, where the
/// bounds are as much smaller.
/// \param cells edge lengths along the largest side of the tree. \param points random ones.
/// \return the verdicts at each edge length; the last one counts.
std::vector<TreeVerdict> tryTree(std::uint64_t seed, double cells, std::size_t points);

} // namespace hybridtree::test
