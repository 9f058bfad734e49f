// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/LevelOfDetail.h"

#include "reconstruction/ConvectedSolid.h"
#include "reconstruction/DynamicSurface.h"
#include "reconstruction/PointOctree.h"
#include "reconstruction/SpatialOrder.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Error.h"
#include "core/mesh/MeshDistance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace hybridtree
{
namespace
{

// Cells of the first subset are flat to this share of the tolerance. Sampled once a cell, a surface
// of constant curvature is about three times as far from its facets as its points from their plane.
constexpr double kFlat = 0.35;
// Share of the wanted vertices in the first subset; the others go where the surface misses most.
constexpr double kFirstShare = 0.85;
// Share of the wanted vertices that will do: the last few would take as long as all others.
constexpr double kEnough = 0.98;
// How often convection may start anew for points that could not be taken up.
constexpr int kRestarts = 3;
constexpr int kMostRounds = 60;

// Distances of points to the surface, and what changes them.
class Refinement
{
public:
  Refinement(const std::vector<Vec3>& points, const LevelOfDetail& detail,
    const ConvectionOptions& options, const Progress& progress);

  void run(const Progress& progress);
  ReconstructedSurface result() const;

private:
  // Of an input point.
  struct State
  {
    Triangle nearest{ -1, -1, -1 };                            // sites of the nearest triangle
    double distance = std::numeric_limits<double>::infinity(); // an upper bound
    std::int32_t leaf = 0;
    bool used = false;    // a site
    bool refused = false; // until the surface near it changes
  };

  void start(const Progress& progress);
  void assignLeaves();
  bool convect(const Progress& progress);
  bool addFiner(const Progress& progress);
  void measure(const std::vector<std::int32_t>& points, const std::vector<Triangle>& triangles);
  void measureAll();
  void measureTouched();
  std::vector<std::int32_t> candidates() const;
  std::size_t vertexCount() const;
  bool hasEnough() const;
  void place(const std::vector<std::int32_t>& points, const Progress& progress);
  void refine(const Progress& progress);
  void startAnew(const Progress& progress);
  std::vector<std::int32_t> farPoints() const;
  std::vector<std::int32_t> left() const;
  void add(const std::vector<std::int32_t>& points, const Progress& progress);
  void warn();
  bool wantsVertices() const { return detail_.vertices > 0; }

  const std::vector<Vec3>& points_;
  LevelOfDetail detail_;
  ConvectionOptions options_;
  PointOctree octree_;
  std::vector<State> states_;
  DynamicSurface surface_;
  std::vector<std::int32_t> pointOfSite_;
  std::vector<Triangle> triangles_;
  std::vector<std::string> warnings_;
};

Refinement::Refinement(const std::vector<Vec3>& points, const LevelOfDetail& detail,
  const ConvectionOptions& options, const Progress& progress)
  : points_(points)
  , detail_(detail)
  , options_(options)
  , octree_(points, progress)
  , states_(points.size())
{
}

void Refinement::run(const Progress& progress)
{
  this->start(ProgressPart(progress, 0.05, 0.3));
  while (!this->convect(ProgressPart(progress, 0.3, 0.5)) && this->addFiner(progress))
  {
  }
  this->measureAll();
  this->refine(ProgressPart(progress, 0.5, 0.8));
  this->startAnew(ProgressPart(progress, 0.8, 1.0));
  this->warn();
}

// For points that could not be taken up. What comes out is kept if it does much better.
void Refinement::startAnew(const Progress& progress)
{
  std::vector<State> states = states_;
  std::vector<Triangle> triangles = triangles_;
  std::vector<std::string> warnings = warnings_;
  std::size_t far = this->farPoints().size();
  for (int restart = 0; restart < kRestarts && far > 0 && !this->left().empty(); ++restart)
  {
    this->add(this->left(), progress);
    const bool solid = this->convect(progress);
    this->measureAll();
    this->refine(progress);
    if (solid && 2 * this->farPoints().size() < far)
    {
      states = states_;
      triangles = triangles_;
      warnings = warnings_;
      far = this->farPoints().size();
    }
  }
  states_.swap(states);
  triangles_.swap(triangles);
  warnings_.swap(warnings);
}

void Refinement::start(const Progress& progress)
{
  if (this->wantsVertices())
  {
    octree_.splitInto(static_cast<std::size_t>(kFirstShare * double(detail_.vertices)));
  }
  else
  {
    octree_.splitToTolerance(kFlat * detail_.tolerance);
  }
  this->assignLeaves();
  const std::vector<std::int32_t> chosen = octree_.representatives();
  checkOptions(std::max(chosen.size(), detail_.vertices), options_);
  this->add(chosen, progress);
}

void Refinement::assignLeaves()
{
  const std::vector<std::int32_t> leaves = octree_.leafOfOrdered();
  for (std::size_t k = 0; k < leaves.size(); ++k)
  {
    states_[octree_.order()[k]].leaf = leaves[k];
  }
}

// Twice the points, where the first ones did not do; at last all. \returns whether any were left.
bool Refinement::addFiner(const Progress& progress)
{
  const std::size_t leaves = octree_.leafCount();
  octree_.splitInto(2 * leaves);
  this->assignLeaves();
  const bool finer = octree_.leafCount() > leaves;
  std::vector<std::int32_t> chosen = finer ? octree_.representatives() : octree_.order();
  chosen.erase(std::remove_if(chosen.begin(), chosen.end(),
                 [&](std::int32_t point) { return states_[point].used; }),
    chosen.end());
  checkOptions(surface_.sites().size() + chosen.size(), options_);
  this->add(chosen, progress);
  return finer || !chosen.empty();
}

// Without regard to the surface, which is to be found again.
void Refinement::add(const std::vector<std::int32_t>& points, const Progress& progress)
{
  std::vector<Vec3> sites(points.size());
  std::transform(points.begin(), points.end(), sites.begin(),
    [&](std::int32_t point) { return points_[point]; });
  const std::vector<std::int32_t> order = spatialOrder(sites, progress);
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const std::int32_t point = points[order[k]];
    sites[k] = points_[point];
    states_[point].used = true;
    pointOfSite_.push_back(point);
  }
  surface_.insert(sites, progress);
}

// \returns whether there is a solid to go on from.
bool Refinement::convect(const Progress& progress)
{
  if (!surface_.spansVolume() && surface_.sites().size() < points_.size())
  {
    return false;
  }
  const Tetrahedralization tetrahedra = surface_.tetrahedralization(progress);
  warnings_.clear();
  surface_.setInside(tetrahedra, convectSolid(tetrahedra, options_, warnings_, progress));
  triangles_ = surface_.surface();
  return warnings_.empty();
}

void Refinement::measure(
  const std::vector<std::int32_t>& points, const std::vector<Triangle>& triangles)
{
  if (points.empty() || triangles.empty())
  {
    return;
  }
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->points = surface_.sites();
  mesh->triangles = triangles;
  const MeshDistance distances(mesh);
  const std::size_t count = points.size();
  std::vector<double> coordinates(3 * count);
  std::vector<double> distance(count);
  std::vector<std::int32_t> nearest(count);
  std::vector<double> foot(3 * count);
  for (std::size_t k = 0; k < count; ++k)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      coordinates[axis * count + k] = points_[points[k]][static_cast<Eigen::Index>(axis)];
    }
  }
  const double* at = coordinates.data();
  distances.nearest({ at, at + count, at + 2 * count, count },
    std::numeric_limits<double>::infinity(), distance.data(), nearest.data(),
    { foot.data(), foot.data() + count, foot.data() + 2 * count });
  for (std::size_t k = 0; k < count; ++k)
  {
    State& state = states_[points[k]];
    state.distance = distance[k];
    state.nearest = triangles[nearest[k]];
    state.refused = false;
  }
}

void Refinement::measureAll()
{
  surface_.takeTouched();
  this->measure(octree_.order(), triangles_);
}

// Measures again where triangles have gone. Triangles that are left are as near as they were.
void Refinement::measureTouched()
{
  std::vector<std::uint8_t> touched(surface_.sites().size(), 0);
  for (const std::int32_t site : surface_.takeTouched())
  {
    touched[site] = 1;
  }
  const auto touches = [&](const Triangle& t)
  { return touched[t[0]] != 0 && touched[t[1]] != 0 && touched[t[2]] != 0; };
  std::vector<std::int32_t> points;
  for (const std::int32_t point : octree_.order())
  {
    if (touches(states_[point].nearest))
    {
      points.push_back(point);
    }
  }
  std::vector<Triangle> changed;
  std::copy_if(triangles_.begin(), triangles_.end(), std::back_inserter(changed), touches);
  this->measure(points, changed);
}

// The farthest point of each leaf, if it is too far: farthest first.
std::vector<std::int32_t> Refinement::candidates() const
{
  std::vector<std::int32_t> farthest(octree_.leafCount(), -1);
  for (const std::int32_t point : octree_.order())
  {
    const State& state = states_[point];
    if (!state.refused && state.distance > detail_.tolerance)
    {
      std::int32_t& best = farthest[state.leaf];
      best = best < 0 || states_[best].distance < state.distance ? point : best;
    }
  }
  farthest.erase(std::remove(farthest.begin(), farthest.end(), -1), farthest.end());
  std::stable_sort(farthest.begin(), farthest.end(),
    [&](std::int32_t a, std::int32_t b) { return states_[a].distance > states_[b].distance; });
  return farthest;
}

std::size_t Refinement::vertexCount() const
{
  std::vector<std::uint8_t> seen(surface_.sites().size(), 0);
  for (const Triangle& triangle : triangles_)
  {
    for (const std::int32_t site : triangle)
    {
      seen[site] = 1;
    }
  }
  return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), 1));
}

bool Refinement::hasEnough() const
{
  return this->wantsVertices() && double(this->vertexCount()) >= kEnough * double(detail_.vertices);
}

void Refinement::place(const std::vector<std::int32_t>& points, const Progress& progress)
{
  std::size_t step = 0;
  for (const std::int32_t point : points)
  {
    if (++step % 256 == 0)
    {
      progress.check();
    }
    State& state = states_[point];
    switch (surface_.place(points_[point], state.nearest[0], detail_.tolerance))
    {
      case DynamicSurface::Outcome::Placed:
        state.used = true;
        pointOfSite_.push_back(point);
        break;
      case DynamicSurface::Outcome::Surfaced:
        break;
      case DynamicSurface::Outcome::Near:
        state.nearest = surface_.nearTriangle();
        state.distance = surface_.nearDistance();
        break;
      case DynamicSurface::Outcome::Coincides: // and so do all points here
      case DynamicSurface::Outcome::Refused:
        state.refused = true;
        break;
    }
  }
}

void Refinement::refine(const Progress& progress)
{
  for (int round = 0; round < kMostRounds; ++round)
  {
    progress.check();
    progress.report(1.0 - 1.0 / (1.0 + round));
    std::vector<std::int32_t> chosen = this->candidates();
    if (chosen.empty() && !this->wantsVertices())
    {
      // What was refused may have come near since, by triangles that it was not measured against.
      this->measure(this->farPoints(), triangles_);
      return;
    }
    if (this->wantsVertices())
    {
      const std::size_t vertices = this->vertexCount();
      chosen.resize(
        std::min(chosen.size(), detail_.vertices - std::min(vertices, detail_.vertices)));
    }
    if (chosen.empty())
    {
      return;
    }
    this->place(chosen, progress);
    triangles_ = surface_.surface();
    if (this->hasEnough())
    {
      return;
    }
    this->measureTouched();
  }
}

std::vector<std::int32_t> Refinement::farPoints() const
{
  std::vector<std::int32_t> points;
  std::copy_if(octree_.order().begin(), octree_.order().end(), std::back_inserter(points),
    [&](std::int32_t point) { return states_[point].distance > detail_.tolerance; });
  return points;
}

// Those too far that could not be taken up.
std::vector<std::int32_t> Refinement::left() const
{
  std::vector<std::int32_t> left;
  for (const std::int32_t point : octree_.order())
  {
    const State& state = states_[point];
    if (!this->wantsVertices() && !state.used && state.distance > detail_.tolerance)
    {
      left.push_back(point);
    }
  }
  return left;
}

void Refinement::warn()
{
  const std::size_t count = this->farPoints().size();
  double most = 0.0;
  for (const State& state : states_)
  {
    most = std::max(most, state.distance);
  }
  const std::size_t vertices = this->vertexCount();
  if (this->wantsVertices() && double(vertices) > 1.05 * double(detail_.vertices))
  {
    warnings_.push_back("TargetVertices " + std::to_string(detail_.vertices) +
      " are too few to tell inside from outside: the surface has " + std::to_string(vertices) +
      ".");
  }
  if (count > 0 && !this->wantsVertices())
  {
    std::ostringstream text;
    text << count << " of " << points_.size() << " points are farther than Tolerance "
         << detail_.tolerance << " from the surface, the farthest by " << most
         << ": they lie inside the solid, away from it, or in folds that the sampling does not "
            "resolve. Remove outliers, or compare with the surface of all points.";
    warnings_.push_back(text.str());
  }
}

ReconstructedSurface Refinement::result() const
{
  ReconstructedSurface result;
  result.warnings = warnings_;
  std::vector<std::int32_t> meshPoint(surface_.sites().size(), -1);
  for (Triangle triangle : triangles_)
  {
    for (std::int32_t& corner : triangle)
    {
      std::int32_t& point = meshPoint[corner];
      if (point < 0)
      {
        point = static_cast<std::int32_t>(result.pointIds.size());
        result.mesh.points.push_back(surface_.sites()[corner]);
        result.pointIds.push_back(pointOfSite_[corner]);
      }
      corner = point;
    }
    result.mesh.triangles.push_back(triangle);
  }
  setAreaNormals(result.mesh);
  return result;
}

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
}

} // namespace

ReconstructedSurface reconstruct(const std::vector<Vec3>& points, const LevelOfDetail& detail,
  const ConvectionOptions& options, const Progress& progress)
{
  checkDetail(detail);
  checkFinite(points);
  if (points.size() <= detail.vertices)
  {
    return reconstruct(points, options, progress);
  }
  Refinement refinement(points, detail, options, ProgressPart(progress, 0.0, 0.05));
  refinement.run(progress);
  return refinement.result();
}

} // namespace hybridtree
