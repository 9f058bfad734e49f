// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/stitch/PatchBricks.h"

namespace hybridtree
{

/// How the ambiguous faces between marked cells go (core/polygonize/AmbiguousFaces.h), as they do
/// where all is polygonized. Each is decided in the brick of its lowest corner.
class PatchFaces
{
public:
  /// They are kept in the bricks, which must live as long as this.
  explicit PatchFaces(PatchBricks& bricks) : bricks_(bricks) {}

  /// Asks the field, in parallel; once the sides of the corners are settled.
  void decide(const Lattice& lattice, const Progress& progress);

  ///@{
  /// Of a marked cell, \pre decide(). \param face bit 2 axis + side.
  bool isJoined(const PatchBrick& brick, std::array<int, 3> cell, unsigned face);
  bool anyJoined(const PatchBrick& brick, const std::array<int, 3>& cell, unsigned signs);
  ///@}

private:
  void decide(PatchBrick& brick, const Lattice& lattice);

  PatchBricks& bricks_;
};

} // namespace hybridtree
