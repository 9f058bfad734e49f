// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/RingPlan.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

// Of strips, per size of their triangles: equilateral ones, and those between unlike rings, whose
// diagonals are longer.
constexpr double kRegularGap = 0.86602540378443865;
constexpr double kGap = 0.8;
constexpr double kIrregularScale = 0.78;
// Sizes go down to this share of the edge length, and change by this much along the meridian.
constexpr double kLeastSize = 0.125;
constexpr double kGrading = 0.7;
// Normals that differ by less (2 degrees) make no crease; those by more than this keep a ring of
// their own however close to the next (40 degrees).
constexpr double kCrease = 0.035;
constexpr double kStrongTurn = 0.7;
// The normal turns by no more along one strip (half a right angle, and a little).
constexpr double kMostTurn = 0.8;

// Least even number of points, 6 at least, whose chords are no longer than `size`.
int countAround(double radial, double size)
{
  if (size >= radial)
  {
    return 6;
  }
  return std::max(6, 2 * static_cast<int>(std::ceil(0.5 * kPi / std::asin(0.5 * size / radial))));
}

Ring mirrored(Ring ring)
{
  ring.place.position.y() *= -1.0;
  ring.place.normal.y() *= -1.0;
  return ring;
}

} // namespace

RingPlan::RingPlan(const Meridian& meridian, double edgeLength)
  : meridian_(meridian)
  , edgeLength_(edgeLength)
  , end_(meridian.symmetric() ? 0.5 * meridian.length() : meridian.length())
{
  this->findStations();
  this->findSizes();
  this->findStretches();
}

std::vector<Ring> RingPlan::rings()
{
  do
  {
    this->placeRings();
    this->chooseCounts();
  } while (this->shrinkWhereTooLong());
  this->mirror();
  return std::move(rings_);
}

void RingPlan::findStations()
{
  const std::vector<Meridian::Piece>& pieces = meridian_.pieces();
  const double gap = kGap * edgeLength_;
  const auto tight = [&](const Meridian::Piece& piece) { return piece.turn * gap > piece.length; };
  const auto tiny = [&](const Meridian::Piece& piece) { return piece.length < 0.5 * gap; };
  // Straight along the axis: all its rings alike.
  const auto tube = [&](const Meridian::Piece& piece)
  {
    return piece.length > 2.0 * gap && piece.turn == 0.0 &&
      std::abs(piece.at(0.0).normal.y()) < 1e-9;
  };
  const auto distinct = [&](const Meridian::Piece& piece)
  { return tube(piece) || (tight(piece) && !tiny(piece)); };

  stations_ = { { 0.0, 0.0 } };
  double turned = 0.0;
  for (std::size_t k = 0; k < pieces.size() && pieces[k].start < end_ * (1.0 - 1e-12); ++k)
  {
    const Meridian::Piece& piece = pieces[k];
    if (k > 0)
    {
      const Meridian::Piece& before = pieces[k - 1];
      const double crease = angleBetween(before.at(before.length).normal, piece.at(0.0).normal);
      turned += crease;
      this->offerStation(
        piece.start, crease > kCrease || distinct(before) || distinct(piece), turned);
    }
    // A tight bend too short for rings at its ends has one in its middle.
    const double middle = piece.start + 0.5 * piece.length;
    const bool whole = middle < end_;
    turned += whole ? 0.5 * piece.turn : 0.0;
    this->offerStation(middle, whole && tight(piece) && tiny(piece), turned);
    turned += piece.start + piece.length > end_ * (1.0 + 1e-12) ? 0.0 : 0.5 * piece.turn;
  }
  this->settleLastStation(turned);
}

void RingPlan::offerStation(double s, bool wanted, double& turned)
{
  const bool apart = s - stations_.back().s >= 0.5 * kGap * edgeLength_;
  if (wanted && (apart || turned >= kStrongTurn))
  {
    stations_.push_back({ s, turned });
    turned = 0.0;
  }
}

// The end is a station; what is too close before it is not, unless the surface turns there. The
// middle of a symmetric meridian needs no ring where one strip reaches across, if it turns by no
// more than a right angle.
void RingPlan::settleLastStation(double turned)
{
  const double gap = kGap * edgeLength_;
  if (meridian_.symmetric() && stations_.size() > 1 && 2.0 * (end_ - stations_.back().s) < gap &&
    turned < kMostTurn)
  {
    middleRing_ = false;
    end_ = stations_.back().s;
    return;
  }
  while (stations_.size() > 1 && end_ - stations_.back().s < 0.5 * gap &&
    stations_.back().turn + turned < kStrongTurn)
  {
    turned += stations_.back().turn;
    stations_.pop_back();
  }
  stations_.push_back({ end_, turned });
}

void RingPlan::findSizes()
{
  const double wanted = std::ceil(8.0 * end_ / edgeLength_);
  const std::size_t steps = static_cast<std::size_t>(std::clamp(wanted, 64.0, 1e6));
  step_ = end_ / static_cast<double>(steps);
  for (std::size_t k = 0; k <= steps; ++k)
  {
    radial_.push_back(meridian_.at(std::min(end_, step_ * static_cast<double>(k))).position.x());
  }
  size_.assign(steps + 1, edgeLength_);
  this->limitByRadius();
  this->limitByStations();
  this->grade();
  cells_.assign(1, 0.0);
  for (std::size_t k = 0; k < steps; ++k)
  {
    cells_.push_back(cells_[k] + 0.5 * step_ * (1.0 / size_[k] + 1.0 / size_[k + 1]));
  }
}

// No needles along a thin tube: six points around it are its radius apart. On the way to the axis
// the radius vanishes without the surface being thin, so the largest around counts.
void RingPlan::limitByRadius()
{
  const std::size_t reach = static_cast<std::size_t>(std::min(1e6, std::ceil(edgeLength_ / step_)));
  const std::size_t count = radial_.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    if (2.0 * radial_[k] >= edgeLength_)
    {
      continue;
    }
    const std::size_t from = k > reach ? k - reach : 0;
    const std::size_t to = std::min(count, k + reach + 1);
    const double most = *std::max_element(radial_.begin() + static_cast<std::ptrdiff_t>(from),
      radial_.begin() + static_cast<std::ptrdiff_t>(to));
    size_[k] = std::min(size_[k], std::max(2.0 * most, kLeastSize * edgeLength_));
  }
}

// Nor along a narrow band between two stations.
void RingPlan::limitByStations()
{
  const auto limit = [&](double begin, double end, double width)
  {
    const double size = std::max(2.0 * width, kLeastSize * edgeLength_);
    for (std::size_t k = this->sampleBelow(begin);
         k < size_.size() && step_ * static_cast<double>(k) < end + step_; ++k)
    {
      size_[k] = std::min(size_[k], size);
    }
  };
  for (std::size_t k = 0; k + 1 < stations_.size(); ++k)
  {
    const double begin = stations_[k].s;
    const double end = stations_[k + 1].s;
    limit(begin, end, (end - begin) / this->leastStrips(begin, end));
  }
  if (!middleRing_)
  {
    limit(end_, end_, meridian_.length() - 2.0 * end_);
  }
}

// By the turn of the normal.
int RingPlan::leastStrips(double begin, double end) const
{
  double turn = 0.0;
  for (const Meridian::Piece& piece : meridian_.pieces())
  {
    const double from = std::max(begin, piece.start);
    const double to = std::min(end, piece.start + piece.length);
    turn += to > from ? piece.turn * (to - from) / piece.length : 0.0;
  }
  return std::max(1, static_cast<int>(std::ceil(turn / kMostTurn)));
}

void RingPlan::grade()
{
  const std::size_t count = size_.size();
  const double rise = kGrading * step_;
  const bool around = meridian_.loop() && !meridian_.symmetric();
  for (int round = 0; round < (around ? 2 : 1); ++round)
  {
    for (std::size_t k = 1; k < count; ++k)
    {
      size_[k] = std::min(size_[k], size_[k - 1] + rise);
    }
    for (std::size_t k = count - 1; k > 0; --k)
    {
      size_[k - 1] = std::min(size_[k - 1], size_[k] + rise);
    }
    if (around)
    {
      size_.front() = size_.back() = std::min(size_.front(), size_.back());
    }
  }
}

void RingPlan::findStretches()
{
  const bool all = this->variesLittle(0.0, end_);
  for (std::size_t k = 0; k + 1 < stations_.size(); ++k)
  {
    const double begin = stations_[k].s;
    const double end = stations_[k + 1].s;
    const bool regular = all || this->variesLittle(begin, end);
    stretches_.push_back({ begin, end, regular, this->leastStrips(begin, end),
      regular ? 1.0 : kIrregularScale, 0, 0 });
  }
}

std::size_t RingPlan::sampleBelow(double s) const
{
  const double last = static_cast<double>(radial_.size() - 2);
  return static_cast<std::size_t>(std::clamp(std::floor(s / step_), 0.0, last));
}

// How many points rings want. The same for all then is a little more than needed for most.
bool RingPlan::variesLittle(double begin, double end) const
{
  const auto wanted = [&](double s) { return meridian_.at(s).position.x() / this->sizeAt(s); };
  double least = std::min(wanted(begin), wanted(end));
  double most = std::max(wanted(begin), wanted(end));
  for (std::size_t k = this->sampleBelow(begin) + 1;
       k < radial_.size() && step_ * static_cast<double>(k) < end; ++k)
  {
    least = std::min(least, radial_[k] / size_[k]);
    most = std::max(most, radial_[k] / size_[k]);
  }
  return least >= (0.6 - 1e-9) * most; // the same for similar shapes, which are rounded
}

double RingPlan::sizeAt(double s) const
{
  const std::size_t k = this->sampleBelow(s);
  const double part = s / step_ - static_cast<double>(k);
  return size_[k] + part * (size_[k + 1] - size_[k]);
}

double RingPlan::cellsBefore(double s) const
{
  const std::size_t k = this->sampleBelow(s);
  const double part = s / step_ - static_cast<double>(k);
  return cells_[k] + part * (cells_[k + 1] - cells_[k]);
}

double RingPlan::afterCells(double cells) const
{
  const auto above = std::upper_bound(cells_.begin() + 1, cells_.end() - 1, cells);
  const std::size_t k = static_cast<std::size_t>(above - cells_.begin()) - 1;
  return step_ * (static_cast<double>(k) + (cells - cells_[k]) / (cells_[k + 1] - cells_[k]));
}

int RingPlan::stripsOf(const Stretch& stretch) const
{
  const double cells = this->cellsBefore(stretch.end) - this->cellsBefore(stretch.begin);
  const double gap = stretch.scale * (stretch.regular ? kRegularGap : kGap);
  const int strips = std::max(1, static_cast<int>(std::ceil(cells / gap - 1e-9)));
  // Around a loop at least four rings; from pole to pole one between.
  const int stretches = static_cast<int>(stretches_.size());
  const int around = meridian_.symmetric() ? 2 : 4;
  const int least = meridian_.loop()                          ? (around + stretches - 1) / stretches
    : middleRing_ && stretches == 1 && !meridian_.symmetric() ? 2
                                                              : 1;
  return std::max({ strips, least, stretch.leastStrips });
}

void RingPlan::placeRings()
{
  rings_.clear();
  along_.clear();
  const bool around = meridian_.loop() && !meridian_.symmetric();
  int total = 0;
  for (Stretch& stretch : stretches_)
  {
    int strips = this->stripsOf(stretch);
    // An even number, so that shifts alternate across the seam.
    const bool odd = around && &stretch == &stretches_.back() && (total + strips) % 2 != 0;
    strips += odd ? 1 : 0;
    total += strips;
    this->placeStretch(stretch, strips);
  }
  if (!around)
  {
    along_.push_back(end_);
    rings_.push_back({ meridian_.at(end_), 0, total % 2 });
  }
}

void RingPlan::placeStretch(Stretch& stretch, int strips)
{
  stretch.firstRing = rings_.size();
  const double before = this->cellsBefore(stretch.begin);
  const double cells = this->cellsBefore(stretch.end) - before;
  for (int k = 0; k < strips; ++k)
  {
    const double s = k == 0 ? stretch.begin : this->afterCells(before + cells * k / strips);
    along_.push_back(s);
    rings_.push_back({ meridian_.at(s), 0, static_cast<int>(rings_.size() % 2) });
  }
  stretch.lastRing = rings_.size(); // the first one of the next stretch
}

void RingPlan::chooseCounts()
{
  const std::size_t count = rings_.size();
  for (const Stretch& stretch : stretches_)
  {
    for (std::size_t k = stretch.firstRing; k <= stretch.lastRing; ++k)
    {
      Ring& ring = rings_[k % count];
      const double size = stretch.scale * this->sizeAt(k < count ? along_[k] : end_);
      ring.count = std::max(ring.count, countAround(ring.place.position.x(), size));
    }
  }
  for (const Stretch& stretch : stretches_)
  {
    int most = 0;
    for (std::size_t k = stretch.firstRing; k <= stretch.lastRing; ++k)
    {
      most = std::max(most, rings_[k % count].count);
    }
    for (std::size_t k = stretch.firstRing; stretch.regular && k <= stretch.lastRing; ++k)
    {
      rings_[k % count].count = most;
    }
  }
  if (!meridian_.loop())
  {
    rings_.front().count = 1;
    this->spareFan(rings_.front(), stretches_.front(), 1);
    if (!meridian_.symmetric())
    {
      rings_.back().count = 1;
      this->spareFan(rings_.back(), stretches_.back(), count - 2);
    }
  }
}

// Around the apex of a cone fewer points give better angles than six.
void RingPlan::spareFan(const Ring& pole, const Stretch& stretch, std::size_t first)
{
  if (first > stretch.firstRing && first < stretch.lastRing)
  {
    const Vec2 across = rings_[first].place.position - pole.place.position;
    const double sixths = 6.0 * across.x() / across.norm();
    const int fewest = std::max(4, 2 * static_cast<int>(std::ceil(0.5 * sixths - 1e-9)));
    rings_[first].count = std::min(rings_[first].count, fewest);
  }
}

bool RingPlan::shrinkWhereTooLong()
{
  bool any = false;
  for (Stretch& stretch : stretches_)
  {
    double longest = 0.0;
    for (std::size_t k = stretch.firstRing; k < stretch.lastRing; ++k)
    {
      longest = std::max(longest, longestAcross(rings_[k], rings_[(k + 1) % rings_.size()]));
    }
    if (!middleRing_ && &stretch == &stretches_.back())
    {
      longest = std::max(longest, longestAcross(rings_.back(), mirrored(rings_.back())));
    }
    if (longest > edgeLength_ * (1.0 + 1e-13))
    {
      any = true;
      stretch.scale *= std::clamp(edgeLength_ / longest, 0.7, 0.98);
    }
  }
  return any;
}

void RingPlan::mirror()
{
  if (!meridian_.symmetric())
  {
    return;
  }
  // Back to the start, which a loop does not repeat, without the middle if that is a ring.
  const std::size_t half = rings_.size();
  const std::size_t stop = meridian_.loop() ? 1 : 0;
  for (std::size_t k = middleRing_ ? half - 1 : half; k-- > stop;)
  {
    rings_.push_back(mirrored(rings_[k]));
  }
}

} // namespace hybridtree
