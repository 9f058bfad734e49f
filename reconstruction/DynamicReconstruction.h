// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Convection.h"
#include "reconstruction/DynamicSurface.h"
#include "reconstruction/LevelOfDetail.h"
#include "reconstruction/PointOctree.h"
#include "reconstruction/SizeQueue.h"
#include "reconstruction/TrianglePoints.h"

#include "core/base/Progress.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace hybridtree
{

/// A reconstruction with a level of detail that is kept, so that a change costs what it changes
/// ([HT] 3; Allegre, Chaine, Akkouche, Convection-driven dynamic surface reconstruction, SMI 2005).
///
/// A subset of the points, chosen by roughness (PointOctree.h), is reconstructed by static
/// convection. Then the input point farthest from the surface is added, over and over;
/// tetrahedralization and surface follow locally (DynamicSurface.h). Only points that are used are
/// ever triangulated. Where more than a few points cannot be taken up, they are added to the
/// tetrahedralization, and convection starts from the hull again.
///
/// A tolerance holds for every point, also for those that convection leaves behind, in narrow bays
/// or thin tips: at last the surface goes to each of them, tetrahedron by tetrahedron, wherever
/// that leaves it a manifold of the same genus. How many are left, if any, a warning says.
///
/// All additions since convection are on a stack. A finer level adds to it; a coarser one takes
/// additions back until it is met; a region of refinement is on top of it. A level that is coarser
/// than the subset starts again, but for the octree.
///
/// Departs from the papers: there points are taken out where the flow finds too many; here they are
/// put in where there are too few, and taken back in the reverse order.
/// Memory: about 150 bytes for a point, about 3 KB for one that is used.
/// Not for several threads at once.
class DynamicReconstruction
{
public:
  /// \throws InvalidGeometry as reconstruct(), and Cancelled.
  explicit DynamicReconstruction(const std::vector<Vec3>& points,
    const ConvectionOptions& options = {}, const Progress& progress = Progress::none());
  DynamicReconstruction(const DynamicReconstruction&) = delete;
  DynamicReconstruction& operator=(const DynamicReconstruction&) = delete;

  /// Points to be regarded from the next update on. Indices, in pointIds of results and elsewhere,
  /// count all points ever given. \throws InvalidGeometry, Cancelled.
  void add(const std::vector<Vec3>& points, const Progress& progress = Progress::none());
  /// Indices of points, each at most once, to be left out from the next update on. Costs little
  /// where they are no vertices; else what came after them is taken back and done again.
  /// \throws std::out_of_range.
  void remove(const std::vector<std::int32_t>& points);

  /// The surface at a level of detail. \throws as reconstruct(). After Cancelled or an error only
  /// destruction makes sense.
  ReconstructedSurface update(
    const LevelOfDetail& detail, const Progress& progress = Progress::none());

private:
  // What convection and refinement have made; copied where an attempt may fail.
  struct State
  {
    explicit State(const std::vector<Vec3>& points) : near(points) {}
    DynamicSurface surface;
    TrianglePoints near;
    std::vector<std::int32_t> pointOfSite; // -1 where a site is unused
    std::vector<double> reach;             // per step: how far its point was from the surface
    std::size_t baseVertices = 0;          // after convection
    std::size_t baseSites = 0;
    std::ptrdiff_t moreTriangles = 0; // since then
    std::vector<std::string> warnings;
  };
  // The farthest point of a triangle.
  struct Candidate
  {
    double distance;
    std::int32_t point;
    bool operator<(const Candidate& other) const
    {
      return distance != other.distance ? distance > other.distance : point < other.point;
    }
  };
  // Who places points, beside others or alone.
  struct Helper
  {
    DynamicSurface::Hand hand;        // beside others
    std::vector<std::int32_t> points; // to be placed
    TrianglePoints::Scratch scratch;
    // What it has done that others do not know yet.
    std::vector<double> reach;
    std::ptrdiff_t moreTriangles = 0;
    std::vector<Candidate> candidates;
    bool placed = false;
    bool refused = false;
    std::vector<std::int32_t> left; // neither
  };
  // What is refined, and how far.
  struct Phase
  {
    double tolerance = 0.0;
    std::size_t vertices = std::numeric_limits<std::size_t>::max();
    const Box3* region = nullptr; // all, if null
    DynamicSurface::Way way = DynamicSurface::Way::Convected;

    static Phase ofLevel(const LevelOfDetail& detail)
    {
      Phase phase;
      phase.tolerance = detail.tolerance;
      phase.vertices = detail.vertices > 0 ? detail.vertices : phase.vertices;
      return phase;
    }
    static Phase ofRegion(const LevelOfDetail& detail)
    {
      Phase phase;
      phase.tolerance = detail.regionTolerance;
      phase.region = &detail.region;
      return phase;
    }
    bool wants(const Vec3& point, double distance) const
    {
      return distance > tolerance && (!region || region->contains(point));
    }
  };

  bool reaches(const LevelOfDetail& detail) const;
  ReconstructedSurface ofAll(const Progress& progress) const;
  std::vector<std::int32_t> usedPoints() const;
  std::vector<Vec3> normalsOf(const std::vector<std::int32_t>& points) const;
  void startAgain(const LevelOfDetail& detail, const Progress& progress);
  std::vector<std::int32_t> representatives() const;
  bool addFiner(const Progress& progress);
  void addSites(const std::vector<std::int32_t>& points, const Progress& progress);
  void removeUnusedSites();
  bool convect(const Progress& progress);
  void measureAll(const Progress& progress);
  void measureNew(const Progress& progress);
  std::size_t vertexCount() const;
  std::ptrdiff_t eulerNumber() const;
  void takeBack();
  void takeBackTo(const LevelOfDetail& detail, const Progress& progress);
  void refine(const Phase& phase, const Progress& progress);
  bool refineOnce(
    const Phase& phase, const std::vector<std::int32_t>& triangles, const Progress& progress);
  std::vector<std::int32_t> placeTogether(
    const Phase& phase, const std::vector<std::int32_t>& round, const Progress& progress);
  std::vector<std::int32_t> placeBySlabs(
    const Phase& phase, std::vector<std::int32_t> round, const Progress& progress);
  void placeAll(Helper& helper, const Phase& phase, const Progress& progress);
  bool place(Helper& helper, const Phase& phase, std::int32_t point);
  const DynamicSurface::Hand& handOf(const Helper& helper) const;
  void follow(Helper& helper);
  void gather(Helper& helper);
  Candidate farthestOf(const Phase& phase, std::int32_t triangle) const;
  bool isWanted(const Phase& phase, std::int32_t point) const;
  void offer(const Candidate& candidate);
  void offerAll(const Phase& phase, const std::vector<std::int32_t>& triangles);
  void callHelpers(const std::vector<std::int32_t>& points, int side);
  void dismissHelpers();
  bool place(const Phase& phase, std::int32_t point);
  bool reach(const Phase& phase, std::int32_t point);
  void offerFarthest(const Phase& phase, std::int32_t triangle);
  std::vector<std::int32_t> nextRound(const Phase& phase);
  std::vector<std::int32_t> farPoints(const Phase& phase) const;
  void convectAgain(const Phase& phase, const Progress& progress);
  void reachAll(Phase phase, const Progress& progress);
  void hold(const Phase& phase, const Progress& progress);
  ReconstructedSurface result(const LevelOfDetail& detail) const;
  void warn(const LevelOfDetail& detail, std::vector<std::string>& warnings) const;
  void warnOf(
    const Phase& phase, const std::string& name, std::vector<std::string>& warnings) const;

  std::vector<Vec3> points_;      // in spatialOrder, where they came together
  std::vector<std::int32_t> ids_; // per point: its index for the caller
  ConvectionOptions options_;
  std::vector<std::uint8_t> removed_; // per point
  std::vector<std::int32_t> active_;  // points in the octree
  std::vector<Vec3> activePoints_;
  std::unique_ptr<PointOctree> octree_;
  double roughness_ = 0.0;            // of the first subset
  std::size_t levelSteps_ = 0;        // of the stack, without those of the region
  std::size_t measured_ = 0;          // points that are with a triangle, or removed
  std::unique_ptr<State> state_;      // null: to be started again
  std::vector<Candidate> candidates_; // scratch; some no longer hold
  Helper alone_;                      // scratch
  std::vector<Helper> helpers_;       // of a refinement
  SizeQueue waiting_;                 // of those, by distance
};

} // namespace hybridtree
