// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/CutFaces.h"

#include "core/base/Parallel.h"
#include "core/boolean/Triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 64;

// One cut triangle after the other; keeps its memory.
class FaceCutter
{
public:
  FaceCutter(const MeshOperand& operand, int mesh, const Keep& keep, const CutCurves& curves,
    const MeshSides& sides, CutFaces& faces)
    : operand_(operand)
    , mesh_(mesh)
    , keep_(keep)
    , curves_(curves)
    , outside_(sides.outside[std::size_t(mesh)])
    , cuts_(curves.cuts[std::size_t(mesh)])
    , faces_(faces)
  {
  }

  void cut(std::size_t index)
  {
    triangle_ = cuts_.triangles[index];
    corner_ = operand_.mesh().triangles[std::size_t(triangle_)];
    ids_.clear();
    points_.clear();
    loops_.clear();
    this->choosePlane();
    this->gather(index);
    this->makeRing();
    this->traceFromBorder();
    const std::size_t outer = loops_.size();
    this->traceInside();
    this->triangulateAll(outer);
  }

  bool contradictory() const { return contradictory_; }

private:
  // A crossing on an edge of the triangle.
  struct Border
  {
    std::int32_t crossing;
    std::int8_t edge;
    bool arrival; // a step of the flow ends here

    bool operator<(const Border& other) const { return crossing < other.crossing; }
  };

  struct Step
  {
    std::int32_t from, to;
    bool visited;

    bool operator<(const Step& other) const { return from < other.from; }
  };

  // Corner k is entry -1 - k.
  using Ring = std::vector<std::int32_t>;

  // Drops the axis along which the triangle is seen largest, keeping it counter-clockwise.
  void choosePlane()
  {
    const Vec3 normal = areaNormal(operand_.mesh(), std::size_t(triangle_));
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    axisX_ = (axis + 1) % 3;
    axisY_ = (axis + 2) % 3;
    if (normal[axis] < 0.0)
    {
      std::swap(axisX_, axisY_);
    }
  }

  // The steps along the curves, with what is kept on their left.
  void gather(std::size_t index)
  {
    // Segments have the outside on their left in A, on their right in B.
    const bool forward = keep_.outside == (mesh_ == 0);
    steps_.clear();
    borders_.clear();
    for (std::int32_t k = cuts_.first[index]; k < cuts_.first[index + 1]; ++k)
    {
      const std::size_t s = std::size_t(cuts_.segments[std::size_t(k)]);
      const Segment& segment = curves_.segments[s];
      const std::array<std::int32_t, 2>& end = curves_.ends[s];
      steps_.push_back({ end[forward ? 0 : 1], end[forward ? 1 : 0], false });
      if (segment.start.mesh == mesh_)
      {
        borders_.push_back({ end[0], segment.start.corner, !forward });
      }
      if (segment.end.mesh == mesh_)
      {
        borders_.push_back({ end[1], segment.end.corner, forward });
      }
    }
    std::sort(steps_.begin(), steps_.end());
    std::sort(borders_.begin(), borders_.end());
  }

  // Corners and border crossings, counter-clockwise. Crossings on an edge are numbered from its
  // lower end.
  void makeRing()
  {
    ring_.clear();
    for (std::int32_t k = 0; k < 3; ++k)
    {
      ring_.push_back(-1 - k);
      const std::size_t first = ring_.size();
      for (const Border& border : borders_)
      {
        if (border.edge == k)
        {
          ring_.push_back(border.crossing);
        }
      }
      if (corner_[std::size_t(k)] > corner_[std::size_t(k + 1) % 3])
      {
        std::reverse(ring_.begin() + std::ptrdiff_t(first), ring_.end());
      }
    }
    places_.clear();
    for (std::size_t k = 0; k < ring_.size(); ++k)
    {
      if (ring_[k] >= 0)
      {
        places_.emplace_back(ring_[k], k);
      }
    }
    std::sort(places_.begin(), places_.end());
  }

  const Border* borderAt(std::int32_t crossing) const
  {
    const auto found =
      std::lower_bound(borders_.begin(), borders_.end(), Border{ crossing, 0, false });
    return found != borders_.end() && found->crossing == crossing ? &*found : nullptr;
  }

  Step* stepFrom(std::int32_t crossing)
  {
    const auto found = std::lower_bound(steps_.begin(), steps_.end(), Step{ crossing, 0, false });
    return found != steps_.end() && found->from == crossing ? &*found : nullptr;
  }

  std::size_t placeOf(std::int32_t crossing) const
  {
    return std::lower_bound(
      places_.begin(), places_.end(), std::make_pair(crossing, std::size_t(0)))
      ->second;
  }

  bool isKept(std::int32_t corner) const
  {
    return (outside_[std::size_t(corner_[std::size_t(corner)])] == 1) == keep_.outside;
  }

  std::int32_t add(std::int32_t id, const Vec3& position, unsigned edges)
  {
    ids_.push_back(id);
    points_.push_back({ position[axisX_], position[axisY_], std::uint8_t(edges) });
    return std::int32_t(points_.size()) - 1;
  }

  std::int32_t addCorner(std::int32_t k)
  {
    const std::int32_t vertex = corner_[std::size_t(k)];
    contradictory_ = contradictory_ || !this->isKept(k);
    return this->add(
      vertex, operand_.mesh().points[std::size_t(vertex)], 1u << k | 1u << (k + 2) % 3);
  }

  std::int32_t addCrossing(std::int32_t crossing, const Border* border)
  {
    return this->add(-1 - crossing, curves_.crossings[std::size_t(crossing)].position,
      border ? 1u << border->edge : 0u);
  }

  // Parts that touch the border of the triangle.
  void traceFromBorder()
  {
    if (places_.empty() && this->isKept(0))
    {
      loops_.push_back({ this->addCorner(0), this->addCorner(1), this->addCorner(2) });
    }
    taken_.assign(ring_.size(), false);
    for (std::size_t first = 0; first < ring_.size(); ++first)
    {
      const Border* start = ring_[first] >= 0 ? this->borderAt(ring_[first]) : nullptr;
      if (start == nullptr || !start->arrival || taken_[first])
      {
        continue;
      }
      Triangulator::Loop loop;
      std::size_t at = first;
      do
      {
        taken_[at] = true;
        at = this->traceOnce(at, loop);
      } while (at < ring_.size() && !taken_[at]);
      contradictory_ = contradictory_ || at != first;
      if (at == first && loop.size() > 2)
      {
        loops_.push_back(std::move(loop));
      }
    }
  }

  // From an arrival along the border to the next departure, and along the curve to its arrival.
  std::size_t traceOnce(std::size_t at, Triangulator::Loop& loop)
  {
    const Border* border = this->borderAt(ring_[at]);
    loop.push_back(this->addCrossing(ring_[at], border));
    for (at = (at + 1) % ring_.size(); ring_[at] < 0; at = (at + 1) % ring_.size())
    {
      loop.push_back(this->addCorner(-1 - ring_[at]));
    }
    border = this->borderAt(ring_[at]);
    if (border->arrival)
    {
      return kLost;
    }
    std::int32_t crossing = ring_[at];
    for (;;)
    {
      loop.push_back(this->addCrossing(crossing, border));
      Step* step = this->stepFrom(crossing);
      if (step == nullptr || step->visited)
      {
        return kLost;
      }
      step->visited = true;
      crossing = step->to;
      border = this->borderAt(crossing);
      if (border)
      {
        return this->placeOf(crossing);
      }
    }
  }

  // Closed curves inside of the triangle.
  void traceInside()
  {
    for (Step& first : steps_)
    {
      Triangulator::Loop loop;
      for (Step* step = &first; step != nullptr && !step->visited; step = this->stepFrom(step->to))
      {
        step->visited = true;
        loop.push_back(this->addCrossing(step->from, nullptr));
      }
      if (!loop.empty())
      {
        loops_.push_back(std::move(loop));
      }
    }
  }

  double areaOf(const Triangulator::Loop& loop) const
  {
    double area = 0.0;
    const PlanarPoint& o = points_[std::size_t(loop[0])];
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    {
      const PlanarPoint& p = points_[std::size_t(loop[k])];
      const PlanarPoint& q = points_[std::size_t(loop[k + 1])];
      area += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
    }
    return area;
  }

  bool contains(const Triangulator::Loop& loop, const PlanarPoint& p) const
  {
    bool inside = false;
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      const PlanarPoint& a = points_[std::size_t(loop[k])];
      const PlanarPoint& b = points_[std::size_t(loop[(k + 1) % loop.size()])];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
      {
        inside = !inside;
      }
    }
    return inside;
  }

  // Twice the area that rounding may give to what has none.
  double rounding(const Triangulator::Loop& loop) const
  {
    double largest = 0.0, sides = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      const PlanarPoint& p = points_[std::size_t(loop[k])];
      largest = std::max({ largest, std::abs(p.x), std::abs(p.y) });
      sides += std::sqrt(squaredDistance(p, points_[std::size_t(loop[(k + 1) % loop.size()])]));
    }
    return 0x1p-46 * largest * sides;
  }

  // The smallest part around most of a hole: rounding may put a point of it beyond the border.
  std::size_t faceAround(
    const Triangulator::Loop& hole, const std::vector<std::vector<Triangulator::Loop>>& faces) const
  {
    if (faces.size() == 1 && this->areaOf(hole) < -this->rounding(hole))
    {
      return 0;
    }
    constexpr std::size_t kMost = 7;
    const std::size_t step = (hole.size() + kMost - 1) / kMost;
    std::size_t best = faces.size();
    std::size_t most = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
      std::size_t inside = 0;
      for (std::size_t k = 0; k < hole.size(); k += step)
      {
        const PlanarPoint& p = points_[std::size_t(hole[k])];
        const PlanarPoint& q = points_[std::size_t(hole[(k + 1) % hole.size()])];
        inside += this->contains(faces[f][0], { 0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0 });
      }
      const double area = inside > 0 && inside >= most ? this->areaOf(faces[f][0]) : least;
      if (inside > most || area < least)
      {
        best = f;
        most = inside;
        least = area;
      }
    }
    return best;
  }

  // Clockwise closed curves are holes in the smallest part around them.
  void triangulateAll(std::size_t fromBorder)
  {
    if (loops_.size() == 1)
    {
      this->triangulate(loops_);
      return;
    }
    std::vector<std::vector<Triangulator::Loop>> faces;
    std::vector<Triangulator::Loop> holes;
    for (std::size_t k = 0; k < loops_.size(); ++k)
    {
      if (k < fromBorder || this->areaOf(loops_[k]) > 0.0)
      {
        faces.push_back({ std::move(loops_[k]) });
      }
      else
      {
        holes.push_back(std::move(loops_[k]));
      }
    }
    for (Triangulator::Loop& hole : holes)
    {
      const std::size_t around = this->faceAround(hole, faces);
      if (around == faces.size())
      {
        faces.emplace_back(); // of no area, by rounding
      }
      faces[around].push_back(std::move(hole));
    }
    for (const std::vector<Triangulator::Loop>& face : faces)
    {
      this->triangulate(face);
    }
  }

  void triangulate(const std::vector<Triangulator::Loop>& loops)
  {
    planar_.clear();
    if (loops.size() == 1 && loops[0].size() == 3)
    {
      planar_.push_back({ loops[0][0], loops[0][1], loops[0][2] });
    }
    else if (!triangulator_.triangulate(points_, loops, planar_))
    {
      for (const Triangulator::Loop& loop : loops)
      {
        this->fan(loop);
      }
    }
    for (const Triangle& t : planar_)
    {
      Triangle made = { ids_[std::size_t(t[0])], ids_[std::size_t(t[1])], ids_[std::size_t(t[2])] };
      if (keep_.flip)
      {
        std::swap(made[1], made[2]);
      }
      faces_.triangles.push_back(made);
      faces_.source.push_back(triangle_);
    }
  }

  Vec3 positionOf(std::int32_t id) const
  {
    return id >= 0 ? operand_.mesh().points[std::size_t(id)]
                   : curves_.crossings[std::size_t(-1 - id)].position;
  }

  void fan(const Triangulator::Loop& loop)
  {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t point : loop)
    {
      middle += this->positionOf(ids_[std::size_t(point)]) / double(loop.size());
    }
    const std::size_t added = curves_.crossings.size() + faces_.addedPoints.size();
    faces_.addedPoints.push_back(middle);
    const std::int32_t center = this->add(-1 - std::int32_t(added), middle, 0);
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      planar_.push_back({ center, loop[k], loop[(k + 1) % loop.size()] });
    }
  }

  static constexpr std::size_t kLost = std::size_t(-1);

  const MeshOperand& operand_;
  const int mesh_;
  const Keep keep_;
  const CutCurves& curves_;
  const std::vector<std::int8_t>& outside_;
  const CutCurves::Cuts& cuts_;
  CutFaces& faces_;
  Triangulator triangulator_;

  std::int32_t triangle_ = -1;
  Triangle corner_{};
  int axisX_ = 0, axisY_ = 1;
  std::vector<Step> steps_;
  std::vector<Border> borders_;
  Ring ring_;
  std::vector<std::pair<std::int32_t, std::size_t>> places_;
  std::vector<bool> taken_;
  std::vector<std::int32_t> ids_;
  std::vector<PlanarPoint> points_;
  std::vector<Triangulator::Loop> loops_;
  std::vector<Triangle> planar_;
  bool contradictory_ = false;
};

} // namespace

CutFaces cutFaces(const MeshOperand& operand, int mesh, const Keep& keep, const CutCurves& curves,
  const MeshSides& sides, bool& contradictory)
{
  const std::size_t count = curves.cuts[std::size_t(mesh)].triangles.size();
  std::vector<CutFaces> parts((count + kGrain - 1) / kGrain);
  std::vector<char> bad(parts.size(), 0);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      const std::size_t part = begin / kGrain;
      FaceCutter cutter(operand, mesh, keep, curves, sides, parts[part]);
      for (std::size_t k = begin; k < end; ++k)
      {
        cutter.cut(k);
      }
      bad[part] = cutter.contradictory();
    });
  contradictory = contradictory || std::find(bad.begin(), bad.end(), 1) != bad.end();
  CutFaces faces;
  const std::int32_t added = -1 - std::int32_t(curves.crossings.size());
  for (CutFaces& part : parts)
  {
    const std::int32_t shift = std::int32_t(faces.addedPoints.size());
    for (Triangle& triangle : part.triangles)
    {
      for (std::int32_t& id : triangle)
      {
        id -= id <= added ? shift : 0;
      }
      faces.triangles.push_back(triangle);
    }
    faces.source.insert(faces.source.end(), part.source.begin(), part.source.end());
    faces.addedPoints.insert(
      faces.addedPoints.end(), part.addedPoints.begin(), part.addedPoints.end());
  }
  return faces;
}

} // namespace hybridtree
