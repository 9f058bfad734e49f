// SPDX-License-Identifier: BSD-3-Clause
// Figure 14 as [SUB] has it: see ConvolutionBenchmark.cpp.
#include "benchmarks/convolution/Works.h"
#include "core/base/Parallel.h"
#include "core/nodes/SkeletonElementFields.h"
#include "core/subdivision/PieceMeshes.h"
#include "tests/support/Random.h"
#include "tests/support/SkeletonShapes.h"

#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

namespace hybridtree::test
{
namespace
{

// [SUB]'s own figure, from the coarse graph to the triangles around all pieces, as in the preview;
// and one query there, of which the element that its point belongs to is known.
class KnownElements
{
public:
  KnownElements(const SkeletonGraph& graph, int level, KernelKind kernel)
    : graph_(graph), level_(level), kernel_(kernel)
  {
  }

  /// \return the meshes. \param byElements otherwise the field wherever points are.
  std::vector<PieceMeshPtr> mesh(BlendingKind blending, bool byElements) const
  {
    const NodePtr node = skeleton(graph_, level_, kernel_, blending);
    const auto& leaf = dynamic_cast<const SubdivisionSkeleton&>(*node);
    std::optional<SkeletonElementFields> elements;
    if (byElements)
    {
      elements.emplace(leaf, SkeletonElementFields::Sums::Own);
    }
    return pieceMeshes(
      { leaf.coarse(), leaf.refined(), level_, leaf, byElements ? &*elements : nullptr }, {});
  }

  /// Seconds a query at all vertices of the meshes of [SUB]'s blending, by elements: all,
  /// neighbours and paper.
  std::vector<double> query(int rounds) const
  {
    std::map<std::int32_t, PointList> points;
    std::size_t count = 0;
    std::size_t most = 0;
    for (const PieceMeshPtr& piece : this->mesh(BlendingKind::Paper, true))
    {
      for (std::size_t k = 0; k < piece->points.size(); ++k)
      {
        PointList& list = points[piece->elements[k]];
        list.add(piece->points[k]);
        most = std::max(most, list.size());
        ++count;
      }
    }
    std::vector<double> value(most);
    VectorList gradient(most);
    const VectorBatch slopes = gradient;
    std::vector<NodePtr> nodes;
    std::vector<std::unique_ptr<SkeletonElementFields>> fields;
    std::vector<Work> works;
    for (const BlendingKind blending : kBlendings)
    {
      nodes.push_back(skeleton(graph_, level_, kernel_, blending));
      fields.push_back(std::make_unique<SkeletonElementFields>(
        dynamic_cast<const SubdivisionSkeleton&>(*nodes.back()), SkeletonElementFields::Sums::Own));
      works.push_back(
        [&, field = fields.back().get()]
        {
          for (int pass = 0; pass < kPasses; ++pass)
          {
            for (const auto& [element, list] : points)
            {
              field->evaluate(element, list.batch(), value.data(), &slopes);
            }
          }
        });
    }
    std::vector<double> seconds = times(works, rounds);
    for (double& of : seconds)
    {
      of /= double(count) * kPasses;
    }
    return seconds;
  }

  // Of all points one after the other: a tenth of a millisecond alone would be spent on what the
  // work before it left in caches.
  static constexpr int kPasses = 20;
  static constexpr std::array<BlendingKind, 3> kBlendings = { BlendingKind::All,
    BlendingKind::Neighbours, BlendingKind::Paper };

private:
  SkeletonGraph graph_;
  int level_;
  KernelKind kernel_;
};

void figure14Meshes(const char* name, const SkeletonGraph& graph, int level, int rounds)
{
  setThreadCount(1);
  for (const KernelKind kernel : { KernelKind::Compact, KernelKind::Cauchy })
  {
    const KnownElements known(graph, level, kernel);
    const std::vector<double> query = known.query(rounds);
    std::array<std::size_t, 4> triangles;
    std::vector<Work> works = { [&]
      { triangles[3] = joinPieces(known.mesh(BlendingKind::All, false)).triangles.size(); } };
    for (std::size_t k = 0; k < 3; ++k)
    {
      works.push_back(
        [&, k]
        {
          const auto pieces = known.mesh(KnownElements::kBlendings[k], true);
          triangles[k] = joinPieces(pieces).triangles.size();
        });
    }
    const std::vector<double> meshes = times(works, rounds);
    std::printf("%-8s %5d %-8s", name, level, nameOf(kernel));
    for (const double seconds : query)
    {
      std::printf(" %9.3f", 1e6 * seconds);
    }
    for (const double seconds : meshes)
    {
      std::printf(" %9.2f", 1e3 * seconds);
    }
    std::printf(" %9zu %9zu %7.1f %7.1f %7.1f\n", triangles[0], triangles[2], query[0] / query[2],
      meshes[1] / meshes[3], meshes[0] / meshes[3]);
  }
}

} // namespace

void printKnownElements(int rounds)
{
  std::printf(
    "\nFigure 14 where elements are known, as [SUB] has it: microseconds a query, value and "
    "gradient; milliseconds for\nthe meshes of all pieces, first by places, then by elements; "
    "triangles; all beside paper: queries, meshes, those by\nplaces. Paper: the element and its "
    "neighbours alone.\n"
    "shape    level kernel      q. all q. neighb  q. paper    places       all neighbours     "
    "paper "
    "tri., all  tri., p.   query  meshes  places\n");
  for (const int level : { 0, 1, 2, 3 })
  {
    figure14Meshes("bretzel", bretzel(), level, std::min(rounds, 5));
    if (level < 3)
    {
      figure14Meshes("alien", alien(), level, std::min(rounds, 5));
    }
  }
}

} // namespace hybridtree::test
