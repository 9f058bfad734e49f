// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/PcdFile.h"

#include "core/base/Error.h"
#include "tests/support/Random.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkHybridTreePCDReader.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

template <typename Number>
void append(std::string& bytes, Number number)
{
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

// A greedy LZF compressor with the format's own words: literals and references.
std::string compressLzf(const std::string& data)
{
  std::string packed;
  std::string literals;
  const auto flush = [&]
  {
    for (std::size_t at = 0; at < literals.size(); at += 32)
    {
      const std::string run = literals.substr(at, 32);
      packed += static_cast<char>(run.size() - 1);
      packed += run;
    }
    literals.clear();
  };
  std::size_t at = 0;
  while (at < data.size())
  {
    std::size_t best = 0;
    std::size_t from = 0;
    for (std::size_t start = at > 200 ? at - 200 : 0; start < at; ++start)
    {
      std::size_t length = 0;
      while (length < 264 && at + length < data.size() && data[start + length] == data[at + length])
      {
        ++length;
      }
      if (length > best)
      {
        best = length;
        from = start;
      }
    }
    if (best < 3)
    {
      literals += data[at++];
      continue;
    }
    flush();
    const std::size_t back = at - from - 1;
    const std::size_t length = best - 2;
    packed += static_cast<char>(std::min<std::size_t>(length, 7) << 5 | back >> 8);
    if (length >= 7)
    {
      packed += static_cast<char>(length - 7);
    }
    packed += static_cast<char>(back & 255);
    at += best;
  }
  flush();
  return packed;
}

// Points with all that a cloud may have.
struct Cloud
{
  std::vector<std::array<float, 3>> places;
  std::vector<std::uint32_t> colors;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<std::int16_t, 2>> labels;
  std::vector<double> times;
  std::size_t width = 0;
  std::size_t height = 1;
};

Cloud randomCloud(std::size_t width, std::size_t height, std::uint64_t seed)
{
  Random random(seed);
  Cloud cloud;
  cloud.width = width;
  cloud.height = height;
  for (std::size_t k = 0; k < width * height; ++k)
  {
    const Vec3 p = random.direction();
    cloud.places.push_back({ float(p.x()), float(p.y()), float(p.z()) });
    cloud.normals.push_back(cloud.places.back());
    cloud.colors.push_back(std::uint32_t(random.uniform(0.0, 4294967295.0)) & 0xff7fffffu);
    cloud.labels.push_back({ std::int16_t(random.uniform(-9e3, 9e3)), std::int16_t(k % 3) });
    cloud.times.push_back(random.uniform(-1.0, 1.0));
  }
  return cloud;
}

std::string headerOf(const Cloud& cloud, const char* kind)
{
  std::ostringstream text;
  text << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
       << "FIELDS x y z rgba normal_x normal_y normal_z label _ time\n"
       << "SIZE 4 4 4 4 4 4 4 2 1 8\nTYPE F F F U F F F I U F\nCOUNT 1 1 1 1 1 1 1 2 3 1\n"
       << "WIDTH " << cloud.width << "\nHEIGHT " << cloud.height << "\nVIEWPOINT 1 2 3 1 0 0 0\n"
       << "POINTS " << cloud.places.size() << "\nDATA " << kind << "\n";
  return text.str();
}

std::string ascii(const Cloud& cloud)
{
  std::ostringstream text;
  text.precision(17);
  for (std::size_t k = 0; k < cloud.places.size(); ++k)
  {
    const auto& p = cloud.places[k];
    const auto& n = cloud.normals[k];
    text << p[0] << ' ' << p[1] << ' ' << p[2] << ' ' << cloud.colors[k] << ' ' << n[0] << ' '
         << n[1] << ' ' << n[2] << ' ' << cloud.labels[k][0] << ' ' << cloud.labels[k][1]
         << " 0 0 0 " << cloud.times[k] << '\n';
  }
  return headerOf(cloud, "ascii") + text.str();
}

std::string binary(const Cloud& cloud)
{
  std::string bytes = headerOf(cloud, "binary");
  for (std::size_t k = 0; k < cloud.places.size(); ++k)
  {
    append(bytes, cloud.places[k]);
    append(bytes, cloud.colors[k]);
    append(bytes, cloud.normals[k]);
    append(bytes, cloud.labels[k]);
    bytes += "abc";
    append(bytes, cloud.times[k]);
  }
  return bytes;
}

std::string compressed(const Cloud& cloud)
{
  std::string bytes;
  const auto column = [&](const auto& rows, std::size_t axis)
  {
    for (const auto& row : rows)
    {
      append(bytes, row[axis]);
    }
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    column(cloud.places, axis);
  }
  for (const std::uint32_t color : cloud.colors)
  {
    append(bytes, color);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    column(cloud.normals, axis);
  }
  for (const auto& label : cloud.labels)
  {
    append(bytes, label);
  }
  bytes += std::string(3 * cloud.places.size(), '\0');
  for (const double time : cloud.times)
  {
    append(bytes, time);
  }
  const std::string packed = compressLzf(bytes);
  std::string file = headerOf(cloud, "binary_compressed");
  append(file, std::uint32_t(packed.size()));
  append(file, std::uint32_t(bytes.size()));
  return file + packed;
}

std::string write(const std::string& bytes)
{
  const std::string name = testing::TempDir() + "hybridtree_" +
    testing::UnitTest::GetInstance()->current_test_info()->name() + ".pcd";
  std::ofstream(name, std::ios::binary) << bytes;
  return name;
}

void expectCloud(vtkPolyData* data, const Cloud& cloud)
{
  const auto count = static_cast<vtkIdType>(cloud.places.size());
  ASSERT_EQ(data->GetNumberOfPoints(), count);
  EXPECT_EQ(data->GetNumberOfVerts(), count);
  EXPECT_EQ(data->GetPoints()->GetDataType(), VTK_FLOAT);
  vtkPointData* arrays = data->GetPointData();
  vtkDataArray* colors = arrays->GetScalars();
  vtkDataArray* normals = arrays->GetNormals();
  vtkDataArray* labels = arrays->GetArray("label");
  vtkDataArray* times = arrays->GetArray("time");
  ASSERT_TRUE(colors && normals && labels && times);
  EXPECT_EQ(arrays->GetNumberOfArrays(), 4);
  ASSERT_EQ(colors->GetNumberOfComponents(), 4);
  ASSERT_EQ(labels->GetNumberOfComponents(), 2);
  for (vtkIdType k = 0; k < count; ++k)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(data->GetPoint(k)[axis], cloud.places[k][axis]) << "point " << k;
      ASSERT_EQ(normals->GetComponent(k, axis), cloud.normals[k][axis]) << "point " << k;
      ASSERT_EQ(colors->GetComponent(k, axis), cloud.colors[k] >> (16 - 8 * axis) & 255);
    }
    ASSERT_EQ(colors->GetComponent(k, 3), cloud.colors[k] >> 24);
    ASSERT_EQ(labels->GetComponent(k, 0), cloud.labels[k][0]);
    ASSERT_EQ(times->GetComponent(k, 0), cloud.times[k]);
  }
}

TEST(PcdReader, ReadsAllThreeKinds)
{
  const Cloud cloud = randomCloud(500, 1, 1);
  for (const std::string& bytes : { ascii(cloud), binary(cloud), compressed(cloud) })
  {
    vtkNew<vtkHybridTreePCDReader> reader;
    const std::string name = write(bytes);
    EXPECT_EQ(vtkHybridTreePCDReader::CanReadFile(name.c_str()), 1);
    reader->SetFileName(name.c_str());
    reader->Update();
    expectCloud(reader->GetOutput(), cloud);
    vtkDataArray* viewpoint = reader->GetOutput()->GetFieldData()->GetArray("Viewpoint");
    ASSERT_TRUE(viewpoint);
    EXPECT_EQ(viewpoint->GetComponent(0, 2), 3.0);
  }
}

TEST(PcdReader, LeavesOutPointsWithoutPlaceOrKeepsThem)
{
  Cloud cloud = randomCloud(20, 10, 2);
  for (std::size_t k = 0; k < 200; k += 3)
  {
    cloud.places[k][k % 2] = std::numeric_limits<float>::quiet_NaN();
  }
  for (const std::string& bytes : { ascii(cloud), binary(cloud), compressed(cloud) })
  {
    vtkNew<vtkHybridTreePCDReader> reader;
    reader->SetFileName(write(bytes).c_str());
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 133);
    EXPECT_EQ(reader->GetOutput()->GetPointData()->GetArray("time")->GetTuple1(1), cloud.times[2]);
    reader->KeepInvalidPointsOn();
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 200);
    EXPECT_EQ(reader->GetOutput()->GetNumberOfVerts(), 133);
    vtkDataArray* dimensions = reader->GetOutput()->GetFieldData()->GetArray("Dimensions");
    ASSERT_TRUE(dimensions);
    EXPECT_EQ(dimensions->GetComponent(0, 0), 20.0);
  }
}

TEST(PcdReader, ReadsColoursPackedAsFloat)
{
  const std::uint32_t packed = 0x00ff8001;
  float number = 0.0f;
  std::memcpy(&number, &packed, 4);
  std::ostringstream text;
  text.precision(9);
  text << "VERSION .7\r\nFIELDS x y z rgb\r\nSIZE 8 8 8 4\r\nTYPE F F F F\r\nWIDTH 1\r\n"
       << "HEIGHT 1\r\nPOINTS 1\r\nDATA ascii\r\n0.1 0.2 0.3 " << number << "\r\n";
  vtkNew<vtkHybridTreePCDReader> reader;
  reader->SetFileName(write(text.str()).c_str());
  reader->Update();
  ASSERT_EQ(reader->GetOutput()->GetNumberOfPoints(), 1);
  EXPECT_EQ(reader->GetOutput()->GetPoint(0)[0], 0.1);
  vtkDataArray* colors = reader->GetOutput()->GetPointData()->GetArray("RGB");
  ASSERT_TRUE(colors);
  EXPECT_EQ(colors->GetComponent(0, 0), 255.0);
  EXPECT_EQ(colors->GetComponent(0, 1), 128.0);
  EXPECT_EQ(colors->GetComponent(0, 2), 1.0);
}

std::string messageOf(const std::string& bytes)
{
  std::istringstream stream(bytes);
  try
  {
    readPcd(stream);
  }
  catch (const InvalidGeometry& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(PcdFile, IsWholeOrAnError)
{
  const Cloud cloud = randomCloud(30, 1, 3);
  Random random(4);
  for (const std::string& bytes : { ascii(cloud), binary(cloud), compressed(cloud) })
  {
    ASSERT_EQ(messageOf(bytes), "no error");
    for (int k = 0; k < 300; ++k)
    {
      // The last line's end and last digits may go without harm.
      const auto kept = static_cast<std::size_t>(random.uniform(0.0, double(bytes.size()) - 30.0));
      EXPECT_NE(messageOf(bytes.substr(0, kept)), "no error") << kept << " of " << bytes.size();
    }
  }
}

TEST(PcdFile, SurvivesDamage)
{
  const Cloud cloud = randomCloud(30, 1, 5);
  Random random(6);
  std::size_t errors = 0;
  for (const std::string& bytes : { ascii(cloud), binary(cloud), compressed(cloud) })
  {
    for (int k = 0; k < 1000; ++k)
    {
      std::string damaged = bytes;
      for (int hit = 0; hit < 3; ++hit)
      {
        const auto at = static_cast<std::size_t>(random.uniform(0.0, double(bytes.size()) - 1.0));
        damaged[at] = static_cast<char>(random.uniform(0.0, 255.0));
      }
      errors += messageOf(damaged) != "no error";
    }
  }
  EXPECT_GT(errors, 500u);
}

TEST(PcdFile, SaysWhatIsWrong)
{
  const std::string good = ascii(randomCloud(3, 1, 7));
  const auto with = [&](const std::string& from, const std::string& to)
  {
    std::string changed = good;
    changed.replace(changed.find(from), from.size(), to);
    return messageOf(changed);
  };
  EXPECT_NE(with("POINTS 3", "POINTS 4").find("POINTS is 4"), std::string::npos);
  EXPECT_NE(with("WIDTH 3", "WIDTH 99999999999").find("WIDTH"), std::string::npos);
  EXPECT_NE(with("WIDTH 3", "WIDTH -3").find("\"-3\""), std::string::npos);
  EXPECT_NE(with("WIDTH 3", "WIDTH 2000000000").find("POINTS"), std::string::npos);
  EXPECT_NE(with("COUNT 1 1", "COUNT 1048576 1").find("cut off"), std::string::npos);
  EXPECT_NE(with("COUNT 1 1", "COUNT 1").find("FIELDS before it"), std::string::npos);
  EXPECT_NE(with("SIZE 4 4", "SIZE 4 3").find("SIZE 3"), std::string::npos);
  EXPECT_NE(with("TYPE F F", "TYPE F Q").find("\"Q\""), std::string::npos);
  EXPECT_NE(with("DATA ascii", "DATA packed").find("\"packed\""), std::string::npos);
  EXPECT_NE(messageOf("").find("DATA"), std::string::npos);
  EXPECT_NE(messageOf("hello\nworld\n").find("\"hello\""), std::string::npos);
}

TEST(PcdReader, ReportsErrors)
{
  for (const std::string& name :
    { std::string("/nowhere/at all.pcd"), write("VERSION 0.7\n"), write("hello") })
  {
    vtkNew<vtkTest::ErrorObserver> errors;
    vtkNew<vtkHybridTreePCDReader> reader;
    reader->AddObserver(vtkCommand::ErrorEvent, errors);
    reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
    reader->SetFileName(name.c_str());
    reader->Update();
    EXPECT_TRUE(errors->GetError());
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  }
}

TEST(Lzf, UndoesItsOpposite)
{
  Random random(8);
  for (int round = 0; round < 50; ++round)
  {
    std::string data;
    const double alphabet = random.uniform(1.0, 20.0);
    while (data.size() < static_cast<std::size_t>(round) * 20)
    {
      data += static_cast<char>(random.uniform(0.0, alphabet));
    }
    const std::string packed = compressLzf(data);
    std::string out(data.size(), 'x');
    const auto* in = reinterpret_cast<const std::uint8_t*>(packed.data());
    auto* to = reinterpret_cast<std::uint8_t*>(&out[0]);
    ASSERT_TRUE(decompressLzf(in, packed.size(), to, out.size()));
    ASSERT_EQ(out, data);
    if (!data.empty())
    {
      EXPECT_FALSE(decompressLzf(in, packed.size(), to, out.size() - 1));
    }
  }
}

} // namespace
