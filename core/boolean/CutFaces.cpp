// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/CutFaces.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/boolean/Triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <string>
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
    , winding_(sides.winding[std::size_t(mesh)])
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
    for (std::int32_t edge = 0; edge < 3; ++edge)
    {
      this->addPieces(edge);
    }
    std::sort(steps_.begin(), steps_.end());
    const std::size_t outer = this->trace();
    this->triangulateAll(outer);
  }

private:
  // A crossing on an edge of the triangle.
  struct Border
  {
    std::int32_t crossing;
    std::int8_t edge;
    bool arrival; // a step of the flow ends here

    bool operator<(const Border& other) const { return crossing < other.crossing; }
  };

  // From one corner of a part to the next, by the ids of CutFaces.
  struct Step
  {
    std::int32_t from, to;
    bool visited;

    bool operator<(const Step& other) const { return from < other.from; }
  };

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
      steps_.push_back({ -1 - end[forward ? 0 : 1], -1 - end[forward ? 1 : 0], false });
      if (segment.start.mesh == mesh_)
      {
        borders_.push_back({ end[0], segment.start.corner, !forward });
      }
      if (segment.end.mesh == mesh_)
      {
        borders_.push_back({ end[1], segment.end.corner, forward });
      }
    }
    std::sort(borders_.begin(), borders_.end());
  }

  // The kept pieces of an edge, from what begins them to what ends them as seen from its lower end.
  // Crossings are numbered from there.
  void addPieces(std::int32_t edge)
  {
    const std::int32_t from = corner_[std::size_t(edge)];
    const std::int32_t to = corner_[std::size_t(edge + 1) % 3];
    const bool ascending = from < to;
    begins_.clear();
    ends_.clear();
    this->addCopies(ascending ? from : to, begins_, ends_);
    for (const Border& border : borders_)
    {
      if (border.edge == edge)
      {
        (border.arrival == ascending ? begins_ : ends_).push_back(-1 - border.crossing);
      }
    }
    this->addCopies(ascending ? to : from, ends_, begins_);
    if (begins_.size() != ends_.size())
    {
      throw InvalidGeometry("Triangle " + std::to_string(triangle_) + " of the " +
        (mesh_ == 0 ? "first" : "second") +
        " mesh is cut so that its parts do not close: a mesh is not oriented. Repair it.");
    }
    for (std::size_t k = 0; k < begins_.size(); ++k)
    {
      steps_.push_back(
        ascending ? Step{ begins_[k], ends_[k], false } : Step{ ends_[k], begins_[k], false });
    }
  }

  // Those of a vertex; turned around they end where they would begin.
  void addCopies(
    std::int32_t vertex, std::vector<std::int32_t>& begins, std::vector<std::int32_t>& ends) const
  {
    const int copies = keep_.copies(winding_[std::size_t(vertex)]);
    const std::int64_t vertices = std::int64_t(winding_.size());
    for (int copy = 0; copy < std::abs(copies); ++copy)
    {
      const std::int64_t id = vertex + copy * vertices;
      if (id > std::numeric_limits<std::int32_t>::max())
      {
        throw TooLarge("A mesh of " + std::to_string(vertices) +
          " points crosses itself too often at the cut. Decimate it.");
      }
      (copies > 0 ? begins : ends).push_back(std::int32_t(id));
    }
  }

  const Border* borderAt(std::int32_t crossing) const
  {
    const auto found =
      std::lower_bound(borders_.begin(), borders_.end(), Border{ crossing, 0, false });
    return found != borders_.end() && found->crossing == crossing ? &*found : nullptr;
  }

  Step* stepFrom(std::int32_t id)
  {
    const auto found = std::lower_bound(steps_.begin(), steps_.end(), Step{ id, 0, false });
    return found != steps_.end() && found->from == id ? &*found : nullptr;
  }

  // Bits of the edges that it lies on.
  unsigned edgesAt(std::int32_t id) const
  {
    if (id < 0)
    {
      const Border* border = this->borderAt(-1 - id);
      return border ? 1u << border->edge : 0u;
    }
    const std::int32_t vertex = std::int32_t(id % std::int64_t(winding_.size()));
    const unsigned k = corner_[0] == vertex ? 0 : corner_[1] == vertex ? 1 : 2;
    return 1u << k | 1u << (k + 2) % 3;
  }

  std::int32_t add(std::int32_t id, const Vec3& position, unsigned edges)
  {
    ids_.push_back(id);
    points_.push_back({ position[axisX_], position[axisY_], std::uint8_t(edges) });
    return std::int32_t(points_.size()) - 1;
  }

  // Around all parts; returns how many touch the border of the triangle, which come first.
  std::size_t trace()
  {
    inside_.clear();
    for (Step& first : steps_)
    {
      Triangulator::Loop loop;
      unsigned edges = 0;
      for (Step* step = &first; step != nullptr && !step->visited; step = this->stepFrom(step->to))
      {
        step->visited = true;
        const unsigned on = this->edgesAt(step->from);
        loop.push_back(this->add(step->from, this->positionOf(step->from), on));
        edges |= on;
      }
      if (loop.size() > 2)
      {
        (edges != 0 ? loops_ : inside_).push_back(std::move(loop));
      }
    }
    const std::size_t outer = loops_.size();
    std::move(inside_.begin(), inside_.end(), std::back_inserter(loops_));
    return outer;
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
    for (std::vector<Triangulator::Loop>& face : faces)
    {
      this->triangulate(face);
    }
  }

  void triangulate(std::vector<Triangulator::Loop>& loops)
  {
    planar_.clear();
    // Kept turned around, where the other mesh crosses itself.
    const bool turned = loops.size() == 1 && this->areaOf(loops[0]) < -this->rounding(loops[0]);
    if (turned)
    {
      std::reverse(loops[0].begin(), loops[0].end());
    }
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
      if (keep_.flip != turned)
      {
        std::swap(made[1], made[2]);
      }
      faces_.triangles.push_back(made);
      faces_.source.push_back(triangle_);
    }
  }

  Vec3 positionOf(std::int32_t id) const
  {
    return id >= 0 ? operand_.mesh().points[std::size_t(id) % winding_.size()]
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

  const MeshOperand& operand_;
  const int mesh_;
  const Keep keep_;
  const CutCurves& curves_;
  const std::vector<std::int8_t>& winding_;
  const CutCurves::Cuts& cuts_;
  CutFaces& faces_;
  Triangulator triangulator_;

  std::int32_t triangle_ = -1;
  Triangle corner_{};
  int axisX_ = 0, axisY_ = 1;
  std::vector<Step> steps_;
  std::vector<Border> borders_;
  std::vector<std::int32_t> begins_, ends_;
  std::vector<std::int32_t> ids_;
  std::vector<PlanarPoint> points_;
  std::vector<Triangulator::Loop> loops_;
  std::vector<Triangulator::Loop> inside_;
  std::vector<Triangle> planar_;
};

} // namespace

CutFaces cutFaces(const MeshOperand& operand, int mesh, const Keep& keep, const CutCurves& curves,
  const MeshSides& sides)
{
  const std::size_t count = curves.cuts[std::size_t(mesh)].triangles.size();
  std::vector<CutFaces> parts((count + kGrain - 1) / kGrain);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      const std::size_t part = begin / kGrain;
      FaceCutter cutter(operand, mesh, keep, curves, sides, parts[part]);
      for (std::size_t k = begin; k < end; ++k)
      {
        cutter.cut(k);
      }
    });
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
