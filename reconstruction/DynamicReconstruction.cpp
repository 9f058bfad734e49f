// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/DynamicReconstruction.h"

#include "reconstruction/ConvectedSolid.h"
#include "reconstruction/SpatialOrder.h"
#include "reconstruction/WorkEstimate.h"

#include "core/base/Error.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace hybridtree
{
namespace
{

// Cells of the first subset are flat to this share of the tolerance. Sampled once a cell, a surface
// of constant curvature is about three times as far from its facets as its points from their plane.
constexpr double kFlat = 0.35;
// Share of the wanted vertices in the first subset; the others go where the surface misses most.
constexpr double kFirstShare = 0.85;
// A subset for a tolerance this many times finer than the wanted one has too many vertices.
constexpr double kTooFine = 1.5;
// A surface of fewer vertices than this share of the wanted ones has missed something.
constexpr double kFewVertices = 0.9;
// One that is this many times coarser, in vertices or tolerance, may have missed what matters now.
constexpr double kTooCoarse = 2.5;

void checkDetail(const LevelOfDetail& detail)
{
  if (!(detail.tolerance >= 0.0) || !std::isfinite(detail.tolerance))
  {
    throw InvalidParameter("Tolerance", detail.tolerance, "a finite length above 0");
  }
  if ((detail.tolerance > 0.0) == (detail.vertices > 0))
  {
    throw InvalidParameter(
      "Tolerance", detail.tolerance, "above 0, or else a number of vertices; one of the two");
  }
  if (detail.vertices > 0 && detail.vertices < 4)
  {
    throw InvalidParameter("TargetVertices", double(detail.vertices), "at least 4");
  }
  if (!(detail.regionTolerance >= 0.0) || !std::isfinite(detail.regionTolerance))
  {
    throw InvalidParameter("RefineTolerance", detail.regionTolerance, "a finite length from 0 on");
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double end : { detail.region.min()[axis], detail.region.max()[axis] })
    {
      if (!std::isfinite(end))
      {
        throw InvalidParameter("RefineOrigin + RefineLengths", end, "a finite coordinate");
      }
    }
  }
}

} // namespace

DynamicReconstruction::DynamicReconstruction(
  const std::vector<Vec3>& points, const ConvectionOptions& options, const Progress& progress)
  : options_(options)
{
  this->add(points, progress);
}

void DynamicReconstruction::add(const std::vector<Vec3>& points, const Progress& progress)
{
  checkExtent(points);
  const std::size_t known = points_.size();
  for (const std::int32_t k : spatialOrder(points, progress))
  {
    points_.push_back(points[k]);
    ids_.push_back(static_cast<std::int32_t>(known) + k);
  }
  removed_.resize(points_.size(), 0);
  octree_.reset();
}

void DynamicReconstruction::remove(const std::vector<std::int32_t>& points)
{
  std::vector<std::uint8_t> listed(points_.size(), 0);
  for (const std::int32_t id : points)
  {
    listed.at(id) = 1;
  }
  octree_.reset();
  for (std::int32_t point = 0; point < static_cast<std::int32_t>(ids_.size()); ++point)
  {
    if (listed[ids_[point]] == 0)
    {
      continue;
    }
    removed_[point] = 1;
    if (state_ && static_cast<std::size_t>(point) < measured_)
    {
      state_->near.remove(point);
    }
  }
  if (!state_)
  {
    return;
  }
  const auto& used = state_->pointOfSite;
  const auto gone = [&](std::int32_t point) { return point >= 0 && removed_[point] != 0; };
  const auto first =
    static_cast<std::size_t>(std::find_if(used.begin(), used.end(), gone) - used.begin());
  if (first < state_->baseSites)
  {
    state_.reset();
    return;
  }
  while (used.size() > first)
  {
    this->takeBack();
  }
  levelSteps_ = std::min(levelSteps_, state_->surface.stepCount());
}

ReconstructedSurface DynamicReconstruction::update(
  const LevelOfDetail& detail, const Progress& progress)
{
  checkDetail(detail);
  const auto count = static_cast<std::size_t>(std::count(removed_.begin(), removed_.end(), 0));
  if (count <= detail.vertices)
  {
    return this->ofAll(progress);
  }
  if (!state_ || !this->reaches(detail))
  {
    this->startAgain(detail, ProgressPart(progress, 0.0, 0.5));
  }
  else
  {
    this->measureNew(progress);
    this->takeBackTo(detail, ProgressPart(progress, 0.3, 0.5));
  }
  const Phase level = Phase::ofLevel(detail);
  this->refine(level, ProgressPart(progress, 0.5, 0.8));
  this->convectAgain(level, ProgressPart(progress, 0.8, 0.88));
  this->hold(level, ProgressPart(progress, 0.88, 0.9));
  levelSteps_ = state_->surface.stepCount();
  if (!detail.region.isEmpty())
  {
    this->refine(Phase::ofRegion(detail), ProgressPart(progress, 0.9, 0.98));
    this->hold(Phase::ofRegion(detail), ProgressPart(progress, 0.98, 1.0));
  }
  return this->result(detail);
}

// Whether the first subset is no finer than the level, nor much coarser.
bool DynamicReconstruction::reaches(const LevelOfDetail& detail) const
{
  const auto wanted = static_cast<double>(detail.vertices);
  const auto base = static_cast<double>(state_->baseVertices);
  const double flat = kFlat * detail.tolerance;
  return detail.vertices > 0 ? base <= wanted && wanted <= kTooCoarse * base
                             : kTooFine * roughness_ >= flat && roughness_ <= kTooCoarse * flat;
}

ReconstructedSurface DynamicReconstruction::ofAll(const Progress& progress) const
{
  const std::vector<std::int32_t> used = this->usedPoints();
  std::vector<Vec3> points(used.size());
  std::transform(
    used.begin(), used.end(), points.begin(), [&](std::int32_t point) { return points_[point]; });
  ConvectionOptions options = options_;
  options.normals = this->normalsOf(used);
  ReconstructedSurface surface = reconstruct(points, options, progress);
  for (std::int32_t& point : surface.pointIds)
  {
    point = ids_[used[point]];
  }
  return surface;
}

// None if none were given; 0 for points that came later.
std::vector<Vec3> DynamicReconstruction::normalsOf(const std::vector<std::int32_t>& points) const
{
  std::vector<Vec3> normals;
  for (std::size_t k = 0; k < points.size() && !options_.normals.empty(); ++k)
  {
    const auto id = static_cast<std::size_t>(ids_[points[k]]);
    normals.push_back(id < options_.normals.size() ? options_.normals[id] : Vec3(Vec3::Zero()));
  }
  return normals;
}

std::vector<std::int32_t> DynamicReconstruction::usedPoints() const
{
  std::vector<std::int32_t> points;
  for (std::size_t k = 0; k < points_.size(); ++k)
  {
    if (removed_[k] == 0)
    {
      points.push_back(static_cast<std::int32_t>(k));
    }
  }
  return points;
}

void DynamicReconstruction::startAgain(const LevelOfDetail& detail, const Progress& progress)
{
  state_ = std::make_unique<State>(points_);
  state_->surface.limitTetrahedra(mostTetrahedra(options_.maxMemory));
  levelSteps_ = 0;
  if (!octree_)
  {
    active_ = this->usedPoints();
    activePoints_.resize(active_.size());
    std::transform(active_.begin(), active_.end(), activePoints_.begin(),
      [&](std::int32_t point) { return points_[point]; });
    octree_ = std::make_unique<PointOctree>(activePoints_, ProgressPart(progress, 0.0, 0.1));
  }
  if (detail.vertices > 0)
  {
    roughness_ =
      octree_->splitInto(static_cast<std::size_t>(kFirstShare * double(detail.vertices)));
  }
  else
  {
    roughness_ = kFlat * detail.tolerance;
    octree_->splitToTolerance(roughness_);
  }
  const std::vector<std::int32_t> chosen = this->representatives();
  checkOptions(std::max(chosen.size(), detail.vertices), options_);
  this->addSites(chosen, ProgressPart(progress, 0.1, 0.4));
  while (!this->convect(ProgressPart(progress, 0.4, 0.8)) && this->addFiner(progress))
  {
  }
  this->measureAll(progress);
}

std::vector<std::int32_t> DynamicReconstruction::representatives() const
{
  std::vector<std::int32_t> chosen = octree_->representatives();
  std::transform(chosen.begin(), chosen.end(), chosen.begin(),
    [&](std::int32_t point) { return active_[point]; });
  return chosen;
}

// Twice the points, where the first ones did not do; at last all. \returns whether any were left.
bool DynamicReconstruction::addFiner(const Progress& progress)
{
  const std::size_t leaves = octree_->leafCount();
  octree_->splitInto(2 * leaves);
  const bool finer = octree_->leafCount() > leaves;
  std::vector<std::int32_t> chosen = finer ? this->representatives() : active_;
  std::vector<std::uint8_t> used(points_.size(), 0);
  for (const std::int32_t point : state_->pointOfSite)
  {
    used[point] = 1;
  }
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(),
                 [&](std::int32_t point) { return used[point] != 0; }),
    chosen.end());
  checkOptions(state_->surface.sites().size() + chosen.size(), options_);
  this->addSites(chosen, progress);
  return finer || !chosen.empty();
}

// Without regard to the surface, which is to be found again.
void DynamicReconstruction::addSites(
  const std::vector<std::int32_t>& points, const Progress& progress)
{
  std::vector<Vec3> sites(points.size());
  std::transform(points.begin(), points.end(), sites.begin(),
    [&](std::int32_t point) { return points_[point]; });
  this->removeUnusedSites();
  const std::vector<std::int32_t> order = spatialOrder(sites, progress);
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const std::int32_t point = points[order[k]];
    sites[k] = points_[point];
    state_->pointOfSite.push_back(point);
  }
  state_->surface.insert(sites, progress);
}

void DynamicReconstruction::removeUnusedSites()
{
  std::vector<std::int32_t>& points = state_->pointOfSite;
  std::vector<std::uint8_t> kept(points.size());
  std::transform(
    points.begin(), points.end(), kept.begin(), [](std::int32_t point) { return point >= 0; });
  if (std::find(kept.begin(), kept.end(), 0) != kept.end())
  {
    state_->surface.removeSites(kept);
    points.erase(std::remove(points.begin(), points.end(), -1), points.end());
  }
}

// \returns whether there is a solid to go on from.
bool DynamicReconstruction::convect(const Progress& progress)
{
  DynamicSurface& surface = state_->surface;
  if (!surface.spansVolume() && surface.sites().size() < active_.size())
  {
    return false;
  }
  const Tetrahedralization tetrahedra = surface.tetrahedralization(progress);
  state_->warnings.clear();
  const std::vector<Vec3> normals = this->normalsOf(state_->pointOfSite);
  surface.setInside(tetrahedra,
    convectSolid(
      tetrahedra, options_, normals.empty() ? nullptr : &normals, state_->warnings, progress));
  std::vector<std::uint8_t> seen(surface.sites().size(), 0);
  for (const std::int32_t triangle : surface.surface())
  {
    for (const std::int32_t site : surface.triangle(triangle))
    {
      seen[site] = 1;
    }
  }
  state_->baseVertices = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), 1));
  state_->baseSites = surface.sites().size();
  state_->moreTriangles = 0;
  state_->reach.clear();
  return state_->warnings.empty();
}

void DynamicReconstruction::measureAll(const Progress& progress)
{
  state_->near.clear();
  state_->near.measure(this->usedPoints(), state_->surface, progress);
  measured_ = points_.size();
}

void DynamicReconstruction::measureNew(const Progress& progress)
{
  std::vector<std::int32_t> points;
  for (; measured_ < points_.size(); ++measured_)
  {
    if (removed_[measured_] == 0)
    {
      points.push_back(static_cast<std::int32_t>(measured_));
    }
  }
  state_->near.measure(points, state_->surface, progress);
}

// Of a closed manifold of constant topology, a vertex for every two triangles.
std::size_t DynamicReconstruction::vertexCount() const
{
  return state_->baseVertices + static_cast<std::size_t>(state_->moreTriangles / 2);
}

std::ptrdiff_t DynamicReconstruction::eulerNumber() const
{
  return std::ptrdiff_t(this->vertexCount()) - std::ptrdiff_t(state_->surface.surface().size() / 2);
}

void DynamicReconstruction::takeBack()
{
  state_->surface.undo();
  state_->pointOfSite.resize(state_->surface.sites().size());
  state_->reach.pop_back();
  this->follow(alone_);
  state_->moreTriangles += std::exchange(alone_.moreTriangles, 0);
}

void DynamicReconstruction::takeBackTo(const LevelOfDetail& detail, const Progress& progress)
{
  const auto tooFine = [&]
  {
    const std::size_t steps = state_->surface.stepCount();
    return steps > 0 &&
      (steps > levelSteps_ ||
        (detail.vertices > 0 ? this->vertexCount() > detail.vertices
                             : state_->reach.back() <= detail.tolerance));
  };
  for (std::size_t step = 0; tooFine(); ++step)
  {
    if (step % 256 == 0)
    {
      progress.check();
    }
    this->takeBack();
  }
}

ReconstructedSurface DynamicReconstruction::result(const LevelOfDetail& detail) const
{
  ReconstructedSurface result;
  result.warnings = state_->warnings;
  this->warn(detail, result.warnings);
  const DynamicSurface& surface = state_->surface;
  const std::vector<std::int32_t> triangles = surface.surface();
  std::vector<std::int32_t> meshPoint(surface.sites().size(), -1);
  result.mesh.triangles.reserve(triangles.size());
  for (const std::int32_t number : triangles)
  {
    Triangle triangle = surface.triangle(number);
    for (std::int32_t& corner : triangle)
    {
      std::int32_t& point = meshPoint[corner];
      if (point < 0)
      {
        point = static_cast<std::int32_t>(result.mesh.points.size());
        result.mesh.points.push_back(surface.sites()[corner]);
        result.pointIds.push_back(ids_[state_->pointOfSite[corner]]);
      }
      corner = point;
    }
    result.mesh.triangles.push_back(triangle);
  }
  setAreaNormals(result.mesh);
  return result;
}

void DynamicReconstruction::warn(
  const LevelOfDetail& detail, std::vector<std::string>& warnings) const
{
  const std::size_t vertices = this->vertexCount();
  if (detail.vertices > 0 && detail.region.isEmpty() &&
    double(vertices) > 1.05 * double(detail.vertices))
  {
    warnings.push_back("TargetVertices " + std::to_string(detail.vertices) +
      " are too few to tell inside from outside: the surface has " + std::to_string(vertices) +
      ".");
  }
  if (double(vertices) < kFewVertices * double(detail.vertices))
  {
    warnings.push_back("The surface could take up only " + std::to_string(vertices) + " of " +
      std::to_string(detail.vertices) +
      " TargetVertices: the points are on too open a surface, or scattered. Use all points.");
  }
  if (detail.tolerance > 0.0)
  {
    this->warnOf(Phase::ofLevel(detail), "Tolerance", warnings);
  }
  if (!detail.region.isEmpty() && detail.regionTolerance > 0.0)
  {
    this->warnOf(Phase::ofRegion(detail), "RefineTolerance", warnings);
  }
}

void DynamicReconstruction::warnOf(
  const Phase& phase, const std::string& name, std::vector<std::string>& warnings) const
{
  const std::vector<std::int32_t> far = this->farPoints(phase);
  if (far.empty())
  {
    return;
  }
  double most = 0.0;
  for (const std::int32_t point : far)
  {
    most = std::max(most, state_->near.distance(point));
  }
  std::ostringstream text;
  text << far.size() << " of " << this->usedPoints().size() << " points are farther than " << name
       << " " << phase.tolerance << " from the surface, the farthest by " << most
       << ": it could take them up only by touching itself, or by another handle.";
  warnings.push_back(text.str());
}

} // namespace hybridtree
