// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Error.h"

namespace hybridtree
{

/// How long work tells its caller where it is, and learns that it is no longer wanted.
/// Both functions may be called from any thread.
class Progress
{
public:
  virtual ~Progress() = default;

  /// \param fraction done of the whole, 0 to 1; may stand still, need not reach 1.
  virtual void report(double fraction) const { static_cast<void>(fraction); }
  virtual bool cancelled() const { return false; }

  /// \throws Cancelled once the caller has asked to stop.
  void check() const
  {
    if (this->cancelled())
    {
      throw Cancelled();
    }
  }

  /// Listens to nobody.
  static const Progress& none();
};

/// Maps 0..1 of one step onto [begin, end] of the whole.
class ProgressPart final : public Progress
{
public:
  ProgressPart(const Progress& whole, double begin, double end)
    : whole_(whole)
    , begin_(begin)
    , end_(end)
  {
  }
  void report(double fraction) const override
  {
    whole_.report(begin_ + (end_ - begin_) * fraction);
  }
  bool cancelled() const override { return whole_.cancelled(); }

private:
  const Progress& whole_;
  double begin_;
  double end_;
};

} // namespace hybridtree
