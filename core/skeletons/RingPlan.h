// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/RingMesh.h"

#include <vector>

namespace hybridtree
{

/// Where the rings of a revolved mesh stand along the meridian, and how many points each has.
///
/// Stations, which are the ends, creases and tight bends, always have a ring. Between two of them
/// rings are evenly spaced, as `size` has it: the edge length, or less where the surface is thin or
/// narrow, and changing slowly in between.
class RingPlan
{
public:
  /// \pre edgeLength > 0; the number of rings is modest.
  RingPlan(const Meridian& meridian, double edgeLength);

  /// All rings in the order of the meridian; strips between them have no edge above edgeLength.
  std::vector<Ring> rings();

private:
  // From one station to the next.
  struct Stretch
  {
    double begin;
    double end;
    bool regular; ///< equal counts, so equilateral triangles; otherwise they may be at any phase
    int leastStrips;
    double scale; ///< of the sizes, found by trial
    std::size_t firstRing;
    std::size_t lastRing;
  };

  void findStations();
  void offerStation(double s, bool wanted, double& turned);
  void settleLastStation(double turned);
  void findSizes();
  void limitByRadius();
  void limitByStations();
  int leastStrips(double begin, double end) const;
  void grade();
  void findStretches();

  std::size_t sampleBelow(double s) const;
  bool variesLittle(double begin, double end) const;
  double sizeAt(double s) const;
  double cellsBefore(double s) const;
  double afterCells(double cells) const;

  void placeRings();
  void placeStretch(Stretch& stretch, int strips);
  int stripsOf(const Stretch& stretch) const;
  void chooseCounts();
  void spareFan(const Ring& pole, const Stretch& stretch, std::size_t first);
  bool shrinkWhereTooLong();
  void mirror();

  const Meridian& meridian_;
  double edgeLength_;
  double end_;             // of the part that is planned: all or, if symmetric, half
  bool middleRing_ = true; // of a symmetric meridian
  struct Station
  {
    double s;
    double turn; // of the normal since the station before
  };
  std::vector<Station> stations_;
  double step_ = 0.0; // between samples
  std::vector<double> radial_;
  std::vector<double> size_;
  std::vector<double> cells_; // integral of ds / size up to each sample
  std::vector<Stretch> stretches_;
  std::vector<double> along_; // length at each ring
  std::vector<Ring> rings_;
};

} // namespace hybridtree
