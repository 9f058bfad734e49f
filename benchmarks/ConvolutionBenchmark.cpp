// SPDX-License-Identifier: BSD-3-Clause
// Fields of subdivision skeletons.
//   - Figure 14 of [SUB]: all-blending beside our blending with neighbours, and [SUB]'s own with
//     immediate ones ("paper"), on a bretzel and an alien: value and gradient at the vertices of
//     the surface, with both kernels. "Unpruned" sums every element at every point, as [SUB] did,
//     by the same vector kernels. The compact kernel passes over all but the near elements already
//     when all blend, so there the two other times can at best be equal to that. The Cauchy kernel
//     is the one with which blending with neighbours has elements to pass over, as in [SUB].
//   - The closed form of a triangle beside a rule of 64 points (8 x 8, Gauss and Legendre): one
//     point at a time, and over batches in vectors of the same width.
// Medians of rounds in turns, one thread, its processor time.
//
//   ConvolutionBenchmark [rounds, default 7] [places | known | triangles: only that part]
#include "benchmarks/convolution/Works.h"

#include <cstdio>
#include <cstdlib>
#include <string>

int main(int argc, char** argv)
{
  using namespace hybridtree::test;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  const std::string part = argc > 2 ? argv[2] : "all";
  if (part == "all" || part == "places")
  {
    printPlaces(rounds);
  }
  if (part == "all" || part == "known")
  {
    printKnownElements(rounds);
  }
  if (part == "all" || part == "triangles")
  {
    printTriangles(rounds);
  }
  return 0;
}
