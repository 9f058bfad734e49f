// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/Validate.h"

#include "core/base/Error.h"

#include <Eigen/SVD>

#include <cmath>
#include <sstream>

namespace hybridtree
{
namespace
{

// A few units in the last place: what a normalised vector or matrix is off by.
constexpr double kRounding = 2e-15;

template <class Matrix>
std::string text(const Matrix& value)
{
  std::ostringstream stream;
  const Eigen::IOFormat format(
    Eigen::StreamPrecision, Eigen::DontAlignCols, " ", "; ", "", "", "(", ")");
  stream << value.format(format);
  return stream.str();
}

} // namespace

const Vec3& requireFinite(const std::string& name, const Vec3& value)
{
  if (!value.allFinite())
  {
    throw InvalidParameter(name, text(value.transpose()), "three finite numbers");
  }
  return value;
}

double requireFinite(const std::string& name, double value)
{
  if (!std::isfinite(value))
  {
    throw InvalidParameter(name, value, "a finite number");
  }
  return value;
}

double requireNotNegative(const std::string& name, double value)
{
  if (!std::isfinite(value) || value < 0.0)
  {
    throw InvalidParameter(name, value, "a finite number >= 0");
  }
  return value;
}

Vec3 requireDirection(const std::string& name, const Vec3& value)
{
  requireFinite(name, value);
  const double length = value.stableNorm();
  if (!(length > 0.0))
  {
    throw InvalidParameter(
      name, text(value.transpose()), "of a length other than 0, to give a direction");
  }
  if (std::abs(length - 1.0) <= kRounding)
  {
    return value;
  }
  // Twice: the first division of a very small or large vector may leave a few digits less.
  return (value / length).normalized();
}

Mat3 requireOrthonormal(const std::string& name, const Mat3& value)
{
  const auto deviation = [](const Mat3& m)
  { return (m.transpose() * m - Mat3::Identity()).cwiseAbs().maxCoeff(); };
  if (!value.allFinite() || !(deviation(value) <= 1e-9))
  {
    throw InvalidParameter(
      name, text(value), "a rotation: three unit columns at right angles to each other");
  }
  if (deviation(value) <= kRounding)
  {
    return value;
  }
  // The nearest orthonormal matrix.
  const Eigen::JacobiSVD<Mat3> svd(value, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Vec3 anyAcross(const Vec3& unit)
{
  int smallest = 0;
  unit.cwiseAbs().minCoeff(&smallest);
  return unit.cross(Vec3::Unit(smallest)).normalized();
}

} // namespace hybridtree
