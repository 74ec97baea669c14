// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/SchlierenArrays.h"

#include "Filters/Common/NamedArray.h"
#include "Filters/Common/ThreadedLoop.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/** A picture as numbers, row by row. */
struct Picture
{
  std::vector<float> Values;
  int Width = 0;
  int Height = 0;
};

Picture ReadPicture(vtkImageData* image)
{
  Picture picture;
  const int* size = image->GetDimensions();
  picture.Width = size[0];
  picture.Height = size[1];
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < vtkIdType{ size[0] } * size[1]; ++i)
  {
    picture.Values.push_back(static_cast<float>(scalars->GetComponent(i, 0)));
  }
  return picture;
}

/** Writes the arrays whose values are those of their pixels alone. */
class PixelWriter
{
public:
  PixelWriter(const SchlierenRays& rays, const TetrahedralMesh& mesh,
    const Instruments& instruments, Shadowgraph& shadows, vtkImageData* output)
    : Rays(rays)
    , Settings(instruments)
    , Radius(mesh.GetRadius())
    , Width(output->GetDimensions()[0])
    , Size(output->GetDimensions()[0], output->GetDimensions()[1])
    , Irradiance(shadows)
  {
    shadows.Landings.resize(static_cast<std::size_t>(output->GetNumberOfPoints()));
    const glm::dvec3 half = mesh.GetHalfSize() / mesh.GetRadius();
    this->Shadow = rays.GetPlane(rays.GetDepthBehind(half, instruments.ScreenDistance));
    this->Background = rays.GetPlane(rays.GetDepthBehind(half, instruments.BackgroundDistance));
    if (instruments.Background)
    {
      this->Seen = ReadPicture(instruments.Background);
      this->PerPixel = glm::dvec2(this->Seen.Width, this->Seen.Height) / this->Size;
    }
    const auto add = [output](const char* name, int components)
    { return AddPointArray<vtkFloatArray>(output, name, components)->GetPointer(0); };
    this->Deflections = add("Deflection", 2);
    this->Paths = add("OpticalPathDifference", 1);
    this->Shadows = add("Shadowgraph", 1);
    this->Knives = add("Schlieren", 1);
    this->Fringes = add("Interferogram", 1);
    this->Shifts = add("Displacement", 2);
    this->Warped = instruments.Background ? add("Background", 1) : nullptr;
  }

  /** Writes the values of a row of pixels. */
  void WriteRow(std::size_t row, const LightOfImage& light)
  {
    for (std::size_t column = 0; column < this->Width; ++column)
    {
      const std::size_t number = row * this->Width + column;
      this->Write(number, glm::dvec2(column, row), light.States[number], light.Behind[number]);
    }
  }

  /** @pre all pixels are written. */
  void WriteShadows()
  {
    this->Irradiance.Compute(
      static_cast<int>(this->Size.x), static_cast<int>(this->Size.y), ThreadedLoop);
    const std::vector<double>& values = this->Irradiance.GetIrradiance();
    std::transform(values.begin(), values.end(), this->Shadows,
      [](double light) { return static_cast<float>(light); });
  }

  /**
   * Returns false if no light passes.
   * @pre all pixels are written.
   */
  bool WriteKnife()
  {
    KnifeEdge knife = this->Settings.Knife;
    if (!(knife.Range > 0.0))
    {
      double largest = 0.0;
      for (std::size_t i = 0; i < this->Irradiance.Landings.size(); ++i)
      {
        largest = std::max(largest, std::abs(knife.Along(this->DeflectionOf(i))));
      }
      knife.Range = largest > 0.0 ? 2.0 * largest : 1.0;
    }
    bool passes = false;
    for (std::size_t i = 0; i < this->Irradiance.Landings.size(); ++i)
    {
      const double share = knife.Transmit(this->DeflectionOf(i));
      this->Knives[i] = static_cast<float>(share);
      passes |= share > 0.0;
    }
    return passes;
  }

private:
  /** Writes the values of a pixel, and notes where its light lands. */
  void Write(
    std::size_t number, const glm::dvec2& pixel, GradedRayState state, const LightBehind& light)
  {
    glm::dvec2 deflection(0.0);
    glm::dvec2 landing = pixel;
    glm::dvec2 seen = pixel;
    double path = 0.0;
    if (state == GradedRayState::Left)
    {
      path = this->Radius * (light.OpticalPath - this->Settings.ReferenceIndex * light.Length);
    }
    if (state == GradedRayState::Left && !std::isnan(light.Slope.x))
    {
      deflection = light.Slope - this->Rays.GetImage().GetSlope(pixel);
      landing = this->Shadow.Meet(light);
      seen = this->Background.Meet(light);
    }
    else if (state != GradedRayState::Missed)
    {
      landing = glm::dvec2(NaN);
    }
    this->Irradiance.Landings[number] = landing;
    SetPair(this->Deflections, number, deflection);
    SetPair(this->Shifts, number, seen - pixel);
    this->Paths[number] = static_cast<float>(path);
    this->Fringes[number] =
      static_cast<float>(this->Settings.Meter.Interfere(path, (pixel + 0.5) / this->Size));
    if (this->Warped)
    {
      this->Warped[number] = static_cast<float>(SamplePicture(this->Seen.Values, this->Seen.Width,
        this->Seen.Height, (seen + 0.5) * this->PerPixel - 0.5));
    }
  }

  static void SetPair(float* array, std::size_t number, const glm::dvec2& values)
  {
    array[2 * number] = static_cast<float>(values.x);
    array[2 * number + 1] = static_cast<float>(values.y);
  }
  glm::dvec2 DeflectionOf(std::size_t number) const
  {
    return { this->Deflections[2 * number], this->Deflections[2 * number + 1] };
  }

  const SchlierenRays& Rays;
  const Instruments& Settings;
  /** World length of the mesh's unit. */
  double Radius;
  std::size_t Width;
  glm::dvec2 Size;
  RayPlane Shadow;
  RayPlane Background;
  /** The picture behind the medium, and its pixels per pixel of the image. */
  Picture Seen;
  glm::dvec2 PerPixel{ 1.0 };
  Shadowgraph& Irradiance;
  float* Deflections = nullptr;
  float* Paths = nullptr;
  float* Shadows = nullptr;
  float* Knives = nullptr;
  float* Fringes = nullptr;
  float* Shifts = nullptr;
  float* Warped = nullptr;
};

}

//------------------------------------------------------------------------------
SchlierenRays::SchlierenRays(const IntegralView& view, const int size[2])
  : View(view)
  , Image(view.Rays, view.BeginDepth, glm::ivec2(size[0], size[1]))
{
}

//------------------------------------------------------------------------------
double SchlierenRays::GetDepthBehind(const glm::dvec3& half, double distance) const
{
  return glm::dot(glm::abs(this->View.Rays.RowDepth), half) +
    distance / glm::length(this->View.Rays.ViewToWorld[2]);
}

//------------------------------------------------------------------------------
RayPlane SchlierenRays::GetPlane(double depth) const
{
  RayPlane plane;
  plane.Depth = depth;
  plane.PerPlace = glm::inverse(this->Image.GetSteps(depth));
  plane.Pixel = this->Image.GetMiddle() - plane.PerPlace * this->Image.GetMiddleAt(depth);
  return plane;
}

//------------------------------------------------------------------------------
LightBehind SchlierenRays::Measure(const glm::dvec2& pixel, const GradedRayResult& ray) const
{
  LightBehind light;
  const glm::dvec3 place = this->Image.GetToFrame() * ray.Exit;
  const glm::dvec3 direction = this->Image.GetToFrame() * ray.Direction;
  light.Slope = direction.z > 0.0 ? glm::dvec2(direction) / direction.z : glm::dvec2(NaN);
  light.Place = glm::dvec2(place) - place.z * light.Slope;
  light.OpticalPath = ray.OpticalPath;
  light.Length = glm::dot(ray.Exit - ray.Entry, glm::normalize(this->GetDirection(pixel)));
  return light;
}

//------------------------------------------------------------------------------
bool WriteImages(const SchlierenRays& rays, const LightOfImage& light, const TetrahedralMesh& mesh,
  const Instruments& instruments, Shadowgraph& shadows, vtkImageData* output)
{
  PixelWriter writer(rays, mesh, instruments, shadows, output);
  const auto height = static_cast<std::size_t>(output->GetDimensions()[1]);
  ForEachItem(height, ThreadedLoop, [&](std::size_t row) { writer.WriteRow(row, light); });
  writer.WriteShadows();
  return writer.WriteKnife();
}

}
