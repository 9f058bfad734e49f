// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/EdgeRoots.h"

#include "core/base/Scratch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hybridtree
{
namespace
{

// All in cells, along the edge.
constexpr double kEndDistance = 1e-4;  // of a vertex from the ends of its edge
constexpr double kLastStep = 1e-3;     // a Newton step up to this is the last one,
constexpr double kChordMiss = 1e-4;    // if the chord crosses as near to where it leads
constexpr double kSmallBracket = 2e-6; // nothing left to find
constexpr double kFirstEndDistance = 0.01;

constexpr double kJump = 1e-3;          // of the field across a small bracket: not continuous there
constexpr double kFlatGradient = 1e-10; // |grad f| times the cell size below this has no direction

/// Search for the crossing on one edge, in the coordinate t from 0 at its low to 1 at its high end.
/// Ends 1 and 2 bracket it; 1 is the newer one, 3 the one before.
struct Search
{
  double t1, f1;
  double t2, f2;
  double t3, f3;
  double t; ///< to be tried next
  bool lowInside;

  void start(const CrossedEdge& edge)
  {
    lowInside = edge.lowInside;
    t1 = 0.0;
    f1 = edge.lowValue;
    t2 = 1.0;
    f2 = edge.highValue;
    const double linear = std::abs(f1) / (std::abs(f1) + std::abs(f2));
    t = linear >= 0.0 && linear <= 1.0
      ? std::clamp(linear, kFirstEndDistance, 1.0 - kFirstEndDistance)
      : 0.5;
  }

  /// Takes in f - T at t.
  void narrow(double f)
  {
    const bool inside = isInside(f);
    t3 = t1;
    f3 = f1;
    if (inside != this->insideAt1())
    {
      t3 = t2;
      f3 = f2;
      t2 = t1;
      f2 = f1;
    }
    t1 = t;
    f1 = f;
  }

  bool insideAt1() const { return lowInside == (t1 < t2); }
  double width() const { return std::abs(t2 - t1); }
  bool brackets(double at) const
  {
    return std::min(t1, t2) - kSmallBracket <= at && at <= std::max(t1, t2) + kSmallBracket;
  }

  /// From t to where the chord to the bracket's end on the other side crosses. Where the field is
  /// convex or concave, as at a crease, the crossing is between this and Newton's step.
  double chordStep(double f) const
  {
    const bool beside1 = isInside(f) == this->insideAt1();
    const double end = beside1 ? t2 : t1;
    const double rise = std::abs(beside1 ? f2 : f1);
    return (end - t) * std::abs(f) / (std::abs(f) + rise);
  }

  void next()
  {
    const double xi = (t1 - t2) / (t3 - t2);
    const double phi = (f1 - f2) / (f3 - f2);
    double share = 0.5; // of the way from 1 to 2
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
    {
      share = f1 / (f2 - f1) * (f3 / (f2 - f3)) +
        (t3 - t1) / (t2 - t1) * (f1 / (f3 - f1)) * (f2 / (f3 - f2));
    }
    const double margin = std::min(0.5, 0.25 * kSmallBracket / this->width());
    share = share >= 0.0 && share <= 1.0 ? std::clamp(share, margin, 1.0 - margin) : 0.5;
    t = t1 + share * (t2 - t1);
  }
};

class SurfaceFinder
{
public:
  SurfaceFinder(const FieldSource& source, const Lattice& lattice,
    const std::vector<CrossedEdge>& edges, Vec3* points, Vec3* normals)
    : source_(source)
    , lattice_(lattice)
    , edges_(edges)
    , points_(points)
    , normals_(normals)
    , searches_(edges.size())
  {
  }

  void run()
  {
    std::vector<std::uint32_t> active;
    active.reserve(edges_.size());
    for (std::uint32_t k = 0; k < edges_.size(); ++k)
    {
      if (this->isCap(edges_[k]))
      {
        this->place(k, edges_[k].lowInside ? 0.0 : 1.0, Vec3::Zero());
        continue;
      }
      searches_[k].start(edges_[k]);
      active.push_back(k);
    }
    while (!active.empty())
    {
      this->tryValues(active);
      this->tryGradients(active);
    }
  }

private:
  /// One end is outside of the region where the field counts: the solid is closed right there.
  bool isCap(const CrossedEdge& edge) const
  {
    return edge.low[edge.axis] < lattice_.low[edge.axis] ||
      edge.low[edge.axis] >= lattice_.high[edge.axis];
  }

  void gatherPoints(const std::vector<std::uint32_t>& active, VectorBatch points) const
  {
    for (std::size_t n = 0; n < active.size(); ++n)
    {
      points.set(n, this->pointAt(active[n], searches_[active[n]].t));
    }
  }

  Vec3 pointAt(std::uint32_t k, double t) const
  {
    const CrossedEdge& edge = edges_[k];
    Vec3 point = lattice_.point(edge.low);
    point[edge.axis] = lattice_.origin[edge.axis] +
      (static_cast<double>(edge.low[edge.axis]) + t) * lattice_.cellSize;
    return point;
  }

  void tryValues(const std::vector<std::uint32_t>& active)
  {
    ScratchVectors points(active.size());
    ScratchArray values(active.size());
    this->gatherPoints(active, points.batch());
    source_.field(points.points(), values.data());
    for (std::size_t n = 0; n < active.size(); ++n)
    {
      Search& search = searches_[active[n]];
      search.narrow(values[n] - kThreshold);
      search.next();
    }
  }

  /// Drops the edges that are done.
  void tryGradients(std::vector<std::uint32_t>& active)
  {
    ScratchVectors points(active.size());
    ScratchVectors gradients(active.size());
    ScratchArray values(active.size());
    this->gatherPoints(active, points.batch());
    source_.fieldAndGradient(points.points(), values.data(), gradients.batch());
    std::size_t left = 0;
    for (std::size_t n = 0; n < active.size(); ++n)
    {
      if (!this->finish(active[n], values[n] - kThreshold, gradients.points()[n]))
      {
        active[left++] = active[n];
      }
    }
    active.resize(left);
  }

  bool finish(std::uint32_t k, double f, const Vec3& gradient)
  {
    Search& search = searches_[k];
    const double step = -f / (gradient[edges_[k].axis] * lattice_.cellSize);
    if (std::abs(step) <= kLastStep && search.brackets(search.t + step) &&
      std::abs(step - search.chordStep(f)) <= kChordMiss)
    {
      this->place(k, search.t + step, gradient);
      return true;
    }
    search.narrow(f);
    if (search.width() <= kSmallBracket)
    {
      const bool jump = !(std::abs(search.f1 - search.f2) < kJump);
      this->place(k, 0.5 * (search.t1 + search.t2), jump ? Vec3::Zero() : gradient);
      return true;
    }
    search.next();
    return false;
  }

  void place(std::uint32_t k, double t, const Vec3& gradient)
  {
    points_[k] = this->pointAt(k, std::clamp(t, kEndDistance, 1.0 - kEndDistance));
    const double length = gradient.norm();
    const bool hasDirection = std::isfinite(length) && length * lattice_.cellSize > kFlatGradient;
    normals_[k] = hasDirection ? Vec3(gradient / -length) : Vec3::Zero();
  }

  const FieldSource& source_;
  const Lattice& lattice_;
  const std::vector<CrossedEdge>& edges_;
  Vec3* points_;
  Vec3* normals_;
  std::vector<Search> searches_;
};

/// Asks for the values at ends whose brick was pruned or belongs to nobody.
void fillEnds(const FieldSource& source, const Lattice& lattice, std::vector<CrossedEdge>& edges)
{
  std::vector<float*> missing;
  std::vector<Vec3> ends;
  for (CrossedEdge& edge : edges)
  {
    if (std::isnan(edge.lowValue))
    {
      missing.push_back(&edge.lowValue);
      ends.push_back(lattice.point(edge.low));
    }
    if (std::isnan(edge.highValue))
    {
      Index3 high = edge.low;
      ++high[edge.axis];
      missing.push_back(&edge.highValue);
      ends.push_back(lattice.point(high));
    }
  }
  if (missing.empty())
  {
    return;
  }
  ScratchVectors points(ends.size());
  ScratchArray values(ends.size());
  for (std::size_t k = 0; k < ends.size(); ++k)
  {
    points.batch().set(k, ends[k]);
  }
  source.field(points.points(), values.data());
  for (std::size_t k = 0; k < ends.size(); ++k)
  {
    *missing[k] = static_cast<float>(values[k] - kThreshold);
  }
}

} // namespace

void findSurface(const FieldSource& source, const Lattice& lattice, std::vector<CrossedEdge>& edges,
  Vec3* points, Vec3* normals)
{
  fillEnds(source, lattice, edges);
  SurfaceFinder(source, lattice, edges, points, normals).run();
}

} // namespace hybridtree
