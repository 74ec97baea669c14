// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PassTables.h"

#include "Frames.h"
#include "Pool.h"
#include "PoolScene.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace meniscus::benchmark
{

namespace
{

//------------------------------------------------------------------------------
// One row and one JSON object per mode.
template <typename Frames>
std::string PrintFrames(std::ostream& out, const std::vector<Frames>& all)
{
  std::ostringstream json;
  for (const Frames& frames : all)
  {
    out << "| " << frames.Mode << " | " << frames.PerSecond << " | " << frames.CpuMs << " |\n";
    json << (json.tellp() > 0 ? ", " : "") << "{\"mode\": \"" << frames.Mode
         << "\", \"frames_per_second\": " << frames.PerSecond << ", \"cpu_ms\": " << frames.CpuMs
         << "}";
  }
  return "[" + json.str() + "]";
}

//------------------------------------------------------------------------------
std::string PrintPool(std::ostream& out, const PoolPictures& pool)
{
  std::ostringstream json;
  const auto print = [&out, &json](const char* name, const char* key, const PoolFigures& figures)
  {
    out << "| " << name << ", " << figures.SetUp << " | " << figures.Ms << " | " << figures.Percent
        << " |\n";
    json << (json.tellp() > 0 ? ", " : "{") << "\"" << key << "_ms\": " << figures.Ms << ", \""
         << key << "_percent_off\": " << figures.Percent;
  };
  print("vtkRefractionPass", "pass", pool.Pass);
  print("vtkRefractionPass, coarsest", "coarse_pass", pool.CoarsePass);
  if (pool.HasTraced)
  {
    print("Embree, on the processor", "embree", pool.Traced);
    print("Embree, coarsest", "coarse_embree", pool.CoarseTraced);
  }
  return json.str() + "}";
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::string PrintPassTables(std::ostream& out)
{
  out << std::fixed << std::setprecision(2)
      << "| filter alone, well of 1,445 vertices below 512 facets | frames/s | CPU ms "
         "|\n|---|---|---|\n";
  std::string json = "\"well\": " + PrintFrames(out, MeasureWell());
  out << "\n| vtkRefractionPass, 512 x 512, moving waves | frames/s | CPU ms |\n|---|---|---|\n";
  json += ",\n\"pass\": " + PrintFrames(out, MeasurePass());
  out << "\n| picture of the pool | ms | % of the water off by more than 8/255 |\n|---|---|---|\n";
  return json + ",\n\"pool\": " + PrintPool(out, ComparePool());
}

//------------------------------------------------------------------------------
bool WritePoolPicture(const std::string& file)
{
  test::PoolScene scene(16);
  scene.SetOptics({ true, true, glm::dvec3(0.02, 0.008, 0.004) });
  scene.ShowObjects(true);
  const test::ByteImage picture = scene.Draw();
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.Width, picture.Height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::copy(
    picture.Rgb.begin(), picture.Rgb.end(), static_cast<unsigned char*>(image->GetScalarPointer()));
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(image);
  writer->Write();
  return writer->GetErrorCode() == 0;
}

} // namespace meniscus::benchmark
