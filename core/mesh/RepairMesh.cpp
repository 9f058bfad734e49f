// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/RepairMesh.h"

#include "core/base/Error.h"
#include "core/geometry/Predicates.h"
#include "core/mesh/LooseTriangles.h"
#include "core/mesh/Orient.h"
#include "core/mesh/Seams.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace hybridtree
{
namespace
{

std::string plural(std::size_t count, const char* one, const char* many)
{
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

void checkInput(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles)
{
  if (triangles.empty())
  {
    throw InvalidGeometry("The mesh has no polygons (" + plural(points.size(), "point", "points") +
      "). A leaf needs a surface: reconstruct one from a point set first.");
  }
  const std::size_t most = std::size_t(std::numeric_limits<std::int32_t>::max()) / 3;
  if (points.size() > most || triangles.size() > most)
  {
    throw TooLarge("The mesh has " + std::to_string(points.size()) + " points and " +
      std::to_string(triangles.size()) + " triangles; at most " + std::to_string(most) +
      " of each can be used. Decimate it.");
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (const std::int32_t vertex : triangles[t])
    {
      if (vertex < 0 || std::size_t(vertex) >= points.size())
      {
        throw InvalidGeometry("Triangle " + std::to_string(t) + " refers to point " +
          std::to_string(vertex) + ", but the mesh has points 0 to " +
          std::to_string(std::int64_t(points.size()) - 1) + ".");
      }
      if (!points[std::size_t(vertex)].allFinite())
      {
        throw InvalidGeometry("Point " + std::to_string(vertex) + " (of triangle " +
          std::to_string(t) + ") has a coordinate that is not finite. Remove or repair the point.");
      }
    }
  }
}

// Gives every used point the first used point with equal coordinates. Open addressing.
class Welder
{
public:
  explicit Welder(const std::vector<Vec3>& points) : points_(points)
  {
    std::size_t capacity = 16;
    while (capacity < 2 * points.size())
    {
      capacity *= 2;
    }
    slots_.assign(capacity, -1);
  }

  std::int32_t representative(std::int32_t point)
  {
    const Vec3& p = points_[std::size_t(point)];
    for (std::size_t slot = hash(p);; ++slot)
    {
      std::int32_t& held = slots_[slot & (slots_.size() - 1)];
      if (held < 0)
      {
        held = point;
      }
      if (points_[std::size_t(held)] == p) // numeric: -0 equals 0
      {
        return held;
      }
    }
  }

private:
  static std::size_t hash(const Vec3& p)
  {
    std::uint64_t all = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double value = p[axis] + 0.0; // -0 becomes 0
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      all = (all ^ bits) * 0x9e3779b97f4a7c15ull;
      all ^= all >> 29;
    }
    return std::size_t(all ^ (all >> 32));
  }

  const std::vector<Vec3>& points_;
  std::vector<std::int32_t> slots_;
};

// True for the second and later copies of a triangle, whichever way round.
std::vector<bool> findDuplicates(const std::vector<Triangle>& triangles)
{
  std::vector<std::pair<Triangle, std::int32_t>> sorted(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    sorted[t] = { triangles[t], std::int32_t(t) };
    std::sort(sorted[t].first.begin(), sorted[t].first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> duplicate(triangles.size(), false);
  for (std::size_t k = 1; k < sorted.size(); ++k)
  {
    duplicate[std::size_t(sorted[k].second)] = sorted[k].first == sorted[k - 1].first;
  }
  return duplicate;
}

struct Counts
{
  std::size_t joined = 0;     // by seams
  std::size_t degenerate = 0; // repeated corner
  std::size_t flat = 0;       // three points on one line
  std::size_t duplicate = 0;
  std::size_t loose = 0; // open pieces of a few beside closed surfaces
};

class Repair
{
public:
  Repair(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles)
    : points_(points), triangles_(triangles)
  {
  }

  RepairedMesh run()
  {
    checkInput(points_, triangles_);
    Orientation orientation = this->makeWithSeams();
    if (orientation.openEdges > 0 && this->findLoose())
    {
      orientation = this->make();
    }
    this->tell(orientation);
    result_.mesh = std::make_shared<const TriangleMesh>(std::move(mesh_));
    return std::move(result_);
  }

private:
  Orientation make()
  {
    mesh_ = {};
    result_ = {};
    counts_ = {};
    used_.clear();
    this->weld();
    this->dropBadTriangles();
    this->compactPoints();
    return orientTriangles(mesh_);
  }

  Orientation makeWithSeams()
  {
    const Orientation before = this->make();
    if (before.openEdges == 0 || !this->findSeams())
    {
      return before;
    }
    const Orientation after = this->make();
    if (after.openEdges < before.openEdges && after.nonManifoldEdges <= before.nonManifoldEdges)
    {
      return after;
    }
    seam_.clear();
    return this->make();
  }

  // Whether there are any.
  bool findLoose()
  {
    const std::vector<bool> loose = looseTriangles(mesh_.triangles);
    loose_.assign(loose.empty() ? 0 : triangles_.size(), false);
    for (std::size_t t = 0; t < loose.size(); ++t)
    {
      loose_[std::size_t(result_.triangleMap[t])] = loose[t];
    }
    return !loose_.empty();
  }

  // Whether there are any; between points that welding takes for others.
  bool findSeams()
  {
    const std::vector<std::int32_t> targets = seamPoints(mesh_);
    if (targets.empty())
    {
      return false;
    }
    seam_.assign(points_.size(), -1);
    for (std::size_t k = 0; k < targets.size(); ++k)
    {
      seam_[std::size_t(used_[k])] = used_[std::size_t(targets[k])];
    }
    return true;
  }

  std::int32_t joined(std::int32_t point)
  {
    const std::int32_t target = seam_.empty() ? point : seam_[std::size_t(point)];
    counts_.joined += target >= 0 && target != point;
    return target >= 0 ? target : point;
  }

  void weld()
  {
    Welder welder(points_);
    std::vector<std::int32_t> first(points_.size(), -1);
    mesh_.triangles = triangles_;
    for (Triangle& corner : mesh_.triangles)
    {
      for (std::int32_t& vertex : corner)
      {
        std::int32_t& target = first[std::size_t(vertex)];
        if (target < 0)
        {
          target = this->joined(welder.representative(vertex));
        }
        vertex = target;
      }
    }
    result_.pointMap = std::move(first);
  }

  bool isFlat(const Triangle& c) const
  {
    return collinear(
      points_[std::size_t(c[0])], points_[std::size_t(c[1])], points_[std::size_t(c[2])]);
  }

  void dropBadTriangles()
  {
    const std::vector<bool> duplicate = findDuplicates(mesh_.triangles);
    std::vector<Triangle> kept;
    kept.reserve(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const Triangle& c = mesh_.triangles[t];
      const bool repeated = c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
      const bool flat = !repeated && this->isFlat(c);
      counts_.degenerate += repeated;
      counts_.flat += flat;
      counts_.duplicate += !repeated && !flat && duplicate[t];
      const bool loose = !repeated && !flat && !duplicate[t] && !loose_.empty() && loose_[t];
      counts_.loose += loose;
      if (!repeated && !flat && !duplicate[t] && !loose)
      {
        kept.push_back(c);
        result_.triangleMap.push_back(std::int32_t(t));
      }
    }
    if (kept.empty())
    {
      throw InvalidGeometry("All " + std::to_string(triangles_.size()) +
        " triangles of the mesh are flat: they repeat a point or have three points on one line. "
        "A leaf needs a surface.");
    }
    mesh_.triangles = std::move(kept);
  }

  // Keeps the points in use, in order.
  void compactPoints()
  {
    std::vector<std::int32_t> place(points_.size(), -1);
    for (const Triangle& corner : mesh_.triangles)
    {
      for (const std::int32_t vertex : corner)
      {
        place[std::size_t(vertex)] = 0;
      }
    }
    for (std::size_t k = 0; k < points_.size(); ++k)
    {
      if (place[k] == 0)
      {
        place[k] = std::int32_t(mesh_.points.size());
        mesh_.points.push_back(points_[k]);
        used_.push_back(std::int32_t(k));
      }
    }
    for (Triangle& corner : mesh_.triangles)
    {
      for (std::int32_t& vertex : corner)
      {
        vertex = place[std::size_t(vertex)];
      }
    }
    for (std::int32_t& target : result_.pointMap)
    {
      target = target < 0 ? -1 : place[std::size_t(target)];
    }
  }

  void say(std::size_t count, const char* one, const char* many, const std::string& rest)
  {
    add(result_.warnings, count, one, many, rest);
  }

  void blame(std::size_t count, const char* one, const char* many, const std::string& rest)
  {
    add(result_.faults, count, one, many, rest);
  }

  static void add(std::vector<std::string>& to, std::size_t count, const char* one,
    const char* many, const std::string& rest)
  {
    if (count > 0)
    {
      to.push_back(plural(count, one, many) + " " + rest);
    }
  }

  void tell(const Orientation& orientation)
  {
    this->say(counts_.joined, "point", "points",
      "of open edges joined with others that differ by less than a millionth of the diagonal.");
    this->say(counts_.degenerate, "triangle", "triangles", "that repeated a point dropped.");
    this->say(counts_.flat, "triangle", "triangles",
      orientation.openEdges > 0
        ? "with three points on one line dropped; this may have opened T-junctions, which have no "
          "width but keep the mesh from being closed."
        : "with three points on one line dropped.");
    this->say(counts_.duplicate, "duplicate triangle", "duplicate triangles", "dropped.");
    this->say(counts_.loose, "loose triangle", "loose triangles",
      "dropped: without them the mesh is closed.");
    this->say(orientation.flippedTriangles, "triangle", "triangles",
      "turned to agree with the neighbours.");
    this->say(orientation.flippedShells, "closed shell", "closed shells",
      "turned: outer shells point outward, shells inside an odd number of others bound cavities.");
    this->blame(orientation.oneSidedShells, "shell", "shells",
      "cannot be oriented: one-sided, as a Moebius strip is.");
    this->blame(
      orientation.nonManifoldEdges, "edge", "edges", "shared by more than two triangles.");
    this->blame(orientation.openEdges, "open edge", "open edges",
      "of one triangle only: the mesh is not closed.");
  }

  const std::vector<Vec3>& points_;
  const std::vector<Triangle>& triangles_;
  TriangleMesh mesh_;
  std::vector<std::int32_t> used_; // per point of the mesh the input point that it is
  std::vector<std::int32_t> seam_; // per input point the one that stands for it; -1: itself
  std::vector<bool> loose_;        // per input triangle, or empty
  Counts counts_;
  RepairedMesh result_;
};

} // namespace

RepairedMesh repairMesh(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles)
{
  return Repair(points, triangles).run();
}

} // namespace hybridtree
