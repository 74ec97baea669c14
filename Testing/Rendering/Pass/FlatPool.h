// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** A flat pool seen through vtkRefractionPass, and Snell's law and Fresnel's for its pixels. */
#pragma once

#include "ExactStack.h"
#include "RayCastScene.h"
#include "SceneParts.h"

#include <vtkAlgorithmOutput.h>
#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractionPass.h>

namespace meniscus::test
{

/** Names that are common words elsewhere. */
namespace flatpool
{

constexpr int Size = 120;
constexpr double EyeHeight = 4.0;
constexpr double Depth = 1.5;
constexpr double Water = 1.333;
constexpr double Background[3] = { 0.1, 0.3, 0.7 };
// Rounding to 8 bits, of the image behind the membrane and of the result.
constexpr double Rounding = 1.5 / 255.0;

/** A window that looks down on water in the plane z = 0, with a white floor below it. */
class Pool
{
public:
  explicit Pool(int samples = 0)
    : Bottom(MakePlane(6.0, -Depth, 60))
    , Surface(MakePlane(3.0, 0.0, 4))
    , Scene(Size, Size, samples)
  {
    this->Filter->SetInputConnection(this->Bottom->GetOutputPort());
    this->Filter->SetMembraneConnection(this->Surface->GetOutputPort());
    this->Filter->SetInteriorIndexOfRefraction(Water);
    this->Filter->SetCamera(this->GetCamera());
    this->Membrane = MakeActor(this->Surface->GetOutputPort());
    this->Floor = MakeActor(this->Filter->GetOutputPort());
    SetFlatColor(this->Floor, 1.0, 1.0, 1.0);
    this->Pass->AddRefraction(this->Membrane, this->Floor, this->Filter);
    this->GetRenderer()->SetPass(this->Pass);
    this->GetRenderer()->SetBackground(Background[0], Background[1], Background[2]);
    this->LookFrom(0.0, 0.0);
  }

  void LookFrom(double x, double y)
  {
    this->GetCamera()->SetPosition(x, y, EyeHeight);
    this->GetCamera()->SetFocalPoint(0.0, 0.0, 0.0);
    this->GetCamera()->SetViewUp(0.0, 1.0, 0.0);
    this->GetCamera()->SetViewAngle(60.0);
    this->GetCamera()->SetClippingRange(0.1, 20.0);
  }

  vtkRenderer* GetRenderer() { return this->Scene.GetRenderer(); }
  vtkCamera* GetCamera() { return this->GetRenderer()->GetActiveCamera(); }
  ByteImage Render()
  {
    this->Scene.GetWindow()->Render();
    return ReadBytes(this->Scene.GetWindow());
  }

  vtkSmartPointer<vtkPlaneSource> Bottom;
  vtkSmartPointer<vtkPlaneSource> Surface;
  vtkNew<vtkRefractedGeometryFilter> Filter;
  vtkNew<vtkRefractionPass> Pass;
  vtkSmartPointer<vtkActor> Membrane;
  vtkSmartPointer<vtkActor> Floor;
  VolumeScene Scene;
};

struct Sight
{
  bool OnMembrane;
  /** Cosines of the angles of incidence and refraction. */
  double Cosine;
  double RefractedCosine;
  /** Intersection of the sight ray with the water. */
  double Point[2];
};

/** Place in a plane that a pixel's ray meets, by Snell's law. */
inline Sight SightOf(vtkCamera* camera, int x, int y)
{
  double eye[3];
  double forward[3];
  double up[3];
  camera->GetPosition(eye);
  camera->GetDirectionOfProjection(forward);
  camera->OrthogonalizeViewUp();
  camera->GetViewUp(up);
  const double right[3] = { forward[1] * up[2] - forward[2] * up[1],
    forward[2] * up[0] - forward[0] * up[2], forward[0] * up[1] - forward[1] * up[0] };
  const double scale = std::tan(camera->GetViewAngle() * std::acos(-1.0) / 360.0) / (0.5 * Size);
  const double u = (x + 0.5 - 0.5 * Size) * scale;
  const double v = (y + 0.5 - 0.5 * Size) * scale;
  double direction[3];
  double length = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    direction[i] = forward[i] + u * right[i] + v * up[i];
    length += direction[i] * direction[i];
  }
  Sight sight;
  sight.Cosine = -direction[2] / std::sqrt(length);
  const double sine = std::sqrt(1.0 - sight.Cosine * sight.Cosine) / Water;
  sight.RefractedCosine = std::sqrt(1.0 - sine * sine);
  const double t = -eye[2] / direction[2];
  sight.Point[0] = eye[0] + t * direction[0];
  sight.Point[1] = eye[1] + t * direction[1];
  sight.OnMembrane =
    direction[2] < 0.0 && std::max(std::fabs(sight.Point[0]), std::fabs(sight.Point[1])) < 3.0;
  return sight;
}

/** True for pixels at the border of the membrane, which may count as inside or outside. */
inline bool IsBorder(const Sight& sight)
{
  const double reach = std::max(std::fabs(sight.Point[0]), std::fabs(sight.Point[1]));
  return std::fabs(reach - 3.0) < 0.15;
}

/** Reflectance of unpolarised light, from the amplitudes (the pass uses the form of Eq. 2.6). */
inline double MakeFresnel(const Sight& sight)
{
  return reference::MakeReflectance(sight.Cosine, 1.0, Water);
}

inline double Schlick(const Sight& sight)
{
  const double r = std::pow((Water - 1.0) / (Water + 1.0), 2.0);
  return r + (1.0 - r) * std::pow(1.0 - sight.Cosine, 5.0);
}

template <typename ColorOf>
void ExpectColors(
  Pool& pool, const std::string& what, ColorOf&& colorOf, double slack = Rounding, int blur = 0)
{
  SCOPED_TRACE(what);
  const ByteImage image = pool.Render();
  int seen = 0;
  // A filter of that radius wraps around at the border of the image.
  for (const auto& [y, x] :
    Product(Numbers<int>(blur, Size - blur), Numbers<int>(blur, Size - blur)))
  {
    const Sight sight = SightOf(pool.GetCamera(), x, y);
    bool border = false;
    for (int k = 0; k < (2 * blur + 1) * (2 * blur + 1); ++k)
    {
      const int dx = k % (2 * blur + 1) - blur;
      const int dy = k / (2 * blur + 1) - blur;
      border = border || IsBorder(SightOf(pool.GetCamera(), x + dx, y + dy));
    }
    if (border)
    {
      continue;
    }
    seen += sight.OnMembrane ? 1 : 0;
    for (int channel = 0; channel < 3; ++channel)
    {
      const double expected = sight.OnMembrane ? colorOf(sight, channel) : Background[channel];
      ASSERT_NEAR(image.GetPixel(x, y)[channel] / 255.0, expected, slack) << x << " " << y;
    }
  }
  EXPECT_GT(seen, Size * Size / 4);
}

}

}
