// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/SubdivisionSkeletonMesh.h"

#include "core/base/Parallel.h"
#include "core/geometry/PointTriangle.h"
#include "core/mesh/Remesh.h"
#include "core/nodes/LatticeMesh.h"
#include "core/nodes/MappedMesh.h"
#include "core/nodes/SkeletonElementFields.h"
#include "core/nodes/SkeletonLocalField.h"
#include "core/nodes/SurfaceProjection.h"
#include "core/subdivision/SkeletonMesh.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

PieceMeshCache& sharedCache()
{
  static PieceMeshCache cache;
  return cache;
}

SkeletonField fieldOf(const SubdivisionSkeleton& leaf, const SkeletonElementFields& elements,
  const SkeletonLocalField& local)
{
  return { leaf.coarse(), leaf.refined(), leaf.options().level, leaf, &elements,
    leaf.options().blending.kind == BlendingKind::All, &local };
}

constexpr std::size_t kTogether = 32; // points whose elements are looked for at once
constexpr double kRounding = 1e-9;    // of distances, in radii

/// The piece of the refined element that a point is nearest to.
class PieceFinder
{
public:
  explicit PieceFinder(const SubdivisionSkeleton& leaf)
    : leaf_(leaf), inverse_(leaf.map() ? leaf.map()->inverse() : Affine3::Identity())
  {
  }

  /// \param points of the node's space, in a small box.
  void find(const std::vector<Vec3>& points, std::int32_t* pieces) const
  {
    Box3 box;
    for (const Vec3& point : points)
    {
      box.extend(point);
    }
    std::vector<Vec3> own(points.size());
    std::transform(
      points.begin(), points.end(), own.begin(), [&](const Vec3& p) { return inverse_ * p; });
    std::vector<double> least;
    const std::vector<Candidate> candidates = this->candidatesIn(box, own, least);
    const bool isOne = areOfOnePiece(candidates);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      pieces[k] = candidates.empty() ? -1
        : isOne                      ? candidates.front().piece
                                     : this->nearest(candidates, own[k], least[k]);
    }
  }

private:
  // An element, and a ball around it.
  struct Candidate
  {
    bool isSegment;
    std::size_t element;
    std::int32_t piece;
    Vec3 center;
    double size;
    double radius; // the largest of the skeleton
    std::size_t order;

    double leastDistance(const Vec3& p) const { return ((p - center).norm() - size) / radius; }
    /// \param squared way from the center to a point.
    bool mayBeWithin(double distance, double squared) const
    {
      const double most = size + (distance + kRounding) * radius;
      return squared <= most * most;
    }
  };

  static bool areOfOnePiece(const std::vector<Candidate>& candidates)
  {
    return std::all_of(candidates.begin(), candidates.end(),
      [&](const Candidate& of) { return of.piece == candidates.front().piece; });
  }

  /// Those that may be the nearest to one of the points, if these are of several pieces. \param
  /// least to be filled: how far each point is from one of them.
  std::vector<Candidate> candidatesIn(
    const Box3& box, const std::vector<Vec3>& points, std::vector<double>& least) const
  {
    const SubdivisionSkeleton::Reaching reaching = leaf_.elementsReaching(box);
    std::vector<Candidate> candidates;
    const auto add = [&](bool isSegment, std::size_t element, std::int32_t piece, auto corners)
    {
      Candidate of{ isSegment, element, piece, Vec3::Zero(), 0.0, 0.0, candidates.size() };
      for (const std::int32_t corner : corners)
      {
        of.center += this->at(corner);
        of.radius = std::max(of.radius, this->radius(corner));
      }
      of.center *= 1.0 / double(corners.size());
      for (const std::int32_t corner : corners)
      {
        of.size = std::max(of.size, (this->at(corner) - of.center).norm());
      }
      candidates.push_back(of);
    };
    const RefinedSkeleton& refined = leaf_.refined();
    for (const std::size_t s : reaching.segments)
    {
      add(true, s, leaf_.pieces().segments[std::size_t(refined.segmentParents[s])],
        refined.segments[s]);
    }
    for (const std::size_t t : reaching.triangles)
    {
      add(false, t, leaf_.pieces().triangles[std::size_t(refined.triangleParents[t])],
        refined.triangles[t]);
    }
    this->dropFar(inverse_ * box.center(), points, candidates, least);
    return candidates;
  }

  /// The one whose ball is nearest to the middle bounds how far all points are from theirs: what is
  /// farther is no candidate.
  void dropFar(const Vec3& middle, const std::vector<Vec3>& points,
    std::vector<Candidate>& candidates, std::vector<double>& least) const
  {
    if (areOfOnePiece(candidates))
    {
      return;
    }
    double size = 0.0;
    for (const Vec3& p : points)
    {
      size = std::max(size, (p - middle).norm());
    }
    std::vector<double> bounds;
    bounds.reserve(candidates.size());
    for (const Candidate& of : candidates)
    {
      bounds.push_back(of.leastDistance(middle));
    }
    const Candidate first =
      candidates[std::size_t(std::min_element(bounds.begin(), bounds.end()) - bounds.begin())];
    double most = 0.0;
    for (const Vec3& p : points)
    {
      least.push_back(this->distance(first, p));
      most = std::max(most, least.back());
    }
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                       [&](const Candidate& of)
                       { return bounds[of.order] - size / of.radius > most + kRounding; }),
      candidates.end());
  }

  double distance(const Candidate& of, const Vec3& p) const
  {
    return of.isSegment ? this->distanceToSegment(p, leaf_.refined().segments[of.element])
                        : this->distanceToTriangle(p, leaf_.refined().triangles[of.element]);
  }

  /// A candidate and the squared way from its center to a point.
  struct Near
  {
    double squared;
    const Candidate* candidate;

    bool operator<(const Near& other) const { return squared < other.squared; }
  };

  /// The best so far of a point.
  struct Best
  {
    const Candidate* candidate;
    double distance;
  };

  /// Of those equally near the first in the skeleton. \param least distance from any candidate.
  std::int32_t nearest(const std::vector<Candidate>& candidates, const Vec3& p, double least) const
  {
    static thread_local std::vector<Near> near; // no allocation once warm
    near.clear();
    for (const Candidate& of : candidates)
    {
      const double squared = (p - of.center).squaredNorm();
      if (of.mayBeWithin(least, squared))
      {
        near.push_back({ squared, &of });
      }
    }
    const Candidate* const first = std::min_element(near.begin(), near.end())->candidate;
    Best best{ first, this->distance(*first, p) };
    // Others of its piece matter only where one of another piece is nearer than it.
    this->improve(near, p, first->piece, false, best);
    if (best.candidate != first)
    {
      this->improve(near, p, first->piece, true, best);
    }
    return best.candidate->piece;
  }

  /// Looks among those of a piece, or not of it.
  void improve(
    const std::vector<Near>& near, const Vec3& p, std::int32_t piece, bool isOfIt, Best& best) const
  {
    for (const Near& of : near)
    {
      if ((of.candidate->piece == piece) != isOfIt ||
        !of.candidate->mayBeWithin(best.distance, of.squared))
      {
        continue;
      }
      const double distance = this->distance(*of.candidate, p);
      if (distance < best.distance ||
        (distance == best.distance && of.candidate->order < best.candidate->order))
      {
        best = { of.candidate, distance };
      }
    }
  }

  const Vec3& at(std::int32_t point) const { return leaf_.refined().points[std::size_t(point)]; }
  double radius(std::int32_t point) const { return leaf_.refined().radii[std::size_t(point)]; }

  double distanceToSegment(const Vec3& p, const SkeletonSegment& ends) const
  {
    const Vec3 way = at(ends[1]) - at(ends[0]);
    const double t = std::clamp((p - at(ends[0])).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const double here = (1.0 - t) * radius(ends[0]) + t * radius(ends[1]);
    return (p - at(ends[0]) - t * way).norm() / here;
  }

  double distanceToTriangle(const Vec3& p, const Triangle& corners) const
  {
    const Vec3 nearest = nearestOnTriangle(p, at(corners[0]), at(corners[1]), at(corners[2])).point;
    const double mean = (radius(corners[0]) + radius(corners[1]) + radius(corners[2])) / 3.0;
    return (p - nearest).norm() / mean;
  }

  const SubdivisionSkeleton& leaf_;
  Affine3 inverse_;
};

/// The same skeleton in its own space.
NodePtr withoutMap(const SubdivisionSkeleton& leaf)
{
  return std::make_shared<SubdivisionSkeleton>(leaf.shape(), Affine3::Identity());
}

/// What to do where blending control takes long; empty where it does not.
std::string slownessWarning(const SubdivisionSkeleton& leaf)
{
  constexpr double kMany = 300.0;
  const double count = leaf.convolution().meanNeighbours();
  return count <= kMany ? std::string()
                        : "A piece of this skeleton has " + std::to_string(std::int64_t(count)) +
      " others near it. Blending = neighbours compares them all, and that is slow: Blending = all, "
      "a smaller radius or BlendDistance, or a coarser skeleton takes less, and Preview shows the "
      "pieces sooner.";
}

/// The mesh made in the skeleton's own space, mapped and mended.
TriangleMesh mappedMesh(const SubdivisionSkeleton& leaf, double edgeLength, std::string& warning,
  const Progress& progress)
{
  const NodePtr own = withoutMap(leaf);
  TriangleMesh mesh = subdivisionSkeletonMesh(static_cast<const SubdivisionSkeleton&>(*own),
    edgeLength / middleStretch(*leaf.map()), warning, ProgressPart(progress, 0.0, 0.8));
  applyMap(*leaf.map(), mesh);
  mesh.sourceLeaf.clear(); // pieces are to have no borders here
  RemeshOptions options;
  options.edgeLength = edgeLength;
  remeshStretched(
    mesh, options,
    [&](std::vector<Vec3>& points, std::vector<Vec3>& normals)
    { projectOntoSurface(leaf, 0.5 * edgeLength, points, normals, progress); },
    ProgressPart(progress, 0.8, 1.0));
  mesh.sourceLeaf = skeletonPieceNumbers(leaf, mesh);
  return mesh;
}

} // namespace

TriangleMesh subdivisionSkeletonMesh(const SubdivisionSkeleton& leaf, double edgeLength,
  std::string& warning, const Progress& progress)
{
  if (leaf.isNegative())
  {
    return latticeMesh(leaf, edgeLength, progress);
  }
  if (leaf.map())
  {
    return mappedMesh(leaf, edgeLength, warning, progress);
  }
  SkeletonMeshOptions options;
  options.edgeLength = edgeLength;
  options.refinement = leaf.options().refinement;
  const SkeletonElementFields elements(leaf, SkeletonElementFields::Sums::Largest);
  const SkeletonLocalField local(leaf);
  std::optional<StitchedMesh> made = skeletonMesh(
    fieldOf(leaf, elements, local), options, &sharedCache(), ProgressPart(progress, 0.0, 0.8));
  if (const std::string slow = slownessWarning(leaf); !slow.empty())
  {
    warning = slow;
  }
  if (made && made->mesh.triangles.empty())
  {
    warning = "The skeleton has no surface: it is too short beside its radius, or too thin for the "
              "edge length. Change its radius, or make InfluenceRatio or the edge length smaller.";
  }
  if (!made)
  {
    warning = "The meshes of the skeleton's pieces could not be joined; all of it was polygonized. "
              "A shorter edge length may help. " +
      slownessWarning(leaf);
    return latticeMesh(leaf, edgeLength, ProgressPart(progress, 0.8, 1.0));
  }
  return std::move(made->mesh);
}

TriangleMesh subdivisionSkeletonPreview(const SubdivisionSkeleton& leaf, const Progress& progress)
{
  if (leaf.isNegative())
  {
    return {};
  }
  if (const std::optional<Affine3> map = leaf.map())
  {
    const NodePtr own = withoutMap(leaf);
    TriangleMesh mesh =
      subdivisionSkeletonPreview(static_cast<const SubdivisionSkeleton&>(*own), progress);
    applyMap(*map, mesh);
    return mesh;
  }
  PieceMeshOptions options;
  options.refinement = leaf.options().refinement;
  const SkeletonElementFields elements(leaf, SkeletonElementFields::Sums::Own);
  const SkeletonLocalField local(leaf);
  return joinPieces(pieceMeshes(fieldOf(leaf, elements, local), options, &sharedCache(), progress));
}

void nearestPieces(const SubdivisionSkeleton& leaf, PointBatch points, std::int32_t* pieces)
{
  const PieceFinder finder(leaf);
  std::vector<Vec3> together; // neighbours in the list are often neighbours in space
  for (std::size_t first = 0; first < points.size; first += kTogether)
  {
    together.clear();
    for (std::size_t k = first; k < std::min(first + kTogether, points.size); ++k)
    {
      together.push_back(points[k]);
    }
    finder.find(together, pieces + first);
  }
}

std::vector<std::int32_t> skeletonPieceNumbers(
  const SubdivisionSkeleton& leaf, const TriangleMesh& mesh)
{
  const PieceFinder finder(leaf);
  std::vector<std::int32_t> result(mesh.triangles.size());
  parallelFor(result.size(), kTogether,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<Vec3> centers;
      for (std::size_t first = begin; first < end; first += kTogether)
      {
        centers.clear();
        for (std::size_t t = first; t < std::min(first + kTogether, end); ++t)
        {
          const auto& [a, b, c] = mesh.triangles[t];
          centers.push_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0);
        }
        finder.find(centers, result.data() + first);
      }
    });
  return result;
}

} // namespace hybridtree
