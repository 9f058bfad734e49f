// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"

#include <atomic>

namespace hybridtree::test
{

/// Lets work look at abort so many times; from then on it is cancelled. For any number of threads.
class CancelAt final : public Progress
{
public:
  explicit CancelAt(int looks) : left_(looks) {}
  bool cancelled() const override { return --left_ < 0; }
  int looksLeft() const { return left_; } ///< below 0 once it has cancelled

private:
  mutable std::atomic<int> left_;
};

} // namespace hybridtree::test
