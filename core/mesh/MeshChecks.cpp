// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshChecks.h"

#include "core/base/DisjointSets.h"

#include <algorithm>
#include <sstream>

namespace hybridtree
{
namespace
{

/// One side of a triangle: the side that starts at `corner` (3 * triangle + local index), seen from
/// its end point with the smaller index.
struct Side
{
  std::int32_t other;   ///< the end point with the larger index
  std::uint32_t corner; ///< where the side starts
  bool forward;         ///< runs from the smaller to the larger index
};

bool isValid(const TriangleMesh& mesh, const Triangle& c)
{
  const auto size = static_cast<std::int32_t>(mesh.points.size());
  const auto exists = [size](std::int32_t p) { return 0 <= p && p < size; };
  return exists(c[0]) && exists(c[1]) && exists(c[2]) && c[0] != c[1] && c[1] != c[2] &&
    c[2] != c[0];
}

std::uint32_t nextCorner(std::uint32_t corner)
{
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

class Checker
{
public:
  explicit Checker(const TriangleMesh& mesh)
    : mesh_(mesh), fans_(3 * mesh.triangles.size()), components_(mesh.points.size())
  {
  }

  MeshReport run()
  {
    this->checkTriangles();
    this->sortSides();
    for (std::size_t p = 0; p < mesh_.points.size(); ++p)
    {
      this->checkSidesOf(static_cast<std::int32_t>(p));
    }
    this->countFans();
    report_.eulerCharacteristic = static_cast<std::int64_t>(report_.points) -
      static_cast<std::int64_t>(report_.edges) + static_cast<std::int64_t>(report_.triangles);
    return report_;
  }

private:
  void checkTriangles()
  {
    valid_.assign(mesh_.triangles.size(), true);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (!isValid(mesh_, mesh_.triangles[t]))
      {
        valid_[t] = false;
        note(report_.invalidTriangles, report_.firstInvalidTriangle, static_cast<std::int32_t>(t));
        continue;
      }
      ++report_.triangles;
      if (!(areaNormal(mesh_, t).squaredNorm() > 0.0))
      {
        note(report_.degenerateTriangles, report_.firstDegenerateTriangle,
          static_cast<std::int32_t>(t));
      }
    }
  }

  /// Counting sort by the smaller end point: first_[p] .. first_[p + 1] are the sides of point p.
  void sortSides()
  {
    first_.assign(mesh_.points.size() + 1, 0);
    this->forEachSide([&](std::int32_t low, const Side&) { ++first_[low + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    sides_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    this->forEachSide([&](std::int32_t low, const Side& side) { sides_[next[low]++] = side; });
  }

  template <class Body>
  void forEachSide(Body&& body) const
  {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (!valid_[t])
      {
        continue;
      }
      for (std::uint32_t k = 0; k < 3; ++k)
      {
        const std::int32_t a = mesh_.triangles[t][k];
        const std::int32_t b = mesh_.triangles[t][(k + 1) % 3];
        body(std::min(a, b), Side{ std::max(a, b), static_cast<std::uint32_t>(3 * t + k), a < b });
      }
    }
  }

  void checkSidesOf(std::int32_t low)
  {
    const auto begin = sides_.begin() + static_cast<std::ptrdiff_t>(first_[low]);
    const auto end = sides_.begin() + static_cast<std::ptrdiff_t>(first_[low + 1]);
    std::sort(begin, end,
      [](const Side& a, const Side& b)
      { return a.other != b.other ? a.other < b.other : a.corner < b.corner; });
    for (auto side = begin; side != end;)
    {
      auto last = side;
      while (last != end && last->other == side->other)
      {
        ++last;
      }
      this->checkEdge(low, &*side, static_cast<std::size_t>(last - side));
      side = last;
    }
  }

  void checkEdge(std::int32_t low, const Side* sides, std::size_t count)
  {
    ++report_.edges;
    const std::array<std::int32_t, 2> edge{ low, sides[0].other };
    if (count == 1)
    {
      note(report_.boundaryEdges, report_.firstBoundaryEdge, edge);
    }
    else if (count > 2)
    {
      note(report_.crowdedEdges, report_.firstCrowdedEdge, edge);
    }
    else if (sides[0].forward == sides[1].forward)
    {
      note(report_.misorientedEdges, report_.firstMisorientedEdge, edge);
    }
    components_.join(static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(sides[0].other));
    for (std::size_t k = 1; k < count; ++k)
    {
      fans_.join(cornerAt(sides[0], true), cornerAt(sides[k], true));
      fans_.join(cornerAt(sides[0], false), cornerAt(sides[k], false));
    }
  }

  /// Corner of the side's triangle at the smaller or the larger end point.
  static std::uint32_t cornerAt(const Side& side, bool low)
  {
    return side.forward == low ? side.corner : nextCorner(side.corner);
  }

  void countFans()
  {
    std::vector<std::uint8_t> fans(mesh_.points.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      for (std::uint32_t k = 0; valid_[t] && k < 3; ++k)
      {
        const auto corner = static_cast<std::uint32_t>(3 * t + k);
        std::uint8_t& count = fans[mesh_.triangles[t][k]];
        if (count < 2 && fans_.find(corner) == corner)
        {
          ++count;
        }
      }
    }
    for (std::size_t p = 0; p < fans.size(); ++p)
    {
      const auto point = static_cast<std::uint32_t>(p);
      report_.unusedPoints += fans[p] == 0;
      report_.points += fans[p] > 0;
      report_.components += fans[p] > 0 && components_.find(point) == point;
      if (fans[p] > 1)
      {
        note(report_.crowdedPoints, report_.firstCrowdedPoint, static_cast<std::int32_t>(p));
      }
    }
  }

  template <class Element>
  static void note(std::size_t& count, Element& first, const Element& element)
  {
    if (count++ == 0)
    {
      first = element;
    }
  }

  const TriangleMesh& mesh_;
  MeshReport report_;
  std::vector<bool> valid_;
  std::vector<std::size_t> first_;
  std::vector<Side> sides_;
  DisjointSets fans_; ///< of corners, joined across shared edges
  DisjointSets components_;
};

} // namespace

std::string MeshReport::describe() const
{
  std::ostringstream text;
  const auto list = [&](std::size_t count, const char* what, const auto&... where)
  {
    if (count > 0)
    {
      text << (text.tellp() > 0 ? "; " : "") << count << ' ' << what << " (first:";
      ((text << ' ' << where), ...);
      text << ')';
    }
  };
  list(invalidTriangles, "invalid triangles", firstInvalidTriangle);
  list(degenerateTriangles, "triangles without area", firstDegenerateTriangle);
  list(boundaryEdges, "boundary edges", firstBoundaryEdge[0], firstBoundaryEdge[1]);
  list(crowdedEdges, "edges of more than two triangles", firstCrowdedEdge[0], firstCrowdedEdge[1]);
  list(misorientedEdges, "edges of contradicting orientation", firstMisorientedEdge[0],
    firstMisorientedEdge[1]);
  list(crowdedPoints, "points of more than one fan", firstCrowdedPoint);
  if (text.tellp() == 0)
  {
    text << "closed 2-manifold";
  }
  text << "; " << points << " points, " << triangles << " triangles, " << components
       << " components, Euler characteristic " << eulerCharacteristic;
  return text.str();
}

MeshReport checkMesh(const TriangleMesh& mesh)
{
  return Checker(mesh).run();
}

bool isClosedManifold(const TriangleMesh& mesh)
{
  return checkMesh(mesh).closedManifold();
}

} // namespace hybridtree
