// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshOperand.h"

#include <string>

namespace hybridtree
{

/// What to say of an operand whose triangles cross each other, and of what is to be done about it;
/// empty where none do. Told apart are shells across each other, which can be united one by one,
/// and a surface that crosses itself. Tests all of it, so only for one that has turned out
/// unusable. \param name with which the sentence begins: "The first operand".
std::string tellOfSelfCrossing(const MeshOperand& operand, const std::string& name);

} // namespace hybridtree
