// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/PerturbedPredicates.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr double kEpsilon = 0x1p-53;
constexpr double kFilter = 40.0 * kEpsilon; // of a sum of at most 12 determinants
constexpr double kSteep = 0x1p-10;          // of volumes, beside the products that make them
constexpr int kOrders = 4;                  // powers of e in one vertex: 0 to 3
constexpr int kDegree = 3 * (kOrders - 1);

// Three odd integers below 2^20 in size: never in an axis-parallel plane.
Vec3 randomVector(std::uint64_t seed, std::int32_t index, bool second)
{
  std::uint64_t state = seed + 2 * std::uint64_t(std::uint32_t(index)) + (second ? 1 : 0);
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis)
  {
    state += 0x9e3779b97f4a7c15ull; // splitmix64
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    z ^= z >> 31;
    const double size = double((z & 0xfffff) | 1);
    result[axis] = (z >> 63) != 0 ? -size : size;
  }
  return result;
}

struct Rounded
{
  double value = 0.0;
  double size = 0.0; // of the products that make the value

  bool isCertain() const { return std::abs(value) > kFilter * size; }
};

void addDeterminant(const Vec3& a, const Vec3& b, const Vec3& c, Rounded& sum)
{
  for (int k = 0; k < 3; ++k)
  {
    const int l = (k + 1) % 3;
    const int m = (k + 2) % 3;
    const double left = b[l] * c[m];
    const double right = b[m] * c[l];
    sum.value += a[k] * (left - right);
    sum.size += std::abs(a[k]) * (std::abs(left) + std::abs(right));
  }
}

using ExactVector = std::array<Expansion, 3>;

Expansion determinant(const ExactVector& a, const ExactVector& b, const ExactVector& c)
{
  Expansion sum;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (!a[k].isZero())
    {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      sum += a[k] * (b[l] * c[m] - b[m] * c[l]);
    }
  }
  return sum;
}

} // namespace

// det(b - a, c - a, d - a) as a polynomial in e.
class PerturbedPredicates::Volume
{
public:
  Volume(const PerturbedPredicates& predicates, const Site& a, const Site& b, const Site& c,
    const Site& d)
    : predicates_(predicates), site_{ &a, &b, &c, &d }
  {
    // From a vertex of A, which is moved least.
    const auto base =
      std::find_if(site_.begin(), site_.end(), [](const Site* site) { return !site->second; });
    if (base != site_.begin())
    {
      std::swap(site_.front(), *base);
      sign_ = -1.0;
    }
    for (std::size_t row = 0; row < 3; ++row)
    {
      rows_[row][0] = site_[row + 1]->position - site_[0]->position;
    }
  }

  /// The coefficient of e^0.
  Rounded value() const
  {
    Rounded sum;
    addDeterminant(rows_[0][0], rows_[1][0], rows_[2][0], sum);
    sum.value *= sign_;
    return sum;
  }

  int sign()
  {
    const Rounded rough = this->value();
    if (rough.isCertain())
    {
      return rough.value > 0.0 ? 1 : -1;
    }
    for (int k = 0; k <= kDegree; ++k)
    {
      const int sign = this->signOf(k);
      if (sign != 0)
      {
        return sign;
      }
    }
    return 0;
  }

  /// Exactly.
  const Expansion& coefficient(int k)
  {
    if (!coefficients_)
    {
      coefficients_ = std::make_unique<Coefficients>();
    }
    std::optional<Expansion>& kept = (*coefficients_)[std::size_t(k)];
    if (!kept)
    {
      this->perturb(k);
      Expansion sum;
      this->forEachTerm(k,
        [&](int i, int j, int l)
        { sum += determinant(this->exactRow(0, i), this->exactRow(1, j), this->exactRow(2, l)); });
      kept = sign_ > 0.0 ? sum : Expansion() - sum;
    }
    return *kept;
  }

private:
  int signOf(int k)
  {
    this->perturb(k);
    Rounded sum;
    this->forEachTerm(k,
      [&](int i, int j, int l)
      {
        addDeterminant(
          rows_[0][std::size_t(i)], rows_[1][std::size_t(j)], rows_[2][std::size_t(l)], sum);
      });
    if (sum.size == 0.0)
    {
      return 0;
    }
    if (sum.isCertain())
    {
      return (sum.value > 0.0) == (sign_ > 0.0) ? 1 : -1;
    }
    return this->coefficient(k).sign();
  }

  // Makes the rows that the coefficient of e^k needs. Few need those of the random vectors.
  void perturb(int k)
  {
    if (!directed_)
    {
      directed_ = true;
      for (std::size_t row = 0; row < 3; ++row)
      {
        const Site& site = *site_[row + 1];
        second_[row] = site.second;
        rows_[row][1] =
          site.second && site.index >= 0 ? predicates_.direction_(site.index) : Vec3::Zero();
        same_[row] = site_[1 + row]->position == site_[1 + (row + 1) % 3]->position;
      }
    }
    if (k > 1 && !perturbed_)
    {
      perturbed_ = true;
      const Vec3 base = this->random(*site_[0]);
      for (std::size_t row = 0; row < 3; ++row)
      {
        const Site& site = *site_[row + 1];
        rows_[row][2] = site.second ? this->random(site) : Vec3::Zero();
        rows_[row][3] = site.second ? Vec3(-base) : Vec3(this->random(site) - base);
      }
    }
  }

  Vec3 random(const Site& site) const
  {
    return randomVector(predicates_.seed_, site.index, site.second);
  }

  // The products of e^i, e^j and e^l that make e^k, but for those that are zero at sight: two
  // vertices at the same place make two rows alike.
  template <class Visit>
  void forEachTerm(int k, Visit&& visit) const
  {
    const auto absent = [&](std::size_t row, int order)
    { return !second_[row] && (order == 1 || order == 2); };
    for (int i = 0; i <= std::min(k, kOrders - 1); ++i)
    {
      for (int j = 0; j <= std::min(k - i, kOrders - 1); ++j)
      {
        const int l = k - i - j;
        if (l >= kOrders || absent(0, i) || absent(1, j) || absent(2, l) ||
          (same_[0] && i == 0 && j == 0) || (same_[1] && j == 0 && l == 0) ||
          (same_[2] && l == 0 && i == 0))
        {
          continue;
        }
        visit(i, j, l);
      }
    }
  }

  ExactVector exactRow(std::size_t row, int order) const
  {
    const Vec3& rounded = rows_[row][std::size_t(order)];
    ExactVector exact;
    for (int axis = 0; axis < 3; ++axis)
    {
      exact[std::size_t(axis)] = order > 0
        ? Expansion(rounded[axis])
        : Expansion::difference(site_[row + 1]->position[axis], site_[0]->position[axis]);
    }
    return exact;
  }

  const PerturbedPredicates& predicates_;
  std::array<const Site*, 4> site_;
  double sign_ = 1.0;
  std::array<std::array<Vec3, kOrders>, 3> rows_; // per vertex but the first, per power of e
  std::array<bool, 3> second_{};
  std::array<bool, 3> same_{};
  bool directed_ = false;
  bool perturbed_ = false;
  using Coefficients = std::array<std::optional<Expansion>, kDegree + 1>;
  std::unique_ptr<Coefficients> coefficients_;
};

int PerturbedPredicates::side(const Site& a, const Site& b, const Site& c, const Site& d) const
{
  Rounded volume;
  addDeterminant(b.position - a.position, c.position - a.position, d.position - a.position, volume);
  if (volume.isCertain())
  {
    return volume.value > 0.0 ? 1 : -1;
  }
  return Volume(*this, a, b, c, d).sign();
}

// With P and Q the volumes over a triangle at p and at q, the parameter is P / (P - Q), and the
// sign of P - Q is that of P. So the first is less where P1 Q2 - P2 Q1 has the sign of P1 P2.
int PerturbedPredicates::order(const Site& p, const Site& q, const std::array<Site, 3>& first,
  const std::array<Site, 3>& second) const
{
  Volume p1(*this, first[0], first[1], first[2], p);
  Volume q1(*this, first[0], first[1], first[2], q);
  Volume p2(*this, second[0], second[1], second[2], p);
  Volume q2(*this, second[0], second[1], second[2], q);
  const int signs = p1.sign() * p2.sign();
  const Rounded a = p1.value();
  const Rounded b = q1.value();
  const Rounded c = p2.value();
  const Rounded d = q2.value();
  const double difference = a.value * d.value - c.value * b.value;
  const double error = 2.0 * kFilter * (a.size * d.size + c.size * b.size);
  if (std::abs(difference) > error)
  {
    return (difference > 0.0 ? -1 : 1) * signs;
  }
  for (int k = 0; k <= 2 * kDegree; ++k)
  {
    Expansion sum;
    for (int i = std::max(0, k - kDegree); i <= std::min(k, kDegree); ++i)
    {
      const int j = k - i;
      sum += p1.coefficient(i) * q2.coefficient(j) - p2.coefficient(i) * q1.coefficient(j);
    }
    if (!sum.isZero())
    {
      return -sum.sign() * signs;
    }
  }
  return 0;
}

double PerturbedPredicates::parameter(
  const Site& p, const Site& q, const std::array<Site, 3>& triangle) const
{
  Volume atP(*this, triangle[0], triangle[1], triangle[2], p);
  Volume atQ(*this, triangle[0], triangle[1], triangle[2], q);
  const Rounded roughP = atP.value();
  const Rounded roughQ = atQ.value();
  // Signs alone are not enough: along an edge nearly parallel to the triangle, an error far above
  // rounding would be made of them.
  const bool isSteep =
    std::abs(roughP.value - roughQ.value) > kSteep * std::max(roughP.size, roughQ.size);
  if (isSteep && roughP.isCertain() && roughQ.isCertain())
  {
    return roughP.value / (roughP.value - roughQ.value);
  }
  for (int k = 0; k <= kDegree; ++k)
  {
    const Expansion& exactP = atP.coefficient(k);
    const Expansion& exactQ = atQ.coefficient(k);
    if (exactP.isZero() && exactQ.isZero())
    {
      continue;
    }
    const double t = exactP.value() / (exactP - exactQ).value();
    return std::clamp(t, 0.0, 1.0);
  }
  return 0.5;
}

} // namespace hybridtree
