// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeCase.h"

#include "MapScene.h"
#include "MeshFamilies.h"
#include "ProjectionModes.h"

#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus::test
{

namespace
{

std::array<double, 3> RandomColor(RandomNumbers& random)
{
  const double r = random.Uniform();
  const double g = random.Uniform();
  return { r, g, random.Uniform() };
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

  void GetOpacity(double place, double value)
  {
    this->Function.Opacity.push_back({ this->Low + place * this->Width, value });
  }

  void GetColor(double place)
  {
    this->Function.Color.push_back({ this->Low + place * this->Width, RandomColor(this->Random) });
  }

  LookFunction Function;

private:
  double Low;
  double Width;
  RandomNumbers& Random;
};

const char* const FunctionNames[] = { "ramps", "peaks", "steps", "opaque", "window" };

LookFunction RandomFunction(
  int kind, const std::array<double, 2>& range, bool lengthCounts, RandomNumbers& random)
{
  FunctionMaker maker(range, random);
  const double strong = lengthCounts && kind == 3 ? 30.0 : 1.0;
  switch (kind)
  {
    case 1:
      for (const double place : { 0.2, 0.5, 0.8 })
      {
        const double middle = place + random.Uniform(-0.1, 0.1);
        const double half = random.Uniform(0.005, 0.05);
        maker.GetOpacity(middle - half, 0.0);
        maker.GetOpacity(middle, random.Uniform(0.3, 1.0));
        maker.GetOpacity(middle + half, 0.0);
      }
      break;
    case 2: // an even number of points: a jump at each second
      maker.GetOpacity(0.0, random.Uniform());
      for (const double place : { 0.3, 0.6, 0.85 })
      {
        const double at = place + random.Uniform(-0.1, 0.1);
        maker.GetOpacity(at, random.Uniform());
        maker.GetOpacity(at, random.Uniform());
      }
      break;
    case 4:
    {
      const double low = random.Uniform(0.1, 0.6);
      maker.GetOpacity(low, 0.0);
      maker.GetOpacity(low + 0.05, random.Uniform(0.3, 1.0));
      maker.GetOpacity(low + 0.25, random.Uniform(0.3, 1.0));
      maker.GetOpacity(low + 0.3, 0.0);
      break;
    }
    default:
      for (const double place : { 0.0, 0.3, 0.7, 1.0 })
      {
        maker.GetOpacity(place + random.Uniform(-0.1, 0.1), strong * random.Uniform(0.05, 0.9));
      }
  }
  for (const double place : { 0.0, 0.4, 0.7, 1.0 })
  {
    maker.GetColor(place + random.Uniform(-0.05, 0.05));
  }
  if (kind == 2)
  {
    maker.GetColor(1.0 + 0.06);
    maker.GetColor(1.0 + 0.06);
  }
  return maker.Function;
}

//------------------------------------------------------------------------------
void SetView(VolumeCase& test, RandomNumbers& random)
{
  double b[6];
  test.MakeMesh().GetBounds(b);
  const double radius = 0.5 * DiagonalOf(b);
  glm::dvec3 direction = random.GetDirection();
  if (test.Membrane.Mesh)
  {
    // From above, at an angle steep enough to show more than the membrane's edge.
    direction.y = -std::fabs(direction.y) - 0.5;
  }
  const auto cell =
    static_cast<std::size_t>(random.Below(static_cast<int>(test.MakeMesh().Cells.size())));
  glm::dvec3 place(0.0);
  for (const vtkIdType id : test.MakeMesh().Cells[cell].Ids)
  {
    place += test.MakeMesh().Points[static_cast<std::size_t>(id)] /
      static_cast<double>(test.MakeMesh().Cells[cell].Ids.size());
  }
  const int kind = random.Below(test.Membrane.Mesh ? 2 : 6);
  test.View = VolumeView::Towards(b, direction, kind == 1 || (kind == 4 && random.Below(2)));
  VolumeView& view = test.View;
  if (kind == 2 || kind == 3)
  {
    test.Name += kind == 2 ? ", eye inside" : ", eye near";
    view.Eye = kind == 2 ? place : view.Focus - random.Uniform(1.02, 1.3) * radius * direction;
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
    view.HalfHeight /= random.Uniform(4.0, 30.0);
    view.Near -= radius;
    view.Far += radius;
  }
  test.Name += view.Parallel ? ", parallel" : ", perspective";
}

//------------------------------------------------------------------------------
void SetMembrane(VolumeCase& test, RandomNumbers& random)
{
  const int kind = random.Below(3);
  const double level = random.Uniform(-0.3, 1.1);
  const int cells = 2 + random.Below(8);
  test.Membrane = kind == 0 ? MakePlaneCase(level, 1.6, cells)
    : kind == 1             ? MakeDomeCase(level, random.Uniform(3.0, 6.0), 1.6, cells)
                            : MakeWavesCase(level, 0.05, 4.0, 1.6, 8 + cells);
  test.Membrane.Surface.Exterior = random.Below(4) ? 1.0 : 1.333;
  test.Membrane.Surface.Interior = random.Below(4) ? 1.333 : 1.0;
  const char* const names[3] = { ", plane", ", dome", ", waves" };
  test.Name += names[kind];
}

//------------------------------------------------------------------------------
// Selects several components, gradients, or a mode other than compositing, as far as the needs
// allow.
void SetMode(VolumeCase& test, const CaseNeeds& needs, RandomNumbers& random)
{
  VolumeLook& look = test.Look;
  const int numberOfProjections = static_cast<int>(std::size(ProjectionModes));
  const int kind = random.Below(needs.Composite ? 5 : 5 + numberOfProjections + 1);
  if (kind == 3 && !needs.OneComponent)
  {
    const int components = 2 + random.Below(3);
    SetRandomFields(test.MakeMesh(), components, needs.Linear, random);
    look.Independent = components == 3 || random.Below(2) == 0;
    test.Name += ", components";
  }
  else if (kind == 4 && !needs.NoGradients)
  {
    look.Shade = random.Below(3) != 0;
    look.Gradients = needs.NoVertexGradients ? 0 : random.Below(2);
    if (!look.Shade || random.Below(2))
    {
      look.GradientOpacity = { { 0.0, random.Uniform() }, { random.Uniform(0.5, 4.0), 1.0 } };
    }
    test.Name += look.Shade ? ", lit" : ", gradient opacity";
  }
  else if (kind >= 5)
  {
    const bool isProjection = kind < 5 + numberOfProjections;
    look.Blend =
      isProjection ? ProjectionModes[kind - 5].Number : int(vtkVolumeMapper::ISOSURFACE_BLEND);
    test.Name +=
      std::string(", ") + (isProjection ? ProjectionModes[kind - 5].Name : "isosurfaces");
    look.Gradients = needs.NoVertexGradients ? 0 : random.Below(2);
    look.Shade = !isProjection && !needs.NoGradients && random.Below(2) == 0;
  }
}

void SetFunctions(VolumeCase& test, RandomNumbers& random)
{
  VolumeLook& look = test.Look;
  double b[6];
  test.MakeMesh().GetBounds(b);
  // Usually some units deep; one scene in four is nearly opaque on the scale of small cells.
  const double unit =
    random.Below(4) ? random.Uniform(0.05, 0.4) : std::pow(10.0, random.Uniform(-4.0, -1.0));
  look.Unit = unit * DiagonalOf(b);
  const int kind = random.Below(5);
  test.Name += std::string(", ") + FunctionNames[kind];
  const bool lengthCounts =
    look.Blend == vtkVolumeMapper::COMPOSITE_BLEND && test.MakeMesh().Components == 1;
  for (int c = 0; c < test.MakeMesh().Components; ++c)
  {
    const std::array<double, 2> range = test.MakeMesh().MakeRange(c);
    look.Functions.push_back(RandomFunction(kind, range, lengthCounts, random));
    look.Functions.back().Weight = random.Uniform(0.2, 1.0);
  }
  if (!look.Independent)
  {
    look.Functions.front().Opacity = look.Functions.back().Opacity;
    look.Functions.resize(1);
  }
  const std::array<double, 2> range = test.MakeMesh().MakeRange(0);
  if (look.Blend == vtkVolumeMapper::ISOSURFACE_BLEND)
  {
    for (int i = 1 + random.Below(3); i > 0; --i)
    {
      look.IsoValues.push_back(range[0] + random.Uniform(0.05, 0.95) * (range[1] - range[0]));
    }
  }
}

// Scales colours to [0, 1].
void NormaliseColors(MeshArrays& mesh)
{
  for (int c = 0; c + 1 < mesh.Components; ++c)
  {
    const std::array<double, 2> range = mesh.MakeRange(c);
    const double width = range[1] > range[0] ? range[1] - range[0] : 1.0;
    for (std::size_t i = 0; i < mesh.Tuples(); ++i)
    {
      double& value = mesh.Values[i * static_cast<std::size_t>(mesh.Components) + c];
      value = std::clamp((value - range[0]) / width, 0.0, 1.0);
    }
  }
}

// Offsets the scalars far from 0, relative to their range.
void OffsetValues(MeshArrays& mesh, RandomNumbers& random)
{
  const double offset = std::pow(10.0, random.Uniform(0.0, 5.0));
  const bool colors = mesh.Components == 4;
  for (double& value : mesh.Values)
  {
    value += colors ? 0.0 : offset;
  }
}

bool IsFolded(const MeshArrays& mesh)
{
  std::vector<double> points;
  for (const glm::dvec3& p : mesh.Points)
  {
    points.insert(points.end(), { p.x, p.y, p.z });
  }
  std::vector<std::int64_t> ids;
  for (const MeshTetrahedron& tetrahedron : TetrahedraOf(mesh))
  {
    ids.insert(ids.end(), tetrahedron.Ids.begin(), tetrahedron.Ids.end());
  }
  std::vector<double> scalars(mesh.Points.size());
  const reference::ReferenceMesh cells(std::move(points), std::move(ids), std::move(scalars));
  return cells.NumberOfInvertedCells() > 0;
}

FamilyMesh ChooseMesh(const CaseNeeds& needs, RandomNumbers& random)
{
  for (;;)
  {
    MeshFamily family = RandomFamily(random);
    if (family == MeshFamily::Data && needs.Small)
    {
      family = MeshFamily::RandomPoints;
    }
    FamilyMesh mesh = MakeFamilyMesh(family, needs.Linear, random);
    if ((!needs.Tetrahedra || mesh.Mesh.IsTetrahedral()) && !mesh.Mesh.Cells.empty() &&
      !(needs.NoFolds && IsFolded(mesh.Mesh)))
    {
      return mesh;
    }
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
VolumeCase RandomCase(const CaseNeeds& needs, RandomNumbers& random)
{
  const FamilyMesh family = ChooseMesh(needs, random);
  VolumeCase test;
  test.Name = family.Name;
  test.Linear = family.Linear;
  test.Blocks = { family.Mesh };
  if (needs.Membrane || (!needs.NoMembrane && random.Below(4) == 0))
  {
    SetMembrane(test, random);
  }
  SetMode(test, needs, random);
  if (!test.Look.Independent && test.MakeMesh().Components == 4)
  {
    NormaliseColors(test.MakeMesh());
  }
  const bool mayBeOnCells = !needs.NoCellData && !needs.Linear && test.MakeMesh().Components == 1 &&
    !test.HasGradients() && test.Look.Blend != vtkVolumeMapper::ISOSURFACE_BLEND;
  if (mayBeOnCells && random.Below(6) == 0)
  {
    MoveToCells(test.MakeMesh());
    test.Name += ", cell data";
  }
  if (random.Below(4) == 0)
  {
    test.Name += ", offset scalars";
    OffsetValues(test.MakeMesh(), random);
  }
  SetFunctions(test, random);
  SetView(test, random);
  if (!test.Membrane.Mesh && random.Below(4) == 0)
  {
    test.Name += ", elsewhere";
    const double scale = std::pow(10.0, random.Uniform(-6.0, 6.0));
    const glm::dvec3 offset =
      scale * std::pow(10.0, random.Uniform(0.0, 6.0)) * random.GetDirection();
    MapScene(test, glm::scale(glm::translate(glm::dmat4(1.0), offset), glm::dvec3(scale)));
  }
  // Shaders are far slower where OpenGL is software: they draw half of the cases.
  const int backends[4] = { vtkTetrahedraRayCastMapper::NATIVE, vtkTetrahedraRayCastMapper::NATIVE,
    vtkTetrahedraRayCastMapper::OPENGL, vtkTetrahedraRayCastMapper::COMPUTE };
  test.Backend = backends[random.Below(4)];
  return test;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkVolumeProperty> ToProperty(const VolumeLook& look)
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
void MapScalars(VolumeLook& look, double factor, double offset, double lengthFactor)
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

} // namespace meniscus::test
