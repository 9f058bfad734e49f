// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/NotchSearch.h"

#include <algorithm>

namespace hybridtree
{

using Index = std::int32_t;

namespace
{

// Of a look at all: edges and triangles as they are. The rest is for edges in their place.
constexpr double kEdgesShare = 0.7;

} // namespace

NotchKey notchKey(const Triangle& corners)
{
  NotchKey key{ corners[0], corners[1], corners[2], -1 };
  std::rotate(key.begin(), std::min_element(key.begin(), key.begin() + 3), key.begin() + 3);
  return key;
}

std::size_t NotchKeyHash::operator()(const NotchKey& key) const
{
  std::uint64_t hash = 0;
  for (const Index v : key)
  {
    hash = (hash ^ static_cast<std::uint32_t>(v)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return hash;
}

NotchSearch::NotchSearch(
  const FieldSource& field, const NotchOptions& options, const TriangleMesh& mesh)
  : field_(field), options_(options), mesh_(mesh), hot_(mesh.points.size())
{
  for (std::size_t t = options.first; t < mesh.triangles.size(); ++t)
  {
    const bool calm = !options.calm.empty() && options.calm[t];
    if (!calm && this->isBent(mesh.triangles[t]))
    {
      hasHotPoints_ = true;
      this->heat(mesh.triangles[t]);
    }
  }
}

bool NotchSearch::isBent(const Triangle& c) const
{
  const Vec3& a = mesh_.normals[c[0]];
  const Vec3& b = mesh_.normals[c[1]];
  const Vec3& d = mesh_.normals[c[2]];
  return std::min({ a.dot(b), b.dot(d), d.dot(a) }) < options_.leastCosine;
}

void NotchSearch::heat(const Triangle& corners)
{
  for (const Index v : corners)
  {
    hot_[v] = true;
  }
}

void NotchSearch::heatFrom(std::size_t firstMade)
{
  hot_.resize(mesh_.points.size(), true);
  for (std::size_t t = firstMade; t < mesh_.triangles.size(); ++t)
  {
    this->heat(mesh_.triangles[t]);
  }
}

void NotchSearch::update(const std::vector<bool>& removed, const Progress& progress)
{
  this->findTriangles(removed);
  std::vector<NotchKey> keys;
  for (const TriangleSide& side : sides_.all())
  {
    if (const TriangleSide* twin = this->changeableTwin(side))
    {
      keys.push_back(this->edgeKey(side, *twin));
    }
  }
  for (const std::size_t t : triangles_)
  {
    if (t >= options_.first && this->isBent(mesh_.triangles[t]))
    {
      keys.push_back(notchKey(mesh_.triangles[t]));
    }
  }
  this->lookAt(keys, ProgressPart(progress, 0.0, kEdgesShare));
  keys.clear();
  for (const TriangleSide& side : sides_.all())
  {
    const TriangleSide* twin = this->changeableTwin(side);
    if (twin && this->find(this->edgeKey(side, *twin))->height > 0.0)
    {
      keys.push_back(flipped(this->edgeKey(side, *twin)));
    }
  }
  this->lookAt(keys, ProgressPart(progress, kEdgesShare, 1.0));
}

void NotchSearch::findTriangles(const std::vector<bool>& removed)
{
  triangles_.clear();
  sides_.clear();
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
  {
    const Triangle& c = mesh_.triangles[t];
    if (!removed[t] && (hot_[c[0]] || hot_[c[1]] || hot_[c[2]]))
    {
      triangles_.push_back(t);
      sides_.add(mesh_, t);
    }
  }
  sides_.sort();
  twins_.clear();
  for (const TriangleSide& side : sides_.all())
  {
    twins_.push_back(this->findChangeableTwin(side));
  }
}

const TriangleSide* NotchSearch::findChangeableTwin(const TriangleSide& side) const
{
  if (side.from > side.to || !hot_[side.from] || !hot_[side.to] || side.triangle < options_.first)
  {
    return nullptr;
  }
  const TriangleSide* twin = sides_.twinOf(side);
  return twin && twin->triangle >= options_.first ? twin : nullptr;
}

NotchKey NotchSearch::edgeKey(const TriangleSide& side, const TriangleSide& twin) const
{
  return { side.from, cornerOpposite(mesh_, twin), side.to, cornerOpposite(mesh_, side) };
}

bool NotchSearch::mayBeJoined(Index a, Index b) const
{
  return !hot_[a] || !hot_[b] || sides_.find(a, b) || sides_.find(b, a) || sides_.isOpenAt(a) ||
    sides_.isOpenAt(b);
}

const NotchPoint* NotchSearch::find(const NotchKey& key) const
{
  const auto found = known_.find(key);
  return found == known_.end() ? nullptr : &found->second;
}

void NotchSearch::lookAt(const std::vector<NotchKey>& keys, const Progress& progress)
{
  std::vector<NotchKey> fresh;
  std::vector<NotchSite> sites;
  for (const NotchKey& key : keys)
  {
    if (known_.emplace(key, NotchPoint{}).second)
    {
      fresh.push_back(key);
      sites.push_back(this->siteOf(key));
    }
  }
  const std::vector<NotchPoint> points =
    findNotchPoints(field_, options_.cellSize, sites, progress);
  for (std::size_t k = 0; k < fresh.size(); ++k)
  {
    known_[fresh[k]] = points[k];
  }
}

NotchSite NotchSearch::siteOf(const NotchKey& key) const
{
  NotchSite site;
  site.count = key[3] < 0 ? 3 : 4;
  for (int k = 0; k < site.count; ++k)
  {
    site.rim[k] = mesh_.points[key[k]];
    site.normals[k] = mesh_.normals[key[k]];
  }
  return site;
}

} // namespace hybridtree
