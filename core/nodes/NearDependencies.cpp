// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/NearDependencies.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace hybridtree
{
namespace
{

using Marker = std::shared_ptr<const int>;

/// Told apart from nodes, and from one another, by being other objects.
struct Markers
{
  Marker law = std::make_shared<const int>(0);
  Marker again = std::make_shared<const int>(1);
  Marker number = std::make_shared<const int>(2);
};

const Markers& markers()
{
  static const auto* const instance = new Markers; // outlives all statics
  return *instance;
}

} // namespace

NearDependencies::NearDependencies(std::vector<Box3> boxes, Leaves leaves)
  : boxes_(std::move(boxes)), leaves_(leaves)
{
  for (const Box3& box : boxes_)
  {
    whole_.extend(box);
  }
}

bool NearDependencies::reaches(const Box3& influence) const
{
  return whole_.intersects(influence) &&
    std::any_of(
      boxes_.begin(), boxes_.end(), [&](const Box3& box) { return box.intersects(influence); });
}

void NearDependencies::addNumber(double number, std::int64_t index)
{
  found_.emplace_back(markers().number, number, index);
}

void NearDependencies::add(const Node& node, std::int32_t firstLeaf, double count, Leaves leaves)
{
  const auto* const op = dynamic_cast<const Operator*>(&node);
  const std::optional<PointwiseLaw> law = op ? op->pointwiseLaw() : std::nullopt;
  const std::int32_t leaf = leaves == Leaves::Numbered ? firstLeaf : 0;
  if (!law)
  {
    found_.emplace_back(node.shared_from_this(), count, leaf);
    faceted_ = faceted_ || node.isFaceted();
    return;
  }
  auto& places = leaves == Leaves::Numbered ? numberedPlaces_ : namelessPlaces_;
  const auto [place, isNew] = places.emplace(&node, static_cast<std::int64_t>(found_.size()));
  if (isNew)
  {
    this->addOperands(*op, *law, firstLeaf, count, leaves);
    return;
  }
  // What is below has been told; there may be exponentially many ways down to it.
  found_.emplace_back(markers().again, count, place->second);
  this->addNumber(0.0, leaf);
}

void NearDependencies::addOperands(const Operator& node, const PointwiseLaw& law,
  std::int32_t firstLeaf, double count, Leaves leaves)
{
  const std::size_t here = found_.size();
  found_.emplace_back(markers().law, 0.0, 0);
  std::int64_t which = 0;
  int place = 0;
  node.visitOperands(whole_,
    [&](const Operand& operand)
    {
      if (this->reaches(operand.node->influenceBounds()))
      {
        // Of a sum it suffices how many there are: the rest adds nothing, wherever it stands.
        which += law.isSum ? 1 : std::int64_t(1) << place;
        this->add(*operand.node, firstLeaf + operand.firstLeaf, operand.count,
          operand.hasSources ? leaves : Leaves::Nameless);
      }
      ++place;
    });
  found_[here] = Dependency(markers().law, count, (std::int64_t(law.number) << 32) + which);
}

} // namespace hybridtree
