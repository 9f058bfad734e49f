// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace hybridtree
{

/// Calls body(k) for each k in [0, sizes.size()), in parallel. Tasks of very different sizes begin
/// with the largest, so that no thread waits long for a large one that another began last.
/// \param sizes in any unit. An exception in a body stops the loop and comes out.
void forLargestFirst(
  const std::vector<std::size_t>& sizes, const std::function<void(std::size_t)>& body);

} // namespace hybridtree
