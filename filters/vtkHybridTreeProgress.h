// SPDX-License-Identifier: BSD-3-Clause
// Private: lets core report to a filter and hear of its abortion.
#ifndef vtkHybridTreeProgress_h
#define vtkHybridTreeProgress_h

#include "core/base/Progress.h"
#include "vtkAlgorithm.h"
#include "vtkHybridTreeAbort.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace hybridtree
{

/// Part of a filter's progress that reading its inputs takes.
constexpr double kReadingShare = 0.05;

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
    if (std::this_thread::get_id() != thread_)
    {
      return;
    }
    // Every event may redraw a progress bar at the far end of a network. Where the fraction stands
    // still they go on, as only observers of them can stop the filter; and it never goes back,
    // though some work is done once more in another way.
    const auto now = std::chrono::steady_clock::now();
    if (fraction >= reported_ + 0.01 || now >= told_ + std::chrono::milliseconds(100))
    {
      reported_ = std::max(reported_, fraction);
      told_ = now;
      algorithm_->UpdateProgress(reported_);
    }
  }

  bool cancelled() const override
  {
    if (std::this_thread::get_id() == thread_ && mustStop(algorithm_))
    {
      cancelled_ = true;
    }
    return cancelled_;
  }

private:
  vtkAlgorithm* algorithm_;
  std::thread::id thread_;
  mutable double reported_ = -1.0; ///< so that even a start is told
  mutable std::chrono::steady_clock::time_point told_;
  mutable std::atomic<bool> cancelled_{ false };
};

/// Takes back what a filter calls its progress when it goes: other work has none but its name.
class OwnProgressText
{
public:
  explicit OwnProgressText(vtkAlgorithm* filter) : filter_(filter) {}
  ~OwnProgressText() { filter_->SetProgressText(nullptr); }
  OwnProgressText(const OwnProgressText&) = delete;
  OwnProgressText& operator=(const OwnProgressText&) = delete;

private:
  vtkAlgorithm* filter_;
};

} // namespace hybridtree

#endif
