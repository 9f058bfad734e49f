// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/RemeshSurface.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/CompactMesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr double kLongEdge = 4.0 / 3.0; // edge lengths L
constexpr double kDegrees = 0.017453292519943295;
constexpr double kMaxTriangles = 1e8;
constexpr std::size_t kStepsPerLook = 1024;
constexpr std::size_t kGrain = 16 * IndexSet::kPerWord; // threads must not share words

} // namespace

RemeshSurface::RemeshSurface(
  TriangleMesh& mesh, const RemeshOptions& options, const Progress& progress)
  : mesh_(mesh)
  , progress_(progress)
  , edgeLength_(options.edgeLength)
  , longSquared_(std::pow(kLongEdge * options.edgeLength, 2.0))
  , shortSquared_(std::pow(options.shortEdge * options.edgeLength, 2.0))
  , badShape_(std::cos(kDegrees * options.badAngle))
  , links_(mesh.triangles, mesh.points.size())
{
  this->requireCountable();
  this->measureAll();
}

void RemeshSurface::lookForStop(std::size_t step) const
{
  if (step % kStepsPerLook == 0)
  {
    progress_.check();
  }
}

void RemeshSurface::requireCountable() const
{
  std::vector<double> areas((links_.triangleCount() + kGrain - 1) / kGrain, 0.0);
  parallelFor(links_.triangleCount(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress_.check();
      for (std::size_t t = begin; t < end; ++t)
      {
        areas[begin / kGrain] += this->normal(t).norm();
      }
    });
  const double count =
    std::accumulate(areas.begin(), areas.end(), 0.0) / (edgeLength_ * edgeLength_);
  if (!(count < kMaxTriangles))
  {
    throw TooLarge("An edge length of " + std::to_string(edgeLength_) + " makes some " +
      std::to_string(count) + " triangles; the limit is " + std::to_string(kMaxTriangles) +
      ". Use a longer one.");
  }
}

void RemeshSurface::measureAll()
{
  const std::size_t count = links_.triangleCount();
  shapes_.resize(count);
  edits_.resize(count, 0);
  for (IndexSet* set : { &long_, &bad_, &touched_, &toFlip_ })
  {
    set->resize(count);
  }
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        this->measure(t);
      }
    });
  toFlip_ = bad_;
}

void RemeshSurface::measure(std::size_t t)
{
  const Triangle& c = links_.triangle(t);
  const SquaredSides sides(this->point(c[0]), this->point(c[1]), this->point(c[2]));
  shapes_[t] = shapeOf(sides);
  long_.set(t, sides.longest > longSquared_);
  bad_.set(t, shapes_[t] >= badShape_);
}

std::uint32_t RemeshSurface::lastEditAt(Index p) const
{
  std::uint32_t last = 0;
  links_.forEachLeaving(p, [&](Index leaving) { last = std::max(last, edits_[leaving / 3]); });
  return last;
}

void RemeshSurface::split(Index h, Index middle)
{
  ++edit_;
  const Index twin = links_.twin(h);
  const std::size_t before = links_.triangleCount();
  links_.split(h, middle);
  this->addHalf(h);
  if (twin != MeshLinks::kNone)
  {
    this->addHalf(twin);
  }
  for (std::size_t t = before; t < links_.triangleCount(); ++t)
  {
    this->changed(t);
  }
  this->changed(static_cast<std::size_t>(h / 3));
  if (twin != MeshLinks::kNone)
  {
    this->changed(static_cast<std::size_t>(twin / 3));
  }
}

/// The arrays of the triangle that has come off that of h.
void RemeshSurface::addHalf(Index h)
{
  const std::size_t t = shapes_.size();
  shapes_.push_back(0.0);
  edits_.push_back(edit_);
  for (IndexSet* set : { &long_, &bad_, &touched_, &toFlip_ })
  {
    set->resize(t + 1);
  }
  touched_.insert(t);
  touched_.insert(static_cast<std::size_t>(h / 3));
  for (std::vector<std::int32_t>* source : { &mesh_.sourceLeaf, &mesh_.sourceTriangle })
  {
    if (!source->empty())
    {
      const std::int32_t value = (*source)[h / 3];
      source->push_back(value);
    }
  }
}

void RemeshSurface::flip(Index h)
{
  ++edit_;
  const Index twin = links_.twin(h);
  links_.flip(h);
  for (const Index half : { h, twin })
  {
    this->changeSource(half);
    this->changed(static_cast<std::size_t>(half / 3));
  }
}

void RemeshSurface::collapse(Index h)
{
  ++edit_;
  const Index end = links_.to(h);
  for (const Index half : { h, links_.twin(h) })
  {
    for (IndexSet* set : { &long_, &bad_, &toFlip_ })
    {
      set->erase(static_cast<std::size_t>(half / 3));
    }
  }
  links_.collapse(h);
  links_.forEachLeaving(end, [&](Index leaving) { this->changeSource(leaving); });
  links_.forEachLeaving(
    end, [&](Index leaving) { this->changed(static_cast<std::size_t>(leaving / 3)); });
}

void RemeshSurface::movePoint(Index p, const Vec3& place)
{
  ++edit_;
  mesh_.points[p] = place;
  links_.forEachLeaving(
    p, [&](Index leaving) { this->changed(static_cast<std::size_t>(leaving / 3)); });
}

void RemeshSurface::changeSource(Index h)
{
  touched_.insert(static_cast<std::size_t>(h / 3));
  if (!mesh_.sourceTriangle.empty())
  {
    mesh_.sourceTriangle[h / 3] = -1;
  }
}

/// Its corners or their places are new, so its edges look different from both sides.
void RemeshSurface::changed(std::size_t t)
{
  this->measure(t);
  edits_[t] = edit_;
  this->look(t);
  for (auto h = static_cast<Index>(3 * t); h < static_cast<Index>(3 * t + 3); ++h)
  {
    if (links_.twin(h) != MeshLinks::kNone)
    {
      this->look(static_cast<std::size_t>(links_.twin(h) / 3));
    }
  }
}

void RemeshSurface::look(std::size_t t)
{
  if (touched_.contains(t) || bad_.contains(t))
  {
    toFlip_.insert(t);
  }
}

void RemeshSurface::pack()
{
  std::vector<bool> keep(links_.triangleCount());
  mesh_.triangles.resize(keep.size());
  for (std::size_t t = 0; t < keep.size(); ++t)
  {
    this->lookForStop(t);
    keep[t] = !links_.isRemoved(t);
    mesh_.triangles[t] = links_.triangle(t);
  }
  keepTriangles(mesh_, keep);
}

} // namespace hybridtree
