// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeMembranes.h"

#include "MembraneScene.h"

#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkReverseSense.h>
#include <vtkSphereSource.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace meniscus::benchmark
{
namespace
{

constexpr char NameOfWaves[] = "waves, 20,000 facets";

struct NamedMembrane
{
  std::string Name;
  std::vector<vtkSmartPointer<vtkPolyData>> Surfaces;
  std::vector<double> Indices; // of the first medium, and behind each surface
};

//------------------------------------------------------------------------------
void SetMembrane(vtkTetrahedraRayCastMapper* mapper, const NamedMembrane& membrane)
{
  vtkNew<vtkRefractingInterfaceCollection> list;
  for (std::size_t i = 0; i < membrane.Surfaces.size(); ++i)
  {
    vtkNew<vtkRefractingInterface> interface;
    interface->SetExteriorIndexOfRefraction(membrane.Indices[i]);
    interface->SetInteriorIndexOfRefraction(membrane.Indices[i + 1]);
    list->AddItem(interface);
    mapper->AddMembraneData(membrane.Surfaces[i]);
  }
  mapper->SetInterfaces(list);
}

//------------------------------------------------------------------------------
/**
 * Cap of 25 degrees of a sphere, around the axis y at the height `rim`, with normals up.
 * @param side 1: above the rim, -1: below it
 */
vtkSmartPointer<vtkPolyData> MakeCap(double radius, double rim, double side)
{
  constexpr double angle = 25.0;
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(72);
  sphere->SetPhiResolution(24);
  sphere->SetEndPhi(angle);
  vtkNew<vtkTransform> up;
  up->Translate(0.0, rim - side * radius * std::cos(vtkMath::RadiansFromDegrees(angle)), 0.0);
  up->RotateX(-90.0 * side);
  vtkNew<vtkTransformPolyDataFilter> mover;
  mover->SetTransform(up);
  mover->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkReverseSense> reverse;
  reverse->ReverseNormalsOn();
  reverse->SetInputConnection(mover->GetOutputPort());
  vtkAlgorithm* last = side > 0.0 ? static_cast<vtkAlgorithm*>(mover) : reverse;
  last->Update();
  return vtkPolyData::SafeDownCast(last->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
// As long and wide as is visible in the images from elevations of 35 degrees and more.
std::vector<NamedMembrane> MakeMembranes(vtkUnstructuredGrid* grid)
{
  double bounds[6];
  grid->GetBounds(bounds);
  const double diagonal = test::DiagonalOf(bounds);
  const double half = 2.5 * diagonal;
  const double top = 0.5 * (bounds[3] - bounds[2]) + 0.1 * diagonal;
  vtkNew<vtkTransform> toCenter;
  toCenter->Translate(
    0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]), 0.5 * (bounds[4] + bounds[5]));
  const auto placed = [&toCenter](vtkPolyData* surface)
  {
    vtkNew<vtkTransformPolyDataFilter> mover;
    mover->SetTransform(toCenter);
    mover->SetInputData(surface);
    mover->Update();
    return vtkSmartPointer<vtkPolyData>(mover->GetOutput());
  };
  const auto plane = [&](double height)
  { return placed(test::MakePlaneCase(top + height * diagonal, half, 2).Mesh); };
  const auto waves =
    placed(test::MakeWavesCase(top, 0.02 * diagonal, 12.0 / diagonal, half, 100).Mesh);
  const auto cap = [&](double side)
  { return placed(MakeCap(2.0 * diagonal, top + 0.25 * diagonal, side)); };
  return { { "none", {}, {} }, { "plane above, 8 facets", { plane(0.0) }, { 1.0, 1.333 } },
    { "plane through the middle, 8 facets", { placed(test::MakePlaneCase(0.0, half, 2).Mesh) },
      { 1.0, 1.333 } },
    { "dome, 3,200 facets", { placed(test::MakeDomeCase(top, 4.0 * diagonal, half, 40).Mesh) },
      { 1.0, 1.333 } },
    { NameOfWaves, { waves }, { 1.0, 1.333 } },
    { "pane above, 2 x 8 facets", { plane(0.05), plane(0.0) }, { 1.0, 1.5, 1.0 } },
    { "three planes above, 3 x 8 facets", { plane(0.1), plane(0.05), plane(0.0) },
      { 1.0, 1.5, 1.0, 1.333 } },
    { "pane over waves, 20,016 facets", { plane(0.1), plane(0.05), waves },
      { 1.0, 1.5, 1.0, 1.333 } },
    { "magnifying lens, 6,480 facets", { cap(1.0), cap(-1.0) }, { 1.0, 1.5, 1.0 } } };
}

} // anonymous namespace

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeWavesAbove(vtkUnstructuredGrid* grid)
{
  const std::vector<NamedMembrane> membranes = MakeMembranes(grid);
  const auto waves = std::find_if(membranes.begin(), membranes.end(),
    [](const NamedMembrane& one) { return one.Name == NameOfWaves; });
  return waves->Surfaces.front();
}

//------------------------------------------------------------------------------
std::vector<MembraneCost> MeasureMembranes(
  const VolumeOptions& options, vtkUnstructuredGrid* grid, int backend)
{
  const std::vector<NamedMembrane> membranes = MakeMembranes(grid);
  std::vector<Contestant> contestants;
  for (const NamedMembrane& membrane : membranes)
  {
    Contestant ours = MakeOurs(backend, membrane.Name);
    ours.Make = [make = ours.Make, &membrane]()
    {
      const MapperPointer mapper = make();
      SetMembrane(vtkTetrahedraRayCastMapper::SafeDownCast(mapper), membrane);
      return mapper;
    };
    contestants.push_back(ours);
  }
  VolumeComparison comparison(options, grid);
  comparison.Enter(contestants);
  const auto moves = comparison.MeasureMoves();
  std::vector<MembraneCost> costs;
  for (std::size_t i = 1; i < membranes.size(); ++i)
  {
    costs.push_back({ membranes[i].Name, RatioOf(moves.Moving[i], moves.Moving[0], true),
      RatioOf(moves.Resting[i], moves.Resting[0], true) });
  }
  return costs;
}

} // namespace meniscus::benchmark
