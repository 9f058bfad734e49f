// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/CreasePoints.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/polygonize/CreaseJudge.h"
#include "core/polygonize/CreasePolygon.h"
#include "core/polygonize/NearSurface.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

namespace hybridtree
{
namespace
{

// Shares of the way from the point to the corners at which the field is asked. On the surface
// itself the side of a mesh is dear to tell, so not quite from the corners.
constexpr double kWays[] = { 0.95, 0.5, 0.2, 0.1, 0.02 };
constexpr int kSteps = 5;
constexpr int kShifting = 2; // the step after which it moves along the crease no more,
constexpr int kJudging = 3;  // and the one at which it must look like a crease

constexpr double kLeastShare = 0.5; // of the angle between the corners' normals that is left there
// What is merely curved: with normals at the corners no further apart than the first; or than the
// second, if from one corner inward, across and out to the other one, as the steps have seen it,
// the normal never turns by more than a share of that at once. An arc of the second is 0.3 cells
// high.
constexpr double kEvenBend = 1.05;
constexpr double kMostBend = 1.5;
constexpr double kMostTurn = 0.45;
constexpr double kFarthest = 1.2;    // cells, from the middle of the polygon
constexpr double kBeyondCell = 0.75; // cells
constexpr double kOnSurface = 1e-6;  // cells
constexpr double kWorthIt = 2e-3;    // cells, that the point must be off the polygon's middle
constexpr double kStraight = 0.1;    // cells, that the surface may be off the lines to the corners
constexpr double kReach = 0.3;       // cells, in which the surface is looked for
constexpr double kMargin = 2.0;      // cells around the polygons in which the field is asked

// Of one task.
constexpr std::size_t kLoopsPerRun = 32;
constexpr std::int64_t kBricksAlongRun = 4;

/// Search on one polygon.
struct Search
{
  CreasePolygon polygon;
  std::size_t loop = 0;
  Vec3 middle = Vec3::Zero();
  Vec3 target = Vec3::Zero(); ///< on an edge, the point next to this is wanted
  Vec3 point = Vec3::Zero();
  TouchingPlanes planes;   ///< one for each corner, from the last step
  PlanePair widest{};      ///< of the corners
  double turnInward = 0.0; ///< at most, of their normals from step to step, radians
  double mostTurn = 0.0;   ///< the same on the whole way between these two
  bool looksSharp = false; ///< from near, too
  bool isJudged = false;
  bool alive = true;
};

/// The polygons of one task, which lie together.
class PointFinder
{
public:
  PointFinder(const FieldSource& field, const Lattice& lattice, const TriangleMesh& mesh,
    const CreaseLoop* loops, std::size_t count, double leastAngle, CreasePoint* result)
    : field_(field), leastAngle_(leastAngle), cell_(lattice.cellSize), result_(result)
  {
    searches_.reserve(count);
    for (std::size_t k = 0; k < count; ++k)
    {
      const CreasePolygon polygon(mesh, lattice, loops[k], std::cos(leastAngle));
      const Vec3 middle = polygon.middle();
      searches_.push_back({ polygon, k, middle, middle, middle, TouchingPlanes(polygon.size()) });
    }
  }

  void run()
  {
    this->dropRound();
    for (int step = 0; step < kSteps; ++step)
    {
      this->ask(kWays[step]);
      for (Search& search : searches_)
      {
        search.alive = search.alive && this->narrow(search, step);
      }
    }
    this->settle();
    this->checkWays();
    for (const Search& search : searches_)
    {
      result_[search.loop].found = search.alive;
      result_[search.loop].suspected = !search.alive && !PointFinder::isEven(search);
    }
  }

private:
  static bool isEven(const Search& search)
  {
    const double angle = search.widest.angle;
    const bool turnsEvenly =
      search.isJudged && angle <= kMostBend && search.mostTurn <= kMostTurn * angle;
    return !search.looksSharp && (angle <= kEvenBend || turnsEvenly);
  }

  /// New planes for all searches, from so far on the way to the corners.
  void ask(double way)
  {
    std::size_t count = 0;
    for (const Search& search : searches_)
    {
      count += search.alive ? search.planes.size() : 0;
    }
    ScratchVectors points(count), gradients(count);
    ScratchArray values(count);
    std::size_t next = 0;
    for (const Search& search : searches_)
    {
      for (std::size_t k = 0; search.alive && k < search.planes.size(); ++k)
      {
        points.batch().set(next++, search.point + way * (search.polygon.corner(k) - search.point));
      }
    }
    field_.fieldAndGradient(points.points(), values.data(), gradients.batch());
    next = 0;
    for (Search& search : searches_)
    {
      for (std::size_t k = 0; search.alive && k < search.planes.size(); ++k, ++next)
      {
        const TouchingPlane plane =
          TouchingPlane::of(points.points()[next], values[next], gradients.points()[next]);
        if (!search.planes[k].normal.isZero(0.0) &&
          (k == search.widest.first || k == search.widest.second))
        {
          search.turnInward =
            std::max(search.turnInward, angleBetween(search.planes[k].normal, plane.normal));
        }
        search.planes[k] = plane;
      }
    }
  }

  /// Drops polygons that are merely curved, which two of their corners tell. Where the planes of
  /// all of them meet there would be a tip.
  void dropRound()
  {
    std::vector<CreasePair> pairs;
    for (Search& search : searches_)
    {
      TouchingPlanes planes;
      for (std::size_t k = 0; k < search.polygon.size(); ++k)
      {
        planes.push_back({ search.polygon.meshNormal(k), search.polygon.corner(k), 0.0, 0.0 });
      }
      search.widest = widestPair(planes);
      const Meeting meeting = meetingOf(planes, search.middle, kFarthest * cell_);
      pairs.push_back({ { planes[search.widest.first], planes[search.widest.second] },
        meeting.found ? meeting.point : search.middle });
    }
    judgeCreasePairs(field_, leastAngle_, kFarthest * cell_, pairs);
    for (std::size_t k = 0; k < pairs.size(); ++k)
    {
      searches_[k].alive = !pairs[k].isRound;
      searches_[k].isJudged = pairs[k].isRound;
      searches_[k].mostTurn = pairs[k].mostTurn;
    }
  }

  /// One step nearer to the crease; false where there is none.
  bool narrow(Search& search, int step)
  {
    if (step == 0)
    {
      search.widest = widestPair(search.planes);
      this->keepNormals(search);
    }
    for (const TouchingPlane& plane : search.planes)
    {
      if (!plane.normal.allFinite() || !(std::abs(plane.ahead) <= kFarthest * cell_))
      {
        return false;
      }
    }
    if (step >= kJudging)
    {
      search.isJudged = true;
      search.mostTurn = std::max(search.turnInward,
        angleBetween(
          search.planes[search.widest.first].normal, search.planes[search.widest.second].normal));
    }
    if (step == kJudging)
    {
      search.looksSharp =
        widestAngle(search.planes) >= std::max(leastAngle_, kLeastShare * search.widest.angle);
      if (!search.looksSharp)
      {
        return false;
      }
    }
    const std::optional<Vec3> halfWay =
      step < kShifting ? search.polygon.halfWay(search.planes) : std::nullopt;
    search.target = halfWay.value_or(search.target);
    const Meeting meeting = meetingOf(search.planes, search.target, kFarthest * cell_);
    if (!meeting.found && step > kJudging)
    {
      search.looksSharp = widestAngle(search.planes) >= leastAngle_; // or is round, from very near
    }
    search.point = meeting.point;
    if (meeting.found && !meeting.edge.isZero() && step <= kShifting && !halfWay)
    {
      const double way =
        step == kShifting ? search.polygon.toUpright(meeting) : search.polygon.toMiddle(meeting);
      search.target = search.point = meeting.point + way * meeting.edge;
    }
    return meeting.found;
  }

  void keepNormals(Search& search)
  {
    std::vector<Vec3>& normals = result_[search.loop].cornerNormals;
    for (const TouchingPlane& plane : search.planes)
    {
      normals.push_back(plane.normal);
    }
    search.polygon.setNormals(normals);
  }

  /// Puts the points exactly on the surface.
  void settle()
  {
    for (Search& search : searches_)
    {
      if (!search.alive)
      {
        continue;
      }
      CreasePoint& result = result_[search.loop];
      const Vec3 normal = middleNormal(search.planes, leastAngle_);
      for (const TouchingPlane& plane : search.planes)
      {
        result.slope += plane.slope / static_cast<double>(search.planes.size());
      }
      const double gain = std::abs(normal.normalized().dot(search.point - search.middle));
      search.alive = normal.norm() > 1e-3 && gain > kWorthIt * cell_;
      result.normal = normal.normalized();
      search.alive = search.alive &&
        (std::abs(excessAt(field_, search.point)) <= kOnSurface * cell_ * result.slope ||
          moveToSurface(field_, kReach * cell_, result.normal, search.point));
      result.point = search.point;
      search.alive = search.alive && search.polygon.beyondCell(search.point) <= kBeyondCell * cell_;
    }
  }

  /// The surface must run straight from the point to the corners.
  void checkWays()
  {
    this->ask(0.5);
    for (Search& search : searches_)
    {
      for (std::size_t k = 0; search.alive && k < search.planes.size(); ++k)
      {
        search.alive = std::abs(search.planes[k].ahead) <= kStraight * cell_;
      }
    }
  }

  const FieldSource& field_;
  const double leastAngle_;
  const double cell_;
  CreasePoint* result_;
  std::vector<Search> searches_;
};

/// Loops before this, from the last one on, lie together: whole bricks that follow one another, as
/// long as they are few loops and not far apart, so that the field can be narrowed.
std::vector<std::size_t> endsOfRuns(const std::vector<CreaseLoop>& loops)
{
  const auto brickOf = [](const CreaseLoop& loop) {
    return Index3{ loop.cell[0] >> 3, loop.cell[1] >> 3, loop.cell[2] >> 3 };
  };
  std::vector<std::size_t> ends;
  std::size_t begin = 0;
  Index3 low{}, high{};
  for (std::size_t k = 0; k < loops.size(); ++k)
  {
    const Index3 brick = brickOf(loops[k]);
    bool joins = k > 0 && (k - begin < kLoopsPerRun || brick == brickOf(loops[k - 1]));
    for (int axis = 0; axis < 3 && joins; ++axis)
    {
      joins =
        std::max(high[axis], brick[axis]) - std::min(low[axis], brick[axis]) < kBricksAlongRun;
    }
    if (!joins)
    {
      if (k > 0)
      {
        ends.push_back(k);
      }
      begin = k;
      low = high = brick;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], brick[axis]);
      high[axis] = std::max(high[axis], brick[axis]);
    }
  }
  ends.push_back(loops.size());
  return ends;
}

Box3 boxOf(const Lattice& lattice, const CreaseLoop* loops, std::size_t count)
{
  Box3 box;
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec3 low = lattice.point(loops[k].cell);
    box.extend(low - Vec3::Constant(kMargin * lattice.cellSize));
    box.extend(low + Vec3::Constant((1.0 + kMargin) * lattice.cellSize));
  }
  return box;
}

} // namespace

std::vector<CreasePoint> findCreasePoints(const FieldSource& field, const Lattice& lattice,
  const TriangleMesh& mesh, const std::vector<CreaseLoop>& loops, double leastAngle,
  const Progress& progress)
{
  std::vector<CreasePoint> points(loops.size());
  if (loops.empty())
  {
    return points;
  }
  const std::vector<std::size_t> ends = endsOfRuns(loops);
  std::atomic<std::size_t> done(0);
  parallelFor(ends.size(), 1,
    [&](std::size_t from, std::size_t to)
    {
      for (std::size_t k = from; k < to; ++k)
      {
        progress.check();
        const std::size_t begin = k == 0 ? 0 : ends[k - 1];
        const std::size_t count = ends[k] - begin;
        if (const FieldSourcePtr near = field.restrictedTo(boxOf(lattice, &loops[begin], count)))
        {
          PointFinder(*near, lattice, mesh, &loops[begin], count, leastAngle, &points[begin]).run();
        }
        progress.report(static_cast<double>(++done) / static_cast<double>(ends.size()));
      }
    });
  return points;
}

} // namespace hybridtree
