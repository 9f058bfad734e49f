// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/NormalsOnWay.h"

#include "core/base/Scratch.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{

double angleBetween(const Vec3& a, const Vec3& b)
{
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

void NormalsOnWay::halveAbove(double turn)
{
  const double leastCosine = std::cos(turn);
  std::vector<Stop> finer{ stops_.front() };
  for (std::size_t k = 1; k < stops_.size(); ++k)
  {
    const Stop& last = finer.back();
    if (last.normal.dot(stops_[k].normal) < leastCosine)
    {
      finer.push_back({ 0.5 * (last.place + stops_[k].place), Vec3::Zero(), false });
    }
    finer.push_back(stops_[k]);
  }
  stops_ = std::move(finer);
}

double NormalsOnWay::mostTurn() const
{
  double most = 0.0;
  for (std::size_t k = 1; k < stops_.size() && !std::isnan(most); ++k)
  {
    const double turn = angleBetween(stops_[k - 1].normal, stops_[k].normal);
    most = turn <= most ? most : turn;
  }
  return most;
}

void askForNormals(const FieldSource& field, std::vector<NormalsOnWay>& ways)
{
  std::vector<NormalsOnWay::Stop*> asked;
  for (NormalsOnWay& way : ways)
  {
    for (NormalsOnWay::Stop& stop : way.stops_)
    {
      if (!stop.known)
      {
        asked.push_back(&stop);
      }
    }
  }
  ScratchVectors points(asked.size()), gradients(asked.size());
  ScratchArray values(asked.size());
  for (std::size_t k = 0; k < asked.size(); ++k)
  {
    points.batch().set(k, asked[k]->place);
  }
  field.fieldAndGradient(points.points(), values.data(), gradients.batch());
  for (std::size_t k = 0; k < asked.size(); ++k)
  {
    const Vec3 gradient = gradients.points()[k];
    asked[k]->normal = gradient / -gradient.norm();
    asked[k]->known = true;
  }
}

} // namespace hybridtree
