// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"

#include <memory>

namespace hybridtree
{

struct MeshUnionResult
{
  TriangleMesh mesh;
  std::vector<std::int32_t> sourceOperand; ///< per triangle: index of its operand
  std::vector<std::int32_t>
    sourceTriangle; ///< per triangle: which; -1 where an open one was closed
  std::vector<std::string> warnings;
  bool usable = true; ///< as in MeshBooleanResult
};

/// Union of any number of solids. In rounds: those whose bounds meet are united by pairs, smallest
/// first, until none meet; the rest is put side by side. So each triangle is copied as often as
/// the logarithm of the number of operands, not as often as there are operands.
/// \pre no operand is null. \throws as meshBoolean().
MeshUnionResult meshUnion(const std::vector<std::shared_ptr<const MeshOperand>>& operands,
  const Progress& progress = Progress::none());

} // namespace hybridtree
