// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/support/OffFile.h"

#include <fstream>
#include <sstream>

namespace hybridtree::benchmark
{

std::unique_ptr<TriangleMesh> readOff(const std::string& file)
{
  std::ifstream stream(file);
  std::string text;
  for (std::string line; std::getline(stream, line);)
  {
    text += line.substr(0, line.find('#')) + "\n";
  }
  std::istringstream words(text);
  std::string magic;
  std::size_t points = 0, faces = 0, edges = 0;
  if (!(words >> magic >> points >> faces >> edges) || magic != "OFF")
  {
    return nullptr;
  }
  auto mesh = std::make_unique<TriangleMesh>();
  mesh->points.resize(points);
  for (Vec3& p : mesh->points)
  {
    words >> p.x() >> p.y() >> p.z();
  }
  std::string line;
  for (std::size_t f = 0; f < faces && words >> std::ws && std::getline(words, line); ++f)
  {
    std::istringstream face(line); // colours may follow
    std::size_t corners = 0;
    face >> corners;
    std::vector<std::int32_t> v(corners);
    for (std::int32_t& corner : v)
    {
      face >> corner;
    }
    for (std::size_t k = 2; k < corners; ++k)
    {
      mesh->triangles.push_back({ v[0], v[k - 1], v[k] });
    }
  }
  return mesh;
}

} // namespace hybridtree::benchmark
