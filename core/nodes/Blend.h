// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"
#include "core/nodes/NodeMaker.h"

namespace hybridtree
{

/// How the mesh of a blend is made ([HT] 5.2.1). The surface is the same; what differs is how much
/// of the operands' own meshes is in it.
enum class BlendMethod
{
  Automatic,      ///< primitive-based where faster, or meshes finer than the lattice take part
  NodeBased,      ///< the children's meshes stand where one child is alone
  PrimitiveBased, ///< through nested blends, those of what is blended: less is made anew
  Global          ///< all from the field, over the lattice
};

struct BlendOptions
{
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
