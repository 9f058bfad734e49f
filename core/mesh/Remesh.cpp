// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/Remesh.h"

#include "core/base/Error.h"
#include "core/mesh/RemeshSteps.h"

#include <cmath>

namespace hybridtree
{
namespace
{

void checkOptions(const RemeshOptions& options)
{
  if (!(options.edgeLength > 0.0) || !std::isfinite(options.edgeLength))
  {
    throw InvalidParameter("EdgeLength", options.edgeLength, "a finite length > 0");
  }
  if (!(options.shortEdge >= 0.0 && options.shortEdge <= 0.7))
  {
    throw InvalidParameter("The share for short edges", options.shortEdge, "from 0 to 0.7");
  }
  if (!(options.badAngle >= 0.0 && options.badAngle <= 30.0))
  {
    throw InvalidParameter("The bad angle", options.badAngle, "from 0 to 30 degrees");
  }
}

} // namespace

void remeshStretched(TriangleMesh& mesh, const RemeshOptions& options,
  const ProjectToSurface& project, const Progress& progress)
{
  checkOptions(options);
  RemeshSurface surface(mesh, options, progress);
  RemeshPoints points(mesh, project);
  ShortEdges shortEdges(surface);
  for (int round = 0; round < options.maxRounds; ++round)
  {
    progress.check();
    progress.report(static_cast<double>(round) / options.maxRounds);
    const bool split = splitLongEdges(surface, points, progress);
    const bool collapsed = shortEdges.collapse();
    const bool flipped = flipEdges(surface);
    points.project(surface);
    if (!split && !collapsed && !flipped)
    {
      break;
    }
  }
  surface.pack();
}

} // namespace hybridtree
