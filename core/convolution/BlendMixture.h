// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/BlendSets.h"

#include <array>

namespace hybridtree
{

/// The largest of the sums G_i at some points (BlendedField.h). Sums whose fields with all shares 1
/// are no larger than the best so far are passed over. The gradient is that of the largest sum:
/// pieces' gradients, each times a weight per point.
class BlendMixture
{
public:
  static constexpr std::size_t kMostPoints = 64;

  /// \param bounds as for BlendSets.
  /// \pre at most kMostPoints points.
  BlendMixture(PieceFields& fields, const std::vector<double>& bounds);

  double best(std::size_t k) const { return best_.data()[k]; }
  double leastBest() const;

  /// Of the largest sums at some of the points.
  void findGradients(const std::vector<std::size_t>& some, const VectorBatch& gradient);

private:
  class Weights;

  void clear(ScratchArray& row) const;
  void add(const double* from, ScratchArray& row) const;

  bool mayBeBest(const BlendSets::Set& set);
  bool staysPossible(const BlendSets::Set& set);
  void findNearness();
  bool mayBeBestByShares(const BlendSets::Set& set);
  void sumPlaces(const BlendSets::Set& set);
  void findOthers(const BlendSets::Set& set);
  void findDistance(const BlendSets::Set& set, std::size_t member);
  void tryOut(std::size_t set);

  PieceFields& fields_;
  BlendShare share_;
  const std::vector<double>& bounds_;
  BlendSets sets_;
  std::size_t points_;
  ScratchArray best_;
  ScratchArray total_;
  ScratchArray here_;
  ScratchArray distance_; ///< D of one member
  ScratchArray near_; ///< per group and point: sum of f_c (farthest - d(c, j)) over all pieces c
  ScratchArray all_;  ///< sum of f_c over all pieces c
  bool isNearKnown_ = false;
  std::vector<std::size_t> others_; ///< groups with fields here that are not in a set
  std::array<std::size_t, kMostPoints> winners_;
};

} // namespace hybridtree
