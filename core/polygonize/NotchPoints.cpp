// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/NotchPoints.h"

#include "core/base/Parallel.h"
#include "core/base/Scratch.h"
#include "core/polygonize/CreasePlanes.h"
#include "core/polygonize/NearSurface.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

namespace hybridtree
{
namespace
{

// Shares of the way from the point to the corners at which the field is asked. A corner itself may
// be on another crease.
constexpr double kWays[] = { 0.7, 0.4, 0.2, 0.1, 0.02 };
constexpr int kSteps = 5;
constexpr int kNearer = 1;   // the first step of a second search
constexpr int kShifting = 2; // the step after which it moves along the crease no more,
constexpr int kJudging = 3;  // and the one until which it must look like a crease

constexpr double kLeastAngle = 0.43; // 25 degrees, seen from near
constexpr double kLeastShare = 0.5;  // of the first angle between the planes that is left there
constexpr double kSmooth = 0.97; // cosine of the surface's normal to the mean of those of the rim

// In cells.
constexpr double kFlat = 0.08; // first guess of the height of what need not be looked at
// By which, and by which share, a smooth surface may be off what the normals at the rim say.
constexpr double kOffSmooth = 0.03;
constexpr double kOffShare = 1.0;
constexpr double kLeastCrease = 0.2;
constexpr double kLeastCurve = 0.3;
constexpr double kLeastRise = 0.15; // first guess of a height that may be that of a curve
constexpr double kFarthest = 4.0;
constexpr double kOnSurface = 1e-6;
constexpr double kReach = 0.3;       // in which the surface is looked for near a crease,
constexpr double kRise = 4.0;        // and over a site without one
constexpr double kLeastHeight = 0.1; // of the triangles around the point
constexpr double kMargin = 6.0;
constexpr double kGroup = 32.0; // side of the cubes whose sites ask the same narrowed field
constexpr std::size_t kSitesPerTask = 64;

/// The sites of one task, which lie together.
class NotchFinder
{
public:
  NotchFinder(const FieldSource& field, double cell) : field_(field), cell_(cell) {}

  void add(const NotchSite& site, NotchPoint& result)
  {
    const Vec3 middle = site.middle();
    sites_.push_back({ &site, &result, middle, middle, false, 0.0, {}, true });
  }

  void run()
  {
    this->keepFar();
    // Corners may be on other faces than those that meet over the middle; then what is nearer
    // tells.
    for (const int first : { 0, kNearer })
    {
      this->findCreases(first);
      this->settle();
      this->dropFound();
    }
    this->rise();
  }

private:
  struct Search
  {
    const NotchSite* site;
    NotchPoint* result;
    Vec3 point;  ///< where the planes of the steps before meet; at first the middle
    Vec3 target; ///< the point of the crease next to this is wanted
    bool inside; ///< the middle
    double wideAngle = 0.0;
    TouchingPlanes planes; ///< of the step at hand
    bool isCrease = true;  ///< until a step tells otherwise, or it is not found
  };

  /// Leaves out those that are on the surface, nearly, or as far below it as the normals of the rim
  /// tell that a smooth one is: small balls. One question for all.
  void keepFar()
  {
    std::vector<Vec3> middles;
    for (const Search& search : sites_)
    {
      middles.push_back(search.site->middle());
    }
    std::vector<double> values;
    const TouchingPlanes planes = this->planesAt(middles, values);
    std::vector<Search> far;
    for (std::size_t k = 0; k < sites_.size(); ++k)
    {
      sites_[k].inside = values[k] >= kThreshold;
      sites_[k].result->off = std::abs(planes[k].ahead);
      if (!(sites_[k].result->off < kFlat * cell_) && !this->isSmooth(*sites_[k].site, planes[k]))
      {
        far.push_back(sites_[k]);
      }
    }
    sites_ = std::move(far);
  }

  bool isSmooth(const NotchSite& site, const TouchingPlane& plane) const
  {
    const double off = std::abs(plane.ahead);
    const double expected = std::abs(site.smoothHeight());
    return off < kLeastCurve * cell_ && plane.normal.dot(site.middleNormal()) > kSmooth &&
      std::abs(off - expected) < kOffSmooth * cell_ + kOffShare * expected;
  }

  TouchingPlanes planesAt(const std::vector<Vec3>& points, std::vector<double>& values) const
  {
    ScratchVectors places(points.size()), gradients(points.size());
    values.resize(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      places.batch().set(k, points[k]);
    }
    field_.fieldAndGradient(places.points(), values.data(), gradients.batch());
    TouchingPlanes planes;
    planes.reserve(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      planes.push_back(TouchingPlane::of(points[k], values[k], gradients.points()[k]));
    }
    return planes;
  }

  /// One question for all sites at every step.
  void findCreases(int first)
  {
    for (Search& search : sites_)
    {
      search.point = search.site->middle();
      search.target = search.point;
      search.wideAngle = 0.0;
      search.isCrease = true;
    }
    for (int step = first; step < kSteps; ++step)
    {
      this->askAround(kWays[step]);
      for (Search& search : sites_)
      {
        search.isCrease = search.isCrease && this->approach(search, step);
      }
    }
  }

  void dropFound()
  {
    const auto left = std::remove_if(sites_.begin(), sites_.end(),
      [](const Search& search) { return search.result->height > 0.0; });
    sites_.erase(left, sites_.end());
  }

  /// Whether it still looks like a crease.
  bool approach(Search& search, int step) const
  {
    const double angle = this->areNear(search.planes) ? widestAngle(search.planes) : 0.0;
    search.wideAngle = search.wideAngle > 0.0 ? search.wideAngle : angle; // of the first step
    if (step <= kJudging && angle < std::max(kLeastAngle, kLeastShare * search.wideAngle))
    {
      return false;
    }
    const Meeting meeting = meetingOf(search.planes, search.target, kFarthest * cell_);
    if (!meeting.found)
    {
      return false;
    }
    search.point = meeting.point;
    if (step <= kShifting)
    {
      search.point += this->toUpright(*search.site, meeting) * meeting.edge;
      search.target = search.point;
    }
    return true;
  }

  std::vector<Vec3> placesAround(const NotchSite& site, double way, const Vec3& point) const
  {
    std::vector<Vec3> places;
    for (int k = 0; k < site.count; k += site.isEdge() ? 2 : 1)
    {
      places.push_back(point + way * (site.rim[k] - point));
    }
    return places;
  }

  void askAround(double way)
  {
    std::vector<Vec3> places;
    for (const Search& search : sites_)
    {
      if (search.isCrease)
      {
        const std::vector<Vec3> around = this->placesAround(*search.site, way, search.point);
        places.insert(places.end(), around.begin(), around.end());
      }
    }
    std::vector<double> values;
    const TouchingPlanes planes = this->planesAt(places, values);
    auto next = planes.begin();
    for (Search& search : sites_)
    {
      if (search.isCrease)
      {
        const int count = search.site->isEdge() ? 2 : 3;
        search.planes.assign(next, next + count);
        next += count;
      }
    }
  }

  /// How far along the crease to go to the next place from which no side of the rim is seen the
  /// wrong way round; 0 where there is none.
  double toUpright(const NotchSite& site, const Meeting& meeting) const
  {
    LinePart part{ -kFarthest * cell_, kFarthest * cell_ };
    for (int k = 0; k < site.count; ++k)
    {
      const int next = (k + 1) % site.count;
      const Vec3 up = site.normals[k] + site.normals[next];
      const Vec3 inward = up.cross(site.rim[next] - site.rim[k]).normalized();
      part.clip(
        inward.dot(meeting.point - site.rim[k]) - kLeastHeight * cell_, inward.dot(meeting.edge));
    }
    return part.empty() || meeting.edge.isZero() ? 0.0 : part.nearest(0.0);
  }

  bool areNear(const TouchingPlanes& planes) const
  {
    return std::all_of(planes.begin(), planes.end(),
      [&](const TouchingPlane& plane)
      { return plane.normal.allFinite() && std::abs(plane.ahead) <= kFarthest * cell_; });
  }

  /// Puts the points of creases on the surface, and keeps them.
  void settle()
  {
    std::vector<Search*> creases;
    std::vector<SurfaceMove> moves;
    std::vector<Vec3> points;
    for (Search& search : sites_)
    {
      if (search.isCrease)
      {
        creases.push_back(&search);
        moves.push_back(
          { search.point, middleNormal(search.planes, kLeastAngle).stableNormalized(), false });
        points.push_back(search.point);
      }
    }
    const std::vector<double> excess = excessAt(field_, points);
    std::size_t off = 0;
    for (std::size_t k = 0; k < creases.size(); ++k)
    {
      if (std::abs(excess[k]) <= kOnSurface * cell_ * NotchFinder::steepest(creases[k]->planes))
      {
        this->keep(*creases[k], moves[k], kLeastCrease * cell_);
        continue;
      }
      creases[off] = creases[k];
      moves[off++] = moves[k];
    }
    moves.resize(off);
    moveToSurface(field_, kReach * cell_, moves);
    for (std::size_t k = 0; k < off; ++k)
    {
      creases[k]->isCrease = moves[k].found;
      if (moves[k].found)
      {
        this->keep(*creases[k], moves[k], kLeastCrease * cell_);
      }
    }
  }

  static double steepest(const TouchingPlanes& planes)
  {
    double slope = 0.0;
    for (const TouchingPlane& plane : planes)
    {
      slope = std::max(slope, plane.slope);
    }
    return slope;
  }

  /// To the surface over the middle, where there is no crease.
  void rise()
  {
    std::vector<const Search*> low;
    std::vector<Vec3> points;
    for (const Search& search : sites_)
    {
      if (search.result->off >= kLeastRise * cell_)
      {
        const double least = search.inside ? kLeastCurve : -kLeastCurve;
        low.push_back(&search);
        points.push_back(search.site->middle() + least * cell_ * search.site->middleNormal());
      }
    }
    // Most are too low, which one more question tells.
    const std::vector<double> excess = excessAt(field_, points);
    std::vector<const Search*> high;
    std::vector<SurfaceMove> moves;
    for (std::size_t k = 0; k < low.size(); ++k)
    {
      if ((excess[k] >= 0.0) == low[k]->inside)
      {
        high.push_back(low[k]);
        moves.push_back({ low[k]->site->middle(), low[k]->site->middleNormal(), false });
      }
    }
    moveToSurface(field_, kRise * cell_, moves);
    for (std::size_t k = 0; k < high.size(); ++k)
    {
      if (moves[k].found)
      {
        this->keep(*high[k], moves[k], kLeastCurve * cell_);
      }
    }
  }

  /// What is inside is so by the surface that lies over it.
  void keep(const Search& search, const SurfaceMove& found, double least) const
  {
    const double height = search.site->distance(found.point);
    const bool rises = found.direction.dot(found.point - search.site->middle()) > 0.0;
    if (!found.direction.isZero() && height >= least && rises == search.inside)
    {
      *search.result = { search.result->off, height, found.point, found.direction };
    }
  }

  const FieldSource& field_;
  const double cell_;
  std::vector<Search> sites_;
};

using Group = std::array<std::int64_t, 3>;

Group groupOf(const NotchSite& site, double size)
{
  const Vec3 place = (site.middle() / size).array().floor();
  return { std::int64_t(place.x()), std::int64_t(place.y()), std::int64_t(place.z()) };
}

} // namespace

Vec3 NotchSite::middle() const
{
  return this->isEdge() ? Vec3(0.5 * (rim[0] + rim[2])) : Vec3((rim[0] + rim[1] + rim[2]) / 3.0);
}

Vec3 NotchSite::middleNormal() const
{
  const Vec3 sum = normals[0] + normals[2];
  return (this->isEdge() ? sum : Vec3(sum + normals[1])).stableNormalized();
}

double NotchSite::smoothHeight() const
{
  // At distance d from the middle a surface of curvature k lies d^2 k / 2 lower, and its normal
  // leans outward by d k.
  const Vec3 center = this->middle();
  const int step = this->isEdge() ? 2 : 1;
  double sum = 0.0;
  int points = 0;
  for (int k = 0; k < count; k += step, ++points)
  {
    sum += normals[k].dot(rim[k] - center);
  }
  return 0.5 * sum / points;
}

double NotchSite::distance(const Vec3& p) const
{
  const Vec3 along = rim[2] - rim[0];
  if (this->isEdge())
  {
    const double length = along.squaredNorm();
    const double share = length > 0.0 ? (p - rim[0]).dot(along) / length : 0.0;
    return (rim[0] + std::clamp(share, 0.0, 1.0) * along - p).norm();
  }
  const Vec3 normal = along.cross(rim[1] - rim[0]).stableNormalized();
  return std::abs(normal.dot(p - rim[0]));
}

std::vector<NotchPoint> findNotchPoints(const FieldSource& field, double cellSize,
  const std::vector<NotchSite>& sites, const Progress& progress)
{
  std::vector<Group> groups;
  groups.reserve(sites.size());
  for (const NotchSite& site : sites)
  {
    groups.push_back(groupOf(site, kGroup * cellSize));
  }
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return groups[a] < groups[b]; });
  std::vector<std::size_t> begins; // of groups
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    if (k == 0 || groups[order[k]] != groups[order[k - 1]])
    {
      begins.push_back(k);
    }
  }
  std::vector<NotchPoint> points(sites.size());
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<std::size_t> done(0);
  parallelFor(begins.size(), 1,
    [&](std::size_t from, std::size_t to)
    {
      for (std::size_t g = from; g < to; ++g)
      {
        progress.check();
        const std::size_t end = g + 1 < begins.size() ? begins[g + 1] : order.size();
        Box3 box;
        for (std::size_t k = begins[g]; k < end; ++k)
        {
          box.extend(sites[order[k]].middle());
        }
        const Vec3 margin = Vec3::Constant(kMargin * cellSize);
        const FieldSourcePtr near =
          field.restrictedTo(Box3(Vec3(box.min() - margin), Vec3(box.max() + margin)));
        if (!near)
        {
          continue;
        }
        parallelFor(end - begins[g], kSitesPerTask,
          [&](std::size_t first, std::size_t last)
          {
            progress.check();
            NotchFinder finder(*near, cellSize);
            for (std::size_t k = begins[g] + first; k < begins[g] + last; ++k)
            {
              finder.add(sites[order[k]], points[order[k]]);
            }
            finder.run();
            done += last - first;
            if (std::this_thread::get_id() == caller)
            {
              progress.report(static_cast<double>(done) / static_cast<double>(sites.size()));
            }
          });
      }
    });
  return points;
}

} // namespace hybridtree
