// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshLinks.h"

#include "core/mesh/HalfEdges.h"

namespace hybridtree
{

MeshLinks::MeshLinks(const std::vector<Triangle>& triangles, std::size_t points)
  : triangles_(triangles)
  , twins_(halfEdges(triangles).opposite)
  , leaving_(points, kNone)
  , locked_(points, false)
{
  for (Index h = 0; h < static_cast<Index>(twins_.size()); ++h)
  {
    // Neighbours that contradict each other are none.
    const bool twins = twins_[h] >= 0 && this->from(h) == this->to(twins_[h]);
    twins_[h] = twins ? twins_[h] : kNone;
    leaving_[this->from(h)] = h;
  }
  this->lockPoints();
}

void MeshLinks::lockPoints()
{
  std::vector<Index> corners(locked_.size(), 0);
  for (Index h = 0; h < static_cast<Index>(twins_.size()); ++h)
  {
    ++corners[this->from(h)];
    if (twins_[h] == kNone)
    {
      locked_[this->from(h)] = true;
      locked_[this->to(h)] = true;
    }
  }
  for (std::size_t point = 0; point < locked_.size(); ++point)
  {
    const auto p = static_cast<Index>(point);
    if (leaving_[p] == kNone)
    {
      locked_[p] = true;
    }
    else if (!locked_[p])
    {
      Index around = 0;
      this->forEachLeaving(p, [&](Index) { ++around; });
      locked_[p] = around != corners[p];
    }
  }
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
  int aroundA = 0;
  int aroundB = 0;
  this->forEachLeaving(a,
    [&](Index leaving)
    {
      ++aroundA;
      const Index point = this->to(leaving);
      this->forEachLeaving(b, [&](Index h2) { common += this->to(h2) == point; });
    });
  this->forEachLeaving(b, [&](Index) { ++aroundB; });
  // With three neighbours each they are on a tetrahedron.
  return common == 2 && aroundA + aroundB > 6;
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
