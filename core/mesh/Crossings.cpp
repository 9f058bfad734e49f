// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/Crossings.h"

#include "core/base/Parallel.h"
#include "core/geometry/Predicates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 16384;

// Of the largest new triangle that a cell of the grid must be.
constexpr double kLeastShare = 0.25;

using Pair = std::pair<std::size_t, std::size_t>;

/// Whether a segment meets a triangle that does not lie in one plane with it.
bool meets(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const int atP = orientation3d(a, b, c, p);
  const int atQ = orientation3d(a, b, c, q);
  if (atP == atQ)
  {
    return false;
  }
  const int ab = orientation3d(p, q, a, b);
  const int bc = orientation3d(p, q, b, c);
  const int ca = orientation3d(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// Triangles by the cells of a hashed grid that their boxes meet.
class CrossingFinder
{
public:
  CrossingFinder(const TriangleMesh& mesh, std::size_t firstNew, const std::vector<bool>& removed,
    double cellSize)
    : mesh_(mesh), firstNew_(firstNew), removed_(removed), cellSize_(cellSize)
  {
    for (std::size_t t = firstNew_; t < mesh_.triangles.size(); ++t)
    {
      bounds_.extend(this->boxOf(t));
      cellSize_ = std::max(cellSize_, kLeastShare * this->boxOf(t).sizes().maxCoeff());
    }
    this->fillGrid();
  }

  std::vector<Pair> run() const
  {
    const std::size_t count = mesh_.triangles.size();
    std::vector<std::vector<Pair>> parts((count + kGrain - 1) / kGrain);
    parallelFor(count, kGrain,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t t = begin; t < end; ++t)
        {
          if (t >= firstNew_ || !removed_[t])
          {
            this->findCrossings(t, parts[t / kGrain]);
          }
        }
      });
    std::vector<Pair> all;
    for (const std::vector<Pair>& part : parts)
    {
      all.insert(all.end(), part.begin(), part.end());
    }
    std::sort(all.begin(), all.end(),
      [](const Pair& a, const Pair& b)
      { return std::make_pair(a.second, a.first) < std::make_pair(b.second, b.first); });
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

private:
  struct Entry
  {
    std::uint32_t slot;
    std::uint32_t triangle;
  };

  Box3 boxOf(std::size_t t) const
  {
    Box3 box;
    for (const std::int32_t v : mesh_.triangles[t])
    {
      box.extend(mesh_.points[v]);
    }
    return box;
  }

  template <class Visit>
  void forEachSlot(const Box3& box, Visit&& visit) const
  {
    std::int64_t low[3];
    std::int64_t high[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = static_cast<std::int64_t>(std::floor(box.min()[axis] / cellSize_));
      high[axis] = static_cast<std::int64_t>(std::floor(box.max()[axis] / cellSize_));
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
    {
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
        {
          const std::uint64_t mixed = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u ^
            static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu ^
            static_cast<std::uint64_t>(z) * 0x165667B19E3779F9u;
          visit(static_cast<std::uint32_t>((mixed ^ mixed >> 29) % slots_));
        }
      }
    }
  }

  void fillGrid()
  {
    slots_ = 4 * static_cast<std::uint32_t>(mesh_.triangles.size() - firstNew_) + 1;
    std::vector<Entry> entries;
    for (std::size_t t = firstNew_; t < mesh_.triangles.size(); ++t)
    {
      this->forEachSlot(this->boxOf(t),
        [&](std::uint32_t slot) {
          entries.push_back({ slot, static_cast<std::uint32_t>(t) });
        });
    }
    firstOf_.assign(slots_ + 1, 0);
    for (const Entry& entry : entries)
    {
      ++firstOf_[entry.slot + 1];
    }
    for (std::size_t k = 0; k < slots_; ++k)
    {
      firstOf_[k + 1] += firstOf_[k];
    }
    std::vector<std::uint32_t> next(firstOf_.begin(), firstOf_.end() - 1);
    inSlot_.resize(entries.size());
    for (const Entry& entry : entries)
    {
      inSlot_[next[entry.slot]++] = entry.triangle;
    }
  }

  void findCrossings(std::size_t t, std::vector<Pair>& found) const
  {
    const Box3 box = this->boxOf(t).intersection(bounds_);
    if (box.isEmpty())
    {
      return;
    }
    const auto test = [&](std::size_t other)
    {
      if (t < other && box.intersects(this->boxOf(other)) && this->cross(t, other))
      {
        found.emplace_back(t, other);
      }
    };
    if ((box.sizes() / cellSize_).prod() > static_cast<double>(slots_))
    {
      for (std::size_t other = firstNew_; other < mesh_.triangles.size(); ++other)
      {
        test(other);
      }
      return;
    }
    this->forEachSlot(box,
      [&](std::uint32_t slot) {
        std::for_each(inSlot_.begin() + firstOf_[slot], inSlot_.begin() + firstOf_[slot + 1], test);
      });
  }

  bool cross(std::size_t s, std::size_t t) const
  {
    Triangle a = mesh_.triangles[s];
    Triangle b = mesh_.triangles[t];
    int shared = 0;
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        if (mesh_.triangles[s][i] == mesh_.triangles[t][j])
        {
          ++shared;
          std::rotate(a.begin(), std::find(a.begin(), a.end(), mesh_.triangles[s][i]), a.end());
          std::rotate(b.begin(), std::find(b.begin(), b.end(), mesh_.triangles[s][i]), b.end());
        }
      }
    }
    if (shared > 0)
    {
      // From the shared point only the sides across it can meet the other triangle elsewhere.
      return shared == 1 && (this->sideMeets(a, 1, b) || this->sideMeets(b, 1, a));
    }
    for (int k = 0; k < 3; ++k)
    {
      if (this->sideMeets(a, k, b) || this->sideMeets(b, k, a))
      {
        return true;
      }
    }
    return false;
  }

  /// The side that starts at corner k.
  bool sideMeets(const Triangle& a, int k, const Triangle& b) const
  {
    const std::vector<Vec3>& p = mesh_.points;
    return meets(p[a[k]], p[a[(k + 1) % 3]], p[b[0]], p[b[1]], p[b[2]]);
  }

  const TriangleMesh& mesh_;
  const std::size_t firstNew_;
  const std::vector<bool>& removed_;
  double cellSize_;
  Box3 bounds_;
  std::uint32_t slots_ = 1;
  std::vector<std::uint32_t> firstOf_; ///< of each slot's triangles in inSlot_
  std::vector<std::uint32_t> inSlot_;
};

} // namespace

std::vector<std::pair<std::size_t, std::size_t>> newCrossings(
  const TriangleMesh& mesh, std::size_t firstNew, const std::vector<bool>& removed, double cellSize)
{
  return CrossingFinder(mesh, firstNew, removed, cellSize).run();
}

} // namespace hybridtree
