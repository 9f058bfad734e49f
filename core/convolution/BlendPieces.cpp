// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendPieces.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/convolution/ElementTree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

namespace hybridtree
{
namespace
{

constexpr double kSightDistance = 1.0;         // up to which beta is 1
constexpr std::size_t kMostWeights = 60000000; // in both tables: about a gigabyte
constexpr std::size_t kSamples = 128;
constexpr double kClearly = 1.15; // so that what would fit is not refused by an estimate
constexpr std::size_t kLeastGrain = 32;
constexpr std::size_t kMostParts = 128;

[[noreturn]] void refuse()
{
  throw TooLarge("Blending = neighbours would have to keep more than " +
    std::to_string(kMostWeights) +
    " distances along the skeleton: its elements are many and small beside the radius. Choose "
    "Blending = all, a lower Level, a smaller radius or BlendDistance, or a coarser skeleton.");
}

// A ball around some.
ElementBall around(const ElementBall& a, const ElementBall& b)
{
  const double radiusA = std::sqrt(a.squaredRadius);
  const double radiusB = std::sqrt(b.squaredRadius);
  const double between = (b.center - a.center).norm();
  if (between + radiusB <= radiusA)
  {
    return a;
  }
  if (between + radiusA <= radiusB)
  {
    return b;
  }
  const double radius = 0.5 * (1.0 + 1e-12) * (between + radiusA + radiusB);
  return { a.center + (radius - radiusA) / between * (b.center - a.center), radius * radius };
}

Box3 boxOf(const ElementBall& ball)
{
  const Vec3 radius = Vec3::Constant(std::sqrt(ball.squaredRadius));
  return Box3(Vec3(ball.center - radius), Vec3(ball.center + radius));
}

bool meet(const ElementBall& a, const ElementBall& b)
{
  const double reach = std::sqrt(a.squaredRadius) + std::sqrt(b.squaredRadius);
  return (a.center - b.center).squaredNorm() < reach * reach;
}

} // namespace

void validate(const BlendingControl& control)
{
  if (!(control.distance >= 0.5 && control.distance <= 100.0))
  {
    throw InvalidParameter("BlendDistance", control.distance,
      "from 0.5 to 100: the distance along the skeleton, in influence radii, up to which parts "
      "blend fully");
  }
}

// Rows of both tables, from the distances of one piece from the others.
class BlendPieces::Relations
{
public:
  Relations(const BlendPieces& pieces, const PieceGraph& graph, const BlendingControl& control)
    : pieces_(pieces)
    , graph_(graph)
    , share_(control)
    , sight_(BlendingControl{ BlendingKind::Neighbours, kSightDistance })
    , farthest_(std::max(share_.end(), sight_.end()))
  {
    if (pieces.isLocal())
    {
      std::vector<Box3> boxes;
      boxes.reserve(pieces.size());
      for (const Piece& piece : pieces.pieces_)
      {
        boxes.push_back(boxOf(piece.ball));
      }
      tree_ = ElementTree(boxes);
    }
  }

  void fill(PieceTable& sights, PieceTable& shares) const
  {
    this->requireFew();
    const std::size_t count = pieces_.size();
    const std::size_t grain = std::max(kLeastGrain, count / kMostParts + 1);
    std::vector<Part> parts((count + grain - 1) / grain);
    std::atomic<std::size_t> total = 0;
    parallelFor(count, grain,
      [&](std::size_t begin, std::size_t end)
      {
        PieceGraph::Search search(graph_);
        Part& part = parts[begin / grain];
        this->addRows(search, begin, end, part);
        if ((total += part.sights.size() + part.shares.size()) > kMostWeights)
        {
          refuse();
        }
      });
    for (PieceTable* table : { &sights, &shares })
    {
      table->begin.reserve(count + 1);
      table->begin.push_back(0);
    }
    for (const Part& part : parts)
    {
      append(part.sightEnds, part.sights, sights);
      append(part.shareEnds, part.shares, shares);
    }
  }

private:
  // Rows of some pieces.
  struct Part
  {
    std::vector<std::size_t> sightEnds, shareEnds;
    std::vector<PieceWeight> sights, shares;
  };

  static void append(const std::vector<std::size_t>& ends, const std::vector<PieceWeight>& weights,
    PieceTable& table)
  {
    const std::size_t before = table.weights.size();
    for (const std::size_t end : ends)
    {
      table.begin.push_back(static_cast<std::uint32_t>(before + end));
    }
    table.weights.insert(table.weights.end(), weights.begin(), weights.end());
  }

  // From a sample, before any are kept.
  void requireFew() const
  {
    const std::size_t count = pieces_.size();
    if (2.0 * double(count) * double(count) <= double(kMostWeights))
    {
      return;
    }
    const std::size_t samples = std::min(kSamples, count);
    PieceGraph::Search search(graph_);
    Part part;
    for (std::size_t k = 0; k < samples; ++k)
    {
      const std::size_t piece = k * count / samples;
      this->addRows(search, piece, piece + 1, part);
    }
    const double found = double(part.sights.size() + part.shares.size());
    if (found / double(samples) * double(count) > kClearly * double(kMostWeights))
    {
      refuse();
    }
  }

  void addRows(PieceGraph::Search& search, std::size_t begin, std::size_t end, Part& part) const
  {
    std::vector<std::uint32_t> others;
    for (std::size_t k = begin; k < end; ++k)
    {
      const auto piece = static_cast<std::uint32_t>(k);
      search.run(piece, farthest_);
      this->findOthers(search, piece, others);
      for (const std::uint32_t other : others)
      {
        const double distance = search.distance(other);
        const double sight = sight_(distance);
        const double share = share_(distance);
        const double counts = pieces_.isLocal() ? 1.0 - share : share;
        if (sight > 0.0)
        {
          part.sights.push_back({ other, sight });
        }
        if (counts > 0.0)
        {
          part.shares.push_back({ other, counts });
        }
      }
      part.sightEnds.push_back(part.sights.size());
      part.shareEnds.push_back(part.shares.size());
    }
  }

  // Ascending.
  void findOthers(
    const PieceGraph::Search& search, std::uint32_t piece, std::vector<std::uint32_t>& others) const
  {
    if (pieces_.isLocal())
    {
      others.clear();
      const ElementBall& ball = pieces_[piece].ball;
      tree_.visit(boxOf(ball),
        [&](std::uint32_t other)
        {
          if (meet(ball, pieces_[other].ball))
          {
            others.push_back(other);
          }
        });
    }
    else
    {
      others = search.found();
    }
    std::sort(others.begin(), others.end());
  }

  const BlendPieces& pieces_;
  const PieceGraph& graph_;
  BlendShare share_;
  BlendShare sight_;
  double farthest_;
  ElementTree tree_; // over the reaches of the pieces
};

BlendPieces::BlendPieces(
  const GroupedElements& elements, const BlendingControl& control, const ConvolutionKernel& kernel)
  : isLocal_(kernel.kind == KernelKind::Compact)
{
  CutPieces cut = cutIntoPieces(elements);
  this->addPieces(cut, elements.groups.size());
  if (!cut.areWhole)
  {
    elements_ = std::make_unique<const ConvolutionField>(kernel, cut.segments, cut.triangles);
  }
  if (!isLocal_)
  {
    this->findBounds(cut, kernel);
  }
  segmentPieces_ = std::move(cut.segmentPieces);
  trianglePieces_ = std::move(cut.trianglePieces);
  const PieceGraph graph(
    std::move(cut.places), std::move(cut.contacts), std::move(cut.sides), elements.points);
  Relations(*this, graph, control).fill(sights_, shares_);
  shareGroups_.resize(elements.groups.size());
  this->findGroups(shares_, shareGroups_);
  if (!isLocal_)
  {
    sightGroups_.resize(elements.groups.size());
    this->findGroups(sights_, sightGroups_);
  }
}

void BlendPieces::addPieces(const CutPieces& cut, std::size_t groups)
{
  for (std::size_t k = 0; k < cut.places.size(); ++k)
  {
    pieces_.push_back({ cut.groups[k], cut.places[k].isTriangle, 0, 0, { Vec3::Zero(), 0.0 } });
  }
  const auto add = [&](const auto& elements, const std::vector<std::uint32_t>& of)
  {
    for (std::uint32_t k = 0; k < elements.size(); ++k)
    {
      Piece& piece = pieces_[of[k]];
      const bool isFirst = piece.end == 0;
      piece.begin = isFirst ? k : piece.begin;
      piece.end = k + 1;
      piece.ball = isFirst ? elements[k].ball : around(piece.ball, elements[k].ball);
    }
  };
  add(cut.segments, cut.segmentPieces);
  add(cut.triangles, cut.trianglePieces);
  for (const Piece& piece : pieces_)
  {
    (piece.isTriangle ? trianglesBegin_ : segmentsBegin_).push_back(piece.begin);
  }
  segmentsBegin_.push_back(static_cast<std::uint32_t>(cut.segments.size()));
  trianglesBegin_.push_back(static_cast<std::uint32_t>(cut.triangles.size()));
  groupBegin_.assign(groups, 0);
  groupEnd_.assign(groups, 0);
  for (std::uint32_t k = 0; k < pieces_.size(); ++k)
  {
    const auto group = static_cast<std::size_t>(pieces_[k].group);
    groupBegin_[group] = groupEnd_[group] == 0 ? k : groupBegin_[group];
    groupEnd_[group] = k + 1;
  }
}

void BlendPieces::findBounds(const CutPieces& cut, const ConvolutionKernel& kernel)
{
  if (elements_)
  {
    elements_->select(elements_->influenceBounds(), all_);
  }
  std::vector<CauchyBound> bounds(pieces_.size());
  const auto add = [&](const auto& elements, const std::vector<std::uint32_t>& of)
  {
    for (std::size_t k = 0; k < elements.size(); ++k)
    {
      bounds[of[k]].add(elements[k], kernel);
    }
  };
  add(cut.segments, cut.segmentPieces);
  add(cut.triangles, cut.trianglePieces);
  for (const CauchyBound& of : bounds)
  {
    meanReach_ += of.largestReach() / double(bounds.size());
  }
  const std::size_t size = this->boundsSize();
  bounds_.assign(7 * size, 0.0);
  for (std::size_t k = 0; k < bounds.size(); ++k)
  {
    const CauchyBound& of = bounds[k];
    const Vec3 center = of.box().center();
    const std::array<double, 7> row = { center.x(), center.y(), center.z(),
      0.5 * of.box().diagonal().norm(), 1.0 / of.largestReach(), of.measure(), of.slope() };
    for (std::size_t r = 0; r < row.size(); ++r)
    {
      bounds_[r * size + k] = row[r];
    }
  }
}

std::size_t BlendPieces::boundsSize() const
{
  return (pieces_.size() + kRowStep - 1) / kRowStep * kRowStep;
}

FarBounds BlendPieces::bounds() const
{
  const std::size_t size = this->boundsSize();
  const auto row = [&](std::size_t k) { return bounds_.data() + k * size; };
  return { size, row(0), row(1), row(2), row(3), row(4), row(5), row(6) };
}

void BlendPieces::findGroups(
  const PieceTable& table, std::vector<std::vector<std::int32_t>>& lists) const
{
  std::vector<std::size_t> metBy(lists.size(), lists.size());
  for (std::size_t group = 0; group < lists.size(); ++group)
  {
    const std::uint32_t end = table.begin[groupEnd_[group]];
    for (std::uint32_t k = table.begin[groupBegin_[group]]; k < end; ++k)
    {
      const std::int32_t other = pieces_[table.weights[k].piece].group;
      if (std::exchange(metBy[static_cast<std::size_t>(other)], group) != group)
      {
        lists[group].push_back(other);
      }
    }
    std::sort(lists[group].begin(), lists[group].end());
  }
}

double BlendPieces::meanNear() const
{
  // Those that are seen and those that do not blend are others; of the rest there are few.
  return double(sights_.weights.size() + (isLocal_ ? shares_.weights.size() : 0)) /
    double(std::max<std::size_t>(1, pieces_.size()));
}

} // namespace hybridtree
