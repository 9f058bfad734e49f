// SPDX-License-Identifier: BSD-3-Clause
// All that blends asked for by places: see ConvolutionBenchmark.cpp.
#include "benchmarks/convolution/Works.h"
#include "core/convolution/ConvolutionKernels.h"
#include "tests/support/Random.h"
#include "tests/support/SkeletonShapes.h"

#include <array>
#include <cstdio>
#include <map>

namespace hybridtree::test
{
namespace
{

// Every element at every point.
class Unpruned
{
public:
  explicit Unpruned(const SubdivisionSkeleton& node) : kernel_(node.options().kernel)
  {
    const RefinedSkeleton& refined = node.refined();
    const auto point = [&](std::int32_t k) { return refined.points[std::size_t(k)]; };
    const auto reach = [&](std::int32_t k)
    { return kernel_.influenceRatio * refined.radii[std::size_t(k)]; };
    for (const SkeletonSegment& s : refined.segments)
    {
      segments_.push_back(makeSegmentElement(point(s[0]), point(s[1]), reach(s[0]), reach(s[1])));
    }
    for (const Triangle& t : refined.triangles)
    {
      triangles_.push_back(makeTriangleElement(
        { point(t[0]), point(t[1]), point(t[2]) }, { reach(t[0]), reach(t[1]), reach(t[2]) }));
    }
    for (const SegmentElement& segment : segments_)
    {
      segmentPointers_.push_back(&segment);
    }
    for (const TriangleElement& triangle : triangles_)
    {
      trianglePointers_.push_back(&triangle);
    }
  }

  void operator()(PointBatch points, double* value, VectorBatch gradient) const
  {
    for (double* array : { value, gradient.x, gradient.y, gradient.z })
    {
      std::fill_n(array, points.size, 0.0);
    }
    const ConvolutionKernels& kernels = convolutionKernels(kernel_.kind);
    kernels.addSegmentsWithGradient(
      { segmentPointers_.data(), segmentPointers_.size() }, kernel_, points, value, gradient);
    kernels.addTrianglesWithGradient(
      { trianglePointers_.data(), trianglePointers_.size() }, kernel_, points, value, gradient);
  }

private:
  ConvolutionKernel kernel_;
  std::vector<SegmentElement> segments_;
  std::vector<TriangleElement> triangles_;
  std::vector<const SegmentElement*> segmentPointers_;
  std::vector<const TriangleElement*> trianglePointers_;
};

// The points by cells of a grid, as polygonization asks for them: brick by brick.
struct Bricks
{
  struct Brick
  {
    Box3 box;
    PointList points;
  };
  std::vector<Brick> bricks;
  std::size_t size = 0;

  Bricks(const std::vector<Vec3>& points, double side) : size(points.size())
  {
    std::map<std::array<int, 3>, std::size_t> places;
    for (const Vec3& p : points)
    {
      const Vec3 cell = (p / side).array().floor();
      const std::array<int, 3> key = { int(cell.x()), int(cell.y()), int(cell.z()) };
      const auto [found, isNew] = places.emplace(key, bricks.size());
      if (isNew)
      {
        bricks.push_back({ Box3(Vec3(side * cell), Vec3(side * (cell + Vec3::Ones()))), {} });
      }
      bricks[found->second].points.add(p);
    }
  }

  /// body(box, points) for each.
  template <typename Body>
  void forEach(const Body& body) const
  {
    for (const Brick& brick : bricks)
    {
      body(brick.box, brick.points.batch());
    }
  }
};

void figure14(const char* name, const SkeletonGraph& graph, int level, int rounds)
{
  const NodePtr shape = skeleton(graph, level, KernelKind::Compact, BlendingKind::Neighbours);
  const MeshPtr mesh = shape->mesh();
  double reach = 0.0;
  for (const double radius : graph.radii)
  {
    reach += 2.0 * radius / double(graph.radii.size());
  }
  const Bricks bricks(mesh->points, reach);
  VectorList gradient(bricks.size);
  std::vector<double> value(bricks.size);
  for (const KernelKind kernel : { KernelKind::Compact, KernelKind::Cauchy })
  {
    const NodePtr all = skeleton(graph, level, kernel, BlendingKind::All);
    const NodePtr neighbours = skeleton(graph, level, kernel, BlendingKind::Neighbours);
    const NodePtr paper = skeleton(graph, level, kernel, BlendingKind::Paper);
    const auto& leaf = dynamic_cast<const SubdivisionSkeleton&>(*all);
    const Unpruned unpruned(leaf);
    const auto pruned = [&](const Node& node)
    {
      bricks.forEach(
        [&](const Box3& box, PointBatch points)
        {
          if (const FieldSourcePtr part = node.restrictedTo(box))
          {
            part->fieldAndGradient(points, value.data(), gradient);
          }
        });
    };
    const std::vector<double> seconds =
      times({ [&]
              {
                bricks.forEach([&](const Box3&, PointBatch points)
                  { unpruned(points, value.data(), gradient); });
              },
              [&] { pruned(*all); }, [&] { pruned(*neighbours); }, [&] { pruned(*paper); } },
        rounds);
    const double count = double(bricks.size);
    const auto microseconds = [&](std::size_t k) { return 1e6 * seconds[k] / count; };
    std::printf("%-8s %5d %5zu+%-5zu %8zu %-8s %9.3f %9.3f %11.3f %9.3f %9.2f %9.2f\n", name, level,
      leaf.refined().segments.size(), leaf.refined().triangles.size(), bricks.size, nameOf(kernel),
      microseconds(0), microseconds(1), microseconds(2), microseconds(3), seconds[1] / seconds[2],
      seconds[1] / seconds[3]);
  }
}

} // namespace

void printPlaces(int rounds)
{
  std::printf("Figure 14: microseconds a point, value and gradient\n"
              "shape    level  elements     points kernel    unpruned       all  neighbours     "
              "paper     all/n     all/p\n");
  for (const int level : { 0, 2 })
  {
    figure14("bretzel", bretzel(), level, rounds);
    figure14("alien", alien(), level, rounds);
  }
}

} // namespace hybridtree::test
