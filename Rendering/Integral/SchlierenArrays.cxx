// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/SchlierenArrays.h"

#include "Filters/Common/NamedArray.h"
#include "Filters/Common/ThreadedLoop.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
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

void SetPair(vtkFloatArray* array, vtkIdType tuple, const glm::dvec2& values)
{
  array->SetTypedComponent(tuple, 0, static_cast<float>(values.x));
  array->SetTypedComponent(tuple, 1, static_cast<float>(values.y));
}

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

/** Planes behind the medium, and units of paths. */
struct Screens
{
  RayPlane Shadow;
  RayPlane Background;
  double ReferenceIndex = 1.0;
  /** World length of the mesh's unit. */
  double Radius = 1.0;
};

/** Light of a pixel behind the medium. */
struct LightOfPixel
{
  glm::dvec2 Pixel;
  glm::dvec2 Deflection{ 0.0 };
  /** Optical path difference in world coordinates. */
  double Path = 0.0;
  /** Place on the screen of the shadowgraph, in pixels; NaN for light that does not land. */
  glm::dvec2 Landing;
  /** Place of the background that is seen, in pixels. */
  glm::dvec2 Seen;
};

LightOfPixel FindLight(const SchlierenRays& rays, const GradedRayResult& ray,
  const glm::dvec2& pixel, const Screens& screens)
{
  LightOfPixel light;
  light.Pixel = light.Landing = light.Seen = pixel;
  if (ray.State == GradedRayState::Missed)
  {
    return light;
  }
  const glm::dvec2 deflection = rays.Deflect(pixel, ray.Direction);
  const bool leaves = ray.State == GradedRayState::Left;
  if (leaves)
  {
    light.Path = screens.Radius *
      (ray.OpticalPath -
        screens.ReferenceIndex *
          glm::dot(ray.Exit - ray.Entry, glm::normalize(rays.GetDirection(pixel))));
  }
  if (!leaves || std::isnan(deflection.x))
  {
    light.Landing = glm::dvec2(NaN);
    return light;
  }
  light.Deflection = deflection;
  light.Landing = rays.Land(ray, screens.Shadow);
  light.Seen = rays.Land(ray, screens.Background);
  return light;
}

/** Deflections and optical path differences. */
void WriteMeasures(const std::vector<LightOfPixel>& light, vtkImageData* output)
{
  vtkFloatArray* deflections = AddPointArray<vtkFloatArray>(output, "Deflection", 2);
  vtkFloatArray* paths = AddPointArray<vtkFloatArray>(output, "OpticalPathDifference", 1);
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    const auto number = static_cast<vtkIdType>(i);
    SetPair(deflections, number, light[i].Deflection);
    paths->SetValue(number, static_cast<float>(light[i].Path));
  }
}

void WriteShadows(const std::vector<LightOfPixel>& light, vtkImageData* output)
{
  vtkFloatArray* shadows = AddPointArray<vtkFloatArray>(output, "Shadowgraph", 1);
  std::vector<glm::dvec2> landings;
  landings.reserve(light.size());
  for (const LightOfPixel& one : light)
  {
    landings.push_back(one.Landing);
  }
  const int* size = output->GetDimensions();
  double offScreen = 0.0;
  const std::vector<double> irradiance =
    ComputeShadowgraph(landings, size[0], size[1], ThreadedLoop, offScreen);
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    shadows->SetValue(static_cast<vtkIdType>(i), static_cast<float>(irradiance[i]));
  }
}

/**
 * Returns false if no light passes.
 * @param knife with a range of 0, twice the largest deflection is its range.
 */
bool WriteKnife(const std::vector<LightOfPixel>& light, KnifeEdge knife, vtkImageData* output)
{
  vtkFloatArray* knives = AddPointArray<vtkFloatArray>(output, "Schlieren", 1);
  if (!(knife.Range > 0.0))
  {
    double largest = 0.0;
    for (const LightOfPixel& one : light)
    {
      largest = std::max(largest, std::abs(knife.Along(one.Deflection)));
    }
    knife.Range = largest > 0.0 ? 2.0 * largest : 1.0;
  }
  bool passes = false;
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    const double share = knife.Transmit(light[i].Deflection);
    knives->SetValue(static_cast<vtkIdType>(i), static_cast<float>(share));
    passes |= share > 0.0;
  }
  return passes;
}

void WriteFringes(
  const std::vector<LightOfPixel>& light, const Interferometer& meter, vtkImageData* output)
{
  vtkFloatArray* fringes = AddPointArray<vtkFloatArray>(output, "Interferogram", 1);
  const int* dimensions = output->GetDimensions();
  const glm::dvec2 size(dimensions[0], dimensions[1]);
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    fringes->SetValue(static_cast<vtkIdType>(i),
      static_cast<float>(meter.Interfere(light[i].Path, (light[i].Pixel + 0.5) / size)));
  }
}

/** @param background null for none. */
void WriteShifts(
  const std::vector<LightOfPixel>& light, vtkImageData* background, vtkImageData* output)
{
  vtkFloatArray* shifts = AddPointArray<vtkFloatArray>(output, "Displacement", 2);
  vtkFloatArray* warped =
    background ? AddPointArray<vtkFloatArray>(output, "Background", 1) : nullptr;
  const Picture picture = background ? ReadPicture(background) : Picture();
  const int* dimensions = output->GetDimensions();
  const glm::dvec2 scale(static_cast<double>(picture.Width) / dimensions[0],
    static_cast<double>(picture.Height) / dimensions[1]);
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    const auto number = static_cast<vtkIdType>(i);
    const glm::dvec2 shift = light[i].Seen - light[i].Pixel;
    SetPair(shifts, number, shift);
    if (warped)
    {
      warped->SetValue(number,
        static_cast<float>(SamplePicture(
          picture.Values, picture.Width, picture.Height, (light[i].Seen + 0.5) * scale - 0.5)));
    }
  }
}

}

//------------------------------------------------------------------------------
SchlierenRays::SchlierenRays(const IntegralView& view, const int size[2])
  : View(view)
  , Size(size[0], size[1])
  , ToFrame(glm::transpose(glm::dmat3(view.Rays.RowX, view.Rays.RowY, view.Rays.RowDepth)))
  , FromFrame(glm::inverse(this->ToFrame))
  , Middle(0.5 * (size[0] - 1), 0.5 * (size[1] - 1))
{
}

//------------------------------------------------------------------------------
glm::dvec2 SchlierenRays::GetSlope(const glm::dvec2& pixel) const
{
  const glm::dvec2 p = pixel - this->Middle;
  return this->View.Rays.Slope.At(p.x, p.y);
}

//------------------------------------------------------------------------------
glm::dvec3 SchlierenRays::GetOrigin(const glm::dvec2& pixel) const
{
  const glm::dvec2 p = pixel - this->Middle;
  const double depth = this->View.BeginDepth;
  return this->FromFrame *
    glm::dvec3(this->View.Rays.Origin.At(p.x, p.y) + depth * this->GetSlope(pixel), depth);
}

//------------------------------------------------------------------------------
glm::dvec3 SchlierenRays::GetDirection(const glm::dvec2& pixel) const
{
  return this->FromFrame * glm::dvec3(this->GetSlope(pixel), 1.0);
}

//------------------------------------------------------------------------------
double SchlierenRays::GetDepthBehind(const glm::dvec3& half, double distance) const
{
  return glm::dot(glm::abs(this->View.Rays.RowDepth), half) +
    distance / glm::length(this->View.Rays.ViewToWorld[2]);
}

//------------------------------------------------------------------------------
glm::dvec2 SchlierenRays::Deflect(const glm::dvec2& pixel, const glm::dvec3& direction) const
{
  const glm::dvec3 d = this->ToFrame * direction;
  return d.z > 0.0 ? glm::dvec2(d) / d.z - this->GetSlope(pixel) : glm::dvec2(NaN);
}

//------------------------------------------------------------------------------
RayPlane SchlierenRays::GetPlane(double depth) const
{
  const auto& origin = this->View.Rays.Origin;
  const auto& slope = this->View.Rays.Slope;
  RayPlane plane;
  plane.Depth = depth;
  plane.PerPlace = glm::inverse(this->GetSteps(depth));
  plane.Pixel = this->Middle - plane.PerPlace * (origin.Base + depth * slope.Base);
  return plane;
}

//------------------------------------------------------------------------------
glm::dvec2 SchlierenRays::Land(const GradedRayResult& ray, const RayPlane& plane) const
{
  const glm::dvec3 place = this->ToFrame * ray.Exit;
  const glm::dvec3 d = this->ToFrame * ray.Direction;
  if (!(d.z > 0.0))
  {
    return glm::dvec2(NaN);
  }
  const glm::dvec2 there = glm::dvec2(place) + (plane.Depth - place.z) / d.z * glm::dvec2(d);
  return plane.Pixel + plane.PerPlace * there;
}

//------------------------------------------------------------------------------
/** Steps between the rays of neighbouring columns and rows, at a depth in the frame. */
glm::dmat2 SchlierenRays::GetSteps(double depth) const
{
  const auto& origin = this->View.Rays.Origin;
  const auto& slope = this->View.Rays.Slope;
  return { origin.PerColumn + depth * slope.PerColumn, origin.PerRow + depth * slope.PerRow };
}

//------------------------------------------------------------------------------
/** Pixel of the ray through a place; NaN as in RayImage. */
glm::dvec2 SchlierenRays::Project(const glm::dvec3& place) const
{
  // Places have a size of about 1, and with their frame an error of some 2^-50: of less than 2^-22
  // pixels, if pixels are not smaller than this.
  constexpr double smallestStep = 0x1p-28;
  const glm::dvec3 there = this->ToFrame * place;
  const glm::dmat2 steps = this->GetSteps(there.z);
  const double area = std::abs(glm::determinant(steps));
  const double longest = std::max(glm::length(steps[0]), glm::length(steps[1]));
  if (!(there.z > this->View.BeginDepth && area > smallestStep * longest))
  {
    return glm::dvec2(NaN);
  }
  const auto& origin = this->View.Rays.Origin;
  const auto& slope = this->View.Rays.Slope;
  const glm::dvec2 pixel =
    this->Middle + glm::inverse(steps) * (glm::dvec2(there) - origin.Base - there.z * slope.Base);
  // Beyond this, rounding would count.
  constexpr double mostPixels = 0x1p24;
  return std::max(std::abs(pixel.x), std::abs(pixel.y)) < mostPixels ? pixel : glm::dvec2(NaN);
}

//------------------------------------------------------------------------------
RayImage SchlierenRays::GetImage() const
{
  return { this->Size.x, this->Size.y,
    [this](const glm::dvec3& place) { return this->Project(place); },
    [this](const glm::dvec2& pixel) { return this->GetDirection(pixel); },
    this->View.Rays.RowDepth };
}

//------------------------------------------------------------------------------
bool WriteImages(const SchlierenRays& rays, const std::vector<GradedRayResult>& results,
  const TetrahedralMesh& mesh, const Instruments& instruments, vtkImageData* output)
{
  const glm::dvec3 half = mesh.GetHalfSize() / mesh.GetRadius();
  Screens screens;
  screens.Shadow = rays.GetPlane(rays.GetDepthBehind(half, instruments.ScreenDistance));
  screens.Background = rays.GetPlane(rays.GetDepthBehind(half, instruments.BackgroundDistance));
  screens.ReferenceIndex = instruments.ReferenceIndex;
  screens.Radius = mesh.GetRadius();
  const auto width = static_cast<std::size_t>(output->GetDimensions()[0]);
  std::vector<LightOfPixel> light;
  light.reserve(results.size());
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    const glm::dvec2 pixel(static_cast<double>(i % width), static_cast<double>(i / width));
    light.push_back(FindLight(rays, results[i], pixel, screens));
  }
  WriteMeasures(light, output);
  WriteShadows(light, output);
  const bool passes = WriteKnife(light, instruments.Knife, output);
  WriteFringes(light, instruments.Meter, output);
  WriteShifts(light, instruments.Background, output);
  return passes;
}

}
