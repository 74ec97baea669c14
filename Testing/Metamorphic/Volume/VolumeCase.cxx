// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeCase.h"

#include "MapScene.h"
#include "MeshFamilies.h"
#include "VolumeScene.h"

#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkVolumeMapper.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace test
{

namespace
{

std::array<double, 3> randomColor(RandomNumbers& random)
{
  const double r = random.uniform();
  const double g = random.uniform();
  return { r, g, random.uniform() };
}

// Adds control points at fractions of a range.
class FunctionMaker
{
public:
  FunctionMaker(const std::array<double, 2>& range, RandomNumbers& random)
    : Low(range[0])
    , Width(range[1] > range[0] ? range[1] - range[0] : 1.0)
    , Random(random)
  {
  }

  void opacity(double place, double value)
  {
    this->Function.Opacity.push_back({ this->Low + place * this->Width, value });
  }

  void color(double place)
  {
    this->Function.Color.push_back({ this->Low + place * this->Width, randomColor(this->Random) });
  }

  LookFunction Function;

private:
  double Low;
  double Width;
  RandomNumbers& Random;
};

const char* const FunctionNames[] = { "ramps", "peaks", "steps", "opaque", "window" };

LookFunction randomFunction(
  int kind, const std::array<double, 2>& range, bool lengthCounts, RandomNumbers& random)
{
  FunctionMaker maker(range, random);
  const double strong = lengthCounts && kind == 3 ? 30.0 : 1.0;
  switch (kind)
  {
    case 1:
      for (const double place : { 0.2, 0.5, 0.8 })
      {
        const double middle = place + random.uniform(-0.1, 0.1);
        const double half = random.uniform(0.005, 0.05);
        maker.opacity(middle - half, 0.0);
        maker.opacity(middle, random.uniform(0.3, 1.0));
        maker.opacity(middle + half, 0.0);
      }
      break;
    case 2: // an even number of points: a jump at each second
      maker.opacity(0.0, random.uniform());
      for (const double place : { 0.3, 0.6, 0.85 })
      {
        const double at = place + random.uniform(-0.1, 0.1);
        maker.opacity(at, random.uniform());
        maker.opacity(at, random.uniform());
      }
      break;
    case 4:
    {
      const double low = random.uniform(0.1, 0.6);
      maker.opacity(low, 0.0);
      maker.opacity(low + 0.05, random.uniform(0.3, 1.0));
      maker.opacity(low + 0.25, random.uniform(0.3, 1.0));
      maker.opacity(low + 0.3, 0.0);
      break;
    }
    default:
      for (const double place : { 0.0, 0.3, 0.7, 1.0 })
      {
        maker.opacity(place + random.uniform(-0.1, 0.1), strong * random.uniform(0.05, 0.9));
      }
  }
  for (const double place : { 0.0, 0.4, 0.7, 1.0 })
  {
    maker.color(place + random.uniform(-0.05, 0.05));
  }
  if (kind == 2)
  {
    maker.color(1.0 + 0.06);
    maker.color(1.0 + 0.06);
  }
  return maker.Function;
}

//------------------------------------------------------------------------------
void setView(VolumeCase& test, RandomNumbers& random)
{
  double b[6];
  test.mesh().bounds(b);
  const double radius = 0.5 * diagonalOf(b);
  glm::dvec3 direction = random.direction();
  if (test.Membrane.Mesh)
  {
    // From above, at an angle steep enough to show more than the membrane's edge.
    direction.y = -std::fabs(direction.y) - 0.5;
  }
  const auto cell =
    static_cast<std::size_t>(random.below(static_cast<int>(test.mesh().Cells.size())));
  glm::dvec3 place(0.0);
  for (const vtkIdType id : test.mesh().Cells[cell].Ids)
  {
    place += test.mesh().Points[static_cast<std::size_t>(id)] /
      static_cast<double>(test.mesh().Cells[cell].Ids.size());
  }
  const int kind = random.below(test.Membrane.Mesh ? 2 : 6);
  test.View = VolumeView::towards(b, direction, kind == 1 || (kind == 4 && random.below(2)));
  VolumeView& view = test.View;
  if (kind == 2 || kind == 3)
  {
    test.Name += kind == 2 ? ", eye inside" : ", eye near";
    view.Eye = kind == 2 ? place : view.Focus - random.uniform(1.02, 1.3) * radius * direction;
    view.Focus = kind == 2 ? view.Eye + direction : place;
    view.HalfHeight = 0.7;
    view.Near = 1e-3 * radius;
    view.Far = 4.0 * radius;
  }
  else if (kind == 4)
  {
    test.Name += ", zoomed";
    view.Eye += place - view.Focus;
    view.Focus = place;
    view.HalfHeight /= random.uniform(4.0, 30.0);
    view.Near -= radius;
    view.Far += radius;
  }
  test.Name += view.Parallel ? ", parallel" : ", perspective";
}

//------------------------------------------------------------------------------
void setMembrane(VolumeCase& test, RandomNumbers& random)
{
  const int kind = random.below(3);
  const double level = random.uniform(-0.3, 1.1);
  const int cells = 2 + random.below(8);
  test.Membrane = kind == 0 ? makePlaneCase(level, 1.6, cells)
    : kind == 1             ? makeDomeCase(level, random.uniform(3.0, 6.0), 1.6, cells)
                            : makeWavesCase(level, 0.05, 4.0, 1.6, 8 + cells);
  test.Membrane.Surface.Exterior = random.below(4) ? 1.0 : 1.333;
  test.Membrane.Surface.Interior = random.below(4) ? 1.333 : 1.0;
  const char* const names[3] = { ", plane", ", dome", ", waves" };
  test.Name += names[kind];
}

//------------------------------------------------------------------------------
// Selects several components, gradients, or a mode other than compositing, as far as the needs
// allow.
void setMode(VolumeCase& test, const CaseNeeds& needs, RandomNumbers& random)
{
  VolumeLook& look = test.Look;
  const int kind = random.below(needs.Composite ? 5 : 10);
  if (kind == 3 && !needs.OneComponent)
  {
    const int components = 2 + random.below(3);
    setRandomFields(test.mesh(), components, needs.Linear, random);
    look.Independent = components == 3 || random.below(2) == 0;
    test.Name += ", components";
  }
  else if (kind == 4 && !needs.NoGradients)
  {
    look.Shade = random.below(3) != 0;
    look.Gradients = needs.NoVertexGradients ? 0 : random.below(2);
    if (!look.Shade || random.below(2))
    {
      look.GradientOpacity = { { 0.0, random.uniform() }, { random.uniform(0.5, 4.0), 1.0 } };
    }
    test.Name += look.Shade ? ", lit" : ", gradient opacity";
  }
  else if (kind >= 5)
  {
    const int modes[5] = { vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND,
      vtkVolumeMapper::MINIMUM_INTENSITY_BLEND, vtkVolumeMapper::AVERAGE_INTENSITY_BLEND,
      vtkVolumeMapper::ADDITIVE_BLEND, vtkVolumeMapper::ISOSURFACE_BLEND };
    const char* const names[5] = { ", maximum", ", minimum", ", average", ", additive",
      ", isosurfaces" };
    look.Blend = modes[kind - 5];
    test.Name += names[kind - 5];
    look.Gradients = needs.NoVertexGradients ? 0 : random.below(2);
    look.Shade = kind == 9 && !needs.NoGradients && random.below(2) == 0;
  }
}

void setFunctions(VolumeCase& test, RandomNumbers& random)
{
  VolumeLook& look = test.Look;
  double b[6];
  test.mesh().bounds(b);
  // Usually some units deep; one scene in four is nearly opaque on the scale of small cells.
  const double unit =
    random.below(4) ? random.uniform(0.05, 0.4) : std::pow(10.0, random.uniform(-4.0, -1.0));
  look.Unit = unit * diagonalOf(b);
  const int kind = random.below(5);
  test.Name += std::string(", ") + FunctionNames[kind];
  const bool lengthCounts =
    look.Blend == vtkVolumeMapper::COMPOSITE_BLEND && test.mesh().Components == 1;
  for (int c = 0; c < test.mesh().Components; ++c)
  {
    const std::array<double, 2> range = test.mesh().range(c);
    look.Functions.push_back(randomFunction(kind, range, lengthCounts, random));
    look.Functions.back().Weight = random.uniform(0.2, 1.0);
  }
  if (!look.Independent)
  {
    look.Functions.front().Opacity = look.Functions.back().Opacity;
    look.Functions.resize(1);
  }
  const std::array<double, 2> range = test.mesh().range(0);
  if (look.Blend == vtkVolumeMapper::ISOSURFACE_BLEND)
  {
    for (int i = 1 + random.below(3); i > 0; --i)
    {
      look.IsoValues.push_back(range[0] + random.uniform(0.05, 0.95) * (range[1] - range[0]));
    }
  }
}

// Scales colours to [0, 1].
void normaliseColors(MeshArrays& mesh)
{
  for (int c = 0; c + 1 < mesh.Components; ++c)
  {
    const std::array<double, 2> range = mesh.range(c);
    const double width = range[1] > range[0] ? range[1] - range[0] : 1.0;
    for (std::size_t i = 0; i < mesh.tuples(); ++i)
    {
      double& value = mesh.Values[i * static_cast<std::size_t>(mesh.Components) + c];
      value = std::clamp((value - range[0]) / width, 0.0, 1.0);
    }
  }
}

// Offsets the scalars far from 0, relative to their range.
void offsetValues(MeshArrays& mesh, RandomNumbers& random)
{
  const double offset = std::pow(10.0, random.uniform(0.0, 5.0));
  const bool colors = mesh.Components == 4;
  for (double& value : mesh.Values)
  {
    value += colors ? 0.0 : offset;
  }
}

FamilyMesh chooseMesh(const CaseNeeds& needs, RandomNumbers& random)
{
  for (;;)
  {
    MeshFamily family = randomFamily(random);
    if (family == MeshFamily::Data && needs.Small)
    {
      family = MeshFamily::RandomPoints;
    }
    FamilyMesh mesh = makeFamilyMesh(family, needs.Linear, random);
    if ((!needs.Tetrahedra || mesh.Mesh.isTetrahedral()) && !mesh.Mesh.Cells.empty())
    {
      return mesh;
    }
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
VolumeCase randomCase(const CaseNeeds& needs, RandomNumbers& random)
{
  const FamilyMesh family = chooseMesh(needs, random);
  VolumeCase test;
  test.Name = family.Name;
  test.Linear = family.Linear;
  test.Blocks = { family.Mesh };
  if (needs.Membrane || (!needs.NoMembrane && random.below(4) == 0))
  {
    setMembrane(test, random);
  }
  setMode(test, needs, random);
  if (!test.Look.Independent && test.mesh().Components == 4)
  {
    normaliseColors(test.mesh());
  }
  const bool mayBeOnCells = !needs.NoCellData && !needs.Linear && test.mesh().Components == 1 &&
    !test.hasGradients() && test.Look.Blend != vtkVolumeMapper::ISOSURFACE_BLEND;
  if (mayBeOnCells && random.below(6) == 0)
  {
    moveToCells(test.mesh());
    test.Name += ", cell data";
  }
  if (random.below(4) == 0)
  {
    test.Name += ", offset scalars";
    offsetValues(test.mesh(), random);
  }
  setFunctions(test, random);
  setView(test, random);
  if (!test.Membrane.Mesh && random.below(4) == 0)
  {
    test.Name += ", elsewhere";
    const double scale = std::pow(10.0, random.uniform(-6.0, 6.0));
    const glm::dvec3 offset = scale * std::pow(10.0, random.uniform(0.0, 6.0)) * random.direction();
    mapScene(test, glm::scale(glm::translate(glm::dmat4(1.0), offset), glm::dvec3(scale)));
  }
  // Shaders are far slower where OpenGL is software: they draw half of the cases.
  const int backends[4] = { vtkTetrahedraRayCastMapper::NATIVE, vtkTetrahedraRayCastMapper::NATIVE,
    vtkTetrahedraRayCastMapper::OPENGL, vtkTetrahedraRayCastMapper::COMPUTE };
  test.Backend = backends[random.below(4)];
  return test;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkVolumeProperty> toProperty(const VolumeLook& look)
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetIndependentComponents(look.Independent);
  property->SetInterpolationTypeToLinear();
  for (int c = 0; c < static_cast<int>(look.Functions.size()); ++c)
  {
    const LookFunction& function = look.Functions[static_cast<std::size_t>(c)];
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AllowDuplicateScalarsOn();
    for (const auto& point : function.Opacity)
    {
      opacity->AddPoint(point.Scalar, point.Opacity);
    }
    vtkNew<vtkColorTransferFunction> color;
    color->AllowDuplicateScalarsOn();
    for (const auto& point : function.Color)
    {
      color->AddRGBPoint(point.Scalar, point.Color[0], point.Color[1], point.Color[2]);
    }
    property->SetScalarOpacity(c, opacity);
    property->SetColor(c, color);
    property->SetScalarOpacityUnitDistance(c, look.Unit);
    property->SetComponentWeight(c, function.Weight);
  }
  for (int i = 0; i < static_cast<int>(look.IsoValues.size()); ++i)
  {
    property->GetIsoSurfaceValues()->SetValue(i, look.IsoValues[static_cast<std::size_t>(i)]);
  }
  property->SetShade(look.Shade);
  property->SetAmbient(look.Ambient);
  property->SetDiffuse(look.Diffuse);
  property->SetSpecular(look.Specular);
  property->SetSpecularPower(look.SpecularPower);
  if (!look.GradientOpacity.empty())
  {
    vtkNew<vtkPiecewiseFunction> function;
    for (const auto& point : look.GradientOpacity)
    {
      function->AddPoint(point.Scalar, point.Opacity);
    }
    property->SetGradientOpacity(function);
  }
  return property;
}

//------------------------------------------------------------------------------
void mapScalars(VolumeLook& look, double factor, double offset, double lengthFactor)
{
  for (LookFunction& function : look.Functions)
  {
    for (auto& point : function.Opacity)
    {
      point.Scalar = factor * point.Scalar + offset;
    }
    for (auto& point : function.Color)
    {
      point.Scalar = factor * point.Scalar + offset;
    }
  }
  for (double& value : look.IsoValues)
  {
    value = factor * value + offset;
  }
  for (auto& point : look.GradientOpacity)
  {
    point.Scalar *= factor / lengthFactor;
  }
  look.Unit *= lengthFactor;
}

} // namespace test
} // namespace meniscus
