// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/OperandCache.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace hybridtree
{
namespace
{

constexpr std::size_t kKept = 8;

struct Kept
{
  std::weak_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const MeshOperand> operand;
};

} // namespace

std::shared_ptr<const MeshOperand> meshOperand(const MeshPtr& mesh)
{
  static std::mutex mutex;
  static std::vector<Kept> kept; // the last asked for at the end
  {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = std::find_if(kept.begin(), kept.end(),
      [&](const Kept& entry) { return entry.operand->original() == mesh; });
    if (found != kept.end())
    {
      std::rotate(found, found + 1, kept.end());
      return kept.back().operand;
    }
  }
  auto operand = std::make_shared<const MeshOperand>(mesh);
  const std::lock_guard<std::mutex> lock(mutex);
  // Operands hold their mesh once or twice: who holds no more than that is alone.
  kept.erase(std::remove_if(kept.begin(), kept.end(),
               [](const Kept& entry)
               {
                 const long own = entry.operand->addedTriangles() > 0 ? 1 : 2;
                 return entry.operand.use_count() == 1 && entry.mesh.use_count() <= own;
               }),
    kept.end());
  if (kept.size() == kKept)
  {
    kept.erase(kept.begin());
  }
  kept.push_back({ mesh, operand });
  return operand;
}

} // namespace hybridtree
