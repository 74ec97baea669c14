// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Global illumination in every combination of blend mode, kind of data, kind of light and clipping
// plane, against closed forms: a cube of constant attenuation that scatters light, two parallel
// isosurfaces, and modes that show no light.
#include "OpticsTruth.h"

#include <vtkLightCollection.h>

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Cubes = 8; // on a side of [-1, 1]^3
constexpr double CubeSize = 2.0 / Cubes;
constexpr double Attenuation = 0.4;
constexpr double Color[3] = { 1.0, 0.5, 0.25 };
/** Even: no ray passes along edges of cells. */
constexpr int Size = 32;
/** Heights of the isosurfaces, and their opacities. */
constexpr double Heights[2] = { -0.5, 0.5 };
constexpr double Opacities[2] = { 0.6, 0.5 };
constexpr int IsosurfaceMode = 5;

enum class Data
{
  Points,
  Cells,
  IndependentComponents,
  ColorAndOpacity,
  ColorsAsTheyAre
};

enum class LightKind
{
  Sun,
  Lamp,
  Spot,
  Headlight,
  CameraLight,
  SunAndLamp
};
constexpr LightKind LightKinds[] = { LightKind::Sun, LightKind::Lamp, LightKind::Spot,
  LightKind::Headlight, LightKind::CameraLight, LightKind::SunAndLamp };

struct MatrixCase
{
  const char* Name;
  int BlendMode;
  Data Kind;
};

void PrintTo(const MatrixCase& tested, std::ostream* os)
{
  *os << tested.Name;
}

int ComponentsOf(Data kind)
{
  switch (kind)
  {
    case Data::IndependentComponents:
    case Data::ColorAndOpacity:
      return 2;
    case Data::ColorsAsTheyAre:
      return 4;
    default:
      return 1;
  }
}

/** The height at points or in cells; constants if there are several components. */
Grid MakeData(Data kind)
{
  Grid grid = MakeBlock(Cubes, [](double, double, double z) { return z; });
  const int components = ComponentsOf(kind);
  vtkNew<vtkDoubleArray> values;
  values->SetName("values");
  values->SetNumberOfComponents(components);
  if (kind == Data::Cells)
  {
    double bounds[6];
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      grid->GetCellBounds(cell, bounds);
      values->InsertNextValue(0.5 * (bounds[4] + bounds[5]));
    }
    grid->GetPointData()->SetScalars(nullptr);
    grid->GetCellData()->SetScalars(values);
  }
  else if (components > 1)
  {
    const std::array<double, 4> constants{ Color[0], Color[1], Color[2], 1.0 };
    for (vtkIdType point = 0; point < grid->GetNumberOfPoints(); ++point)
    {
      values->InsertNextTuple(constants.data());
    }
    grid->GetPointData()->SetScalars(values);
  }
  return grid;
}

/** A property whose light does not depend on the scalars but by isosurfaces. */
vtkSmartPointer<vtkVolumeProperty> MakeLook(const MatrixCase& tested)
{
  const bool isTwice = tested.Kind == Data::IndependentComponents;
  const double unit = (isTwice ? 2.0 : 1.0) / Attenuation;
  auto property = MakeConstantProperty(1.0, Color[0], Color[1], Color[2], unit);
  if (isTwice)
  {
    property->SetColor(1, property->GetRGBTransferFunction(0));
    property->SetScalarOpacity(1, property->GetScalarOpacity(0));
    property->SetScalarOpacityUnitDistance(1, unit);
  }
  property->SetIndependentComponents(isTwice ? 1 : 0);
  if (tested.BlendMode == IsosurfaceMode)
  {
    vtkNew<vtkPiecewiseFunction> opacity;
    for (int i = 0; i < 2; ++i)
    {
      property->GetIsoSurfaceValues()->SetValue(i, Heights[i]);
      opacity->AddPoint(Heights[i], Opacities[i]);
    }
    property->SetScalarOpacity(opacity);
  }
  property->ShadeOn();
  property->SetAmbient(0.0);
  property->SetDiffuse(1.0);
  property->SetSpecular(0.0);
  return property;
}

void AddLamp(vtkRenderer* renderer, double coneAngle, double intensity)
{
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetPosition(0.5, 0.3, 4.0);
  lamp->SetFocalPoint(0.0, 0.0, 0.0);
  lamp->SetConeAngle(coneAngle);
  lamp->SetExponent(1.0);
  lamp->SetIntensity(intensity);
  renderer->AddLight(lamp);
}

void AddLights(vtkRenderer* renderer, LightKind kind)
{
  renderer->AutomaticLightCreationOff();
  renderer->RemoveAllLights();
  vtkNew<vtkLight> light;
  light->SetFocalPoint(0.0, 0.0, 0.0);
  switch (kind)
  {
    case LightKind::Lamp:
      AddLamp(renderer, 180.0, 0.9);
      return;
    case LightKind::Spot:
      // The cube is within 31 degrees of the axis.
      AddLamp(renderer, 60.0, 0.9);
      return;
    case LightKind::Headlight:
      light->SetLightTypeToHeadlight();
      break;
    case LightKind::CameraLight:
      light->SetLightTypeToCameraLight();
      light->SetPosition(0.5, 0.4, 1.0);
      break;
    default:
      light->SetLightTypeToSceneLight();
      light->SetPosition(-0.5, 0.25, 1.0);
      light->SetIntensity(0.6);
      if (kind == LightKind::SunAndLamp)
      {
        AddLamp(renderer, 180.0, 0.3);
      }
  }
  renderer->AddLight(light);
}

/** The cube, or the part of it on the visible side of a clipping plane. */
struct Box
{
  Vector3 Lower{ -1.0, -1.0, -1.0 };
  Vector3 Upper{ 1.0, 1.0, 1.0 };

  /** Length of a line from a place until it leaves the box; 0 if it begins outside. */
  double LengthFrom(const Vector3& place, const Vector3& direction) const
  {
    return std::max(this->LengthTo(this->AxisFrom(place, direction), place, direction), 0.0);
  }
  /** Axis across the side by which the line leaves the box. */
  int AxisFrom(const Vector3& place, const Vector3& direction) const
  {
    int nearest = 0;
    for (int i = 1; i < 3; ++i)
    {
      const bool isNearer =
        this->LengthTo(i, place, direction) < this->LengthTo(nearest, place, direction);
      nearest = isNearer ? i : nearest;
    }
    return nearest;
  }

private:
  double LengthTo(int axis, const Vector3& place, const Vector3& direction) const
  {
    const Vector3& side = direction[axis] > 0.0 ? this->Upper : this->Lower;
    return direction[axis] != 0.0 ? (side[axis] - place[axis]) / direction[axis]
                                  : std::numeric_limits<double>::infinity();
  }
};

/** Direction to a light, distance, and its strength at a place. */
struct Incoming
{
  Vector3 Direction;
  double Distance = std::numeric_limits<double>::infinity();
  double Strength = 0.0;
};

Incoming LightAt(vtkLight* light, const Vector3& place)
{
  double position[3];
  double focus[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focus);
  Vector3 axis;
  Vector3 step;
  for (int i = 0; i < 3; ++i)
  {
    axis[i] = position[i] - focus[i];
    step[i] = light->GetPositional() ? position[i] - place[i] : axis[i];
  }
  const double size = MakeLength(step);
  Incoming incoming;
  incoming.Strength = light->GetIntensity();
  double cosine = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    incoming.Direction[i] = step[i] / size;
    cosine += incoming.Direction[i] * axis[i] / MakeLength(axis);
  }
  if (light->GetPositional())
  {
    incoming.Distance = size;
    // The exponent, 1, acts within cones.
    incoming.Strength *= light->GetConeAngle() < 90.0 ? cosine : 1.0;
  }
  return incoming;
}

Vector3 PlaceOn(const Ray& ray, double at)
{
  return { ray.Origin[0] + at * ray.Direction[0], ray.Origin[1] + at * ray.Direction[1],
    ray.Origin[2] + at * ray.Direction[2] };
}

std::vector<vtkLight*> LightsOf(vtkRenderer* renderer)
{
  std::vector<vtkLight*> lights;
  vtkCollectionSimpleIterator cookie;
  renderer->GetLights()->InitTraversal(cookie);
  while (vtkLight* light = renderer->GetLights()->GetNextLight(cookie))
  {
    lights.push_back(light);
  }
  return lights;
}

/** True if light comes to the neighbourhood of a place, a cell around, by several sides. */
bool IsAtKink(const Box& box, const Vector3& place, const Vector3& toLight)
{
  const int axis = box.AxisFrom(place, toLight);
  for (int corner = 0; corner < 8; ++corner)
  {
    Vector3 near = place;
    for (int i = 0; i < 3; ++i)
    {
      near[i] += (corner >> i & 1) != 0 ? CubeSize : -CubeSize;
    }
    if (box.AxisFrom(near, toLight) != axis)
    {
      return true;
    }
  }
  return false;
}

/** A value, and the part of it whose light comes to the cells around by several sides. */
struct MediumTruth
{
  double Light = 0.0;
  double AtKinks = 0.0;
};

/** Light that the medium scatters along a ray, by Simpson's rule. */
MediumTruth TruthOfMedium(const Box& box, const Ray& ray, const std::vector<vtkLight*>& lights)
{
  // The ray is parallel to an axis: it enters by the side that is met last.
  double begin = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    if (std::fabs(ray.Direction[i]) > 0.5)
    {
      begin =
        ((ray.Direction[i] > 0.0 ? box.Lower : box.Upper)[i] - ray.Origin[i]) / ray.Direction[i];
    }
  }
  const double length = box.LengthFrom(PlaceOn(ray, begin), ray.Direction);
  constexpr int steps = 64;
  MediumTruth sum;
  for (int k = 0; k <= steps; ++k)
  {
    const double way = length * k / steps;
    const Vector3 place = PlaceOn(ray, begin + way);
    double light = 0.0;
    double atKinks = 0.0;
    for (vtkLight* source : lights)
    {
      const Incoming incoming = LightAt(source, place);
      const double shadow = std::min(box.LengthFrom(place, incoming.Direction), incoming.Distance);
      const double reached = incoming.Strength * std::exp(-Attenuation * shadow);
      light += reached;
      atKinks += IsAtKink(box, place, incoming.Direction) ? reached : 0.0;
    }
    const double weight = (k == 0 || k == steps ? 1.0 : k % 2 != 0 ? 4.0 : 2.0) / 3.0;
    const double seen = weight * Attenuation * std::exp(-Attenuation * way) * length / steps;
    sum.Light += seen * light;
    sum.AtKinks += seen * atKinks;
  }
  return sum;
}

/** True if the upper surface hides a light from a place of the lower one; far: by a margin. */
bool IsShadowed(const Box& box, const Vector3& place, const Vector3& toLight, double margin)
{
  const double way = (Heights[1] - Heights[0]) / toLight[2];
  for (int i = 0; i < 2; ++i)
  {
    const double met = place[i] + way * toLight[i];
    if (met < box.Lower[i] + margin || met > box.Upper[i] - margin)
    {
      return false;
    }
  }
  return true;
}

/** Light of both surfaces, seen from above; negative within two cells of a shadow's border. */
double TruthOfSurfaces(const Box& box, const Ray& ray, const std::vector<vtkLight*>& lights)
{
  double sum = 0.0;
  double seen = 1.0;
  for (int surface = 1; surface >= 0; --surface)
  {
    const Vector3 place = PlaceOn(ray, (Heights[surface] - ray.Origin[2]) / ray.Direction[2]);
    double light = 0.0;
    for (vtkLight* source : lights)
    {
      const Incoming incoming = LightAt(source, place);
      const bool isShadowed =
        surface == 0 && IsShadowed(box, place, incoming.Direction, 2.0 * CubeSize);
      if (surface == 0 && !isShadowed &&
        IsShadowed(box, place, incoming.Direction, -2.0 * CubeSize))
      {
        return -1.0;
      }
      light += incoming.Strength * incoming.Direction[2] * (isShadowed ? 1.0 - Opacities[1] : 1.0);
    }
    sum += seen * Opacities[surface] * light;
    seen *= 1.0 - Opacities[surface];
  }
  return sum;
}

class TetrahedraRayCastShadowsMatrix : public ::testing::TestWithParam<MatrixCase>
{
};

/** A scene of a case, clipped or not. */
struct MatrixScene
{
  MatrixScene(const MatrixCase& tested, bool isClipped)
    : Mesh(MakeData(tested.Kind))
    , Scene(this->Mesh, MakeLook(tested), Size, Size)
  {
    vtkTetrahedraRayCastMapper* mapper = this->Scene.GetRayCaster();
    mapper->SetBlendMode(tested.BlendMode);
    mapper->SetGlobalIlluminationReach(1.0f);
    mapper->SetVolumetricScatteringBlending(2.0f);
    mapper->SetEarlyTerminationOpacity(1.0);
    if (tested.Kind == Data::Cells)
    {
      mapper->SetScalarModeToUseCellData();
    }
    if (isClipped)
    {
      // Along faces of cells: all vertices of cells that are drawn are kept.
      this->Drawn.Upper[0] = CubeSize;
      AddClippingPlane(mapper, { { -1.0, 0.0, 0.0 }, { CubeSize, 0.0, 0.0 } });
    }
    const bool isMedium = tested.BlendMode == vtkVolumeMapper::COMPOSITE_BLEND;
    LookAlongAxis(this->Scene.GetRenderer(), this->Mesh->GetBounds(), isMedium ? 0 : 2);
  }

  double GetCasts() { return this->Scene.GetRayCaster()->GetStatistic("NumberOfShadowCasts"); }

  Grid Mesh;
  RayCastScene Scene;
  Box Drawn;
};

/** Compares the pixels of a picture whose truth is known; returns their number. */
int ExpectClosedForm(MatrixScene& drawn, const MatrixCase& tested)
{
  const bool isMedium = tested.BlendMode == vtkVolumeMapper::COMPOSITE_BLEND;
  const FloatImage image = drawn.Scene.RenderFloat();
  const PixelRays rays(drawn.Scene.GetRenderer());
  const std::vector<vtkLight*> lights = LightsOf(drawn.Scene.GetRenderer());
  // A line across a cell has an optical depth of up to the root of 3 times that of its edge: the
  // light is off by at most the square of that / 8. Where it comes by another side of the box than
  // next to it, the slope of its way jumps by no more than 6, since the components of directions
  // are a fifth or more: in a cell, it is off by a quarter of that depth.
  constexpr double depth = Attenuation * CubeSize;
  constexpr double smooth = 3.0 * depth * depth / 8.0;
  constexpr double atKinks = 6.0 * depth / 4.0;
  int visible = 0;
  for (int y = 0; y < image.Height; ++y)
  {
    for (int x = 0; x < image.Width; ++x)
    {
      const Ray ray = rays.GetRay(x, y);
      const int across = isMedium ? 1 : 0;
      const int up = across + 1;
      const Box& box = drawn.Drawn;
      constexpr double inside = 0.5 * CubeSize;
      if (ray.Origin[across] < box.Lower[across] + inside ||
        ray.Origin[across] > box.Upper[across] - inside || std::fabs(ray.Origin[up]) > 1.0 - inside)
      {
        continue;
      }
      const MediumTruth medium = isMedium ? TruthOfMedium(box, ray, lights) : MediumTruth();
      const double truth = isMedium ? medium.Light : TruthOfSurfaces(box, ray, lights);
      const double tolerance =
        isMedium ? smooth * static_cast<double>(lights.size()) + atKinks * medium.AtKinks : 1.0e-3;
      if (truth < 0.0)
      {
        continue;
      }
      visible += tolerance < 0.1 * truth ? 1 : 0;
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(image.GetPixel(x, y)[c], Color[c] * truth, tolerance) << x << " " << y;
        if (::testing::Test::HasFailure())
        {
          return 0;
        }
      }
    }
  }
  return visible;
}

} // anonymous namespace

TEST_P(TetrahedraRayCastShadowsMatrix, HasClosedForm)
{
  const MatrixCase& tested = GetParam();
  const bool showsLight =
    tested.BlendMode == vtkVolumeMapper::COMPOSITE_BLEND || tested.BlendMode == IsosurfaceMode;
  for (const bool isClipped : { false, true })
  {
    MatrixScene drawn(tested, isClipped);
    const auto observer = ObserveErrors(drawn.Scene.GetRayCaster());
    int visible = 0;
    for (const LightKind kind : LightKinds)
    {
      SCOPED_TRACE(
        "light " + std::to_string(static_cast<int>(kind)) + (isClipped ? ", clipped" : ""));
      AddLights(drawn.Scene.GetRenderer(), kind);
      if (showsLight)
      {
        visible += ExpectClosedForm(drawn, tested);
        // At least one light and the 32 directions of the ambient light.
        EXPECT_GE(drawn.GetCasts(), 33.0);
      }
      else
      {
        const FloatImage image = drawn.Scene.RenderFloat();
        drawn.Scene.GetRayCaster()->SetGlobalIlluminationReach(0.0f);
        EXPECT_EQ(drawn.Scene.RenderFloat().Rgba, image.Rgba);
        drawn.Scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
        EXPECT_EQ(drawn.GetCasts(), 0.0);
      }
      if (::testing::Test::HasFailure())
      {
        return;
      }
    }
    EXPECT_EQ(observer->GetText(), "");
    EXPECT_GE(visible, showsLight ? 100 : 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Combinations, TetrahedraRayCastShadowsMatrix,
  ::testing::Values(MatrixCase{ "CompositePoints", vtkVolumeMapper::COMPOSITE_BLEND, Data::Points },
    MatrixCase{ "CompositeCells", vtkVolumeMapper::COMPOSITE_BLEND, Data::Cells },
    MatrixCase{
      "CompositeIndependent", vtkVolumeMapper::COMPOSITE_BLEND, Data::IndependentComponents },
    MatrixCase{
      "CompositeColorAndOpacity", vtkVolumeMapper::COMPOSITE_BLEND, Data::ColorAndOpacity },
    MatrixCase{
      "CompositeColorsAsTheyAre", vtkVolumeMapper::COMPOSITE_BLEND, Data::ColorsAsTheyAre },
    MatrixCase{ "IsosurfacesPoints", IsosurfaceMode, Data::Points },
    MatrixCase{ "IsosurfacesCells", IsosurfaceMode, Data::Cells },
    MatrixCase{ "MaximumPoints", vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, Data::Points },
    MatrixCase{ "MaximumCells", vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, Data::Cells },
    MatrixCase{ "MinimumPoints", vtkVolumeMapper::MINIMUM_INTENSITY_BLEND, Data::Points },
    MatrixCase{ "MinimumCells", vtkVolumeMapper::MINIMUM_INTENSITY_BLEND, Data::Cells },
    MatrixCase{ "AveragePoints", vtkVolumeMapper::AVERAGE_INTENSITY_BLEND, Data::Points },
    MatrixCase{ "AverageCells", vtkVolumeMapper::AVERAGE_INTENSITY_BLEND, Data::Cells },
    MatrixCase{ "AdditivePoints", vtkVolumeMapper::ADDITIVE_BLEND, Data::Points },
    MatrixCase{ "AdditiveCells", vtkVolumeMapper::ADDITIVE_BLEND, Data::Cells }),
  [](const auto& tested) { return std::string(tested.param.Name); });
