// SPDX-License-Identifier: BSD-3-Clause
// Fields of subdivision skeletons.
//   - Figure 14 of [SUB]: all-blending beside our blending with neighbours, and [SUB]'s own with
//     immediate ones ("paper"), on a bretzel and an alien: value and gradient at the vertices of
//     the surface, with both kernels. "Unpruned" sums every element at every point, as [SUB] did,
//     by the same vector kernels. The compact kernel passes over all but the near elements already
//     when all blend, so there the two other times can at best be equal to that. The Cauchy kernel
//     is the one with which blending with neighbours has elements to pass over, as in [SUB].
//   - The closed form of a triangle beside a rule of 64 points (8 x 8, Gauss and Legendre): one
//     point at a time, and over batches in vectors of the same width.
// Medians of rounds in turns, one thread, its processor time.
//
//   ConvolutionBenchmark [rounds, default 7]
#include "core/base/Parallel.h"
#include "core/convolution/ConvolutionKernels.h"
#include "core/nodes/SkeletonElementFields.h"
#include "core/subdivision/PieceMeshes.h"
#include "tests/support/Random.h"
#include "tests/support/SkeletonShapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <time.h>
#include <vector>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

using Work = std::function<void()>;

// Of the processor, of this thread alone.
double threadSeconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Medians in seconds, of all works in turns.
std::vector<double> times(const std::vector<Work>& works, int rounds)
{
  std::vector<std::vector<double>> seconds(works.size());
  for (int round = -1; round < rounds; ++round)
  {
    for (std::size_t k = 0; k < works.size(); ++k)
    {
      const double start = threadSeconds();
      works[k]();
      const double end = threadSeconds();
      if (round >= 0)
      {
        seconds[k].push_back(end - start);
      }
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& of : seconds)
  {
    std::nth_element(of.begin(), of.begin() + of.size() / 2, of.end());
    medians.push_back(of[of.size() / 2]);
  }
  return medians;
}

NodePtr skeleton(const SkeletonGraph& graph, int level, KernelKind kernel, BlendingKind blending)
{
  SubdivisionSkeletonOptions options;
  options.level = level;
  options.kernel.kind = kernel;
  options.blending.kind = blending;
  return makeSubdivisionSkeleton(graph, options);
}

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
      leaf.refined().segments.size(), leaf.refined().triangles.size(), bricks.size,
      kernel == KernelKind::Compact ? "compact" : "cauchy", microseconds(0), microseconds(1),
      microseconds(2), microseconds(3), seconds[1] / seconds[2], seconds[1] / seconds[3]);
  }
}

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
      { leaf.coarse(), leaf.refined(), level_, leaf, 2.0, 0, byElements ? &*elements : nullptr },
      {});
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
          for (const auto& [element, list] : points)
          {
            field->evaluate(element, list.batch(), value.data(), &slopes);
          }
        });
    }
    std::vector<double> seconds = times(works, rounds);
    for (double& of : seconds)
    {
      of /= double(count);
    }
    return seconds;
  }

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
    std::printf("%-8s %5d %-8s", name, level, kernel == KernelKind::Compact ? "compact" : "cauchy");
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

// 8 x 8 nodes on a triangle: collapsed to one corner.
struct Rule
{
  std::array<Vec3, 64> nodes;
  std::array<double, 64> weights;

  Rule(const Vec3& a, const Vec3& b, const Vec3& c)
  {
    constexpr std::array<double, 4> kNodes = { 0.1834346424956498, 0.5255324099163290,
      0.7966664774136267, 0.9602898564975363 };
    constexpr std::array<double, 4> kWeights = { 0.3626837833783620, 0.3137066458778873,
      0.2223810344533745, 0.1012285362903763 };
    const auto node = [&](int k)
    { return 0.5 + (k < 4 ? -0.5 : 0.5) * kNodes[std::size_t(k < 4 ? k : k - 4)]; };
    const auto weight = [&](int k) { return 0.5 * kWeights[std::size_t(k < 4 ? k : k - 4)]; };
    const double jacobian = (b - a).cross(c - a).norm();
    for (int i = 0; i < 8; ++i)
    {
      for (int j = 0; j < 8; ++j)
      {
        const double s = node(i);
        const double t = node(j) * (1.0 - s);
        nodes[std::size_t(8 * i + j)] = a + s * (b - a) + t * (c - a);
        weights[std::size_t(8 * i + j)] = weight(i) * weight(j) * (1.0 - s) * jacobian;
      }
    }
  }
};

// n = 2, one point at a time.
void byPoints(const Rule& rule, double inverseSquared, PointBatch points, double* value)
{
  for (std::size_t k = 0; k < points.size; ++k)
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < 64; ++i)
    {
      const double g =
        std::max(0.0, 1.0 - (points[k] - rule.nodes[i]).squaredNorm() * inverseSquared);
      sum += rule.weights[i] * g * g;
    }
    value[k] = sum;
  }
}

// The same over batches: vectors as wide as the processor's.
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"))) void inVectors(
  const Rule& rule, double inverseSquared, PointBatch points, double* value)
{
  std::fill_n(value, points.size, 0.0);
  constexpr std::size_t kBlock = 256;
  for (std::size_t begin = 0; begin < points.size; begin += kBlock)
  {
    const std::size_t end = std::min(points.size, begin + kBlock);
    for (std::size_t i = 0; i < 64; ++i)
    {
      const double nx = rule.nodes[i].x();
      const double ny = rule.nodes[i].y();
      const double nz = rule.nodes[i].z();
      const double weight = rule.weights[i];
      for (std::size_t k = begin; k < end; ++k)
      {
        const double dx = points.x[k] - nx;
        const double dy = points.y[k] - ny;
        const double dz = points.z[k] - nz;
        const double rest = 1.0 - (dx * dx + dy * dy + dz * dz) * inverseSquared;
        const double g = rest > 0.0 ? rest : 0.0;
        value[k] += weight * g * g;
      }
    }
  }
}

void triangles(int rounds)
{
  Random random(1);
  const ConvolutionKernel kernel;
  const double reach = 1.0;
  for (const double size : { 0.5, 1.0, 2.0 })
  {
    const Vec3 a = Vec3::Zero();
    const Vec3 b(size, 0, 0);
    const Vec3 c(0.4 * size, 0.9 * size, 0);
    Box3 box(a);
    box.extend(b).extend(c);
    const PointList points = randomPoints(random,
      Box3(Vec3(box.min() - Vec3::Constant(reach)), Vec3(box.max() + Vec3::Constant(reach))),
      20000);
    const TriangleElement triangle = makeTriangleElement({ a, b, c }, { reach, reach, reach });
    const TriangleElement sloped =
      makeTriangleElement({ a, b, c }, { reach, 1.2 * reach, 1.1 * reach });
    const Rule rule(a, b, c);
    const double amplitude = triangleAmplitude(kernel);
    std::vector<double> closed(points.size());
    std::vector<double> other(points.size());
    const auto sum = [&](const TriangleElement& element, PointBatch batch, double* value)
    {
      const TriangleElement* pointer = &element;
      std::fill_n(value, batch.size, 0.0);
      convolutionKernels(kernel.kind).addTriangles({ &pointer, 1 }, kernel, batch, value);
    };
    const auto singly = [&]
    {
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        sum(triangle, points.batch().slice(k, 1), other.data() + k);
      }
    };
    const std::vector<double> seconds =
      times({ [&] { sum(sloped, points, other.data()); }, singly,
              [&] { byPoints(rule, 1.0 / (reach * reach), points, other.data()); },
              [&] { sum(triangle, points, closed.data()); },
              [&] { inVectors(rule, 1.0 / (reach * reach), points, other.data()); } },
        rounds);
    double error = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      error = std::max(error, std::abs(amplitude * other[k] - closed[k]));
    }
    const auto nanoseconds = [&](std::size_t k) { return 1e9 * seconds[k] / points.size(); };
    std::printf("%6.1f %10.1f %10.1f %10.1f %12.1f %12.1f %10.1f %10.1f %10.1f %10.1e\n", size,
      nanoseconds(3), nanoseconds(0), nanoseconds(1), nanoseconds(2), nanoseconds(4),
      seconds[2] / seconds[3], seconds[4] / seconds[3], seconds[2] / seconds[1], error);
  }
}

} // namespace

int main(int argc, char** argv)
{
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  std::printf("Figure 14: microseconds a point, value and gradient\n"
              "shape    level  elements     points kernel    unpruned       all  neighbours     "
              "paper     all/n     all/p\n");
  for (const int level : { 0, 2 })
  {
    figure14("bretzel", bretzel(), level, rounds);
    figure14("alien", alien(), level, rounds);
  }
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
  std::printf(
    "\nOne triangle, edges in units of R: nanoseconds a point; ratios to the closed form\n"
    "  size     closed     sloped    one by 1   64, one by 1   64, vectors   1by1/closed "
    "vect/closed 1by1/1by1 error of 64\n");
  triangles(rounds);
  return 0;
}
