// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSelector.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

// Finds which groups blend in a box.
class Finder
{
public:
  using Groups = std::vector<std::int32_t>;

  Finder(const BlendGroups& field, const ElementSelection& all)
    : field_(field), share_(field.control), all_(all)
  {
    for (const SegmentElement* segment : all.segments)
    {
      segmentGroups_.push_back(field.segmentGroups[field.whole.index(segment)]);
    }
    for (const TriangleElement* triangle : all.triangles)
    {
      triangleGroups_.push_back(field.triangleGroups[field.whole.index(triangle)]);
    }
    groups_ = segmentGroups_;
    groups_.insert(groups_.end(), triangleGroups_.begin(), triangleGroups_.end());
    makeUnique(groups_);
  }

  std::vector<BlendSelection::Cluster> clusters(const Box3& box)
  {
    std::vector<Groups> sets = this->groupSets();
    this->dropSmall(box, sets);
    field_.pieces.select(box, pieces_);
    for (const SegmentElement* segment : pieces_.segments)
    {
      segmentPlaces_.push_back(&field_.places.segmentPlaces[field_.pieces.index(segment)]);
    }
    for (const TriangleElement* triangle : pieces_.triangles)
    {
      trianglePlaces_.push_back(&field_.places.trianglePlaces[field_.pieces.index(triangle)]);
    }
    std::vector<BlendSelection::Cluster> clusters;
    for (const Groups& set : sets)
    {
      clusters.push_back(this->cluster(set));
      if (clusters.back().terms.empty() && set == groups_)
      {
        return {}; // no sum is larger than that of all
      }
    }
    return clusters;
  }

private:
  static void makeUnique(Groups& groups)
  {
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  }

  const Groups& neighboursOf(std::int32_t group) const
  {
    return field_.places.neighbours[static_cast<std::size_t>(group)];
  }
  bool isPaper() const { return field_.control.kind == BlendingKind::Paper; }

  // Per candidate i: the groups in reach that its sum may have. As [SUB]: i first.
  std::vector<Groups> groupSets() const
  {
    Groups candidates = groups_;
    if (!this->isPaper())
    {
      for (const std::int32_t group : groups_)
      {
        const Groups& others = this->neighboursOf(group);
        candidates.insert(candidates.end(), others.begin(), others.end());
      }
      makeUnique(candidates);
    }
    std::vector<Groups> sets;
    for (const std::int32_t candidate : candidates)
    {
      const Groups& others = this->neighboursOf(candidate);
      Groups& set = sets.emplace_back();
      for (const std::int32_t group : groups_)
      {
        if (group == candidate || std::binary_search(others.begin(), others.end(), group))
        {
          set.push_back(group);
        }
      }
      if (this->isPaper())
      {
        std::iter_swap(set.begin(), std::find(set.begin(), set.end(), candidate));
      }
    }
    std::sort(sets.begin(), sets.end());
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    // Large sets first: they may make the others needless.
    std::stable_sort(sets.begin(), sets.end(),
      [](const Groups& a, const Groups& b) { return a.size() > b.size(); });
    return sets;
  }

  // Sets whose sum stays below the field of some group alone: with a kernel without end, most.
  void dropSmall(const Box3& box, std::vector<Groups>& sets) const
  {
    constexpr std::size_t kFew = 4; // not worth the search
    if (sets.size() <= kFew)
    {
      return;
    }
    double least = 0.0;
    std::vector<double> most;
    for (const std::int32_t group : groups_)
    {
      ElementSelection own;
      this->collect({ group }, own);
      const Interval range = field_.whole.range(own, box);
      least = std::max(least, range.min);
      most.push_back(range.max);
    }
    const auto isSmall = [&](const Groups& set)
    {
      double sum = 0.0;
      for (const std::int32_t group : set)
      {
        sum += most[static_cast<std::size_t>(
          std::lower_bound(groups_.begin(), groups_.end(), group) - groups_.begin())];
      }
      return sum < least;
    };
    sets.erase(std::remove_if(sets.begin(), sets.end(), isSmall), sets.end());
  }

  BlendSelection::Cluster cluster(const Groups& set) const
  {
    Groups around = this->isPaper() ? Groups{ set.front() } : set;
    Groups plain;
    BlendSelection::Cluster result;
    std::vector<const BlendPieces::Place*> places;
    this->collectPieces(around, result.pieces, places);
    for (const std::int32_t group : set)
    {
      BlendSelection::Term term = this->term(group, places);
      if (this->isPaper() ? group == set.front() : this->countsInFull(term))
      {
        plain.push_back(group);
        continue;
      }
      this->collect({ group }, term.own);
      result.terms.push_back(std::move(term));
    }
    std::sort(plain.begin(), plain.end());
    this->collect(plain, result.plain);
    if (result.terms.empty())
    {
      result.pieces = {};
    }
    return result;
  }

  BlendSelection::Term term(
    std::int32_t group, const std::vector<const BlendPieces::Place*>& places) const
  {
    BlendSelection::Term term;
    for (const BlendPieces::Place* place : places)
    {
      term.distances.push_back(place->distanceTo(group, share_.end()));
    }
    const auto [least, largest] = std::minmax_element(term.distances.begin(), term.distances.end());
    term.span = places.empty() ? 0.0 : *largest - *least;
    return term;
  }

  bool countsInFull(const BlendSelection::Term& term) const
  {
    return std::all_of(term.distances.begin(), term.distances.end(),
      [this](double distance) { return distance <= share_.begin(); });
  }

  void collect(const Groups& groups, ElementSelection& selection) const
  {
    const auto wanted = [&](std::int32_t group)
    { return std::binary_search(groups.begin(), groups.end(), group); };
    for (std::size_t k = 0; k < segmentGroups_.size(); ++k)
    {
      if (wanted(segmentGroups_[k]))
      {
        selection.segments.push_back(all_.segments[k]);
      }
    }
    for (std::size_t k = 0; k < triangleGroups_.size(); ++k)
    {
      if (wanted(triangleGroups_[k]))
      {
        selection.triangles.push_back(all_.triangles[k]);
      }
    }
  }

  void collectPieces(const Groups& groups, ElementSelection& selection,
    std::vector<const BlendPieces::Place*>& places) const
  {
    const auto wanted = [&](const BlendPieces::Place* place)
    { return std::binary_search(groups.begin(), groups.end(), place->group); };
    for (std::size_t k = 0; k < segmentPlaces_.size(); ++k)
    {
      if (wanted(segmentPlaces_[k]))
      {
        selection.segments.push_back(pieces_.segments[k]);
        places.push_back(segmentPlaces_[k]);
      }
    }
    for (std::size_t k = 0; k < trianglePlaces_.size(); ++k)
    {
      if (wanted(trianglePlaces_[k]))
      {
        selection.triangles.push_back(pieces_.triangles[k]);
        places.push_back(trianglePlaces_[k]);
      }
    }
  }

  const BlendGroups& field_;
  BlendShare share_;
  const ElementSelection& all_;
  Groups segmentGroups_; // per element of all_
  Groups triangleGroups_;
  Groups groups_; // those in reach
  ElementSelection pieces_;
  std::vector<const BlendPieces::Place*> segmentPlaces_; // per piece
  std::vector<const BlendPieces::Place*> trianglePlaces_;
};

} // namespace

std::vector<BlendSelection::Cluster> blendClusters(
  const BlendGroups& groups, const ElementSelection& all, const Box3& box)
{
  return Finder(groups, all).clusters(box);
}

} // namespace hybridtree
