// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/DerivedNodes.h"

#include <cstring>

namespace hybridtree
{

std::uint64_t DerivedNodes::Key::hash() const
{
  HashSum sum;
  for (const Dependency& dependency : from)
  {
    dependency.addTo(sum);
  }
  for (int k = 0; k < 12; ++k)
  {
    const double number = map.matrix()(k % 3, k / 3) + 0.0; // -0 equals 0
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    sum.add(bits);
  }
  return sum.value();
}

NodePtr DerivedNodes::of(
  std::vector<Dependency> from, const Affine3& map, const std::function<NodePtr()>& make)
{
  Key key{ std::move(from), map };
  std::shared_ptr<const Slot> slot = slots_.find(key);
  if (!slot)
  {
    slot = std::make_shared<const Slot>();
    const std::size_t bytes = sizeof(Slot) + sizeof(Key) + key.from.size() * sizeof(Dependency);
    slots_.keep(std::move(key), slot, bytes);
  }
  const std::lock_guard<std::mutex> lock(slot->mutex);
  NodePtr node = slot->node.lock();
  if (!node)
  {
    node = make();
    slot->node = node;
  }
  return node;
}

} // namespace hybridtree
