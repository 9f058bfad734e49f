// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"

namespace hybridtree
{

/// How the mesh of a blend is made ([HT] 5.2.1).
enum class BlendMethod
{
  Automatic,
  NodeBased,
  PrimitiveBased,
  Global
};

struct BlendOptions
{
  /// Kept with the node; every method polygonizes the whole blend over the lattice for now.
  BlendMethod method = BlendMethod::Automatic;
  /// Overlap ratio rho_0 up to which operands keep their own triangles. No unit, 0 to 1.
  double overlapThreshold = 0.5;
};

/// Global blend ([HT] 4.3): the field is the sum of the children's fields. Negative children carve.
///
/// A blend of one child is that child. Automatic Booleans among the children take their smooth
/// form. \pre at least one child, none null; overlapThreshold in [0, 1]. \throws InvalidParameter.
NodePtr makeBlend(std::vector<NodePtr> children, const BlendOptions& options = {});

/// Kind "blend".
NodePtr blendFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

///@{
/// Names "method" and "overlapThreshold". \throws InvalidParameter, InvalidText.
void checkBlendOptions(const BlendOptions& options);
void describeBlendOptions(const BlendOptions& options, Parameters& parameters);
BlendOptions blendOptionsFrom(const Parameters& parameters);
///@}

/// The children as they have to be below a blend (Node::underBlend()).
/// \throws InvalidParameter when one is null.
std::vector<NodePtr> childrenUnderBlend(std::vector<NodePtr> children);

} // namespace hybridtree
