// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionKernel.h"

#include "core/base/Error.h"
#include "core/base/Types.h"

#include <cmath>

namespace hybridtree
{
namespace
{

const double kPi = std::acos(-1.0);

// r^2 / R^2.
double squaredRadius(const ConvolutionKernel& kernel)
{
  return 1.0 / (kernel.influenceRatio * kernel.influenceRatio);
}

} // namespace

void validate(const ConvolutionKernel& kernel)
{
  if (kernel.exponent < 2 || kernel.exponent > kMaxKernelExponent)
  {
    throw InvalidParameter("Exponent", kernel.exponent, "from 2 to 8");
  }
  if (!(kernel.influenceRatio >= 1.05 && kernel.influenceRatio <= 100.0))
  {
    throw InvalidParameter("InfluenceRatio", kernel.influenceRatio,
      "from 1.05 to 100: how many radii the field reaches; nearer to 1 the field is too steep");
  }
}

double faded(double field)
{
  const double x = field / kFadeEnd - 1.0;
  return x <= 0.0 ? 0.0 : x >= 1.0 ? field : kFadeEnd * x * x * (5.0 - 3.0 * x);
}

double fadedSlope(double field)
{
  const double x = field / kFadeEnd - 1.0;
  return x <= 0.0 ? 0.0 : x >= 1.0 ? 1.0 : x * (10.0 - 9.0 * x);
}

double bellIntegral(int exponent)
{
  double integral = 2.0;
  for (int k = 1; k <= exponent; ++k)
  {
    integral *= 2.0 * k / (2.0 * k + 1.0);
  }
  return integral;
}

double segmentAmplitude(const ConvolutionKernel& kernel)
{
  if (kernel.kind == KernelKind::Cauchy)
  {
    const double u = 1.0 + 4.0 * squaredRadius(kernel);
    return kThreshold * 4.0 * u * std::sqrt(u) / kPi;
  }
  const double c = 1.0 - squaredRadius(kernel);
  return kThreshold /
    (integerPower(c, kernel.exponent) * std::sqrt(c) * bellIntegral(kernel.exponent));
}

double triangleAmplitude(const ConvolutionKernel& kernel)
{
  if (kernel.kind == KernelKind::Cauchy)
  {
    return kThreshold * 4.0 * (1.0 + 4.0 * squaredRadius(kernel)) / kPi;
  }
  const double c = 1.0 - squaredRadius(kernel);
  return kThreshold * (kernel.exponent + 1) / (kPi * integerPower(c, kernel.exponent + 1));
}

} // namespace hybridtree
