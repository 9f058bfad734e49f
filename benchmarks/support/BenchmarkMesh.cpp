// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/BenchmarkMesh.h"

#include "core/mesh/RepairMesh.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hybridtree::benchmark
{
namespace
{

TriangleMesh readObj(std::istream& stream)
{
  TriangleMesh mesh;
  for (std::string line; std::getline(stream, line);)
  {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v")
    {
      Vec3 p;
      words >> p.x() >> p.y() >> p.z();
      mesh.points.push_back(p);
    }
    else if (key == "f")
    {
      Triangle corner;
      std::string word;
      for (std::int32_t& vertex : corner)
      {
        words >> word;
        vertex = std::stoi(word) - 1; // stops at a slash
      }
      mesh.triangles.push_back(corner);
    }
  }
  return mesh;
}

// Binary little endian; float32 x, y, z first in a vertex, and faces as uchar count, int32 indices.
TriangleMesh readPly(std::istream& stream)
{
  std::size_t points = 0;
  std::size_t triangles = 0;
  std::size_t vertexBytes = 0;
  bool inVertex = false;
  for (std::string line; std::getline(stream, line) && line.substr(0, 10) != "end_header";)
  {
    std::istringstream words(line);
    std::string key, type;
    std::size_t count = 0;
    words >> key >> type >> count;
    if (key == "element")
    {
      inVertex = type == "vertex";
      (inVertex ? points : triangles) = count;
    }
    else if (key == "property" && inVertex)
    {
      vertexBytes += type == "double" ? 8 : type == "uchar" ? 1 : 4;
    }
  }
  TriangleMesh mesh;
  std::vector<char> vertex(vertexBytes);
  for (std::size_t k = 0; k < points; ++k)
  {
    float xyz[3];
    stream.read(vertex.data(), std::streamsize(vertexBytes));
    std::memcpy(xyz, vertex.data(), sizeof xyz);
    mesh.points.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  for (std::size_t t = 0; t < triangles; ++t)
  {
    char count = 0;
    Triangle corner;
    stream.read(&count, 1);
    stream.read(reinterpret_cast<char*>(corner.data()), sizeof corner);
    if (count != 3)
    {
      throw std::runtime_error("a face of the PLY file is no triangle");
    }
    mesh.triangles.push_back(corner);
  }
  return mesh;
}

TriangleMesh standIn(std::size_t triangles)
{
  const int rows = int(std::sqrt(0.25 * double(triangles))) + 2;
  const int columns = 2 * rows;
  const double pi = std::acos(-1.0);
  TriangleMesh mesh;
  for (int i = 0; i <= rows; ++i)
  {
    for (int j = 0; j < (i == 0 || i == rows ? 1 : columns); ++j)
    {
      const double latitude = pi * i / rows;
      const double longitude = 2.0 * pi * j / columns;
      const Vec3 p(std::sin(latitude) * std::cos(longitude),
        std::sin(latitude) * std::sin(longitude), std::cos(latitude));
      mesh.points.push_back(
        p * (1.0 + 0.3 * std::sin(5 * p.x()) * std::sin(6 * p.y()) * std::sin(7 * p.z() + 1)));
    }
  }
  const auto at = [&](int i, int j)
  {
    return i == 0
      ? 0
      : std::min(1 + (i - 1) * columns, 1 + (rows - 1) * columns) + (i == rows ? 0 : j % columns);
  };
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; j < columns; ++j)
    {
      mesh.triangles.push_back({ at(i, j), at(i + 1, j), at(i + 1, j + 1) });
      mesh.triangles.push_back({ at(i, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
  return mesh;
}

} // namespace

MeshPtr benchmarkMesh(const std::string& file, std::size_t triangles)
{
  const std::string path = std::string(HYBRIDTREE_BENCHMARK_DATA) + "/" + file;
  std::ifstream stream(path, std::ios::binary);
  TriangleMesh mesh;
  if (stream)
  {
    mesh = file.substr(file.size() - 4) == ".obj" ? readObj(stream) : readPly(stream);
  }
  else
  {
    std::fprintf(
      stderr, "%s is not in ../shared/data: a bumpy sphere stands in for it.\n", file.c_str());
    mesh = standIn(triangles);
  }
  const Box3 box = mesh.bounds();
  const double scale = 1.0 / box.sizes().maxCoeff();
  for (Vec3& point : mesh.points)
  {
    point = (point - box.min()) * scale;
  }
  return repairMesh(mesh.points, mesh.triangles).mesh;
}

} // namespace hybridtree::benchmark
