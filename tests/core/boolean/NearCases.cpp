// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/boolean/NearCases.h"

#include "tests/core/boolean/BooleanCases.h"

#include <cmath>
#include <utility>

namespace hybridtree::test
{
namespace
{

double tenTo(Random& random, double low, double high)
{
  return std::pow(10.0, random.uniform(low, high));
}

Vec3 directionOrAxis(Random& random)
{
  return random.chance(0.5) ? random.direction() : Vec3(Vec3::Unit(random.integer(0, 2)));
}

const Vec3& anyPoint(Random& random, const TriangleMesh& mesh)
{
  return mesh.points[std::size_t(random.integer(0, int(mesh.points.size()) - 1))];
}

std::array<Vec3, 3> anyTriangle(Random& random, const TriangleMesh& mesh)
{
  const std::size_t count = mesh.triangles.size();
  const Triangle& c = mesh.triangles[std::size_t(random.integer(0, int(count) - 1))];
  return { mesh.points[std::size_t(c[0])], mesh.points[std::size_t(c[1])],
    mesh.points[std::size_t(c[2])] };
}

Affine3 shift(const Vec3& by)
{
  return Affine3(Eigen::Translation3d(by));
}

Affine3 about(const Vec3& center, const Mat3& linear)
{
  Affine3 map = Affine3::Identity();
  map.linear() = linear;
  map.translation() = center - linear * center;
  return map;
}

// Columns: along the first side, across it in the plane, and the normal.
Mat3 frameOf(const std::array<Vec3, 3>& corner, double normalSign)
{
  Mat3 frame;
  frame.col(0) = (corner[1] - corner[0]).normalized();
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  frame.col(2) = normalSign * normal;
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

NearPair turned(Random& random, const TriangleMesh& solid, const TriangleMesh&)
{
  const Eigen::AngleAxisd rotation(tenTo(random, -16.0, -3.0), directionOrAxis(random));
  const Vec3 center = random.chance(0.5) ? anyPoint(random, solid) : Vec3(Vec3::Zero());
  return { solid, moved(solid, about(center, rotation.toRotationMatrix())) };
}

NearPair shifted(Random& random, const TriangleMesh& solid, const TriangleMesh&)
{
  return { solid, moved(solid, shift(tenTo(random, -17.0, -3.0) * directionOrAxis(random))) };
}

NearPair scaled(Random& random, const TriangleMesh& solid, const TriangleMesh&)
{
  const double factor = 1.0 + (random.chance(0.5) ? 1.0 : -1.0) * tenTo(random, -16.0, -3.0);
  const Vec3 center = random.chance(0.5) ? anyPoint(random, solid) : Vec3(Vec3::Zero());
  return { solid, moved(solid, about(center, factor * Mat3::Identity())) };
}

NearPair slid(Random& random, const TriangleMesh& solid, const TriangleMesh&)
{
  const std::array<Vec3, 3> corner = anyTriangle(random, solid);
  const auto step = [&]
  { return random.chance(0.5) ? 0.25 * random.integer(-4, 4) : random.uniform(-1.0, 1.0); };
  const double u = step();
  const double v = step();
  return { solid, moved(solid, shift(u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]))) };
}

NearPair quarterTurned(Random& random, const TriangleMesh& solid, const TriangleMesh&)
{
  Mat3 quarter = Mat3::Zero();
  const int axis = random.integer(0, 2);
  quarter(axis, axis) = 1.0;
  quarter((axis + 1) % 3, (axis + 2) % 3) = -1.0;
  quarter((axis + 2) % 3, (axis + 1) % 3) = 1.0;
  const Vec3 center = random.chance(0.5) ? anyPoint(random, solid) : Vec3(Vec3::Zero());
  return { solid, moved(solid, about(center, quarter)) };
}

NearPair mirrored(Random& random, const TriangleMesh& solid, const TriangleMesh&)
{
  Mat3 mirror = Mat3::Identity();
  const int axis = random.integer(0, 2);
  mirror(axis, axis) = -1.0;
  TriangleMesh copy = moved(solid, about(anyPoint(random, solid), mirror));
  for (Triangle& corner : copy.triangles)
  {
    std::swap(corner[1], corner[2]);
  }
  return { solid, std::move(copy) };
}

NearPair rounded(Random&, const TriangleMesh& solid, const TriangleMesh&)
{
  TriangleMesh copy = solid;
  for (Vec3& p : copy.points)
  {
    p = p.cast<float>().cast<double>();
  }
  return { solid, std::move(copy) };
}

NearPair faceOnFace(Random& random, const TriangleMesh& first, const TriangleMesh& second)
{
  const std::array<Vec3, 3> on = anyTriangle(random, first);
  const std::array<Vec3, 3> under = anyTriangle(random, second);
  const double sign = random.chance(0.7) ? -1.0 : 1.0; // else the solids overlap
  const Mat3 rotation = frameOf(on, 1.0) * frameOf(under, sign).transpose();
  Affine3 map = Affine3::Identity();
  map.linear() = rotation;
  map.translation() = on[0] - rotation * under[0];
  return { first, moved(second, map) };
}

NearPair vertexOn(Random& random, const TriangleMesh& first, const TriangleMesh& second)
{
  const std::array<Vec3, 3> corner = anyTriangle(random, first);
  const int kind = random.integer(0, 2);
  const Vec3 target = kind == 0 ? corner[0]
    : kind == 1                 ? Vec3(0.5 * (corner[0] + corner[1]))
                                : Vec3(0.25 * corner[0] + 0.25 * corner[1] + 0.5 * corner[2]);
  const TriangleMesh copy =
    moved(second, about(Vec3::Zero(), random.chance(0.5) ? random.rotation() : Mat3::Identity()));
  return { first, moved(copy, shift(target - anyPoint(random, copy))) };
}

NearPair verySmallOrLarge(Random& random, const TriangleMesh& first, const TriangleMesh& second)
{
  const Mat3 scale = tenTo(random, -20.0, 20.0) * Mat3::Identity();
  const TriangleMesh placed =
    random.chance(0.3) ? slid(random, first, first).b : moved(second, randomPlacement(random, 0.8));
  return { moved(first, about(Vec3::Zero(), scale)), moved(placed, about(Vec3::Zero(), scale)) };
}

// Where rounding is up to a hundred-millionth of the solids: what it makes of them.
NearPair farAway(Random& random, const TriangleMesh& first, const TriangleMesh& second)
{
  const Affine3 away = shift(tenTo(random, 2.0, 8.0) * directionOrAxis(random));
  const TriangleMesh placed =
    random.chance(0.3) ? slid(random, first, first).b : moved(second, randomPlacement(random, 0.8));
  return { moved(first, away), moved(placed, away) };
}

} // namespace

std::vector<NearCase> nearCases()
{
  return { { "turned by a little", turned }, { "shifted by a little", shifted },
    { "scaled by a little", scaled }, { "slid along a face", slid },
    { "turned by a quarter", quarterTurned }, { "mirrored", mirrored },
    { "rounded to float", rounded }, { "face on face", faceOnFace }, { "vertex on", vertexOn },
    { "very small or large", verySmallOrLarge }, { "far away", farAway } };
}

NearPair nextOfChain(
  Random& random, const NearPair& pair, const BooleanResults& results, std::string& name)
{
  const std::array<std::pair<const char*, const TriangleMesh*>, 3> made = {
    { { "A + B", &results.unite.mesh }, { "A & B", &results.intersect.mesh },
      { "A - B", &results.subtract.mesh } }
  };
  std::size_t which = std::size_t(random.integer(0, 2));
  which = made[which].second->empty() ? 0 : which;
  const bool isFirst = random.chance(0.5);
  NearPair next = { *made[which].second, isFirst ? pair.a : pair.b };
  name = std::string(made[which].first) + ", " + (isFirst ? "A" : "B");
  if (random.chance(0.4))
  {
    const NearCase moving = nearCases()[std::size_t(random.integer(0, 2))];
    next.b = moving.make(random, next.b, next.b).b;
    name += " " + moving.name;
  }
  if (random.chance(0.3))
  {
    std::swap(next.a, next.b);
    name += ", swapped";
  }
  return next;
}

} // namespace hybridtree::test
