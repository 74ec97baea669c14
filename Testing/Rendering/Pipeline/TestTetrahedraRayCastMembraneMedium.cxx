// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Volumes behind flat membranes, seen through a medium that takes and scatters light, compared with
// closed forms.
#include "MembraneScene.h"
#include "OpticsTruth.h"

#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 96;
constexpr double Block[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
constexpr double Attenuation = 0.875;
constexpr double Colors[3] = { 0.9, 0.5, 0.2 };
constexpr double Range[2] = { -1.0, 1.0 };

double Tolerance()
{
  return BackendUnderTest() == vtkTetrahedraRayCastMapper::NATIVE ? 2e-5 : 1e-4;
}

struct Medium
{
  std::string Name;
  bool IsLinear;
  std::array<double, 3> Coefficients;
  std::array<double, 2> Range;
  std::array<double, 3> Color;

  void Set(vtkTetrahedraRayCastMapper* mapper) const
  {
    mapper->SetMediumModel(this->IsLinear ? vtkTetrahedraRayCastMapper::LINEAR
                                          : vtkTetrahedraRayCastMapper::EXPONENTIAL);
    mapper->SetMediumAttenuationCoefficients(
      this->Coefficients[0], this->Coefficients[1], this->Coefficients[2]);
    mapper->SetMediumRange(this->Range[0], this->Range[1]);
    mapper->SetMediumColor(this->Color[0], this->Color[1], this->Color[2]);
  }
  double Share(double path, int channel) const
  {
    if (!this->IsLinear)
    {
      return std::exp(-this->Coefficients[channel] * path);
    }
    if (this->Range[1] > this->Range[0])
    {
      return std::clamp((this->Range[1] - path) / (this->Range[1] - this->Range[0]), 0.0, 1.0);
    }
    return path < this->Range[1] ? 1.0 : 0.0;
  }
};

const std::vector<Medium>& Media()
{
  static const std::vector<Medium> media{
    { "thin", false, { 0.8, 0.2, 0.0 }, { 0.0, 1.0 }, { 0.2, 0.9, 0.5 } },
    { "dense", false, { 6.0, 25.0, 0.4 }, { 0.0, 1.0 }, { 0.1, 0.3, 0.6 } },
    { "black", false, { 0.5, 1.0, 2.0 }, { 0.0, 1.0 }, { 0.0, 0.0, 0.0 } },
    { "linear", true, { 0.0, 0.0, 0.0 }, { 0.8, 2.1 }, { 0.2, 0.9, 0.5 } },
    { "linear from the surface", true, { 9.0, 9.0, 9.0 }, { 0.0, 1.3 }, { 0.2, 0.9, 0.5 } },
    { "step", true, { 0.0, 0.0, 0.0 }, { 1.1, 1.1 }, { 0.2, 0.9, 0.5 } },
  };
  return media;
}

/** Part of a ray inside the block of constant attenuation, by path lengths through the medium. */
struct Stretch
{
  bool InMedium;
  double Begin;
  double End;
};

/** Integral of tau exp(-tau (s - begin)) (p + q s) over [from, to]. */
double IntegrateLinear(double tau, double begin, double from, double to, double p, double q)
{
  const auto primitive = [=](double s)
  { return -std::exp(-tau * (s - begin)) * (p + q * s + q / tau); };
  return primitive(to) - primitive(from);
}

/** Integral of tau exp(-tau (s - begin)) times the share over a stretch. */
double IntegrateShare(const Medium& medium, double tau, const Stretch& part, int channel)
{
  if (!part.InMedium)
  {
    return -std::expm1(-tau * (part.End - part.Begin));
  }
  if (!medium.IsLinear)
  {
    const double k = medium.Coefficients[channel];
    return tau / (tau + k) * std::exp(-k * part.Begin) *
      -std::expm1(-(tau + k) * (part.End - part.Begin));
  }
  const double low = std::clamp(medium.Range[0], part.Begin, part.End);
  const double high = std::clamp(medium.Range[1], part.Begin, part.End);
  double sum = IntegrateLinear(tau, part.Begin, part.Begin, low, 1.0, 0.0);
  if (high > low)
  {
    const double slope = 1.0 / (medium.Range[1] - medium.Range[0]);
    sum += IntegrateLinear(tau, part.Begin, low, high, medium.Range[1] * slope, -slope);
  }
  return sum;
}

/** A plane y = Level with the index of refraction behind it. */
struct Level
{
  double Height;
  double Index;
};

using Vector = std::array<double, 3>;

/** A straight part of a ray, with a unit direction, and the way through the medium up to it. */
struct Leg
{
  Vector Origin;
  Vector Direction;
  double Length;
  double Before;
  bool InMedium;
};

std::vector<Leg> TraceLegs(const Ray& ray, const std::vector<Level>& levels)
{
  Leg leg{ { ray.Origin[0], ray.Origin[1], ray.Origin[2] }, {}, 0.0, 0.0, false };
  const double size = std::sqrt(ray.Direction[0] * ray.Direction[0] +
    ray.Direction[1] * ray.Direction[1] + ray.Direction[2] * ray.Direction[2]);
  for (int axis = 0; axis < 3; ++axis)
  {
    leg.Direction[axis] = ray.Direction[axis] / size;
  }
  double index = 1.0;
  std::vector<Leg> legs;
  for (const Level& level : levels)
  {
    leg.Length = (level.Height - leg.Origin[1]) / leg.Direction[1];
    legs.push_back(leg);
    leg.Before += leg.InMedium ? leg.Length : 0.0;
    leg.InMedium = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      leg.Origin[axis] += leg.Length * leg.Direction[axis];
    }
    const double x = leg.Direction[0] * index / level.Index;
    const double z = leg.Direction[2] * index / level.Index;
    leg.Direction = { x, -std::sqrt(1.0 - x * x - z * z), z };
    index = level.Index;
  }
  leg.Length = 1e6;
  legs.push_back(leg);
  return legs;
}

std::vector<Stretch> FindStretches(const Ray& ray, const std::vector<Level>& levels)
{
  std::vector<Stretch> stretches;
  for (const Leg& leg : TraceLegs(ray, levels))
  {
    double begin = 0.0;
    double end = leg.Length;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = (-1.0 - leg.Origin[axis]) / leg.Direction[axis];
      const double b = (1.0 - leg.Origin[axis]) / leg.Direction[axis];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    if (begin < end)
    {
      stretches.push_back({ leg.InMedium, leg.Before + begin, leg.Before + end });
    }
  }
  return stretches;
}

/** Colour of a block of constant attenuation and colour. */
std::array<double, 4> ColorOf(
  const Ray& ray, const std::vector<Level>& levels, const Medium& medium, double tau = Attenuation)
{
  std::array<double, 4> color{ 0.0, 0.0, 0.0, 0.0 };
  for (const Stretch& part : FindStretches(ray, levels))
  {
    const double left = 1.0 - color[3];
    const double alpha = -std::expm1(-tau * (part.End - part.Begin));
    for (int c = 0; c < 3; ++c)
    {
      const double own = IntegrateShare(medium, tau, part, c);
      const double scattered = part.InMedium ? medium.Color[c] : 0.0;
      color[c] += left * (own * Colors[c] + (alpha - own) * scattered);
    }
    color[3] += left * alpha;
  }
  return color;
}

vtkSmartPointer<vtkVolumeProperty> Plain()
{
  return MakeConstantProperty(0.7, Colors[0], Colors[1], Colors[2], 0.7 / Attenuation);
}

void SetLevels(vtkTetrahedraRayCastMapper* mapper, const std::vector<Level>& levels)
{
  vtkNew<vtkRefractingInterfaceCollection> list;
  mapper->RemoveAllMembranes();
  double before = 1.0;
  for (const Level& level : levels)
  {
    vtkNew<vtkRefractingInterface> interface;
    interface->SetExteriorIndexOfRefraction(before);
    interface->SetInteriorIndexOfRefraction(level.Index);
    list->AddItem(interface);
    mapper->AddMembraneData(MakePlaneCase(level.Height, 6.0, 3).Mesh);
    before = level.Index;
  }
  mapper->SetInterfaces(list);
}

/** Expects the closed form in every medium. */
void ExpectClosedForm(RayCastScene& scene, const std::vector<Level>& levels,
  const std::string& what, double tau = Attenuation)
{
  SetLevels(scene.GetRayCaster(), levels);
  LookAt(scene.GetRenderer(), Block, 20.0, 40.0);
  for (const Medium& medium : Media())
  {
    medium.Set(scene.GetRayCaster());
    scene.GetWindow()->Render();
    ExpectTrace(
      scene, [&](const Ray& ray) { return ColorOf(ray, levels, medium, tau); },
      what + ", " + medium.Name, Tolerance());
    EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0) << what << ", " << medium.Name;
  }
}

const std::vector<Level> Water{ { 1.5, 1.333 } };

/** Attaches an array of several components, each constant. */
void SetComponents(vtkUnstructuredGrid* grid, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("components");
  array->SetNumberOfComponents(static_cast<int>(values.size()));
  array->SetNumberOfTuples(grid->GetNumberOfPoints());
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    array->FillComponent(static_cast<int>(c), values[c]);
  }
  grid->GetPointData()->SetScalars(array);
}

/** The constant functions of a property for one component. */
void SetFunctions(vtkVolumeProperty* property, int component, double opacity)
{
  vtkNew<vtkColorTransferFunction> color;
  vtkNew<vtkPiecewiseFunction> weight;
  for (const double scalar : { -1.0, 2.0 })
  {
    color->AddRGBPoint(scalar, Colors[0], Colors[1], Colors[2]);
    weight->AddPoint(scalar, opacity);
  }
  property->SetColor(component, color);
  property->SetScalarOpacity(component, weight);
  property->SetScalarOpacityUnitDistance(component, 0.7 / Attenuation);
}

/** Light of a scalar field along the segments of a ray, by the midpoint rule. */
std::array<double, 4> IntegrateFinely(const std::vector<RaySegment>& segments,
  const ReferenceTransferFunction& function, const Medium& medium, double before, bool inMedium)
{
  constexpr int steps = 1000;
  std::array<double, 4> color{ 0.0, 0.0, 0.0, 0.0 };
  for (const RaySegment& segment : segments)
  {
    const double length = (segment.End - segment.Begin) / steps;
    for (int i = 0; i < steps; ++i)
    {
      const double at = (i + 0.5) / steps;
      const OpticalSample sample =
        function.GetValue(segment.ScalarBegin + at * (segment.ScalarEnd - segment.ScalarBegin));
      const double path = before + segment.Begin + at * (segment.End - segment.Begin);
      const double weight = (1.0 - color[3]) * -std::expm1(-sample.Attenuation * length);
      for (int c = 0; c < 3; ++c)
      {
        const double seen = inMedium ? medium.Share(path, c) : 1.0;
        color[c] += weight * (seen * sample.Color[c] + (1.0 - seen) * medium.Color[c]);
      }
      color[3] += weight;
    }
  }
  return color;
}

} // anonymous namespace

TEST(TetrahedraRayCastMembraneMedium, ConstantBlockUnderAPlane)
{
  RayCastScene scene(MakeBlock(4, ConstantField(0.5)), Plain(), Size, Size);
  ExpectClosedForm(scene, Water, "below the water");
}

TEST(TetrahedraRayCastMembraneMedium, OneLargeCellIsDividedAsThinCellsAre)
{
  RayCastScene scene(MakeBlock(1, ConstantField(0.5)), Plain(), Size, Size);
  ExpectClosedForm(scene, Water, "six cells");
}

TEST(TetrahedraRayCastMembraneMedium, DenseBlock)
{
  RayCastScene scene(MakeBlock(2, ConstantField(0.5)),
    MakeConstantProperty(1.0, Colors[0], Colors[1], Colors[2], 0.02), Size, Size);
  ExpectClosedForm(scene, Water, "attenuation 50", 50.0);
}

TEST(TetrahedraRayCastMembraneMedium, ThePartAboveTheWaterIsNotFaded)
{
  RayCastScene scene(MakeBlock(4, ConstantField(0.5)), Plain(), Size, Size);
  ExpectClosedForm(scene, { { 0.1, 1.333 } }, "across the water");
}

TEST(TetrahedraRayCastMembraneMedium, LegsBehindSeveralInterfacesAddUp)
{
  RayCastScene scene(MakeBlock(4, ConstantField(0.5)), Plain(), Size, Size);
  ExpectClosedForm(scene, { { 1.5, 1.5 }, { 1.2, 1.333 } }, "pane");
  ExpectClosedForm(scene, { { 0.6, 1.5 }, { 0.3, 1.2 }, { -0.2, 1.333 } }, "pane in the mesh");
}

TEST(TetrahedraRayCastMembraneMedium, CellData)
{
  const Grid grid = MakeBlock(4, ConstantField(0.5));
  grid->GetPointData()->Initialize();
  grid->GetCellData()->SetScalars(MakeArray("cells", grid->GetNumberOfCells(), 0.5));
  RayCastScene scene(grid, Plain(), Size, Size);
  scene.GetRayCaster()->SetScalarModeToUseCellData();
  ExpectClosedForm(scene, Water, "cell data");
}

TEST(TetrahedraRayCastMembraneMedium, SeveralComponents)
{
  const Grid grid = MakeBlock(3, ConstantField(0.5));
  for (const int independent : { 1, 0 })
  {
    const auto property = Plain();
    property->SetIndependentComponents(independent);
    for (int component = 0; component < 2; ++component)
    {
      SetFunctions(property, component, independent ? 0.35 : 0.7);
    }
    SetComponents(grid, { 0.25, 0.75 });
    RayCastScene scene(grid, property, Size, Size);
    ExpectClosedForm(scene, Water, independent ? "independent" : "colour and opacity");
  }
  const auto property = Plain();
  property->IndependentComponentsOff();
  SetComponents(grid, { Colors[0], Colors[1], Colors[2], 0.5 });
  RayCastScene scene(grid, property, Size, Size);
  ExpectClosedForm(scene, Water, "red, green, blue and opacity");
}

TEST(TetrahedraRayCastMembraneMedium, FieldsThatVary)
{
  constexpr int small = 28;
  for (const FunctionKind kind : { FunctionKind::Smooth, FunctionKind::Peaked })
  {
    RayCastScene scene(MakeBlock(6, WavyField(3.0)), MakeProperty(kind, Range, 3.4), small, small);
    SetLevels(scene.GetRayCaster(), Water);
    LookAt(scene.GetRenderer(), Block, 30.0, 50.0);
    const auto integrator = MakeReference(scene.MakeGrid());
    const auto function = ToReference(scene.GetVolume()->GetProperty());
    for (const Medium& medium : Media())
    {
      if (medium.Name == "step")
      {
        continue; // the rule of IntegrateFinely() is of first order there
      }
      medium.Set(scene.GetRayCaster());
      scene.GetWindow()->Render();
      ExpectTrace(
        scene,
        [&](const Ray& ray)
        {
          const Leg leg = TraceLegs(ray, Water).back();
          Ray part = ray;
          std::copy_n(leg.Origin.begin(), 3, part.Origin.begin());
          std::copy_n(leg.Direction.begin(), 3, part.Direction.begin());
          part.Begin = 0.0;
          part.End = 1e6;
          std::vector<RaySegment> segments;
          integrator->FindSegments(part, segments);
          return IntegrateFinely(segments, function, medium, leg.Before, true);
        },
        medium.Name, FloatTolerance);
    }
  }
}

TEST(TetrahedraRayCastMembraneMedium, IsosurfacesAreSeenAsObjects)
{
  const auto property = Plain();
  property->GetIsoSurfaceValues()->SetValue(0, 0.25);
  RayCastScene scene(MakeBlock(4, LinearField(0.0, 1.0, 0.0)), property, Size, Size);
  scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  SetLevels(scene.GetRayCaster(), Water);
  LookAt(scene.GetRenderer(), Block, 20.0, 40.0);
  for (const Medium& medium : Media())
  {
    medium.Set(scene.GetRayCaster());
    scene.GetWindow()->Render();
    ExpectTrace(
      scene,
      [&](const Ray& ray)
      {
        const Leg leg = TraceLegs(ray, Water).back();
        const double path = (0.25 - leg.Origin[1]) / leg.Direction[1];
        std::array<double, 4> color{ 0.0, 0.0, 0.0, 0.0 };
        if (std::max(std::fabs(leg.Origin[0] + path * leg.Direction[0]),
              std::fabs(leg.Origin[2] + path * leg.Direction[2])) < 1.0)
        {
          color[3] = 0.7;
          for (int c = 0; c < 3; ++c)
          {
            const double seen = medium.Share(path, c);
            color[c] = 0.7 * (seen * Colors[c] + (1.0 - seen) * medium.Color[c]);
          }
        }
        return color;
      },
      medium.Name, FloatTolerance);
  }
}

TEST(TetrahedraRayCastMembraneMedium, ExtremeCoefficientsEnd)
{
  RayCastScene scene(MakeBlock(2, ConstantField(0.5)), Plain(), Size, Size);
  SetLevels(scene.GetRayCaster(), { { 0.5, 1.333 } }); // the medium begins within cells
  LookAt(scene.GetRenderer(), Block, 20.0, 40.0);
  for (const double coefficient : { 1e3, 1e7, 1e30 })
  {
    const Medium medium{ "extreme", false, { coefficient, coefficient, 0.0 }, { 0.0, 1.0 },
      { 0.2, 0.4, 0.8 } };
    medium.Set(scene.GetRayCaster());
    scene.GetWindow()->Render();
    ExpectTrace(
      scene,
      [&](const Ray& ray) {
        return ColorOf(ray, { { 0.5, 1.333 } }, medium);
      },
      std::to_string(coefficient), FloatTolerance);
  }
}

TEST(TetrahedraRayCastMembraneMedium, StraightRaysAndOtherModesSeeNoMedium)
{
  RayCastScene scene(
    MakeBlock(4, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  LookAt(scene.GetRenderer(), Block, 20.0, 40.0);
  const Medium& medium = Media().front();
  const Medium clear{ "clear", false, { 0.0, 0.0, 0.0 }, { 0.0, 1.0 }, { 0.3, 0.3, 0.3 } };
  const auto expectEqual = [&](const std::string& what)
  {
    clear.Set(scene.GetRayCaster());
    const FloatImage before = scene.RenderFloat();
    medium.Set(scene.GetRayCaster());
    EXPECT_EQ(scene.RenderFloat().Rgba, before.Rgba) << what;
  };
  expectEqual("without a membrane");
  SetLevels(scene.GetRayCaster(), { { 1.5, 1.0 } });
  expectEqual("equal indices");
  SetLevels(scene.GetRayCaster(), Water);
  for (const int mode :
    { vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, vtkVolumeMapper::AVERAGE_INTENSITY_BLEND })
  {
    scene.GetRayCaster()->SetBlendMode(mode);
    expectEqual("mode " + std::to_string(mode));
  }
}

TEST(TetrahedraRayCastMembraneMedium, OnlyTheImageIsMadeAgain)
{
  RayCastScene scene(
    MakeBlock(4, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  SetLevels(mapper, Water);
  LookAt(scene.GetRenderer(), Block, 20.0, 40.0);
  const auto render = [&]() { scene.GetWindow()->Render(); };
  render();
  const double casts = mapper->GetStatistic("NumberOfCastImages");
  const vtkTypeInt64 bytes = mapper->GetUploadedBytes();
  const double sights = mapper->GetStatistic("NumberOfSightUpdates");
  Media().front().Set(mapper);
  render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfCastImages"), casts + 1);
  EXPECT_EQ(mapper->GetUploadedBytes(), bytes);
  EXPECT_EQ(mapper->GetStatistic("NumberOfSightUpdates"), sights);
}

TEST(TetrahedraRayCastMembraneMedium, NumbersWithoutMeaningAreAnError)
{
  RayCastScene scene(MakeBlock(2, ConstantField(0.5)), Plain(), Size, Size);
  SetLevels(scene.GetRayCaster(), Water);
  LookAt(scene.GetRenderer(), Block, 20.0, 40.0);
  const auto errors = ObserveErrors(scene.GetRayCaster());
  const Medium clear{ "clear", false, { 0.0, 0.0, 0.0 }, { 0.0, 1.0 }, { 0.0, 0.0, 0.0 } };
  std::vector<Medium> bad(4, clear);
  bad[0].Coefficients[1] = -1.0;
  bad[1].Coefficients[0] = vtkMath::Nan();
  bad[2].Color[2] = vtkMath::Inf();
  bad[3].IsLinear = true;
  bad[3].Range = { 2.0, 1.0 };
  for (const Medium& medium : bad)
  {
    medium.Set(scene.GetRayCaster());
    errors->Errors.clear();
    scene.GetWindow()->Render();
    EXPECT_EQ(errors->Errors.size(), 1u);
    ExpectTrace(
      scene, [&](const Ray& ray) { return ColorOf(ray, Water, clear); }, "clear", Tolerance());
  }
}
