// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/FarLimbs.h"

#include "core/convolution/LimbRanges.h"
#include "core/convolution/LimbRows.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace hybridtree
{
namespace
{

// Where the elements of pieces are.
class FarElements
{
public:
  explicit FarElements(const FarField& field) : pieces_(field.pieces)
  {
    const ElementSelection& all = field.pieces.elements() ? field.pieces.all() : field.all;
    segments_ = all.segments.data();
    triangles_ = all.triangles.data();
  }

  ElementSpans of(std::size_t piece) const
  {
    const BlendPieces::Piece& at = pieces_[piece];
    return at.isTriangle ? ElementSpans{ {}, { triangles_ + at.begin, at.end - at.begin } }
                         : ElementSpans{ { segments_ + at.begin, at.end - at.begin }, {} };
  }

  /// \param pieces ascending: those in a row at once.
  void integrate(PieceList pieces, PointBatch points, LimbRows& rows) const
  {
    const auto ofSegments = static_cast<std::uint32_t>(pieces_.segmentPieceCount());
    for (std::size_t begin = 0, end = 0; begin < pieces.count; begin = end)
    {
      const std::uint32_t first = pieces.first[begin];
      while (end < pieces.count && pieces.first[end] == first + (end - begin) &&
        (first >= ofSegments || pieces.first[end] < ofSegments))
      {
        ++end;
      }
      if (first < ofSegments)
      {
        rows.integrate(
          PieceElements<SegmentElement>{ segments_, pieces_.segmentsBegin() + first, end - begin },
          first, points);
      }
      else
      {
        rows.integrate(PieceElements<TriangleElement>{ triangles_,
                         pieces_.trianglesBegin() + (first - ofSegments), end - begin },
          first, points);
      }
    }
  }

private:
  const BlendPieces& pieces_;
  const SegmentElement* const* segments_;
  const TriangleElement* const* triangles_;
};

// The pieces that may have weight somewhere in a box, and those that these share with or see.
class FarChoice
{
public:
  explicit FarChoice(const BlendPieces& pieces)
    : pieces_(pieces)
    , sights_(pieces.sights())
    , most_(pieces.bounds().size)
    , isChosen_(pieces.groupCount(), 0)
    , mostOfGroup_(pieces.groupCount())
  {
  }

  /// \param leastSight (pieces) tells the least anywhere in the box of the sum of what one sees,
  /// given as a list of weights.
  template <typename LeastSight>
  void choose(const Box3& box, const LeastSight& leastSight)
  {
    limbKernels().findMost(pieces_.bounds(), box, most_.data());
    const auto strongest = static_cast<std::uint32_t>(
      std::max_element(most_.begin(), most_.begin() + std::ptrdiff_t(pieces_.size())) -
      most_.begin());
    this->findCenters(kLeastSight *
      leastSight(sights_.weights + sights_.begin[strongest],
        sights_.begin[strongest + 1] - sights_.begin[strongest]));
    this->findAll();
  }

  PieceList all() const { return { all_.data(), all_.size() }; }
  PieceList centers() const { return { centers_.data(), centers_.size() }; }

private:
  void findCenters(double least)
  {
    centers_.clear();
    for (std::size_t group = 0; group < mostOfGroup_.size(); ++group)
    {
      mostOfGroup_[group] = std::accumulate(
        most_.begin() + pieces_.begin(group), most_.begin() + pieces_.end(group), 0.0);
    }
    for (std::size_t group = 0; group < mostOfGroup_.size(); ++group)
    {
      double sum = 0.0;
      for (const std::int32_t other : pieces_.seen(group))
      {
        sum += mostOfGroup_[static_cast<std::size_t>(other)];
      }
      if (sum >= least)
      {
        this->addPieces(group, centers_);
      }
    }
  }

  void addPieces(std::size_t group, std::vector<std::uint32_t>& list) const
  {
    for (std::uint32_t piece = pieces_.begin(group); piece < pieces_.end(group); ++piece)
    {
      list.push_back(piece);
    }
  }

  // Whole groups.
  void findAll()
  {
    std::fill(isChosen_.begin(), isChosen_.end(), char(0));
    std::int32_t before = -1;
    for (const std::uint32_t center : centers_)
    {
      const std::int32_t group = pieces_[center].group;
      if (group == std::exchange(before, group))
      {
        continue;
      }
      for (const auto* others :
        { &pieces_.sharing(std::size_t(group)), &pieces_.seen(std::size_t(group)) })
      {
        for (const std::int32_t other : *others)
        {
          isChosen_[static_cast<std::size_t>(other)] = 1;
        }
      }
    }
    all_.clear();
    for (std::size_t group = 0; group < isChosen_.size(); ++group)
    {
      if (isChosen_[group])
      {
        this->addPieces(group, all_);
      }
    }
  }

  const BlendPieces& pieces_;
  PieceRows sights_;
  std::vector<double> most_;   // per piece: of its field in the box
  std::vector<char> isChosen_; // per group
  std::vector<double> mostOfGroup_;
  std::vector<std::uint32_t> all_;
  std::vector<std::uint32_t> centers_;
};

constexpr std::size_t kTogether = 4 * kRowStep; // points that pieces are chosen for, at most
constexpr double kNear = 0.7;                   // how far apart these are, in R

// Parts of points that are near each other.
class FarEvaluation
{
public:
  FarEvaluation(
    const FarField& field, PointBatch points, double* value, const VectorBatch* gradient)
    : field_(field)
    , elements_(field)
    , choice_(field.pieces)
    , seen_(field.whole.kernel(), field.pieces.size(), false)
    , rows_(field.whole.kernel(), field.pieces.size(), gradient != nullptr)
    , points_(points)
    , value_(value)
    , gradient_(gradient)
  {
    std::vector<std::size_t> numbers(points.size);
    std::iota(numbers.begin(), numbers.end(), std::size_t(0));
    this->divide(numbers.data(), numbers.data() + numbers.size());
  }

private:
  void divide(std::size_t* begin, std::size_t* end)
  {
    Box3 box;
    std::for_each(begin, end, [&](std::size_t k) { box.extend(points_[k]); });
    const auto count = static_cast<std::size_t>(end - begin);
    if (count <= kRowStep ||
      (count <= kTogether && box.diagonal().norm() < kNear * field_.pieces.meanReach()))
    {
      this->evaluate(begin, count, box);
      return;
    }
    Eigen::Index axis;
    box.sizes().maxCoeff(&axis);
    std::size_t* middle = begin + (count / kRowStep + 1) / 2 * kRowStep;
    std::nth_element(begin, middle, end,
      [&](std::size_t a, std::size_t b) { return points_[a][axis] < points_[b][axis]; });
    this->divide(begin, middle);
    this->divide(middle, end);
  }

  void evaluate(const std::size_t* numbers, std::size_t count, const Box3& box)
  {
    const std::size_t size = (count + kRowStep - 1) / kRowStep * kRowStep;
    ScratchVectors at(size);
    for (std::size_t k = 0; k < size; ++k)
    {
      at.batch().set(k, points_[numbers[std::min(k, count - 1)]]);
    }
    choice_.choose(box,
      [&](const PieceWeight* sights, std::size_t pieces)
      { return this->leastSight(sights, pieces, at.points()); });
    for (std::size_t begin = 0; begin < count; begin += kRowStep)
    {
      this->findMeans(
        at.points().slice(begin, kRowStep), numbers + begin, std::min(kRowStep, count - begin));
    }
  }

  void findMeans(PointBatch points, const std::size_t* numbers, std::size_t count)
  {
    ScratchArray values(kRowStep);
    ScratchVectors slopes(kRowStep);
    const VectorBatch slope = slopes.batch();
    elements_.integrate(choice_.all(), points, rows_);
    rows_.findMeans(choice_.all(), choice_.centers(), field_.pieces.sights(),
      field_.pieces.shares(), false, values.data(), gradient_ ? &slope : nullptr);
    for (std::size_t k = 0; k < count; ++k)
    {
      value_[numbers[k]] = values[k];
      if (gradient_)
      {
        gradient_->set(numbers[k], slope[k]);
      }
    }
  }

  double leastSight(const PieceWeight* sights, std::size_t size, PointBatch points)
  {
    pieces_.clear();
    for (std::size_t k = 0; k < size; ++k)
    {
      pieces_.push_back(sights[k].piece);
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t begin = 0; begin < points.size; begin += kRowStep)
    {
      elements_.integrate({ pieces_.data(), size }, points.slice(begin, kRowStep), seen_);
      std::array<double, kRowStep> sum = {};
      for (std::size_t k = 0; k < size; ++k)
      {
        const double* field = seen_.field(sights[k].piece);
        for (std::size_t point = 0; point < kRowStep; ++point)
        {
          sum[point] += sights[k].weight * field[point];
        }
      }
      least = std::min(least, *std::min_element(sum.begin(), sum.end()));
    }
    return least;
  }

  const FarField& field_;
  FarElements elements_;
  FarChoice choice_;
  LimbRows seen_;
  LimbRows rows_;
  std::vector<std::uint32_t> pieces_;
  PointBatch points_;
  double* value_;
  const VectorBatch* gradient_;
};

} // namespace

void evaluateFarLimbs(
  const FarField& field, PointBatch points, double* value, const VectorBatch* gradient)
{
  FarEvaluation(field, points, value, gradient);
}

Interval farLimbRange(const FarField& field, const Box3& box)
{
  const Interval sum = field.whole.range(field.all, box);
  const FarElements elements(field);
  FarChoice choice(field.pieces);
  choice.choose(box,
    [&](const PieceWeight* sights, std::size_t size)
    {
      double least = 0.0;
      for (std::size_t k = 0; k < size; ++k)
      {
        least += sights[k].weight * field.whole.range(elements.of(sights[k].piece), box).min;
      }
      return least;
    });
  std::vector<Interval> fields(field.pieces.size());
  for (std::size_t k = 0; k < choice.all().count; ++k)
  {
    const std::uint32_t piece = choice.all().first[k];
    fields[piece] = field.whole.range(elements.of(piece), box);
  }
  const Interval mean = LimbRanges(fields, field.pieces.sights(), field.pieces.shares())
                          .mean(choice.centers().first, choice.centers().count);
  const double rounding = 1e-13 * (1.0 + sum.max);
  return { std::max(0.0, mean.min - rounding), std::min(sum.max, mean.max + rounding) };
}

} // namespace hybridtree
