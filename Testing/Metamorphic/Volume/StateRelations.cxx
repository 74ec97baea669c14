// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeRelation.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkMatrix4x4.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace test
{

namespace
{

// Object whose Modified() is called after an edit in place.
enum class Notice
{
  Array,
  Owner, ///< point data, cell data, vtkPoints, vtkCellArray
  Grid
};

const char* const NoticeNames[3] = { "the array", "its owner", "the grid" };

//------------------------------------------------------------------------------
struct Edit
{
  const char* Name;
  /** Sets up the scene that is then edited into the trial's scene. */
  std::function<void(VolumeCase&, RandomNumbers&)> Spoil;
  std::function<void(vtkUnstructuredGrid*, const VolumeCase&, Notice)> Apply;
};

void spoilValues(VolumeCase& test, RandomNumbers& random)
{
  for (double& value : test.mesh().Values)
  {
    value += random.uniform(-0.5, 0.5);
  }
}

// Shrinks the mesh about its middle. It stays in view: if only the grid receives Modified(),
// vtkPoints keeps its old bounds, and the renderer culls by them.
void spoilPoints(VolumeCase& test, RandomNumbers&)
{
  double b[6];
  test.mesh().bounds(b);
  const glm::dvec3 center = 0.5 * glm::dvec3(b[0] + b[1], b[2] + b[3], b[4] + b[5]);
  for (glm::dvec3& p : test.mesh().Points)
  {
    p = center + 0.8 * (p - center);
  }
}

// Makes every third cell one without a volume.
void spoilCells(VolumeCase& test, RandomNumbers&)
{
  for (std::size_t c = 0; c < test.mesh().Cells.size(); c += 3)
  {
    std::vector<vtkIdType>& ids = test.mesh().Cells[c].Ids;
    std::fill(ids.begin(), ids.end(), ids.front());
  }
}

void editValues(vtkUnstructuredGrid* grid, const VolumeCase& wanted, Notice notice)
{
  const MeshArrays& mesh = wanted.mesh();
  vtkDataSetAttributes* owner = mesh.OnCells
    ? static_cast<vtkDataSetAttributes*>(grid->GetCellData())
    : static_cast<vtkDataSetAttributes*>(grid->GetPointData());
  vtkDataArray* array = owner->GetScalars();
  for (std::size_t i = 0; i < mesh.tuples(); ++i)
  {
    array->SetTuple(static_cast<vtkIdType>(i), &mesh.Values[i * std::size_t(mesh.Components)]);
  }
  vtkObject* const told[3] = { array, owner, grid };
  told[static_cast<int>(notice)]->Modified();
}

void editPoints(vtkUnstructuredGrid* grid, const VolumeCase& wanted, Notice notice)
{
  vtkPoints* points = grid->GetPoints();
  for (std::size_t i = 0; i < wanted.mesh().Points.size(); ++i)
  {
    points->GetData()->SetTuple(static_cast<vtkIdType>(i), &wanted.mesh().Points[i][0]);
  }
  vtkObject* const told[3] = { points->GetData(), points, grid };
  told[static_cast<int>(notice)]->Modified();
}

void editCells(vtkUnstructuredGrid* grid, const VolumeCase& wanted, Notice notice)
{
  vtkTypeInt64Array* ids = grid->GetCells()->GetConnectivityArray64();
  vtkIdType at = 0;
  for (const MeshCell& cell : wanted.mesh().Cells)
  {
    for (const vtkIdType id : cell.Ids)
    {
      ids->SetValue(at++, id);
    }
  }
  // VTK's cell array does not propagate a modification of its inner array, so Modified() of the
  // owner is called instead.
  vtkObject* const told[3] = { grid->GetCells(), grid->GetCells(), grid };
  told[static_cast<int>(notice)]->Modified();
}

VolumeRelation editRelation(const Edit& edit)
{
  CaseNeeds needs;
  needs.Small = true;
  return { std::string("edits in place: ") + edit.Name, 3, needs,
    [edit](VolumeTrial& trial)
    {
      for (int notice = 0; notice < 3; ++notice)
      {
        trial.picture();
        VolumeCase spoilt = trial.scene();
        edit.Spoil(spoilt, trial.random());
        trial.stage().draw(spoilt);
        edit.Apply(trial.stage().grid(), trial.scene(), static_cast<Notice>(notice));
        trial.expectSame(
          trial.stage().render(), std::string(edit.Name) + " told by " + NoticeNames[notice]);
      }
    },
    nullptr };
}

//------------------------------------------------------------------------------
// Control points moved in the property's own objects.
void checkEditedFunctions(VolumeTrial& trial)
{
  trial.picture();
  VolumeCase other = trial.scene();
  for (LookFunction& function : other.Look.Functions)
  {
    std::reverse(function.Color.begin(), function.Color.end());
    for (auto& point : function.Opacity)
    {
      point.Opacity *= trial.random().uniform();
    }
  }
  trial.stage().draw(other);
  vtkVolumeProperty* property = trial.stage().scene().volume()->GetProperty();
  const auto wanted = toProperty(trial.scene().Look);
  for (int c = 0; c < static_cast<int>(trial.scene().Look.Functions.size()); ++c)
  {
    property->GetScalarOpacity(c)->DeepCopy(wanted->GetScalarOpacity(c));
    property->GetRGBTransferFunction(c)->DeepCopy(wanted->GetRGBTransferFunction(c));
  }
  trial.expectSame(trial.stage().render(), "functions edited");
}

//------------------------------------------------------------------------------
// The mapper draws something else, and then the scene again.
void checkLaterFrames(VolumeTrial& trial)
{
  trial.picture();
  VolumeStage& stage = trial.stage();
  const VolumeCase& scene = trial.scene();
  stage.draw(scene);
  vtkTetrahedraRayCastMapper* mapper = stage.mapper();
  VolumeScene& window = stage.scene();
  const auto again = [&](const char* words)
  {
    stage.render();
    scene.View.applyTo(window.renderer());
    trial.expectSame(stage.render(), words);
  };
  trial.expectSame(stage.render(), "second frame");

  VolumeView elsewhere = scene.View;
  elsewhere.Eye += 0.2 * glm::distance(elsewhere.Eye, elsewhere.Focus) * trial.random().direction();
  elsewhere.applyTo(window.renderer());
  again("camera moved and back");

  VolumeLook other = scene.Look;
  mapScalars(other, 1.0, 0.2, 1.0);
  const vtkSmartPointer<vtkVolumeProperty> property = window.volume()->GetProperty();
  window.setProperty(toProperty(other));
  stage.render();
  window.setProperty(property);
  again("another property and back");

  window.window()->SetSize(31, 57);
  stage.render();
  window.window()->SetSize(scene.Size, scene.Size);
  again("another size and back");

  if (scene.mesh().Components == 1)
  {
    mapper->SetBlendMode(scene.Look.Blend == vtkVolumeMapper::AVERAGE_INTENSITY_BLEND
        ? vtkVolumeMapper::COMPOSITE_BLEND
        : vtkVolumeMapper::AVERAGE_INTENSITY_BLEND);
    stage.render();
    mapper->SetBlendMode(scene.Look.Blend);
    again("another mode and back");
  }

  VolumeCase half = scene;
  half.mesh().Cells.resize(1 + half.mesh().Cells.size() / 2);
  half.mesh().Values.resize(half.mesh().tuples() * std::size_t(half.mesh().Components));
  stage.setInput(toGrid(half.mesh(), half.Storage));
  stage.render();
  stage.setInput(stage.grid());
  again("another mesh and back");

  mapper->SetMembraneData(nullptr);
  stage.render();
  mapper->SetMembraneData(scene.Membrane.Mesh);
  again("no membrane and back");

  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 3, 0.1);
  matrix->SetElement(1, 1, 1.2);
  window.volume()->SetUserMatrix(matrix);
  stage.render();
  window.volume()->SetUserMatrix(nullptr);
  again("another matrix and back");

  const int usual = scene.Backend;
  mapper->SetBackend(usual == vtkTetrahedraRayCastMapper::NATIVE
      ? vtkTetrahedraRayCastMapper::OPENGL
      : vtkTetrahedraRayCastMapper::NATIVE);
  stage.render();
  mapper->SetBackend(usual);
  again("another backend and back");
}

//------------------------------------------------------------------------------
void checkThreads(VolumeTrial& trial)
{
  trial.picture();
  // VTK's own threads are used: TBB's number of threads cannot be raised again once it was lowered.
  const std::string usual = vtkSMPTools::GetBackend();
  vtkSMPTools::SetBackend("STDThread");
  for (const int threads : { 1, 2, 3, 7 })
  {
    vtkSMPTools::Initialize(threads);
    // The same operations on the same numbers: every digit must be equal.
    trial.expectSame(
      trial.stage().draw(trial.scene()),
      [](int x, int y) {
        return std::array<int, 2>{ x, y };
      },
      0.0, std::to_string(threads) + " threads");
  }
  vtkSMPTools::Initialize(0);
  vtkSMPTools::SetBackend(usual.c_str());
}

// Compares the image with the double-precision reference, which conditioning computes anyway.
void checkExact(VolumeTrial& trial)
{
  FloatImage exact = trial.picture();
  for (int y = 0; y < exact.Height; ++y)
  {
    for (int x = 0; x < exact.Width; ++x)
    {
      const std::array<double, 4> color = trial.exact(x, y);
      std::copy(color.begin(), color.end(), &exact.Rgba[4 * (std::size_t(y) * exact.Width + x)]);
    }
  }
  trial.expectSame(exact, "the exact picture");
}

// Points on a coarse lattice: cells that are flat, inverted, or in the same place. There is no
// reference, but the result must be the same.
void coarsen(VolumeCase& test, RandomNumbers& random)
{
  if (random.below(2))
  {
    return;
  }
  double b[6];
  test.mesh().bounds(b);
  const double step = diagonalOf(b) / (8 + random.below(24));
  for (glm::dvec3& p : test.mesh().Points)
  {
    p = step * glm::round(p / step);
  }
}

void checkAgain(VolumeTrial& trial)
{
  trial.picture();
  for (int i = 0; i < 2; ++i)
  {
    trial.expectSame(
      trial.stage().draw(trial.scene()),
      [](int x, int y) {
        return std::array<int, 2>{ x, y };
      },
      0.0, "drawn again");
  }
}

void useNative(VolumeCase& test, RandomNumbers&)
{
  test.Backend = vtkTetrahedraRayCastMapper::NATIVE;
}

void useShader(VolumeCase& test, RandomNumbers& random)
{
  test.Backend =
    random.below(2) ? vtkTetrahedraRayCastMapper::OPENGL : vtkTetrahedraRayCastMapper::COMPUTE;
}

void checkBackends(VolumeTrial& trial)
{
  const int native = vtkTetrahedraRayCastMapper::NATIVE;
  VolumeCase changed = trial.scene();
  changed.Backend = native;
  trial.picture();
  // Each image is within its own tolerance of the exact one.
  trial.expectSame(
    trial.stage().draw(changed),
    [](int x, int y) {
      return std::array<int, 2>{ x, y };
    },
    plainTolerance(native) + plainTolerance(trial.scene().Backend), "native");
}

void checkCompactTables(VolumeTrial& trial)
{
  trial.picture();
  trial.stage().place(trial.scene());
  trial.stage().mapper()->SetCompactTables(true);
  trial.expectSame(trial.stage().render(), "compact tables");
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<VolumeRelation> stateRelations()
{
  const CaseNeeds any;
  // Lighting in the medium has no exact reference, and the patches of waves are not the waves
  // themselves.
  CaseNeeds exact;
  exact.NoGradients = true;
  exact.NoMembrane = true;
  CaseNeeds small;
  small.Small = true;
  return {
    editRelation({ "values", spoilValues, editValues }),
    editRelation({ "points", spoilPoints, editPoints }),
    editRelation({ "cells", spoilCells, editCells }),
    { "edits in place: functions", 3, any, checkEditedFunctions, nullptr },
    { "later frames", 4, small, checkLaterFrames, nullptr },
    { "exact picture", 6, exact, checkExact, nullptr },
    { "drawn again", 4, any, checkAgain, coarsen },
    { "threads", 2, any, checkThreads, useNative },
    { "backends", 8, any, checkBackends, useShader },
    { "compact tables", 2, any, checkCompactTables, useShader },
  };
}

} // namespace test
} // namespace meniscus
