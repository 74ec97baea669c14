// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Integrals along rays compared with closed forms, without a window.
#include "IntegralScene.h"

using namespace meniscus::test;

namespace
{

const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();

/** Goal of the issue, relative to the largest value of the image. */
constexpr double Tolerance = 1.0e-6;
/** Part of a ray below which the closed form of a silhouette is not defined by single rays. */
constexpr double Grazing = 1.0e-6;

/**
 * Bound of the error of a length in these meshes: corners of a cell are up to 2 * sqrt(3) apart,
 * and each end of a segment is the mean of three corners in single precision, with an error of
 * 2^-24 of their distances each for the corner, its weight and the product. Where a bin absorbs
 * strongly, the error of its optical depth is the attenuation coefficient times this bound.
 */
constexpr double LengthError = 2.0 * 3.4642 / 16777216.0;

/** A linear field that is nowhere negative in [-1, 1]^3. */
double Linear(const glm::dvec3& p)
{
  return 2.5 + 0.7 * p.x - 0.4 * p.y + 1.1 * p.z;
}

double LinearAt(double x, double y, double z)
{
  return Linear({ x, y, z });
}

const glm::dvec3 Directions[] = { { 0.3, -0.5, -1.0 }, { -1.0, 0.2, 0.35 }, { 0.15, 1.0, -0.2 } };

struct Measured
{
  const SolidMesh& Of;
  Filter Rays;

  Measured(const SolidMesh& of, const glm::dvec3& direction)
    : Of(of)
    , Rays(MakeFilter(of.Mesh, 97, 83))
  {
    SetRectangle(this->Rays, direction, 1.75);
  }

  using OnStretch = std::function<double(const glm::dvec3& from, const glm::dvec3& to, Stretch)>;
  double Worst(const char* name, double missed, const OnStretch& truth) const
  {
    return WorstError(this->Rays, name,
      [&](const WorldRay& ray)
      {
        const Stretch in = this->Of.Solid.Clip(ray);
        const double length = in.GetLength();
        if (length <= Grazing)
        {
          return length > 0.0 ? Infinity : missed;
        }
        return truth(
          ray.Origin + in.Begin * ray.Direction, ray.Origin + in.End * ray.Direction, in);
      });
  }
};

double MeanOf(const glm::dvec3& from, const glm::dvec3& to)
{
  return 0.5 * (Linear(from) + Linear(to));
}

void ExpectScalars(const Measured& measured)
{
  vtkTetrahedraRayIntegral* rays = measured.Rays;
  Enable(rays,
    { "Integral", "PathLength", "FirstDepth", "LastDepth", "Minimum", "MinimumDepth", "Maximum",
      "MaximumDepth" });
  using Point = glm::dvec3;
  const auto worst = [&measured](const char* name, double missed, const Measured::OnStretch& truth)
  { EXPECT_LT(measured.Worst(name, missed, truth), Tolerance) << name; };
  worst("Integral", 0.0,
    [](const Point& a, const Point& b, Stretch in) { return MeanOf(a, b) * in.GetLength(); });
  worst("PathLength", 0.0, [](const Point&, const Point&, Stretch in) { return in.GetLength(); });
  worst("FirstDepth", NaN, [](const Point&, const Point&, Stretch in) { return in.Begin; });
  worst("LastDepth", NaN, [](const Point&, const Point&, Stretch in) { return in.End; });
  worst("Minimum", NaN,
    [](const Point& a, const Point& b, Stretch) { return std::min(Linear(a), Linear(b)); });
  worst("Maximum", NaN,
    [](const Point& a, const Point& b, Stretch) { return std::max(Linear(a), Linear(b)); });
  worst("MinimumDepth", NaN,
    [](const Point& a, const Point& b, Stretch in)
    { return Linear(a) <= Linear(b) ? in.Begin : in.End; });
  worst("MaximumDepth", NaN,
    [](const Point& a, const Point& b, Stretch in)
    { return Linear(a) >= Linear(b) ? in.Begin : in.End; });
  EXPECT_EQ(rays->GetStatistic("NumberOfLostRays"), 0);
}

}

//------------------------------------------------------------------------------
TEST(RayIntegralClosedForm, LinearFieldParallel)
{
  for (const SolidMesh& solid : MakeSolids(LinearAt))
  {
    for (const glm::dvec3& direction : Directions)
    {
      SCOPED_TRACE(solid.Name + " " + std::to_string(direction.x));
      ExpectScalars(Measured(solid, direction));
    }
  }
}

//------------------------------------------------------------------------------
TEST(RayIntegralClosedForm, LinearFieldPerspective)
{
  for (const SolidMesh& solid : MakeSolids(LinearAt))
  {
    vtkNew<vtkCamera> camera;
    camera->SetPosition(2.1, 1.7, 2.6);
    camera->SetFocalPoint(0.1, 0.2, 0.0);
    camera->SetViewAngle(40.0);
    // A clipping range that would cut the mesh away has no effect.
    camera->SetClippingRange(100.0, 101.0);
    Measured measured(solid, Directions[0]);
    measured.Rays->SetCamera(camera);
    SCOPED_TRACE(solid.Name);
    ExpectScalars(measured);
  }
}

//------------------------------------------------------------------------------
// Rays begin at the camera, inside the mesh.
TEST(RayIntegralClosedForm, CameraInside)
{
  const SolidMesh block = MakeSolids(LinearAt)[1];
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.2, -0.1, 0.3);
  camera->SetFocalPoint(1.0, 0.4, -0.5);
  Filter rays = MakeFilter(block.Mesh, 60, 50);
  rays->SetCamera(camera);
  rays->GetArraySelection()->EnableArray("Integral");
  EXPECT_LT(WorstError(rays, "Integral",
              [&block](const WorldRay& ray)
              {
                const Stretch in = block.Solid.Clip(ray, 0.0);
                return MeanOf(ray.Origin, ray.Origin + in.End * ray.Direction) * in.GetLength();
              }),
    Tolerance);
}

//------------------------------------------------------------------------------
TEST(RayIntegralClosedForm, EnergyBinsOfTheScalar)
{
  const double attenuations[] = { 0.0, 0.3, 1.7 };
  const double emissions[] = { 0.25, 0.0, 0.6 };
  const double intensities[] = { 1.0, 3.0, 0.5 };
  for (const SolidMesh& solid : MakeSolids(LinearAt))
  {
    const Measured measured(solid, Directions[1]);
    measured.Rays->GetArraySelection()->EnableArray("EnergyBins");
    measured.Rays->SetNumberOfEnergyBins(3);
    for (int bin = 0; bin < 3; ++bin)
    {
      measured.Rays->SetBinAttenuation(bin, attenuations[bin]);
      measured.Rays->SetBinEmission(bin, emissions[bin]);
      measured.Rays->SetBinIntensity(bin, intensities[bin]);
    }
    const std::vector<double> values = ValuesOf(measured.Rays, "EnergyBins");
    ASSERT_EQ(values.size(), 3u * 97u * 83u);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const auto bin = static_cast<int>(i % 3);
      const auto pixel = static_cast<int>(i / 3);
      const WorldRay ray = RayOf(measured.Rays, pixel % 97, pixel / 97);
      const Stretch in = solid.Solid.Clip(ray);
      const double integral = in.GetLength() *
        MeanOf(ray.Origin + in.Begin * ray.Direction, ray.Origin + in.End * ray.Direction);
      const double depth = attenuations[bin] * integral;
      const double emitted = bin == 0 ? integral : -std::expm1(-depth) / attenuations[bin];
      const double expected = intensities[bin] * std::exp(-depth) + emissions[bin] * emitted;
      ASSERT_NEAR(values[i], expected, Tolerance * std::max(1.0, expected)) << solid.Name << i;
    }
  }
}

namespace
{

/** Adds an array of points or cells with one function of the position per component. */
void AddArray(vtkDataSet* grid, const char* name, bool ofCells, const std::vector<Field>& fields)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(fields.size()));
  const vtkIdType count = ofCells ? grid->GetNumberOfCells() : grid->GetNumberOfPoints();
  array->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    double box[6];
    if (ofCells)
    {
      grid->GetCellBounds(i, box);
      for (int axis = 0; axis < 3; ++axis)
      {
        p[axis] = 0.5 * (box[2 * axis] + box[2 * axis + 1]);
      }
    }
    else
    {
      grid->GetPoint(i, p);
    }
    for (std::size_t component = 0; component < fields.size(); ++component)
    {
      array->SetComponent(i, static_cast<int>(component), fields[component](p[0], p[1], p[2]));
    }
  }
  (ofCells ? static_cast<vtkDataSetAttributes*>(grid->GetCellData()) : grid->GetPointData())
    ->AddArray(array);
}

/** Intensity behind a stretch with linear attenuation and emission: Simpson's rule in double. */
double Transmit(double length, const double (&mu)[2], const double (&light)[2], double intensity)
{
  constexpr int steps = 400;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i)
  {
    const double x = static_cast<double>(i) / steps;
    const double depth = length * (mu[0] * x + 0.5 * (mu[1] - mu[0]) * x * x);
    const double weight = i == 0 || i == steps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * (light[0] + (light[1] - light[0]) * x) * std::exp(-depth);
  }
  return intensity * std::exp(-0.5 * length * (mu[0] + mu[1])) + sum * length / (3.0 * steps);
}

void ExpectBins(const SolidMesh& solid, const std::vector<Field>& attenuations,
  const std::vector<Field>& emissions, double intensity)
{
  const auto bins = static_cast<int>(attenuations.size());
  const Measured measured(solid, Directions[0]);
  measured.Rays->GetArraySelection()->EnableArray("EnergyBins");
  measured.Rays->SetAttenuationArrayName("mu");
  measured.Rays->SetEmissionArrayName(emissions.empty() ? nullptr : "light");
  measured.Rays->SetBinIntensity(bins - 1, intensity);
  const std::vector<double> values = ValuesOf(measured.Rays, "EnergyBins");
  ASSERT_EQ(values.size(), static_cast<std::size_t>(bins) * 97u * 83u);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::size_t bin = i % attenuations.size();
    const auto pixel = static_cast<int>(i / attenuations.size());
    const WorldRay ray = RayOf(measured.Rays, pixel % 97, pixel / 97);
    const Stretch in = solid.Solid.Clip(ray);
    const auto at = [&](const Field& field, double place)
    {
      const glm::dvec3 p = ray.Origin + place * ray.Direction;
      return field(p.x, p.y, p.z);
    };
    const auto ends = [&](const Field& field, double(&values2)[2])
    {
      values2[0] = at(field, in.Begin);
      values2[1] = at(field, in.End);
    };
    double mu[2];
    double light[2] = { 0.0, 0.0 };
    ends(attenuations[bin], mu);
    if (!emissions.empty())
    {
      ends(emissions[bin], light);
    }
    const double source = static_cast<int>(bin) == bins - 1 ? intensity : 1.0;
    const double expected = Transmit(in.GetLength(), mu, light, source);
    const double lengthError = LengthError * std::max(mu[0], mu[1]) * std::max(source, 1.0);
    ASSERT_NEAR(values[i], expected, std::max(lengthError, Tolerance * std::max(1.0, expected)))
      << solid.Name << " bin " << bin << " pixel " << pixel;
  }
}

}

//------------------------------------------------------------------------------
TEST(RayIntegralClosedForm, EnergyBinsOfPointArrays)
{
  const std::vector<Field> attenuations{ LinearAt,
    [](double x, double y, double) { return 1.5 + x - 0.3 * y; }, ConstantField(0.0),
    LinearField(0.0, 0.0, 0.0), [](double, double, double z) { return 6.0 + 5.0 * z; } };
  const std::vector<Field> emissions{ ConstantField(0.3),
    [](double x, double, double) { return 1.0 + 0.5 * x; }, LinearAt, ConstantField(0.0),
    [](double, double y, double) { return 2.0 - y; } };
  for (const SolidMesh& solid : MakeSolids(LinearAt))
  {
    AddArray(solid.Mesh, "mu", false, attenuations);
    AddArray(solid.Mesh, "light", false, emissions);
    ExpectBins(solid, attenuations, {}, 2.0);
    ExpectBins(solid, attenuations, emissions, 0.25);
  }
}

//------------------------------------------------------------------------------
TEST(RayIntegralClosedForm, EnergyBinsOfCellArrays)
{
  const std::vector<Field> attenuations{ ConstantField(0.8), ConstantField(0.0), ConstantField(2.5),
    ConstantField(0.1) };
  const std::vector<Field> emissions{ ConstantField(0.3), ConstantField(0.7), ConstantField(1.5),
    ConstantField(0.0) };
  for (const SolidMesh& solid : MakeSolids(LinearAt))
  {
    AddArray(solid.Mesh, "mu", true, attenuations);
    AddArray(solid.Mesh, "light", true, emissions);
    ExpectBins(solid, attenuations, {}, 2.0);
    ExpectBins(solid, attenuations, emissions, 0.25);
  }
}

namespace
{

/** Layers of hexahedra with one value each, perpendicular to z, in [-1, 1]^3. */
const double LayerEnds[] = { -1.0, -0.4, 0.1, 0.3, 1.0 };
const double LayerValues[] = { 0.5, 2.0, 0.25, 1.25 };

vtkSmartPointer<vtkRectilinearGrid> MakeLayers()
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  const auto axis = [](const std::vector<double>& ends)
  {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    for (const double end : ends)
    {
      array->InsertNextValue(end);
    }
    return array;
  };
  const std::vector<double> cross{ -1.0, -0.2, 0.45, 1.0 };
  grid->SetDimensions(4, 4, 5);
  grid->SetXCoordinates(axis(cross));
  grid->SetYCoordinates(axis(cross));
  grid->SetZCoordinates(axis({ std::begin(LayerEnds), std::end(LayerEnds) }));
  AddArray(grid, "density", true,
    { [](double, double, double z)
      {
        int layer = 0;
        while (z > LayerEnds[layer + 1])
        {
          ++layer;
        }
        return LayerValues[layer];
      } });
  return grid;
}

/** Lengths of a ray in the layers. */
std::vector<double> LengthsInLayers(const WorldRay& ray)
{
  std::vector<double> lengths;
  for (int layer = 0; layer < 4; ++layer)
  {
    ConvexSolid box;
    box.Planes = { { { 1, 0, 0 }, 1.0 }, { { -1, 0, 0 }, 1.0 }, { { 0, 1, 0 }, 1.0 },
      { { 0, -1, 0 }, 1.0 }, { { 0, 0, 1 }, LayerEnds[layer + 1] },
      { { 0, 0, -1 }, -LayerEnds[layer] } };
    lengths.push_back(box.Clip(ray).GetLength());
  }
  return lengths;
}

}

//------------------------------------------------------------------------------
TEST(RayIntegralClosedForm, LayersOfCellDataInAStructuredGrid)
{
  const auto layers = MakeLayers();
  Filter rays = MakeFilter(layers, 97, 83);
  SetRectangle(rays, Directions[0], 1.75);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "density");
  Enable(rays, { "Integral", "Maximum", "MaximumDepth" });
  EXPECT_LT(WorstError(rays, "Integral",
              [](const WorldRay& ray)
              {
                const std::vector<double> lengths = LengthsInLayers(ray);
                double sum = 0.0;
                for (int layer = 0; layer < 4; ++layer)
                {
                  sum += LayerValues[layer] * lengths[static_cast<std::size_t>(layer)];
                }
                return sum;
              }),
    Tolerance);
  EXPECT_LT(WorstError(rays, "Maximum",
              [](const WorldRay& ray)
              {
                const std::vector<double> lengths = LengthsInLayers(ray);
                double largest = NaN;
                for (int layer = 0; layer < 4; ++layer)
                {
                  const double length = lengths[static_cast<std::size_t>(layer)];
                  if (length > 0.0 && length < Grazing)
                  {
                    return Infinity;
                  }
                  largest = length > 0.0 ? std::fmax(largest, LayerValues[layer]) : largest;
                }
                return largest;
              }),
    Tolerance);
}

namespace
{

/** Attenuation of the property below: a tent with a jump-free slope on either side of 2. */
double TentAt(double scalar)
{
  return scalar < 2.0 ? 0.8 * std::max(0.0, scalar - 1.0)
                      : std::max(0.0, 0.8 - 0.4 * (scalar - 2.0));
}

/** Integral of TentAt from 0 to the scalar. */
double TentIntegral(double scalar)
{
  const double up = std::clamp(scalar, 1.0, 2.0) - 1.0;
  const double down = std::clamp(scalar, 2.0, 4.0) - 2.0;
  return 0.4 * up * up + 0.8 * down - 0.2 * down * down;
}

vtkSmartPointer<vtkVolumeProperty> MakeTent()
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetScalarOpacity(MakeOpacity({ { 1.0, 0.0 }, { 2.0, 0.4 }, { 4.0, 0.0 } }));
  property->SetColor(MakeColors({ { 0.0, 0.2, 0.5, 0.9 } }));
  property->SetScalarOpacityUnitDistance(0.5);
  return property;
}

}

//------------------------------------------------------------------------------
// One colour: the image's colour is that colour times the opacity, whatever the function.
TEST(RayIntegralClosedForm, OpticalDepthAndColour)
{
  for (const SolidMesh& solid : MakeSolids(LinearAt))
  {
    const Measured measured(solid, Directions[2]);
    measured.Rays->SetVolumeProperty(MakeTent());
    measured.Rays->GetArraySelection()->EnableArray("OpticalDepth");
    measured.Rays->GetArraySelection()->EnableArray("RGBA");
    const auto depthOf = [](const glm::dvec3& a, const glm::dvec3& b, Stretch in)
    {
      const double change = Linear(b) - Linear(a);
      const double mean = std::abs(change) > 1.0e-9
        ? (TentIntegral(Linear(b)) - TentIntegral(Linear(a))) / change
        : TentAt(Linear(a));
      return mean * in.GetLength();
    };
    EXPECT_LT(measured.Worst("OpticalDepth", 0.0, depthOf), Tolerance) << solid.Name;
    const std::vector<double> rgba = ValuesOf(measured.Rays, "RGBA");
    const double color[4] = { 0.2, 0.5, 0.9, 1.0 };
    ASSERT_EQ(rgba.size(), 4u * 97u * 83u);
    for (std::size_t i = 0; i < rgba.size(); ++i)
    {
      const auto pixel = static_cast<int>(i / 4);
      const WorldRay ray = RayOf(measured.Rays, pixel % 97, pixel / 97);
      const Stretch in = solid.Solid.Clip(ray);
      const double depth = in.GetLength() > 0.0
        ? depthOf(ray.Origin + in.Begin * ray.Direction, ray.Origin + in.End * ray.Direction, in)
        : 0.0;
      // The mapper's bound for composite blending in single precision (volume-measurements.md).
      ASSERT_NEAR(rgba[i], -color[i % 4] * std::expm1(-depth), 2.0e-5) << solid.Name;
    }
  }
}
