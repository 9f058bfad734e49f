// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/MemoryBudget.h"

#include "core/base/Error.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace hybridtree
{

void MemoryBudget::check(double bytes, double cells) const
{
  const auto limit = static_cast<double>(maxBytes);
  if (bytes <= limit)
  {
    return;
  }
  const double mib = std::ldexp(1.0, 20);
  std::ostringstream text;
  text << std::setprecision(3) << "An edge length of " << cellSize << " takes some " << cells
       << " cells along the surface and " << bytes / mib << " MiB of memory; the limit is "
       << limit / mib << " MiB. Use an edge length of " << 1.1 * cellSize * std::sqrt(bytes / limit)
       << " or more.";
  throw TooLarge(text.str());
}

} // namespace hybridtree
