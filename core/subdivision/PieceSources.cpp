// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceSources.h"

#include <utility>

namespace hybridtree
{
namespace
{

/// Calls body(source, known) for each triangle of the pieces that stays, with its place in the
/// joined mesh and what its piece remembers.
template <typename Body>
void forEachKept(
  const std::vector<PieceMeshPtr>& pieces, const std::vector<KeptRun>& runs, Body&& body)
{
  std::size_t number = 0;
  for (const KeptRun& run : runs)
  {
    const PieceMesh& piece = *pieces[run.part];
    const std::lock_guard<std::mutex> lock(piece.sources->mutex);
    piece.sources->leaf.resize(piece.triangles.size(), KnownSources::kUnknown);
    for (std::size_t t = run.first; t < run.first + run.count; ++t)
    {
      body(number++, piece.sources->leaf[t]);
    }
  }
}

} // namespace

void findPieceSources(const LocalField& field, const std::vector<PieceMeshPtr>& pieces,
  StitchedMesh& joined, const Progress& progress)
{
  TriangleMesh& mesh = joined.mesh;
  std::vector<std::size_t> unknown;
  forEachKept(pieces, joined.keptRuns,
    [&](std::size_t number, std::int32_t known)
    {
      mesh.sourceLeaf[number] = known;
      if (known == KnownSources::kUnknown)
      {
        unknown.push_back(number);
      }
    });
  if (unknown.empty())
  {
    return;
  }
  TriangleMesh asked;
  asked.points = std::move(mesh.points);
  for (const std::size_t number : unknown)
  {
    asked.triangles.push_back(mesh.triangles[number]);
  }
  field.findSources(asked, progress);
  mesh.points = std::move(asked.points);
  for (std::size_t k = 0; k < unknown.size(); ++k)
  {
    mesh.sourceLeaf[unknown[k]] = asked.sourceLeaf[k];
  }
  forEachKept(pieces, joined.keptRuns,
    [&](std::size_t number, std::int32_t& known) { known = mesh.sourceLeaf[number]; });
}

} // namespace hybridtree
