// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionKernels.h"

namespace hybridtree
{

const KernelNumbers kNumbers = {
  { 1.0, 0.1999999999964796, 0.11111110578002083, 0.07692198997458294, 0.058768281144872724,
    0.04668745304848529, 0.03387126702700675, 0.01671959606350739, 0.003751138483965141,
    0.00021423810738603946 },
  { -0.333333333333307, -0.14285714266926733, -0.09090899793217341, -0.06665764910689723,
    -0.052374234719188166, -0.040811247503178855, -0.02556862364437174, -0.00899108054265826,
    -0.0011252544302234645, -1.93423475928923e-05 },
  0.125,
  0.25,
  0.5,
  1.0,
  3.0,
  4.0,
  5.0,
  8.0,
  1.57079632679489661923,
  1e90,
};

const ConvolutionKernels& convolutionKernels(KernelKind kind)
{
  return kind == KernelKind::Cauchy ? cauchyConvolutionKernels() : compactConvolutionKernels();
}

} // namespace hybridtree
