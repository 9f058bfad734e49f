// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/PlateFill.h"

#include "core/geometry/Predicates.h"
#include "core/mesh/AddTriangle.h"
#include "core/skeletons/PlateLattice.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

// Points of the lattice's border and so many layers behind it may move.
constexpr int kLayers = 2;
// Least distance of the lattice from the outline, in spacings: about half of what is left between
// rows and outline is more, half less than the height of a triangle.
constexpr double kMargin = 0.6;
constexpr int kRounds = 3;
constexpr int kRoundsAfter = 1;

bool turnsLeft(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return orientation2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y()) > 0;
}

// The triangles of the lattice that have all their corners. Around a point there are six, triangle
// k between its neighbours k and k + 1, neighbour 0 to the right.
class LatticeTriangles
{
public:
  explicit LatticeTriangles(const PlateLattice& lattice) : lattice_(lattice)
  {
    around_.assign(static_cast<std::size_t>(lattice.size()), 0);
    this->forEach(
      [this](std::int32_t a, std::int32_t b, std::int32_t c, bool upward)
      {
        around_[static_cast<std::size_t>(a)] |= upward ? 1 : 32;
        around_[static_cast<std::size_t>(b)] |= upward ? 4 : 2;
        around_[static_cast<std::size_t>(c)] |= upward ? 16 : 8;
      });
  }

  // visit(a, b, c, upward): counter-clockwise, first the left one of the two corners that are in
  // one row.
  template <class Visit>
  void forEach(const Visit& visit) const
  {
    const auto& runs = lattice_.runs();
    for (int y = -lattice_.rows(); y < lattice_.rows(); ++y)
    {
      for (int i = lattice_.firstOfRow(y); i < lattice_.firstOfRow(y + 1); ++i)
      {
        for (int j = lattice_.firstOfRow(y + 1); j < lattice_.firstOfRow(y + 2); ++j)
        {
          forEachBetween(
            runs[static_cast<std::size_t>(i)], runs[static_cast<std::size_t>(j)], visit);
        }
      }
    }
  }

  // Bit k: triangle k is there.
  int around(std::int32_t point) const { return around_[static_cast<std::size_t>(point)]; }

private:
  template <class Visit>
  static void forEachBetween(
    const PlateLattice::Run& low, const PlateLattice::Run& high, const Visit& visit)
  {
    for (int x = std::max(low.first, high.first - 1); x <= std::min(low.last - 2, high.last - 1);
         x += 2)
    {
      const std::int32_t a = low.number + (x - low.first) / 2;
      visit(a, a + 1, high.number + (x + 1 - high.first) / 2, true);
    }
    for (int x = std::max(high.first, low.first - 1); x <= std::min(high.last - 2, low.last - 1);
         x += 2)
    {
      const std::int32_t a = high.number + (x - high.first) / 2;
      visit(a, low.number + (x + 1 - low.first) / 2, a + 1, false);
    }
  }

  const PlateLattice& lattice_;
  std::vector<std::uint8_t> around_;
};

class OutlineFill
{
public:
  OutlineFill(const std::vector<Vec2>& corners, const std::vector<Vec2>& outline, double spacing)
    : outline_(outline)
    , spacing_(spacing)
    , lattice_(corners, spacing, kMargin * spacing)
    , triangles_(lattice_)
  {
    places_.reserve(static_cast<std::size_t>(lattice_.size()));
    for (const PlateLattice::Run& run : lattice_.runs())
    {
      for (int x = run.first; x <= run.last; x += 2)
      {
        places_.push_back({ x, run.y });
      }
    }
  }

  std::optional<PlateFace> make(double longest)
  {
    if (!this->findBorder())
    {
      return std::nullopt;
    }
    this->findLayers();
    this->numberStrip();
    if (!this->zip())
    {
      return std::nullopt;
    }
    this->addLayers();
    PlanarTriangulation strip(std::move(points_), std::move(fixed_), std::move(stripTriangles_));
    strip.smooth(kRounds);
    strip.splitLongEdges(longest);
    strip.smooth(kRoundsAfter);
    strip.splitLongEdges(longest); // what that made long again
    return this->join(strip);
  }

private:
  struct Place
  {
    int x, y;
  };

  Vec2 at(std::int32_t point) const
  {
    const Place& place = places_[static_cast<std::size_t>(point)];
    return lattice_.place(place.x, place.y);
  }

  std::int32_t neighbour(std::int32_t point, int k) const
  {
    constexpr int kX[6] = { 2, 1, -1, -2, -1, 1 };
    constexpr int kY[6] = { 0, 1, 1, 0, -1, -1 };
    const Place& place = places_[static_cast<std::size_t>(point)];
    return lattice_.numberAt(place.x + kX[k], place.y + kY[k]);
  }

  // Where the triangles around a point begin: the only k whose triangle is there while the one
  // before it is not. -1 unless there is one such.
  int firstAround(std::int32_t point) const
  {
    const int here = triangles_.around(point);
    const int begins = here & ~((here << 1 | here >> 5) & 63);
    for (int k = 0; k < 6; ++k)
    {
      if (begins == 1 << k)
      {
        return k;
      }
    }
    return -1;
  }

  // The one loop around all triangles, counter-clockwise. False when there are more.
  bool findBorder()
  {
    std::size_t count = 0;
    std::int32_t start = -1;
    for (std::int32_t point = 0; point < lattice_.size(); ++point)
    {
      const int around = triangles_.around(point);
      if (around != 0 && around != 63)
      {
        if (this->firstAround(point) < 0)
        {
          return false;
        }
        ++count;
        start = point;
      }
    }
    if (start < 0)
    {
      return false;
    }
    std::int32_t point = start;
    do
    {
      border_.push_back(point);
      point = this->neighbour(point, this->firstAround(point));
    } while (point != start);
    return border_.size() == count;
  }

  // How many edges a point is from the border, up to kLayers.
  void findLayers()
  {
    layer_.assign(static_cast<std::size_t>(lattice_.size()), kLayers + 1);
    std::vector<std::int32_t> here = border_;
    for (const std::int32_t point : here)
    {
      layer_[static_cast<std::size_t>(point)] = 0;
    }
    inStrip_ = border_;
    for (int layer = 1; layer <= kLayers; ++layer)
    {
      std::vector<std::int32_t> next;
      for (const std::int32_t point : here)
      {
        for (int k = 0; k < 6; ++k)
        {
          const std::int32_t other = this->neighbour(point, k);
          if (other >= 0 && triangles_.around(other) != 0 &&
            layer_[static_cast<std::size_t>(other)] > layer)
          {
            layer_[static_cast<std::size_t>(other)] = static_cast<std::uint8_t>(layer);
            next.push_back(other);
          }
        }
      }
      inStrip_.insert(inStrip_.end(), next.begin(), next.end());
      here = std::move(next);
    }
  }

  // First the outline, then the border, then the layers behind it.
  void numberStrip()
  {
    points_ = outline_;
    fixed_.assign(outline_.size(), 1);
    number_.assign(static_cast<std::size_t>(lattice_.size()), -1);
    for (const std::int32_t point : inStrip_)
    {
      number_[static_cast<std::size_t>(point)] = static_cast<std::int32_t>(points_.size());
      points_.push_back(this->at(point));
      fixed_.push_back(layer_[static_cast<std::size_t>(point)] == kLayers);
    }
  }

  // Triangles between the outline and the border, where the next edge across is the shorter one.
  // False when one would turn over: the strip is no strip there.
  bool zip()
  {
    const int n = static_cast<int>(outline_.size());
    const int m = static_cast<int>(border_.size());
    int first = 0;
    for (int k = 1; k < m; ++k)
    {
      if ((points_[n + k] - points_[0]).squaredNorm() <
        (points_[n + first] - points_[0]).squaredNorm())
      {
        first = k;
      }
    }
    int i = 0;
    int j = 0;
    while (i < n || j < m)
    {
      const int p = i % n;
      const int q = n + (first + j) % m;
      const int nextP = (i + 1) % n;
      const int nextQ = n + (first + j + 1) % m;
      const bool mayP = i < n && turnsLeft(points_[p], points_[nextP], points_[q]);
      const bool mayQ = j < m && turnsLeft(points_[nextQ], points_[q], points_[p]);
      if (!mayP && !mayQ)
      {
        return false;
      }
      const bool isP = mayP &&
        (!mayQ ||
          (points_[nextP] - points_[q]).squaredNorm() <=
            (points_[p] - points_[nextQ]).squaredNorm());
      stripTriangles_.push_back(isP ? Triangle{ p, nextP, q } : Triangle{ nextQ, q, p });
      ++(isP ? i : j);
    }
    return true;
  }

  void addLayers()
  {
    triangles_.forEach(
      [this](std::int32_t a, std::int32_t b, std::int32_t c, bool)
      {
        const auto layer = [&](std::int32_t point)
        { return layer_[static_cast<std::size_t>(point)]; };
        if (std::min({ layer(a), layer(b), layer(c) }) < kLayers)
        {
          const auto id = [&](std::int32_t point)
          { return number_[static_cast<std::size_t>(point)]; };
          stripTriangles_.push_back({ id(a), id(b), id(c) });
        }
        else
        {
          addTriangle(inner_, a, b, c);
        }
      });
  }

  PlateFace join(const PlanarTriangulation& strip)
  {
    PlateFace face;
    face.points = strip.points();
    face.triangles = strip.triangles();
    face.longest = std::max(strip.longestEdge(), inner_.empty() ? 0.0 : spacing_);
    face.points.reserve(face.points.size() + static_cast<std::size_t>(lattice_.size()));
    face.triangles.reserve(face.triangles.size() + inner_.size());
    for (std::int32_t point = 0; point < lattice_.size(); ++point)
    {
      if (number_[static_cast<std::size_t>(point)] < 0 && triangles_.around(point) != 0)
      {
        number_[static_cast<std::size_t>(point)] = static_cast<std::int32_t>(face.points.size());
        face.points.push_back(this->at(point));
      }
    }
    for (const auto& [a, b, c] : inner_)
    {
      addTriangle(face.triangles, number_[static_cast<std::size_t>(a)],
        number_[static_cast<std::size_t>(b)], number_[static_cast<std::size_t>(c)]);
    }
    return face;
  }

  const std::vector<Vec2>& outline_;
  double spacing_;
  PlateLattice lattice_;
  LatticeTriangles triangles_;
  std::vector<Place> places_;        // of the lattice's points
  std::vector<std::int32_t> border_; // of the lattice's triangles, in order
  std::vector<std::uint8_t> layer_;
  std::vector<std::int32_t> inStrip_; // points of the lattice
  std::vector<std::int32_t> number_;  // of the lattice's points in the face; -1 for none
  std::vector<Vec2> points_;          // of the strip
  std::vector<char> fixed_;
  std::vector<Triangle> stripTriangles_;
  std::vector<Triangle> inner_; // the others, of the lattice's points
};

} // namespace

std::optional<PlateFace> fillOutline(const std::vector<Vec2>& corners,
  const std::vector<Vec2>& outline, double spacing, double longest)
{
  return OutlineFill(corners, outline, spacing).make(longest);
}

} // namespace hybridtree
