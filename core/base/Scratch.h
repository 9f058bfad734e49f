// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cstddef>

namespace hybridtree
{

/// Temporary doubles from a stack that belongs to the thread, so that evaluating a tree allocates
/// nothing once warm. Scopes nest: the last made is the first gone. Values start undefined.
/// Must not live across a parallel loop started by the same thread (a stolen task could nest in it
/// out of order).
class ScratchArray
{
public:
  explicit ScratchArray(std::size_t size);
  ~ScratchArray();
  ScratchArray(const ScratchArray&) = delete;
  ScratchArray& operator=(const ScratchArray&) = delete;

  double* data() { return data_; }
  const double* data() const { return data_; }
  double& operator[](std::size_t k) { return data_[k]; }
  std::size_t size() const { return size_; }

private:
  double* data_;
  std::size_t size_;
  std::size_t block_;
  std::size_t offset_;
};

/// Three scratch arrays that hold points or vectors.
class ScratchVectors
{
public:
  explicit ScratchVectors(std::size_t size)
    : x_(size)
    , y_(size)
    , z_(size)
  {
  }
  VectorBatch batch() { return { x_.data(), y_.data(), z_.data() }; }
  PointBatch points() const { return { x_.data(), y_.data(), z_.data(), x_.size() }; }

private:
  ScratchArray x_, y_, z_;
};

} // namespace hybridtree
