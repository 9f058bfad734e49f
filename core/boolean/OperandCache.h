// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshOperand.h"

#include <memory>

namespace hybridtree
{

/// The operand of a mesh. Kept for the last few meshes, as long as somebody else holds the mesh:
/// while one operand of a Boolean is moved about, the other is made ready once.
/// \throws as MeshOperand. Any number of threads may ask.
std::shared_ptr<const MeshOperand> meshOperand(const MeshPtr& mesh);

} // namespace hybridtree
