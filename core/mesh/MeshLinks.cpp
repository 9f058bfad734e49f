// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshLinks.h"

#include "core/base/Parallel.h"
#include "core/mesh/HalfEdges.h"

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 4096;

} // namespace

MeshLinks::MeshLinks(const std::vector<Triangle>& triangles, std::size_t points)
  : triangles_(triangles)
  , twins_(halfEdges(triangles).opposite)
  , leaving_(points, kNone)
  , locked_(points, false)
{
  parallelFor(twins_.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto h = static_cast<Index>(begin); h < static_cast<Index>(end); ++h)
      {
        // Neighbours that contradict each other are none. Each reads what neither changes.
        const Index twin = twins_[h];
        twins_[h] = twin >= 0 && this->from(h) == this->to(twin) ? twin : kNone;
      }
    });
  this->lockPoints();
}

void MeshLinks::lockPoints()
{
  std::vector<Index> corners(locked_.size(), 0);
  for (Index h = 0; h < static_cast<Index>(twins_.size()); ++h)
  {
    const Index p = this->from(h);
    leaving_[p] = h;
    ++corners[p];
    if (twins_[h] == kNone)
    {
      locked_[p] = true;
      locked_[this->to(h)] = true;
    }
  }
  parallelFor(locked_.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto p = static_cast<Index>(begin); p < static_cast<Index>(end); ++p)
      {
        locked_[p] = locked_[p] || leaving_[p] == kNone || this->valence(p) != corners[p];
      }
    });
}

MeshLinks::Index MeshLinks::valence(Index point) const
{
  Index around = 0;
  this->forEachLeaving(point, [&](Index) { ++around; });
  return around;
}

void MeshLinks::join(Index a, Index b)
{
  if (a != kNone)
  {
    twins_[a] = b;
  }
  if (b != kNone)
  {
    twins_[b] = a;
  }
}

bool MeshLinks::areJoined(Index a, Index b) const
{
  if (locked_[a] && locked_[b])
  {
    return true;
  }
  bool joined = false;
  const Index center = locked_[a] ? b : a;
  const Index other = locked_[a] ? a : b;
  this->forEachLeaving(center, [&](Index h) { joined = joined || this->to(h) == other; });
  return joined;
}

void MeshLinks::split(Index h, Index middle)
{
  const Index other = twins_[h];
  leaving_.push_back(kNone);
  locked_.push_back(other == kNone);
  const auto firstNew = static_cast<Index>(twins_.size());
  this->splitTriangle(h, middle);
  if (other != kNone)
  {
    this->splitTriangle(other, middle);
    this->join(h, firstNew + 3);
    this->join(other, firstNew);
  }
  leaving_[middle] = firstNew;
}

/// (a, b, c) with h from a to b becomes (a, m, c) in place, and (m, b, c) at the end; the halves of
/// h are left without twins.
void MeshLinks::splitTriangle(Index h, Index middle)
{
  const Index b = this->to(h);
  const Index c = this->opposite(h);
  const auto added = static_cast<Index>(twins_.size());
  triangles_.push_back({ middle, b, c });
  twins_.insert(twins_.end(), 3, kNone);
  triangles_[h / 3][next(h) % 3] = middle;
  this->join(added + 1, twins_[next(h)]);
  this->join(added + 2, next(h));
  twins_[h] = kNone;
  leaving_[b] = added + 1;
}

bool MeshLinks::canFlip(Index h) const
{
  const Index other = twins_[h];
  return other != kNone && !this->areJoined(this->opposite(h), this->opposite(other));
}

/// (a, b, c) and (b, a, d) become (d, b, c) and (c, a, d): h then runs from d, its twin from c.
void MeshLinks::flip(Index h)
{
  const Index g = twins_[h];
  const Index a = this->from(h);
  const Index b = this->to(h);
  const Index c = this->opposite(h);
  const Index d = this->opposite(g);
  const Index bc = next(h);
  const Index ca = previous(h);
  const Index ad = next(g);
  const Index db = previous(g);
  const Index twinCa = twins_[ca];
  const Index twinDb = twins_[db];
  triangles_[h / 3][h % 3] = d; // h: d b, then b c, c d
  triangles_[g / 3][g % 3] = c; // g: c a, then a d, d c
  this->join(h, twinDb);
  this->join(g, twinCa);
  this->join(ca, db);
  leaving_[a] = ad;
  leaving_[b] = bc;
  leaving_[c] = g;
  leaving_[d] = h;
}

bool MeshLinks::canCollapse(Index h) const
{
  const Index a = this->from(h);
  const Index b = this->to(h);
  if (locked_[a] || locked_[b] || twins_[h] == kNone)
  {
    return false;
  }
  // Points joined to both ends: only the two of the edge's triangles.
  int common = 0;
  this->forEachLeaving(a,
    [&](Index leaving)
    {
      const Index point = this->to(leaving);
      this->forEachLeaving(b, [&](Index h2) { common += this->to(h2) == point; });
    });
  // With three neighbours each they are on a tetrahedron.
  return common == 2 && this->valence(a) + this->valence(b) > 6;
}

void MeshLinks::collapse(Index h)
{
  const Index g = twins_[h];
  const Index a = this->from(h);
  const Index b = this->to(h);
  const Index c = this->opposite(h);
  const Index d = this->opposite(g);
  const Index cb = twins_[next(h)];
  const Index ac = twins_[previous(h)];
  const Index da = twins_[next(g)];
  const Index bd = twins_[previous(g)];
  std::vector<Index> around;
  this->forEachLeaving(a, [&](Index leaving) { around.push_back(leaving); });
  for (const Index leaving : around)
  {
    triangles_[leaving / 3][leaving % 3] = b;
  }
  triangles_[h / 3].fill(kNone);
  triangles_[g / 3].fill(kNone);
  this->join(cb, ac);
  this->join(da, bd);
  leaving_[a] = kNone;
  locked_[a] = true;
  leaving_[b] = ac;
  leaving_[c] = cb;
  leaving_[d] = da;
}

} // namespace hybridtree
