// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/UnfoldPatch.h"

#include "core/stitch/CheckPatch.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

using Index = MeshLinks::Index;

constexpr int kMaxRounds = 12;        // as many steps at one triangle
constexpr double kLargestFold = 0.25; // cells^2, of one triangle
constexpr double kLeastGain = 1e-6;   // cells^2
constexpr double kMostOff = 0.1;      // cells, between old and new surface
constexpr double kLargestTilt = 0.6;  // cosine of a normal to those of the points
constexpr double kSliver = 0.05;      // height over longest side: below, a normal says little
constexpr double kLongestSide = 1.6;  // cells, of a triangle that had shorter ones

class Unfolder
{
public:
  Unfolder(MeshLinks& links, const TriangleMesh& mesh, std::size_t keptPoints,
    const std::vector<bool>& onCrease, double cellSize)
    : links_(links)
    , mesh_(mesh)
    , firstOwn_(static_cast<Index>(keptPoints))
    , onCrease_(onCrease)
    , cellSize_(cellSize)
  {
  }

  std::vector<std::size_t> run()
  {
    std::vector<std::size_t> folded;
    for (std::size_t t = 0; t < links_.triangleCount(); ++t)
    {
      if (this->isFolded(t))
      {
        folded.push_back(t);
      }
    }
    for (int round = 0; round < kMaxRounds && !folded.empty(); ++round)
    {
      std::vector<std::size_t> next;
      for (const std::size_t t : folded)
      {
        if (this->isFolded(t) && this->unfold(t))
        {
          next.insert(next.end(), latest_.begin(), latest_.end());
          next.push_back(t);
        }
      }
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      folded = std::move(next);
    }
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    return std::move(changed_);
  }

private:
  struct Step
  {
    double gain = 0.0; ///< area no longer turned
    Index edge = MeshLinks::kNone;
    bool isFlip = false;
  };

  const Vec3& point(Index v) const { return mesh_.points[static_cast<std::size_t>(v)]; }
  const Vec3& up(Index v) const { return mesh_.normals[static_cast<std::size_t>(v)]; }

  bool isFolded(std::size_t t) const
  {
    return !links_.isRemoved(t) && isTurned(mesh_, links_.triangle(t)) &&
      this->turnedArea(links_.triangle(t)) <= kLargestFold * cellSize_ * cellSize_;
  }

  Vec3 normal(const Triangle& c) const
  {
    return (this->point(c[1]) - this->point(c[0])).cross(this->point(c[2]) - this->point(c[0]));
  }
  Vec3 upOf(const Triangle& c) const
  {
    return (this->up(c[0]) + this->up(c[1]) + this->up(c[2])).stableNormalized();
  }
  double longestSide(const Triangle& c) const
  {
    return std::max({ (this->point(c[0]) - this->point(c[1])).norm(),
      (this->point(c[1]) - this->point(c[2])).norm(),
      (this->point(c[2]) - this->point(c[0])).norm() });
  }
  double turnedArea(const Triangle& c) const
  {
    return std::max(0.0, -0.5 * this->normal(c).dot(this->upOf(c)));
  }

  /// Turned it counts as such; else it should lie along the surface, or be so low that it is on it
  /// in any case.
  bool mayBe(const Triangle& c, double limit) const
  {
    const Vec3 normal = this->normal(c);
    const double along = normal.dot(this->upOf(c));
    const double size = normal.norm();
    const double longest = this->longestSide(c);
    return longest <= limit &&
      (along <= 0.0 || along >= kLargestTilt * size || size <= kMostOff * cellSize_ * longest);
  }

  /// The best step at a triangle. \return false where there is none.
  bool unfold(std::size_t t)
  {
    Step best;
    best.gain = kLeastGain * cellSize_ * cellSize_;
    for (auto h = static_cast<Index>(3 * t); h < static_cast<Index>(3 * t + 3); ++h)
    {
      this->tryFlip(h, best);
      const Index from = links_.from(h);
      if (from >= firstOwn_ && !links_.isLocked(from) && !onCrease_[static_cast<std::size_t>(from)])
      {
        links_.forEachLeaving(from, [&](Index leaving) { this->tryCollapse(leaving, best); });
      }
    }
    if (best.edge == MeshLinks::kNone)
    {
      return false;
    }
    latest_.clear();
    if (best.isFlip)
    {
      latest_ = { static_cast<std::size_t>(best.edge / 3),
        static_cast<std::size_t>(links_.twin(best.edge) / 3) };
      links_.flip(best.edge);
    }
    else
    {
      links_.forEachLeaving(links_.from(best.edge),
        [&](Index leaving) { latest_.push_back(static_cast<std::size_t>(leaving / 3)); });
      links_.collapse(best.edge);
    }
    changed_.insert(changed_.end(), latest_.begin(), latest_.end());
    return true;
  }

  void tryCollapse(Index h, Step& best) const
  {
    const Index from = links_.from(h);
    const Index to = links_.to(h);
    const Vec3 way = this->point(to) - this->point(from);
    const double mostOff = kMostOff * cellSize_;
    bool allowed = way.norm() <= 0.7 * cellSize_ && std::abs(this->up(from).dot(way)) <= mostOff;
    double gain = 0.0;
    double longest = kLongestSide * cellSize_;
    links_.forEachLeaving(from,
      [&](Index leaving)
      {
        const Triangle& c = links_.triangle(static_cast<std::size_t>(leaving / 3));
        longest = std::max(longest, this->longestSide(c));
        gain += this->turnedArea(c);
      });
    links_.forEachLeaving(from,
      [&](Index leaving)
      {
        const Index b = links_.to(leaving);
        const Index c = links_.opposite(leaving);
        allowed = allowed && !this->isOff({ from, b, c }, way, mostOff);
        if (allowed && b != to && c != to)
        {
          const Triangle moved{ to, b, c };
          allowed = this->mayBe(moved, longest);
          gain -= this->turnedArea(moved);
        }
      });
    if (allowed && gain > best.gain && links_.canCollapse(h))
    {
      best = { gain, h, false };
    }
  }

  /// A triangle whose normal says where the surface is has its first corner taken off it.
  bool isOff(const Triangle& c, const Vec3& way, double most) const
  {
    const Vec3 normal = this->normal(c);
    const double size = normal.norm();
    const double longest = this->longestSide(c);
    return size > kSliver * longest * longest && normal.dot(this->upOf(c)) > 0.0 &&
      std::abs(normal.dot(way)) > most * size;
  }

  void tryFlip(Index h, Step& best) const
  {
    const Index twin = links_.twin(h);
    if (twin == MeshLinks::kNone)
    {
      return;
    }
    const Index a = links_.from(h);
    const Index b = links_.to(h);
    const Index c = links_.opposite(h);
    const Index d = links_.opposite(twin);
    const Triangle before[2] = { { a, b, c }, { b, a, d } };
    const Triangle after[2] = { { d, b, c }, { c, a, d } };
    const double gain = this->turnedArea(before[0]) + this->turnedArea(before[1]) -
      this->turnedArea(after[0]) - this->turnedArea(after[1]);
    const double longest = std::max(
      { kLongestSide * cellSize_, this->longestSide(before[0]), this->longestSide(before[1]) });
    const double volume = std::abs(this->normal(before[0]).dot(this->point(d) - this->point(a)));
    const Vec3 ab = this->point(b) - this->point(a);
    const Vec3 cd = this->point(d) - this->point(c);
    // Of all it is that far from the old edge to the new one, or less.
    const bool isNear = volume <= kMostOff * cellSize_ * ab.norm() * cd.norm();
    const bool isCrease =
      onCrease_[static_cast<std::size_t>(a)] && onCrease_[static_cast<std::size_t>(b)];
    if (gain > best.gain && isNear && !isCrease && this->mayBe(after[0], longest) &&
      this->mayBe(after[1], longest) && links_.canFlip(h))
    {
      best = { gain, h, true };
    }
  }

  MeshLinks& links_;
  const TriangleMesh& mesh_;
  const Index firstOwn_;
  const std::vector<bool>& onCrease_;
  const double cellSize_;
  std::vector<std::size_t> latest_; ///< that the last step changed
  std::vector<std::size_t> changed_;
};

} // namespace

std::vector<std::size_t> unfoldTriangles(MeshLinks& links, const TriangleMesh& mesh,
  std::size_t keptPoints, const std::vector<bool>& onCrease, double cellSize)
{
  return Unfolder(links, mesh, keptPoints, onCrease, cellSize).run();
}

} // namespace hybridtree
