// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSelector.h"

#include <algorithm>
#include <limits>

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
    this->findPieces(box);
    if (sets.front() == groups_ && this->isPlain(groups_))
    {
      return {}; // no sum is larger than that of all
    }
    this->dropSmall(box, sets);
    std::vector<BlendSelection::Cluster> clusters;
    for (const Groups& set : sets)
    {
      clusters.push_back(this->cluster(set));
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

  // The pieces in reach, how far they are from the groups in reach, and per pair of groups how far
  // at most.
  void findPieces(const Box3& box)
  {
    field_.pieces.select(box, pieces_);
    most_.assign(groups_.size() * groups_.size(), 0.0);
    this->findReaches();
    for (const SegmentElement* segment : pieces_.segments)
    {
      this->addPlace(field_.places.segmentPlaces[field_.pieces.index(segment)], reachOf(*segment));
    }
    for (const TriangleElement* triangle : pieces_.triangles)
    {
      this->addPlace(
        field_.places.trianglePlaces[field_.pieces.index(triangle)], reachOf(*triangle));
    }
  }

  // Where an element, or the part of a group in reach, has a field. The Cauchy kernel: everywhere;
  // and as [SUB] what cuts the others' fields has to stay where there is none.
  template <class Element>
  Box3 reachOf(const Element& element) const
  {
    const double reach = field_.whole.kernel().kind == KernelKind::Cauchy || this->isPaper()
      ? std::numeric_limits<double>::infinity()
      : largestReach(element);
    const Box3 box = boundsOf(element);
    return Box3(Vec3(box.min() - Vec3::Constant(reach)), Vec3(box.max() + Vec3::Constant(reach)));
  }

  void findReaches()
  {
    reaches_.resize(groups_.size());
    for (std::size_t k = 0; k < all_.segments.size(); ++k)
    {
      reaches_[this->indexOf(segmentGroups_[k])].extend(reachOf(*all_.segments[k]));
    }
    for (std::size_t k = 0; k < all_.triangles.size(); ++k)
    {
      reaches_[this->indexOf(triangleGroups_[k])].extend(reachOf(*all_.triangles[k]));
    }
  }

  void addPlace(const BlendPieces::Place& place, const Box3& reach)
  {
    const std::size_t count = groups_.size();
    const std::size_t begin = distances_.size();
    // Far from a group, so far that a place half there and half here does not blend with it.
    distances_.resize(begin + count, 2.0 * share_.end());
    for (const GroupDistance& near : place.distances)
    {
      const std::size_t index = this->indexOf(near.group);
      if (index < count)
      {
        distances_[begin + index] = near.distance;
      }
    }
    // Where one of both fields is always 0 the distance does not matter.
    for (std::size_t group = 0; group < count; ++group)
    {
      if (!reach.intersects(reaches_[group]))
      {
        distances_[begin + group] = 0.0;
      }
    }
    const std::size_t own = this->indexOf(place.group);
    pieceGroups_.push_back(own);
    if (own < count)
    {
      distances_[begin + own] = 0.0;
      for (std::size_t group = 0; group < count; ++group)
      {
        double& most = most_[count * group + own];
        most = std::max(most, distances_[begin + group]);
      }
    }
  }

  // Among the groups in reach; their number for another.
  std::size_t indexOf(std::int32_t group) const
  {
    const auto found = std::lower_bound(groups_.begin(), groups_.end(), group);
    return found != groups_.end() && *found == group
      ? static_cast<std::size_t>(found - groups_.begin())
      : groups_.size();
  }

  // As [SUB]: a place is one on element i alone, and i counts in full.
  Groups placesOf(const Groups& set) const { return this->isPaper() ? Groups{ set.front() } : set; }

  bool countsInFull(std::int32_t group, const Groups& places) const
  {
    if (this->isPaper())
    {
      return group == places.front();
    }
    const double* most = most_.data() + groups_.size() * this->indexOf(group);
    return std::all_of(places.begin(), places.end(),
      [&](std::int32_t place) { return most[this->indexOf(place)] <= share_.begin(); });
  }

  bool isPlain(const Groups& set) const
  {
    const Groups places = this->placesOf(set);
    return std::all_of(set.begin(), set.end(),
      [&](std::int32_t group) { return this->countsInFull(group, places); });
  }

  BlendSelection::Cluster cluster(const Groups& set) const
  {
    const Groups places = this->placesOf(set);
    std::vector<std::size_t> pieces;
    BlendSelection::Cluster result;
    Groups plain;
    for (const std::int32_t group : set)
    {
      if (this->countsInFull(group, places))
      {
        plain.push_back(group);
        continue;
      }
      if (pieces.empty())
      {
        pieces = this->collectPieces(places, result.pieces);
      }
      result.terms.push_back(this->term(group, pieces));
    }
    std::sort(plain.begin(), plain.end());
    this->collect(plain, result.plain);
    return result;
  }

  BlendSelection::Term term(std::int32_t group, const std::vector<std::size_t>& pieces) const
  {
    const std::size_t index = this->indexOf(group);
    BlendSelection::Term term;
    term.distances.reserve(pieces.size());
    for (const std::size_t piece : pieces)
    {
      term.distances.push_back(distances_[groups_.size() * piece + index]);
    }
    const auto [least, largest] = std::minmax_element(term.distances.begin(), term.distances.end());
    term.span = pieces.empty() ? 0.0 : *largest - *least;
    this->collect({ group }, term.own);
    return term;
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

  // Those of the groups: their places among all in reach.
  std::vector<std::size_t> collectPieces(const Groups& groups, ElementSelection& selection) const
  {
    std::vector<char> wanted(groups_.size() + 1, 0);
    for (const std::int32_t group : groups)
    {
      wanted[this->indexOf(group)] = 1;
    }
    wanted[groups_.size()] = 0;
    std::vector<std::size_t> pieces;
    const std::size_t segments = pieces_.segments.size();
    for (std::size_t k = 0; k < pieceGroups_.size(); ++k)
    {
      if (!wanted[pieceGroups_[k]])
      {
        continue;
      }
      pieces.push_back(k);
      if (k < segments)
      {
        selection.segments.push_back(pieces_.segments[k]);
      }
      else
      {
        selection.triangles.push_back(pieces_.triangles[k - segments]);
      }
    }
    return pieces;
  }

  const BlendGroups& field_;
  BlendShare share_;
  const ElementSelection& all_;
  Groups segmentGroups_; // per element of all_
  Groups triangleGroups_;
  Groups groups_; // those in reach
  ElementSelection pieces_;
  std::vector<std::size_t> pieceGroups_; // places in groups_: of segments, then triangles
  std::vector<Box3> reaches_;            // per group in reach
  std::vector<double> distances_;        // per piece and group in reach
  std::vector<double> most_;             // per group and group of the pieces
};

} // namespace

std::vector<BlendSelection::Cluster> blendClusters(
  const BlendGroups& groups, const ElementSelection& all, const Box3& box)
{
  return Finder(groups, all).clusters(box);
}

} // namespace hybridtree
