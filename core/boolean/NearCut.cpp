// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/NearCut.h"

#include "core/boolean/LocalPart.h"
#include "core/mesh/MeshLinks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr int kRounds = 6;
constexpr double kTurn = 0.3;  // cosine of how far a triangle may turn from its surface
constexpr double kShort = 0.3; // of the longest side: small triangles are to stay where all are
constexpr double kReach = 4.0; // edges up to here, in distances, are collapsed at flat triangles

} // namespace

class NearCut::Worker
{
public:
  using Index = MeshLinks::Index;

  Worker(NearCut& owner, const LocalPart& part)
    : owner_(owner), part_(part), links_(part.triangles, part.pointOf.size())
  {
  }

  void run()
  {
    bool changed = true;
    for (int round = 0; round < kRounds && changed; ++round)
    {
      changed = false;
      for (std::size_t t = 0; t < links_.triangleCount(); ++t)
      {
        changed = this->mend(t) || changed;
      }
    }
    part_.write(links_, owner_.triangles_);
  }

private:
  const Vec3& at(Index point) const { return owner_.points_[std::size_t(this->global(point))]; }
  std::int32_t global(Index point) const { return part_.pointOf[std::size_t(point)]; }
  bool isCut(Index point) const { return owner_.isCut_(this->global(point)); }
  double length(Index h) const
  {
    return (this->at(links_.to(h)) - this->at(links_.from(h))).norm();
  }
  std::int8_t operandOf(Index h) const
  {
    return owner_.operand_[std::size_t(owner_.place_[std::size_t(h / 3)])];
  }

  bool isCurve(Index h) const
  {
    const Index g = links_.twin(h);
    return g != MeshLinks::kNone && this->operandOf(h) != this->operandOf(g);
  }

  bool mend(std::size_t t)
  {
    if (links_.isRemoved(t))
    {
      return false;
    }
    const Triangle& c = links_.triangle(t);
    if (!this->isCut(c[0]) && !this->isCut(c[1]) && !this->isCut(c[2]))
    {
      return false;
    }
    Index longest = 3 * Index(t);
    for (Index h = longest + 1; h < 3 * Index(t) + 3; ++h)
    {
      longest = this->length(h) > this->length(longest) ? h : longest;
    }
    const double near = std::min(owner_.distance_, kShort * this->length(longest));
    for (Index h = 3 * Index(t); h < 3 * Index(t) + 3; ++h)
    {
      if (this->length(h) < near && (this->collapse(h) || this->collapse(links_.twin(h))))
      {
        return true;
      }
    }
    return (this->height(c) < 0.5 * near || !this->agrees(Index(t), c)) && this->flatten(longest);
  }

  Vec3 normal(const Triangle& c) const
  {
    return (this->at(c[1]) - this->at(c[0])).cross(this->at(c[2]) - this->at(c[0]));
  }

  double height(const Triangle& c) const
  {
    const double base = std::max({ (this->at(c[1]) - this->at(c[0])).norm(),
      (this->at(c[2]) - this->at(c[1])).norm(), (this->at(c[0]) - this->at(c[2])).norm() });
    return base > 0.0 ? this->normal(c).norm() / base : 0.0;
  }

  // Whether corners face as the surface that triangle t is a part of.
  bool agrees(Index t, const Triangle& corners) const
  {
    const Vec3& expected = owner_.normals_[std::size_t(owner_.place_[std::size_t(t)])];
    const Vec3 normal = this->normal(corners);
    return normal.dot(expected) > kTurn * normal.norm() * expected.norm();
  }

  // A flat triangle over a long side: the apex goes into the nearer end, or the side is flipped.
  bool flatten(Index longest)
  {
    if (!this->isCurve(longest) && this->flip(longest))
    {
      return true;
    }
    Index to = MeshLinks::next(longest);
    Index from = MeshLinks::previous(longest);
    if (this->length(to) > this->length(from))
    {
      std::swap(to, from);
    }
    for (const Index h : { to, from })
    {
      if (this->length(h) < kReach * owner_.distance_ &&
        (this->collapse(h) || this->collapse(links_.twin(h))))
      {
        return true;
      }
    }
    return false;
  }

  // Merges the start into the end, which is of the curve.
  bool collapse(Index h)
  {
    if (h == MeshLinks::kNone || !this->isCut(links_.to(h)) ||
      (this->isCut(links_.from(h)) && !this->isCurve(h)) || !links_.canCollapse(h) ||
      this->turnsAny(h))
    {
      return false;
    }
    owner_.merged_.push_back({ this->global(links_.from(h)), this->global(links_.to(h)) });
    links_.collapse(h);
    return true;
  }

  // Whether a triangle would face the other way that does not do so already.
  bool turnsAny(Index h) const
  {
    const Index from = links_.from(h);
    const Index to = links_.to(h);
    bool turned = false;
    links_.forEachLeaving(from,
      [&](Index leaving)
      {
        const Index p = links_.to(leaving);
        const Index q = links_.opposite(leaving);
        if (p != to && q != to)
        {
          turned = turned ||
            (!this->agrees(leaving / 3, { to, p, q }) && this->agrees(leaving / 3, { from, p, q }));
        }
      });
    return turned;
  }

  bool flip(Index h)
  {
    if (links_.twin(h) == MeshLinks::kNone || !links_.canFlip(h))
    {
      return false;
    }
    const Index g = links_.twin(h);
    const Index a = links_.from(h);
    const Index b = links_.to(h);
    const Index c = links_.opposite(h);
    const Index d = links_.opposite(g);
    const Triangle one = { d, b, c };
    const Triangle two = { c, a, d };
    if (!this->agrees(g / 3, one) || !this->agrees(g / 3, two) ||
      (this->agrees(h / 3, { a, b, c }) && this->agrees(g / 3, { b, a, d }) &&
        std::min(this->height(one), this->height(two)) <=
          1.1 * std::min(this->height({ a, b, c }), this->height({ b, a, d }))))
    {
      return false;
    }
    owner_.place_[std::size_t(h / 3)] = owner_.place_[std::size_t(g / 3)];
    links_.flip(h);
    return true;
  }

  NearCut& owner_;
  const LocalPart& part_;
  MeshLinks links_;
};

NearCut::NearCut(const std::vector<Vec3>& points, std::vector<Triangle> triangles,
  std::vector<std::int8_t> operand, std::vector<Vec3> normals,
  std::function<bool(std::int32_t)> isCut, double distance)
  : points_(points)
  , triangles_(std::move(triangles))
  , operand_(std::move(operand))
  , normals_(std::move(normals))
  , isCut_(std::move(isCut))
  , distance_(distance)
  , place_(triangles_.size())
{
  std::iota(place_.begin(), place_.end(), 0);
}

void NearCut::run()
{
  const LocalPart part(triangles_);
  Worker(*this, part).run();
}

} // namespace hybridtree
