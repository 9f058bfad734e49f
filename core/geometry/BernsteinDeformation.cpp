// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/BernsteinDeformation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr int kNewtonSteps = 40;
constexpr double kConverged = 1e-15; // residual after which nothing can be gained
constexpr double kAccepted = 1e-12;  // residual of an answer
constexpr double kBeyond = 0.5;      // how far outside of the cube Newton may wander

// Work allowed, in control points visited: keeps lattices of any size within a second or so.
constexpr double kFoldingWork = 5e7;
constexpr double kCellsWork = 4e6;

Box3 unitCube()
{
  return Box3(Vec3::Zero(), Vec3::Ones());
}

bool restsOnFaces(const BernsteinVolume& volume)
{
  const std::array<int, 3>& n = volume.sizes();
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const bool face = i % (n[0] - 1) == 0 || j % (n[1] - 1) == 0 || k % (n[2] - 1) == 0;
        const std::size_t at = i + std::size_t(n[0]) * (j + std::size_t(n[1]) * k);
        if (face && !volume.coefficients()[at].isZero(0.0))
        {
          return false;
        }
      }
    }
  }
  return true;
}

// Largest magnitude of each component; over eighths of the cube, where the coefficients of a part
// bound it more closely, as long as that is cheap.
Vec3 magnitudeBound(const BernsteinVolume& volume)
{
  const Box3 whole = volume.bounds();
  Vec3 bound = whole.min().cwiseAbs().cwiseMax(whole.max().cwiseAbs());
  constexpr std::size_t kCheap = 2000;
  if (bound.isZero(0.0) || volume.coefficients().size() > kCheap)
  {
    return bound;
  }
  Vec3 closer = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 low(0.5 * (corner & 1), 0.5 * ((corner >> 1) & 1), 0.5 * ((corner >> 2) & 1));
    const Box3 part = volume.restricted(Box3(low, Vec3(low.array() + 0.5))).bounds();
    closer = closer.cwiseMax(part.min().cwiseAbs()).cwiseMax(part.max().cwiseAbs());
  }
  return bound.cwiseMin(closer);
}

std::array<Mat3, 3> secondBounds(const BernsteinVolume& volume)
{
  std::array<Mat3, 3> result;
  for (int b = 0; b < 3; ++b)
  {
    const BernsteinVolume first = volume.derivative(b);
    for (int c = b; c < 3; ++c)
    {
      const Vec3 bound = magnitudeBound(first.derivative(c));
      for (int a = 0; a < 3; ++a)
      {
        result[a](b, c) = result[a](c, b) = bound[a];
      }
    }
  }
  return result;
}

double norm(const Mat3& matrix)
{
  return matrix.cwiseAbs().rowwise().sum().maxCoeff();
}

} // namespace

// Images of the cells of a grid over the cube, with those of larger and larger cells above:
// level l has 2^l cells along each axis.
struct BernsteinDeformation::Cells
{
  std::vector<std::vector<Box3>> levels;

  const Box3& image(int level, const std::array<int, 3>& at) const
  {
    return levels[level][at[0] + (std::size_t(at[1]) << level) + (std::size_t(at[2]) << 2 * level)];
  }

  static Box3 cell(int level, const std::array<int, 3>& at)
  {
    const double size = std::ldexp(1.0, -level);
    const Vec3 low(at[0] * size, at[1] * size, at[2] * size);
    return Box3(low, Vec3(low.array() + size));
  }

  // Calls visit(cell) for each of the smallest cells whose image meets the box, except where
  // skip(cell) says of a cell around it that no more is wanted.
  template <typename Skip, typename Visit>
  void forCells(const Box3& box, const Skip& skip, const Visit& visit) const
  {
    this->descend(0, { 0, 0, 0 }, box, skip, visit);
  }

private:
  template <typename Skip, typename Visit>
  void descend(int level, const std::array<int, 3>& at, const Box3& box, const Skip& skip,
    const Visit& visit) const
  {
    const Box3 here = cell(level, at);
    if (!this->image(level, at).intersects(box) || skip(here))
    {
      return;
    }
    if (level + 1 == static_cast<int>(levels.size()))
    {
      visit(here);
      return;
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      this->descend(level + 1,
        { 2 * at[0] + (corner & 1), 2 * at[1] + (corner >> 1 & 1), 2 * at[2] + (corner >> 2) }, box,
        skip, visit);
    }
  }
};

BernsteinDeformation::BernsteinDeformation(
  const std::array<int, 3>& sizes, std::vector<Vec3> displacements)
  : displacement_(sizes, std::move(displacements))
  , identity_(std::all_of(displacement_.coefficients().begin(), displacement_.coefficients().end(),
      [](const Vec3& d) { return d.isZero(0.0); }))
  , restingFaces_(identity_ || restsOnFaces(displacement_))
  , secondBound_(secondBounds(displacement_))
{
}

BernsteinDeformation::~BernsteinDeformation() = default;

bool BernsteinDeformation::isInside(const Vec3& x)
{
  return x.minCoeff() >= -kMargin && x.maxCoeff() <= 1.0 + kMargin;
}

Vec3 BernsteinDeformation::forward(const Vec3& x) const
{
  return identity_ || !isInside(x) ? x : Vec3(x + displacement_.evaluate(x));
}

Mat3 BernsteinDeformation::jacobian(const Vec3& x) const
{
  Mat3 derivative = Mat3::Zero();
  if (!identity_ && isInside(x))
  {
    displacement_.evaluate(x, derivative);
  }
  return Mat3::Identity() + derivative;
}

// Bound of the change of J from the centre of a box to anywhere in it, `half` its half lengths.
Mat3 BernsteinDeformation::deviation(const Vec3& half) const
{
  Mat3 result;
  for (int a = 0; a < 3; ++a)
  {
    result.row(a) = (secondBound_[a] * half).transpose();
  }
  return result;
}

MatrixInterval BernsteinDeformation::jacobianOver(const Box3& part) const
{
  return { this->jacobian(part.center()), this->deviation(0.5 * part.sizes()) };
}

BernsteinDeformation::Folding BernsteinDeformation::folding() const
{
  std::call_once(foldingOnce_, [this] { folding_ = this->findFolding(); });
  return folding_;
}

BernsteinDeformation::Folding BernsteinDeformation::findFolding() const
{
  if (identity_)
  {
    return Folding::None;
  }
  double work = 0.0;
  std::vector<Box3> open{ unitCube() };
  while (!open.empty())
  {
    std::vector<Box3> next;
    for (const Box3& cell : open)
    {
      work += static_cast<double>(displacement_.coefficients().size());
      const MatrixInterval jacobian = this->jacobianOver(cell);
      if (!(jacobian.center.determinant() > 0.0))
      {
        return Folding::Certain;
      }
      if (norm(jacobian.center.inverse().cwiseAbs() * jacobian.radius) < 1.0)
      {
        continue;
      }
      const Vec3 middle = cell.center();
      for (int corner = 0; corner < 8; ++corner)
      {
        Box3 part = cell;
        for (int axis = 0; axis < 3; ++axis)
        {
          ((corner >> axis) & 1 ? part.min() : part.max())[axis] = middle[axis];
        }
        next.push_back(part);
      }
    }
    if (work + 1.0 * static_cast<double>(next.size() * displacement_.coefficients().size()) >
      kFoldingWork)
    {
      return Folding::Possible;
    }
    open.swap(next);
  }
  return Folding::None;
}

const BernsteinDeformation::Cells& BernsteinDeformation::cells() const
{
  std::call_once(cellsOnce_,
    [this]
    {
      const double points = static_cast<double>(displacement_.coefficients().size());
      int finest = 5;
      while (finest > 1 && points * std::ldexp(1.0, 3 * finest) > kCellsWork)
      {
        --finest;
      }
      auto made = std::make_unique<Cells>();
      made->levels.resize(finest + 1);
      for (int level = finest; level >= 0; --level)
      {
        const int count = 1 << level;
        std::vector<Box3>& images = made->levels[level];
        images.reserve(std::size_t(1) << 3 * level);
        for (int k = 0; k < count; ++k)
        {
          for (int j = 0; j < count; ++j)
          {
            for (int i = 0; i < count; ++i)
            {
              Box3 image;
              if (level == finest)
              {
                // Second-order Taylor bound about the centre, over the cell and its margin.
                const Box3 cell = Cells::cell(level, { i, j, k });
                const Vec3 half = (0.5 * cell.sizes()).array() + 2.0 * kMargin;
                const Vec3 center = this->forward(cell.center());
                const Vec3 reach = this->jacobian(cell.center()).cwiseAbs() * half +
                  0.5 * this->deviation(half) * half;
                image = Box3(Vec3(center - reach), Vec3(center + reach));
              }
              else
              {
                for (int corner = 0; corner < 8; ++corner)
                {
                  image.extend(made->image(level + 1,
                    { 2 * i + (corner & 1), 2 * j + (corner >> 1 & 1), 2 * k + (corner >> 2) }));
                }
              }
              images.push_back(image);
            }
          }
        }
      }
      cells_ = std::move(made);
    });
  return *cells_;
}

std::optional<Vec3> BernsteinDeformation::solve(const Vec3& y, const Vec3& start) const
{
  const double rounding = 1.0 + y.cwiseAbs().maxCoeff();
  Vec3 x = start;
  Mat3 derivative;
  Vec3 residual = x + displacement_.evaluate(x, derivative) - y;
  for (int step = 0; step < kNewtonSteps; ++step)
  {
    const double error = residual.norm();
    if (error <= kConverged * rounding)
    {
      return x;
    }
    const Mat3 jacobian = Mat3::Identity() + derivative;
    const double determinant = jacobian.determinant();
    if (!(std::abs(determinant) > 1e-14))
    {
      break;
    }
    const Vec3 direction = -(jacobian.inverse() * residual);
    bool better = false;
    for (double length = 1.0; length > 0.01 && !better; length *= 0.5)
    {
      const Vec3 tried = (x + length * direction).cwiseMax(-kBeyond).cwiseMin(1.0 + kBeyond);
      Mat3 triedDerivative;
      const Vec3 triedResidual = tried + displacement_.evaluate(tried, triedDerivative) - y;
      better = triedResidual.norm() < error;
      if (better)
      {
        x = tried;
        derivative = triedDerivative;
        residual = triedResidual;
      }
    }
    if (!better)
    {
      break;
    }
  }
  return residual.norm() <= kAccepted * rounding ? std::optional<Vec3>(x) : std::nullopt;
}

std::optional<Vec3> BernsteinDeformation::solveFromCells(const Vec3& y) const
{
  std::optional<Vec3> found;
  this->cells().forCells(
    Box3(y, y), [&](const Box3&) { return found.has_value(); },
    [&](const Box3& cell)
    {
      const std::optional<Vec3> x = this->solve(y, cell.center());
      if (x && isInside(*x))
      {
        found = x;
      }
    });
  return found;
}

std::optional<Vec3> BernsteinDeformation::inverse(const Vec3& y) const
{
  if (identity_ || (restingFaces_ && !isInside(y)) || !y.allFinite())
  {
    return y;
  }
  const bool within = isInside(y);
  if (within || this->cells().levels[0][0].contains(y))
  {
    const std::optional<Vec3> x = this->solve(y, y.cwiseMax(0.0).cwiseMin(1.0));
    if (x && isInside(*x))
    {
      return x;
    }
    if (const std::optional<Vec3> other = this->solveFromCells(y))
    {
      return other;
    }
  }
  return within && !restingFaces_ ? std::nullopt : std::optional<Vec3>(y);
}

BernsteinDeformation::Preimage BernsteinDeformation::preimageOf(const Box3& box) const
{
  Preimage result;
  if (identity_)
  {
    result.box = box.intersection(unitCube());
    result.center = box.center();
    result.inverseJacobian = MatrixInterval(Mat3::Identity(), Mat3::Zero());
    return result;
  }
  this->cells().forCells(
    box, [&](const Box3& cell) { return result.box.contains(cell); },
    [&](const Box3& cell) { result.box.extend(cell); });
  if (result.box.isEmpty())
  {
    return result;
  }
  result.box =
    Box3(Vec3(result.box.min().array() - kMargin), Vec3(result.box.max().array() + kMargin));
  // w(x) - w(c) = J~ (x - c) with J~ between the least and the largest J of the box around both;
  // so x - c = J~^-1 (y - w(c)), and the box shrinks with what holds J~^-1, which shrinks with it.
  // The best c is the preimage of the centre, or close to it where that is beyond the cube.
  const Vec3 root = this->solve(box.center(), result.box.center()).value_or(result.box.center());
  const Vec3 c = root.cwiseMax(0.0).cwiseMin(1.0);
  const Vec3 off = box.center() - this->forward(c);
  const Mat3 inverse = this->jacobian(c).inverse();
  for (int round = 0; round < 3; ++round)
  {
    const Vec3 reach = (result.box.max() - c).cwiseMax(c - result.box.min()).cwiseMax(0.0);
    const Mat3 change = inverse.cwiseAbs() * this->deviation(reach);
    if (!(norm(change) < 0.9))
    {
      break;
    }
    const Mat3 radius = (Mat3::Identity() - change).inverse() * (change * inverse.cwiseAbs());
    result.inverseJacobian = MatrixInterval(inverse, radius);
    result.center = c + inverse * off;
    result.slack = (radius * off.cwiseAbs()).array() + 2.0 * kAccepted * (1.0 + norm(inverse));
    const Vec3 extent = result.inverseJacobian.extent(0.5 * box.sizes()) + result.slack;
    result.box =
      result.box.intersection(Box3(Vec3(*result.center - extent), Vec3(*result.center + extent)));
    if (result.box.isEmpty())
    {
      break;
    }
  }
  return result;
}

} // namespace hybridtree
