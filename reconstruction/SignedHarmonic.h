// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Two nodes that should have the same value, or, where `weight` is negative, opposite ones.
struct SignedLink
{
  std::int32_t a;
  std::int32_t b;
  float weight; ///< how much; not 0, finite
};

/// Values x of nodes that fulfil signed links as well as can be: minimises the sum over links of
/// |weight| (x_a - sign(weight) x_b)^2, while some nodes are held. All values are then within the
/// range of the held ones and their opposites; the sign tells the side, the size how sure it is.
/// By conjugate gradients, in parallel; the same bytes for any number of threads.
///
/// \param held per node: its value, or 0 where it is free. \param links in any order, a != b;
/// links of the same two nodes add up. Nodes that no held one reaches get 0.
/// \returns one value per node, to some 1e-6; less exact (a warning is not needed: signs are what
/// counts) if 400 steps do not do, as where links contradict each other nearly everywhere.
/// \throws Cancelled.
std::vector<double> signedHarmonic(const std::vector<float>& held, std::vector<SignedLink> links,
  const Progress& progress = Progress::none());

} // namespace hybridtree
