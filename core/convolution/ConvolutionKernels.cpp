// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionKernels.h"

namespace hybridtree
{

const ConvolutionKernels& convolutionKernels(KernelKind kind)
{
  return kind == KernelKind::Cauchy ? cauchyConvolutionKernels() : compactConvolutionKernels();
}

} // namespace hybridtree
