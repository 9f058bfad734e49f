// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/SignedHarmonic.h"

#include "core/base/Parallel.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr int kMostSteps = 400;
constexpr double kPrecision = 1e-6;
constexpr std::size_t kGrain = 8192;

using Values = std::vector<double>;

// The quadratic form over the free nodes; its right side comes from the held ones.
class SignedForm
{
public:
  SignedForm(const std::vector<float>& held, std::vector<SignedLink> links)
    : first_(held.size() + 1, 0), diagonal_(held.size(), 0.0), right_(held.size(), 0.0)
  {
    const auto isFree = [&](std::int32_t node) { return held[node] == 0.0f; };
    for (const SignedLink& link : links)
    {
      const bool both = isFree(link.a) && isFree(link.b);
      first_[link.a + 1] += both;
      first_[link.b + 1] += both;
      this->addEnd(held, link.a, link.b, link.weight);
      this->addEnd(held, link.b, link.a, link.weight);
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    others_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const SignedLink& link : links)
    {
      if (isFree(link.a) && isFree(link.b))
      {
        others_[next[link.a]++] = { link.b, link.weight };
        others_[next[link.b]++] = { link.a, link.weight };
      }
    }
  }

  std::size_t size() const { return diagonal_.size(); }
  double diagonal(std::size_t node) const { return diagonal_[node]; }
  double right(std::size_t node) const { return right_[node]; }
  double row(std::size_t node, const Values& x) const
  {
    double sum = diagonal_[node] * x[node];
    for (std::size_t k = first_[node]; k < first_[node + 1]; ++k)
    {
      sum -= double(others_[k].weight) * x[others_[k].node];
    }
    return sum;
  }

private:
  struct Other
  {
    std::int32_t node;
    float weight;
  };

  // What a link says about one of its ends.
  void addEnd(const std::vector<float>& held, std::int32_t node, std::int32_t other, float weight)
  {
    if (held[node] == 0.0f)
    {
      diagonal_[node] += std::abs(double(weight));
      right_[node] += double(weight) * double(held[other]);
    }
  }

  std::vector<std::size_t> first_;
  std::vector<Other> others_;
  Values diagonal_;
  Values right_;
};

// Sum over all nodes of what body(node) returns, in an order that does not depend on the threads.
template <typename Body>
double sumOver(std::size_t count, const Body& body)
{
  Values parts((count + kGrain - 1) / kGrain, 0.0);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      double sum = 0.0;
      for (std::size_t node = begin; node < end; ++node)
      {
        sum += body(node);
      }
      parts[begin / kGrain] = sum;
    });
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

// Preconditioned by the diagonal. Starts from 0.
Values conjugateGradients(const SignedForm& form, const Progress& progress)
{
  const std::size_t count = form.size();
  Values x(count, 0.0);
  Values residual(count);
  Values way(count, 0.0);
  Values image(count);
  // Of held and lonely nodes the diagonal is 0, and so is all else.
  const auto scaled = [&](std::size_t k)
  { return form.diagonal(k) > 0.0 ? residual[k] / form.diagonal(k) : 0.0; };
  double length = sumOver(count,
    [&](std::size_t k)
    {
      residual[k] = form.right(k);
      way[k] = scaled(k);
      return residual[k] * way[k];
    });
  const double enough = kPrecision * kPrecision * length;
  for (int step = 0; step < kMostSteps && length > enough; ++step)
  {
    progress.check();
    progress.report(double(step) / double(kMostSteps));
    const double bent = sumOver(count,
      [&](std::size_t k)
      {
        image[k] = form.row(k, way);
        return way[k] * image[k];
      });
    if (!(bent > 0.0))
    {
      break; // what is left is rounding
    }
    const double far = length / bent;
    const double next = sumOver(count,
      [&](std::size_t k)
      {
        x[k] += far * way[k];
        residual[k] -= far * image[k];
        return residual[k] * scaled(k);
      });
    const double keep = next / length;
    sumOver(count,
      [&](std::size_t k)
      {
        way[k] = scaled(k) + keep * way[k];
        return 0.0;
      });
    length = next;
  }
  return x;
}

} // namespace

std::vector<double> signedHarmonic(
  const std::vector<float>& held, std::vector<SignedLink> links, const Progress& progress)
{
  const SignedForm form(held, std::move(links));
  Values values = conjugateGradients(form, progress);
  for (std::size_t node = 0; node < held.size(); ++node)
  {
    values[node] = held[node] != 0.0f ? double(held[node]) : values[node];
  }
  return values;
}

} // namespace hybridtree
