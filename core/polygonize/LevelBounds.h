// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"

namespace hybridtree
{

/// A box around where f >= `level` within a box: conservative, and within about `tolerance` of the
/// tightest by FieldSource::range(). Empty where the field stays below everywhere.
///
/// Each side is searched for by itself: of boxes that may hold such points the outermost is halved
/// until it is small, so that few boxes are asked. A search that takes too many stops with the
/// bound that it has.
/// \pre tolerance > 0.
Box3 levelBounds(const FieldSource& field, double level, const Box3& within, double tolerance);

} // namespace hybridtree
