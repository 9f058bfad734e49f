// SPDX-License-Identifier: BSD-3-Clause
// Private: what the processes of a parallel server have to agree on. Every function here is to be
// called by all of them, and does nothing where there is one only.
#ifndef vtkHybridTreeProcesses_h
#define vtkHybridTreeProcesses_h

#include "HybridTreeFiltersModule.h" // for export macro
#include "vtkHybridTreeBlocks.h"

#include <functional>
#include <vector>

class vtkAlgorithm;

namespace hybridtree
{

/// Gathers every block of which processes have different parts, so that each has the whole.
void joinProcesses(std::vector<Block>& blocks);

/// What RequestData() of a filter is to return: 1 once `work` has come to its end or the user has
/// stopped it, 0 when it has thrown on any process. The filter tells the error, and `clear` empties
/// its outputs, on all processes (sources, which ask nobody, each on its own): VTK does not run
/// what is below a filter that failed, and runs that filter again at the next update, so the others
/// would wait for this process in an exchange.
HYBRIDTREEFILTERS_EXPORT int runOnAll(
  vtkAlgorithm* filter, const std::function<void()>& work, const std::function<void()>& clear);

} // namespace hybridtree

#endif
