// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/PieceMeshes.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr double kAxisReach = 2.7; // of a piece's mesh from its skeleton, in radii

class Hash
{
public:
  void add(std::uint64_t word)
  {
    state_ = (state_ ^ word) * 0x9e3779b97f4a7c15ull;
    state_ ^= state_ >> 29;
    state_ *= 0xbf58476d1ce4e5b9ull;
    state_ ^= state_ >> 32;
  }
  void add(double value)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    add(word);
  }
  std::uint64_t result() const { return state_; }

private:
  std::uint64_t state_ = 0x6a09e667f3bcc909ull;
};

/// Which parts of a skeleton each piece depends on, as a number for each piece.
class PieceKeys
{
public:
  PieceKeys(const SkeletonField& skeleton, const PieceMeshOptions& options) : skeleton_(skeleton)
  {
    common_.add(skeleton.key);
    common_.add(std::uint64_t(skeleton.elements != nullptr));
    common_.add(std::uint64_t(skeleton.level));
    common_.add(options.refinement);
    common_.add(options.longestEdge);
    common_.add(skeleton.influenceRatio);
    for (const SkeletonSegment& segment : skeleton.refined.segments)
    {
      reach_.push_back(boxOf(segment, skeleton.influenceRatio));
    }
    for (const Triangle& triangle : skeleton.refined.triangles)
    {
      reach_.push_back(boxOf(triangle, skeleton.influenceRatio));
    }
  }

  std::uint64_t ofCurve(const CurvePiece& piece) const
  {
    return of(piece.segments, skeleton_.refined.segments, 0, 1 << skeleton_.level);
  }

  std::uint64_t ofSurface(const SurfacePiece& piece) const
  {
    return of(piece.triangles, skeleton_.refined.triangles, skeleton_.refined.segments.size(),
      1 << (2 * skeleton_.level));
  }

private:
  template <std::size_t N>
  Box3 boxOf(const std::array<std::int32_t, N>& corners, double radii) const
  {
    Box3 box;
    double radius = 0.0;
    for (const std::int32_t point : corners)
    {
      box.extend(skeleton_.refined.points[point]);
      radius = std::max(radius, skeleton_.refined.radii[point]);
    }
    box.min().array() -= radii * radius;
    box.max().array() += radii * radius;
    return box;
  }

  template <std::size_t N>
  void addElement(const std::array<std::int32_t, N>& corners, Hash& hash) const
  {
    for (const std::int32_t point : corners)
    {
      hash.add(std::uint64_t(point));
      for (const double coordinate : skeleton_.refined.points[point])
      {
        hash.add(coordinate);
      }
      hash.add(skeleton_.refined.radii[point]);
    }
  }

  template <std::size_t N>
  std::uint64_t of(const std::vector<std::int32_t>& own,
    const std::vector<std::array<std::int32_t, N>>& elements, std::size_t kind, int parts) const
  {
    Hash hash = common_;
    hash.add(std::uint64_t(kind != 0));
    std::vector<Box3> region;
    for (const std::int32_t coarse : own)
    {
      hash.add(std::uint64_t(coarse));
      Box3 box;
      for (std::int32_t n = coarse * parts; n < (coarse + 1) * parts; ++n)
      {
        box.extend(boxOf(elements[n], kAxisReach));
      }
      region.push_back(box);
    }
    const RefinedSkeleton& all = skeleton_.refined;
    for (std::size_t k = 0; k < reach_.size(); ++k)
    {
      if (std::none_of(
            region.begin(), region.end(), [&](const Box3& b) { return b.intersects(reach_[k]); }))
      {
        continue;
      }
      if (k < all.segments.size())
      {
        addElement(all.segments[k], hash);
      }
      else
      {
        addElement(all.triangles[k - all.segments.size()], hash);
      }
    }
    return hash.result();
  }

  const SkeletonField& skeleton_;
  Hash common_;
  std::vector<Box3> reach_; // segments, then triangles
};

std::size_t bytesOf(const PieceMesh& mesh)
{
  return mesh.points.size() * (3 * sizeof(Vec3) + 5) + mesh.triangles.size() * sizeof(Triangle) +
    mesh.axes.size() * sizeof(SkeletonAxis) + sizeof(PieceMesh);
}

} // namespace

PieceMeshPtr PieceMeshCache::find(std::uint64_t key)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = places_.find(key);
  if (found == places_.end())
  {
    return nullptr;
  }
  ++hits_;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->second;
}

void PieceMeshCache::insert(std::uint64_t key, const PieceMeshPtr& mesh)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (places_.count(key) != 0)
  {
    return;
  }
  entries_.emplace_front(key, mesh);
  places_[key] = entries_.begin();
  bytes_ += bytesOf(*mesh);
  while (bytes_ > maxBytes_ && entries_.size() > 1)
  {
    bytes_ -= bytesOf(*entries_.back().second);
    places_.erase(entries_.back().first);
    entries_.pop_back();
  }
}

PieceMeshPtr PieceMeshCache::last(std::size_t piece) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = last_.find(piece);
  return found == last_.end() ? nullptr : found->second.lock();
}

void PieceMeshCache::setLast(std::size_t piece, const PieceMeshPtr& mesh)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  last_[piece] = mesh;
}

std::size_t PieceMeshCache::hits() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return hits_;
}

std::vector<PieceMeshPtr> pieceMeshes(const SkeletonField& skeleton,
  const PieceMeshOptions& options, PieceMeshCache* cache, const Progress& progress)
{
  const SkeletonPieces pieces = findPieces(skeleton.coarse, SkeletonTopology(skeleton.coarse));
  const std::size_t curves = pieces.curves.size();
  const PieceKeys keys(skeleton, options);
  const PlacedField field{ skeleton.field, skeleton.elements };
  std::vector<PieceMeshPtr> result(pieces.size());
  parallelFor(pieces.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        progress.check();
        const bool isCurve = k < curves;
        const std::uint64_t key = !cache ? 0
          : isCurve                      ? keys.ofCurve(pieces.curves[k])
                                         : keys.ofSurface(pieces.surfaces[k - curves]);
        result[k] = cache ? cache->find(key) : nullptr;
        if (result[k])
        {
          continue;
        }
        const PieceCage cage = isCurve
          ? curveCage(pieces.curves[k], skeleton.refined, skeleton.level, field)
          : surfaceCage(pieces.surfaces[k - curves], skeleton.refined, skeleton.level, field);
        const PieceMeshPtr before = cache ? cache->last(k) : nullptr;
        result[k] = std::make_shared<PieceMesh>(refineCage(
          cage, field, options, before ? before->axes : std::vector<SkeletonAxis>(), progress));
        if (cache)
        {
          cache->insert(key, result[k]);
          cache->setLast(k, result[k]);
        }
      }
    });
  return result;
}

TriangleMesh joinPieces(const std::vector<PieceMeshPtr>& pieces)
{
  TriangleMesh mesh;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const auto first = std::int32_t(mesh.points.size());
    const PieceMesh& piece = *pieces[k];
    mesh.points.insert(mesh.points.end(), piece.points.begin(), piece.points.end());
    mesh.normals.insert(mesh.normals.end(), piece.normals.begin(), piece.normals.end());
    for (const auto& [a, b, c] : piece.triangles)
    {
      mesh.triangles.push_back({ first + a, first + b, first + c });
    }
    mesh.sourceLeaf.resize(mesh.triangles.size(), std::int32_t(k));
  }
  return mesh;
}

} // namespace hybridtree
