// SPDX-License-Identifier: BSD-3-Clause
// Private: lets core report to a filter and hear of its abortion.
#ifndef vtkHybridTreeProgress_h
#define vtkHybridTreeProgress_h

#include "core/base/Progress.h"
#include "vtkAlgorithm.h"

#include <atomic>
#include <thread>

namespace hybridtree
{

/// VTK's progress events and abort flag belong to the thread that runs the filter. Other threads'
/// reports are dropped, and what they hear of an abortion is what that thread has seen last.
class FilterProgress final : public Progress
{
public:
  explicit FilterProgress(vtkAlgorithm* algorithm)
    : algorithm_(algorithm), thread_(std::this_thread::get_id())
  {
  }

  void report(double fraction) const override
  {
    // Every report may redraw a progress bar at the far end of a network.
    if (std::this_thread::get_id() == thread_ && fraction >= reported_ + 0.01)
    {
      reported_ = fraction;
      algorithm_->UpdateProgress(fraction);
    }
  }

  bool cancelled() const override
  {
    if (std::this_thread::get_id() == thread_ && mustStop(algorithm_, 0))
    {
      cancelled_ = true;
    }
    return cancelled_;
  }

private:
  /// CheckAbort() exists from VTK 9.3 on, and also tells of aborted filters further up.
  template <class Algorithm>
  static auto mustStop(Algorithm* algorithm, int) -> decltype(algorithm->CheckAbort())
  {
    return algorithm->CheckAbort();
  }
  template <class Algorithm>
  static bool mustStop(Algorithm* algorithm, long)
  {
    return algorithm->GetAbortExecute() != 0;
  }

  vtkAlgorithm* algorithm_;
  std::thread::id thread_;
  mutable double reported_ = 0.0;
  mutable std::atomic<bool> cancelled_{ false };
};

} // namespace hybridtree

#endif
