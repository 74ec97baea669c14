// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WellScene.h"

#include "vtkAppendPolyData.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCylinderSource.h"
#include "vtkFloatArray.h"
#include "vtkGenericCell.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkPolygon.h"
#include "vtkSMPTools.h"
#include "vtkSphereSource.h"
#include "vtkStaticCellLocator.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{

constexpr double Depth = 2.0;
constexpr int TilesPerSide = 10;
constexpr int QuadsPerTile = 3;

// Amplitude, wave vector and speed. Crests focus light at depths of 1 to 2.
constexpr double Waves[3][4] = { { 0.030, 5.0, 4.0, 2.0 }, { 0.020, -3.0, 7.5, 3.0 },
  { 0.012, 8.0, -6.0, 4.0 } };

using Color = std::array<double, 3>;
using ColorRule = std::function<Color(const double center[3])>;

// Sets the colour of each cell by its position, lit from above the well.
void ColorCells(vtkPolyData* data, const ColorRule& rule)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(data->GetNumberOfCells());
  const double lamp[3] = { 0.35, -0.25, 0.9 };
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    vtkPoints* points = data->GetCell(i)->GetPoints();
    double normal[3];
    vtkPolygon::ComputeNormal(points, normal);
    double center[3] = { 0.0, 0.0, 0.0 };
    for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
    {
      double p[3];
      points->GetPoint(k, p);
      vtkMath::Add(center, p, center);
    }
    vtkMath::MultiplyScalar(center, 1.0 / static_cast<double>(points->GetNumberOfPoints()));
    const double light = 0.45 + 0.55 * std::fabs(vtkMath::Dot(normal, lamp));
    const Color color = rule(center);
    for (int c = 0; c < 3; ++c)
    {
      colors->SetComponent(i, c, 255.0 * std::min(color[static_cast<std::size_t>(c)] * light, 1.0));
    }
  }
  data->GetCellData()->SetScalars(colors);
  data->GetPointData()->Initialize();
}

void AddSide(vtkAppendPolyData* well, const double origin[3], const double point1[3],
  const double point2[3], const Color& dark)
{
  constexpr int quads = TilesPerSide * QuadsPerTile;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(origin[0], origin[1], origin[2]);
  plane->SetPoint1(point1[0], point1[1], point1[2]);
  plane->SetPoint2(point2[0], point2[1], point2[2]);
  plane->SetResolution(quads, quads);
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->Update();
  vtkPolyData* side = plane->GetOutput();
  const auto along = [&](const double p[3], const double to[3])
  {
    double u[3];
    double v[3];
    vtkMath::Subtract(to, origin, u);
    vtkMath::Subtract(p, origin, v);
    return static_cast<int>(TilesPerSide * vtkMath::Dot(u, v) / vtkMath::Dot(u, u));
  };
  ColorCells(side,
    [&](const double p[3]) {
      return (along(p, point1) + along(p, point2)) % 2 ? dark : Color{ 0.95, 0.93, 0.86 };
    });
  well->AddInputData(side);
}

void AddObject(vtkAppendPolyData* well, vtkPolyDataAlgorithm* source, const double position[3],
  double turn, const Color& color, const Color& other)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(position);
  transform->RotateX(turn);
  vtkNew<vtkTransformPolyDataFilter> placed;
  placed->SetInputConnection(source->GetOutputPort());
  placed->SetTransform(transform);
  placed->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(placed->GetOutputPort());
  triangles->Update();
  vtkPolyData* object = triangles->GetOutput();
  ColorCells(
    object, [&](const double p[3]) { return std::fmod(p[2] + 8.0, 0.2) < 0.1 ? color : other; });
  well->AddInputData(object);
}

/** Refracts a ray at the water, a length `t` from the eye: where it goes on, and its direction. */
void RefractAtSurface(const DemoWater& water, const double eye[3], const double direction[3],
  double t, double start[3], double behind[3])
{
  for (int c = 0; c < 3; ++c)
  {
    start[c] = eye[c] + t * direction[c];
  }
  const auto normal = water.GetNormal(start[0], start[1]);
  const double ratio = 1.0 / water.GetIndex();
  const double cosine = vtkMath::Dot(direction, normal.data());
  const double along = -ratio * cosine - std::sqrt(1.0 - ratio * ratio * (1.0 - cosine * cosine));
  for (int c = 0; c < 3; ++c)
  {
    behind[c] = ratio * direction[c] + along * normal[static_cast<std::size_t>(c)];
    start[c] += 1e-9 * behind[c];
  }
}

}

//------------------------------------------------------------------------------
double DemoWater::GetHeight(double x, double y) const
{
  double sum = 0.0;
  for (const auto& wave : Waves)
  {
    sum += wave[0] * std::sin(wave[1] * x + wave[2] * y + wave[3] * this->Time);
  }
  return this->WaveHeight * sum;
}

//------------------------------------------------------------------------------
std::array<double, 3> DemoWater::GetNormal(double x, double y) const
{
  std::array<double, 3> normal = { 0.0, 0.0, 1.0 };
  for (const auto& wave : Waves)
  {
    const double slope =
      this->WaveHeight * wave[0] * std::cos(wave[1] * x + wave[2] * y + wave[3] * this->Time);
    normal[0] -= wave[1] * slope;
    normal[1] -= wave[2] * slope;
  }
  vtkMath::Normalize(normal.data());
  return normal;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> DemoWater::MakeMesh(int cells) const
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-HalfSide, -HalfSide, 0.0);
  plane->SetPoint1(HalfSide, -HalfSide, 0.0);
  plane->SetPoint2(-HalfSide, HalfSide, 0.0);
  plane->SetResolution(cells, cells);
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(plane->GetOutputPort());
  triangles->Update();
  vtkSmartPointer<vtkPolyData> mesh = triangles->GetOutput();
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    mesh->GetPoints()->SetPoint(i, p[0], p[1], this->GetHeight(p[0], p[1]));
    normals->SetTuple(i, this->GetNormal(p[0], p[1]).data());
  }
  mesh->GetPointData()->SetNormals(normals);
  return mesh;
}

//------------------------------------------------------------------------------
double DemoWater::Intersect(const double eye[3], const double direction[3]) const
{
  if (!(direction[2] < 0.0))
  {
    return -1.0;
  }
  const auto above = [&](double t)
  {
    return eye[2] + t * direction[2] -
      this->GetHeight(eye[0] + t * direction[0], eye[1] + t * direction[1]);
  };
  // Steps much shorter than the waves through the layer that contains them, then bisection.
  const double highest = Highest * std::max(this->WaveHeight, 1.0);
  double low = (eye[2] - highest) / -direction[2];
  const double last = (eye[2] + highest) / -direction[2];
  const double step = (last - low) / 64.0;
  while (low < last && above(low + step) > 0.0)
  {
    low += step;
  }
  double high = low + step;
  for (int i = 0; i < 50; ++i)
  {
    const double middle = 0.5 * (low + high);
    (above(middle) > 0.0 ? low : high) = middle;
  }
  return high;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeDemoWell()
{
  vtkNew<vtkAppendPolyData> well;
  well->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  const double low[4][3] = { { -1, -1, -Depth }, { 1, -1, -Depth }, { 1, 1, -Depth },
    { -1, 1, -Depth } };
  AddSide(well, low[0], low[1], low[3], { 0.15, 0.40, 0.62 });
  for (int i = 0; i < 4; ++i)
  {
    const double top[3] = { low[i][0], low[i][1], -0.1 };
    AddSide(well, low[i], low[(i + 1) % 4], top, { 0.35, 0.62, 0.66 });
  }
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.3);
  ball->SetThetaResolution(48);
  ball->SetPhiResolution(32);
  ball->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  const double ballAt[3] = { -0.4, 0.3, -1.5 };
  AddObject(well, ball, ballAt, 0.0, { 0.95, 0.25, 0.15 }, { 1.0, 0.85, 0.2 });
  vtkNew<vtkParametricTorus> torus;
  torus->SetRingRadius(0.3);
  torus->SetCrossSectionRadius(0.1);
  vtkNew<vtkParametricFunctionSource> ring;
  ring->SetParametricFunction(torus);
  ring->SetUResolution(48);
  ring->SetVResolution(16);
  const double ringAt[3] = { 0.4, -0.35, -1.1 };
  AddObject(well, ring, ringAt, 50.0, { 0.25, 0.75, 0.3 }, { 0.1, 0.45, 0.2 });
  vtkNew<vtkCylinderSource> post;
  post->SetRadius(0.07);
  post->SetHeight(2.3);
  post->SetResolution(24);
  post->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  const double postAt[3] = { 0.6, 0.6, -0.85 };
  AddObject(well, post, postAt, 90.0, { 0.9, 0.6, 0.2 }, { 0.9, 0.6, 0.2 });
  well->Update();
  return well->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkUnsignedCharArray> TraceDemoWell(vtkPolyData* well, const DemoWater& water,
  const DemoView& view, int size, const unsigned char background[3])
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(well);
  locator->BuildLocator();
  well->GetCell(0); // builds the tables that threads share
  vtkDataArray* colors = well->GetCellData()->GetScalars();
  auto picture = vtkSmartPointer<vtkUnsignedCharArray>::New();
  picture->SetNumberOfComponents(3);
  picture->SetNumberOfTuples(static_cast<vtkIdType>(size) * size);

  double forward[3];
  vtkMath::Subtract(view.Target, view.Eye, forward);
  vtkMath::Normalize(forward);
  double right[3];
  vtkMath::Cross(forward, view.Up, right);
  vtkMath::Normalize(right);
  double up[3];
  vtkMath::Cross(right, forward, up);
  const double half = std::tan(0.5 * vtkMath::RadiansFromDegrees(view.Angle));
  constexpr double far = 20.0;

  vtkSMPTools::For(0, size,
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkGenericCell> cell;
      const auto hit = [&](const double from[3], const double direction[3], double length)
      {
        double to[3];
        double x[3];
        double weights[3];
        double t = 0.0;
        int part = 0;
        vtkIdType id = -1;
        for (int c = 0; c < 3; ++c)
        {
          to[c] = from[c] + length * direction[c];
        }
        return locator->IntersectWithLine(from, to, 1e-9, t, x, weights, part, id, cell) ? id : -1;
      };
      for (vtkIdType i = begin * size; i < end * size; ++i)
      {
        const double u = half * (2.0 * (static_cast<double>(i % size) + 0.5) / size - 1.0);
        const double v = half * (2.0 * (static_cast<double>(i / size) + 0.5) / size - 1.0);
        double direction[3];
        for (int c = 0; c < 3; ++c)
        {
          direction[c] = forward[c] + u * right[c] + v * up[c];
        }
        vtkMath::Normalize(direction);
        const double t = water.Intersect(view.Eye, direction);
        vtkIdType id = hit(view.Eye, direction, t > 0.0 ? t : far);
        if (id < 0 && t > 0.0)
        {
          double s[3];
          double behind[3];
          RefractAtSurface(water, view.Eye, direction, t, s, behind);
          const bool inMesh = std::max(std::fabs(s[0]), std::fabs(s[1])) <= DemoWater::HalfSide;
          id = inMesh ? hit(s, behind, far) : -1;
        }
        for (int c = 0; c < 3; ++c)
        {
          picture->SetComponent(i, c, id < 0 ? background[c] : colors->GetComponent(id, c));
        }
      }
    });
  return picture;
}
