// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeRelation.h"

#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus::test
{

namespace
{

// The nearest number in single precision. It goes through memory: GCC 12 drops the rounding of two
// neighbouring doubles to single precision and back when it vectorises.
double InSinglePrecision(double value)
{
  const volatile float rounded = static_cast<float>(value);
  return rounded;
}

// Rounds points and values to single precision.
void RoundToFloat(VolumeCase& test, RandomNumbers&)
{
  for (glm::dvec3& p : test.MakeMesh().Points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = InSinglePrecision(p[axis]);
    }
  }
  for (double& value : test.MakeMesh().Values)
  {
    value = InSinglePrecision(value);
  }
}

// Rounds values to integers from 0 to 200.
void RoundToWhole(VolumeCase& test, RandomNumbers&)
{
  MeshArrays& mesh = test.MakeMesh();
  const auto range = mesh.MakeRange(0);
  const double width = range[1] > range[0] ? range[1] - range[0] : 1.0;
  const double factor = 200.0 / width;
  for (double& value : mesh.Values)
  {
    value = std::round(factor * (value - range[0]));
  }
  MapScalars(test.Look, factor, -factor * range[0], 1.0);
}

void StoreAs(VolumeCase& test, RandomNumbers& random)
{
  const int types[8] = { VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT, VTK_INT,
    VTK_UNSIGNED_INT, VTK_LONG_LONG, VTK_FLOAT, VTK_UNSIGNED_LONG_LONG };
  test.Storage.ValueType = types[random.Below(8)];
}

//------------------------------------------------------------------------------
void ScaleValues(VolumeCase& test, RandomNumbers& random)
{
  const double factor = std::pow(10.0, random.Uniform(-6.0, 6.0));
  // Rounding of an offset in double precision is far below that of single precision, relative to
  // the range.
  const double offset = factor * random.Uniform(-1e3, 1e3);
  for (double& value : test.MakeMesh().Values)
  {
    value = factor * value + offset;
  }
  MapScalars(test.Look, factor, offset, 1.0);
}

//------------------------------------------------------------------------------
// Adds control points on the straight lines between the existing ones, and beyond the outer ones.
template <typename Point, typename Mix>
void AddBetween(std::vector<Point>& points, RandomNumbers& random, const Mix& mix)
{
  std::vector<Point> more;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    more.push_back(points[i]);
    if (i + 1 < points.size() && points[i + 1].Scalar > points[i].Scalar)
    {
      const int count = random.Below(4);
      for (int k = 1; k <= count; ++k)
      {
        more.push_back(mix(points[i], points[i + 1], double(k) / (count + 1)));
      }
    }
  }
  Point first = more.front();
  first.Scalar -= 1.0 + std::fabs(first.Scalar);
  more.insert(more.begin(), first);
  Point last = more.back();
  last.Scalar += 1.0 + std::fabs(last.Scalar);
  more.push_back(last);
  points = more;
}

void AddRedundantPoints(VolumeCase& test, RandomNumbers& random)
{
  for (LookFunction& function : test.Look.Functions)
  {
    AddBetween(function.Opacity, random,
      [](const auto& a, const auto& b, double u)
      {
        return LookFunction::OpacityPoint{ a.Scalar + u * (b.Scalar - a.Scalar),
          a.Opacity + u * (b.Opacity - a.Opacity) };
      });
    AddBetween(function.Color, random,
      [](const auto& a, const auto& b, double u)
      {
        LookFunction::ColorPoint point{ a.Scalar + u * (b.Scalar - a.Scalar), a.Color };
        for (std::size_t c = 0; c < 3; ++c)
        {
          point.Color[c] += u * (b.Color[c] - a.Color[c]);
        }
        return point;
      });
  }
}

// Scales opacities and the unit distance by one factor; opacities stay within [0, 1].
void ScaleUnit(VolumeCase& test, RandomNumbers& random)
{
  const double factor = random.Uniform(0.1, 1.0);
  for (LookFunction& function : test.Look.Functions)
  {
    for (auto& point : function.Opacity)
    {
      point.Opacity *= factor;
    }
  }
  test.Look.Unit *= factor;
}

//------------------------------------------------------------------------------
vtkColorTransferFunction* ColorsOf(VolumeTrial& trial)
{
  return trial.GetStage().MakeScene().GetVolume()->GetProperty()->GetRGBTransferFunction();
}

// One component of several, selected by the mapper or by the colour function, compared with an
// array of that component.
void CheckComponent(VolumeTrial& trial)
{
  VolumeCase changed = trial.MakeScene();
  const MeshArrays before = changed.MakeMesh();
  MeshArrays& mesh = changed.MakeMesh();
  mesh.Components = 3;
  mesh.Values.clear();
  const int chosen = trial.MakeRandom().Below(3);
  for (const auto& [i, c] : Product(Below<std::size_t>(before.Tuples()), 3))
  {
    const double other = trial.MakeRandom().Uniform(-1e3, 1e3);
    mesh.Values.push_back(c == chosen ? before.GetValue(i, 0) : other);
  }
  trial.MakePicture();
  trial.GetStage().GetPlace(changed);
  trial.GetStage().GetMapper()->SetVectorMode(vtkTetrahedraRayCastMapper::COMPONENT);
  trial.GetStage().GetMapper()->SetVectorComponent(chosen);
  trial.ExpectSame(trial.GetStage().Render(), "component " + std::to_string(chosen) + " of 3");
  trial.GetStage().GetPlace(changed);
  vtkColorTransferFunction* colors = ColorsOf(trial);
  colors->SetVectorModeToComponent();
  colors->SetVectorComponent(chosen);
  trial.ExpectSame(
    trial.GetStage().Render(), "component " + std::to_string(chosen) + " by colours");
}

// A direction of a vector. Along an axis its length is exact: gradients where the values are all
// but constant are those of the last bits.
glm::dvec3 DirectionOf(bool isExact, RandomNumbers& random)
{
  if (!isExact)
  {
    return random.GetDirection();
  }
  glm::dvec3 direction(0.0);
  direction[random.Below(3)] = random.Below(2) ? 1.0 : -1.0;
  return direction;
}

// The length of vectors compared with an array of it.
void CheckMagnitude(VolumeTrial& trial)
{
  VolumeCase changed = trial.MakeScene();
  const MeshArrays before = changed.MakeMesh();
  MeshArrays& mesh = changed.MakeMesh();
  mesh.Components = 3;
  mesh.Values.clear();
  for (std::size_t i = 0; i < before.Tuples(); ++i)
  {
    const glm::dvec3 direction = DirectionOf(changed.HasGradients(), trial.MakeRandom());
    for (int c = 0; c < 3; ++c)
    {
      mesh.Values.push_back(before.GetValue(i, 0) * direction[c]);
    }
  }
  trial.MakePicture();
  trial.GetStage().GetPlace(changed);
  trial.GetStage().GetMapper()->SetVectorMode(vtkTetrahedraRayCastMapper::MAGNITUDE);
  trial.ExpectSame(trial.GetStage().Render(), "length of vectors");
  trial.GetStage().GetPlace(changed);
  ColorsOf(trial)->SetVectorModeToMagnitude();
  trial.ExpectSame(trial.GetStage().Render(), "length of vectors by colours");
}

// Makes values positive, since lengths are not negative.
void MakePositive(VolumeCase& test, RandomNumbers&)
{
  const double shift = 1.0 - test.MakeMesh().MakeRange(0)[0];
  for (double& value : test.MakeMesh().Values)
  {
    value += shift;
  }
  MapScalars(test.Look, 1.0, shift, 1.0);
}

// Independent components with their functions in another order, and one with a weight of 0.
void PermuteComponents(VolumeCase& test, RandomNumbers& random)
{
  const MeshArrays before = test.MakeMesh();
  MeshArrays& mesh = test.MakeMesh();
  const int first = random.Below(before.Components);
  mesh.Values.clear();
  for (const auto& [i, c] : Product(Below<std::size_t>(before.Tuples()), before.Components))
  {
    mesh.Values.push_back(before.GetValue(i, (c + first) % before.Components));
  }
  auto& functions = test.Look.Functions;
  std::rotate(functions.begin(), functions.begin() + first, functions.end());
}

void MakeIndependent(VolumeCase& test, RandomNumbers& random)
{
  MeshArrays& mesh = test.MakeMesh();
  const MeshArrays before = mesh;
  mesh.Components = 2 + random.Below(3);
  mesh.Values.clear();
  const double width = before.MakeRange(0)[1] - before.MakeRange(0)[0];
  for (const auto& [i, c] : Product(Below<std::size_t>(before.Tuples()), mesh.Components))
  {
    mesh.Values.push_back(before.GetValue(i, 0) + 0.2 * c * width * random.Uniform());
  }
  test.Look.Independent = true;
  while (int(test.Look.Functions.size()) < mesh.Components)
  {
    LookFunction function = test.Look.Functions.front();
    function.Weight = random.Uniform(0.2, 1.0);
    for (auto& point : function.Opacity)
    {
      point.Opacity *= random.Uniform();
    }
    test.Look.Functions.push_back(function);
  }
}

//------------------------------------------------------------------------------
// A gradient opacity of 1 compared with none.
void CheckPlainGradientOpacity(VolumeTrial& trial)
{
  trial.MakePicture();
  trial.GetStage().GetPlace(trial.MakeScene());
  trial.GetStage().MakeScene().GetVolume()->GetProperty()->SetGradientOpacity(
    MakeOpacity({ { 0.0, 1.0 }, { 3.0, 1.0 } }));
  trial.ExpectSame(trial.GetStage().Render(), "gradient opacity of 1");
}

// A gradient opacity without points, which is 0 everywhere as VTK evaluates it.
void CheckEmptyGradientOpacity(VolumeTrial& trial)
{
  trial.MakePicture();
  trial.GetStage().GetPlace(trial.MakeScene());
  vtkVolumeProperty* property = trial.GetStage().MakeScene().GetVolume()->GetProperty();
  property->SetGradientOpacity(vtkSmartPointer<vtkPiecewiseFunction>::New());
  const FloatImage empty = trial.GetStage().Render();
  if (std::any_of(empty.Rgba.begin(), empty.Rgba.end(), [](float v) { return v != 0.0f; }))
  {
    trial.Fail("a gradient opacity without points shows something");
  }
  property->DisableGradientOpacityOn();
  trial.ExpectSame(trial.GetStage().Render(), "no gradient opacity again");
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<VolumeRelation> ValueRelations()
{
  const CaseNeeds any;
  CaseNeeds single;
  single.OneComponent = true;
  // Lighting by gradients of vertices is linear between the places where a segment is split: more
  // control points make it more exact.
  CaseNeeds flat;
  flat.NoVertexGradients = true;
  CaseNeeds medium = single;
  medium.Composite = true;
  CaseNeeds plain = medium;
  plain.NoGradients = true;
  plain.NoCellData = true;
  return {
    { "single precision", 4, any,
      [](VolumeTrial& trial)
      {
        for (int i = 1; i < 4; ++i)
        {
          VolumeCase changed = trial.MakeScene();
          changed.Storage.PointType = i & 1 ? VTK_FLOAT : VTK_DOUBLE;
          changed.Storage.ValueType = i & 2 ? VTK_FLOAT : VTK_DOUBLE;
          trial.ExpectSame(changed,
            std::string(i & 1 ? "points" : "") + (i & 2 ? " values" : "") + " in single precision");
        }
      },
      RoundToFloat },
    RelationOf("ids of 32 bits", 2, any,
      [](VolumeCase& test, RandomNumbers&) { test.Storage.SmallIds = true; }),
    RelationOf("an array per component", 2, any,
      [](VolumeCase& test, RandomNumbers&) { test.Storage.PerComponent = true; }),
    { "whole scalars", 4, single,
      [](VolumeTrial& trial)
      {
        VolumeCase changed = trial.MakeScene();
        StoreAs(changed, trial.MakeRandom());
        trial.ExpectSame(changed, "stored as type " + std::to_string(changed.Storage.ValueType));
      },
      RoundToWhole },
    RelationOf("scalars in other units", 4, single, ScaleValues),
    RelationOf("redundant control points", 4, flat, AddRedundantPoints),
    RelationOf("opacity in other units", 3, medium, ScaleUnit),
    { "component of a vector", 3, single, CheckComponent, nullptr },
    { "length of a vector", 3, single, CheckMagnitude, MakePositive },
    { "order of components", 3, plain,
      [](VolumeTrial& trial)
      {
        VolumeCase changed = trial.MakeScene();
        PermuteComponents(changed, trial.MakeRandom());
        trial.ExpectSame(changed, "order of components");
      },
      MakeIndependent },
    { "gradient opacity of 1", 3, plain, CheckPlainGradientOpacity, nullptr },
    { "gradient opacity without points", 3, plain, CheckEmptyGradientOpacity, nullptr },
  };
}

} // namespace meniscus::test
