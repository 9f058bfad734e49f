// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/subdivision/PieceCage.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace hybridtree
{

struct PieceMeshOptions
{
  /// eta: an edge is split where |f(middle) - T| > eta * T ([SUB] 4.2). (0, 1]; 0.1 gives a round
  /// limb about twelve sides.
  double refinement = 0.1;
  /// Edges are split until they are no longer than this, world units; 0: by eta alone.
  double longestEdge = 0.0;
  /// Its triangles will be asked for their pieces (PieceSources.h): the mesh is kept by the
  /// skeleton's pieces around it, too.
  bool findSources = false;
};

/// What is known of the nearest pieces to the triangles of a mesh.
struct KnownSources
{
  static constexpr std::int32_t kUnknown = -2;

  std::mutex mutex;
  std::vector<std::int32_t> leaf; ///< per triangle; empty while all are unknown
};

/// The surface around one piece. Closed, oriented outward, a 2-manifold; with normals, which are
/// -grad f / |grad f|, or along the axis where not settled.
struct PieceMesh : TriangleMesh
{
  std::vector<std::uint8_t> onSurface; ///< per point: 0 inside of other pieces, where no surface is
  std::vector<Vec3> bases;             ///< per point: the place of the skeleton it belongs to
  std::vector<std::int32_t> elements;  ///< per point: the coarse element, as SkeletonAxis::element
  /// Filled when asked for.
  std::shared_ptr<KnownSources> sources = std::make_shared<KnownSources>();
};

/// Lets the vertices of a cage slide to the surface, then splits edges until they follow it.
///
/// A triangle is divided by those of its edges that are split, in two, three or four (Figure 11
/// without the points that would have to be snapped: there are no T-junctions). New vertices go to
/// the surface along the gradient, in the field of the element that a triangle at their edge
/// surrounds. Edges shorter than a tenth of the radius are not split, so that
/// creases, where parts are united and not blended, end the splitting.
///
/// \throws TooLarge where the radius is tiny beside the piece; Cancelled.
PieceMesh refineCage(const PieceCage& cage, const PlacedField& field,
  const PieceMeshOptions& options, const Progress& progress = Progress::none());

} // namespace hybridtree
