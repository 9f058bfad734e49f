// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/base/Types.h"
#include "core/polygonize/FieldSource.h"

#include <vector>

namespace hybridtree
{

/// Moves points onto f = T, each by no more than `reach`: by Newton steps along the gradient, and
/// where these fail, beside creases and where the field is flat, by bisection along the normal. A
/// point from which neither gets there stays where it was. Normals become -grad f / |grad f| at
/// those that moved; empty `normals` stay empty. The same for any number of threads.
/// \throws Cancelled.
void projectOntoSurface(const FieldSource& field, double reach, std::vector<Vec3>& points,
  std::vector<Vec3>& normals, const Progress& progress = Progress::none());

} // namespace hybridtree
