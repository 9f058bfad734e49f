// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/ConvolutionField.h"

#include <vector>

namespace hybridtree
{

/// What the field in a box is made of: one sum, or the largest of several, each for a set of groups
/// that blend there.
struct BlendSelection
{
  /// A group whose share varies in the box.
  struct Term
  {
    ElementSelection own;
    std::vector<double> distances; ///< of the cluster's pieces from the group
    double span;                   ///< between the largest and the least of them
  };
  struct Cluster
  {
    ElementSelection plain;  ///< elements that count in full
    ElementSelection pieces; ///< that say where the point is; empty without terms
    std::vector<Term> terms;
  };

  ElementSelection all;          ///< all elements that reach the box
  std::vector<Cluster> clusters; ///< empty where everything adds up

  bool empty() const { return all.empty(); }
};

} // namespace hybridtree
