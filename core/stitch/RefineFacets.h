// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/FacetTriangulation.h"

namespace hybridtree
{

/// Adds points in the midst of facets and on the creases between them, and flips edges, so that
/// triangles grow gradually from short sides to far corners, instead of reaching them as needles
/// (Delaunay refinement, after Ruppert 1995 and Chew 1993). It aims at angles of 16 degrees: more
/// costs a half more triangles, and leaves as many small angles where they are given.
///
/// Fixed sides (FacetTriangulation.h) stay as they are, and so do all points; angles at them, and
/// those of the facets themselves, may stay small. Points go only where they do not make small
/// angles at fixed sides, and sides shorter than `least` are not parted, nor is anything graded
/// towards them. All is left as it was unless a smaller share of
/// the triangles has an angle below 10 degrees then.
///
/// \return whether it is better now. \param mesh new points and triangles come last; triangles
/// change. \param least > 0, a length.
bool refineFacets(FacetMesh& mesh, double least);

} // namespace hybridtree
