// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceTableLimits.h"
#include "VolumeRelation.h"

#include <vtkTypeInt64Array.h>

namespace meniscus::test
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

void SpoilValues(VolumeCase& test, RandomNumbers& random)
{
  for (double& value : test.MakeMesh().Values)
  {
    value += random.Uniform(-0.5, 0.5);
  }
}

// Shrinks the mesh about its middle. It stays in view: if only the grid receives Modified(),
// vtkPoints keeps its old bounds, and the renderer culls by them.
void SpoilPoints(VolumeCase& test, RandomNumbers&)
{
  double b[6];
  test.MakeMesh().GetBounds(b);
  const glm::dvec3 center = 0.5 * glm::dvec3(b[0] + b[1], b[2] + b[3], b[4] + b[5]);
  for (glm::dvec3& p : test.MakeMesh().Points)
  {
    p = center + 0.8 * (p - center);
  }
}

// Makes every third cell one without a volume.
void SpoilCells(VolumeCase& test, RandomNumbers&)
{
  for (std::size_t c = 0; c < test.MakeMesh().Cells.size(); c += 3)
  {
    std::vector<vtkIdType>& ids = test.MakeMesh().Cells[c].Ids;
    std::fill(ids.begin(), ids.end(), ids.front());
  }
}

void EditValues(vtkUnstructuredGrid* grid, const VolumeCase& wanted, Notice notice)
{
  const MeshArrays& mesh = wanted.MakeMesh();
  vtkDataSetAttributes* owner = mesh.OnCells
    ? static_cast<vtkDataSetAttributes*>(grid->GetCellData())
    : static_cast<vtkDataSetAttributes*>(grid->GetPointData());
  vtkDataArray* array = owner->GetScalars();
  for (std::size_t i = 0; i < mesh.Tuples(); ++i)
  {
    array->SetTuple(static_cast<vtkIdType>(i), &mesh.Values[i * std::size_t(mesh.Components)]);
  }
  vtkObject* const told[3] = { array, owner, grid };
  told[static_cast<int>(notice)]->Modified();
}

void EditPoints(vtkUnstructuredGrid* grid, const VolumeCase& wanted, Notice notice)
{
  vtkPoints* points = grid->GetPoints();
  for (std::size_t i = 0; i < wanted.MakeMesh().Points.size(); ++i)
  {
    points->GetData()->SetTuple(static_cast<vtkIdType>(i), &wanted.MakeMesh().Points[i][0]);
  }
  vtkObject* const told[3] = { points->GetData(), points, grid };
  told[static_cast<int>(notice)]->Modified();
}

void EditCells(vtkUnstructuredGrid* grid, const VolumeCase& wanted, Notice notice)
{
  vtkTypeInt64Array* ids = grid->GetCells()->GetConnectivityArray64();
  vtkIdType at = 0;
  for (const MeshCell& cell : wanted.MakeMesh().Cells)
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

VolumeRelation EditRelation(const Edit& edit)
{
  CaseNeeds needs;
  needs.Small = true;
  return { std::string("edits in place: ") + edit.Name, 3, needs,
    [edit](VolumeTrial& trial)
    {
      for (int notice = 0; notice < 3; ++notice)
      {
        trial.MakePicture();
        VolumeCase spoilt = trial.MakeScene();
        edit.Spoil(spoilt, trial.MakeRandom());
        trial.GetStage().Draw(spoilt);
        edit.Apply(trial.GetStage().MakeGrid(), trial.MakeScene(), static_cast<Notice>(notice));
        trial.ExpectSame(
          trial.GetStage().Render(), std::string(edit.Name) + " told by " + NoticeNames[notice]);
      }
    },
    nullptr };
}

//------------------------------------------------------------------------------
// Control points moved in the property's own objects.
void CheckEditedFunctions(VolumeTrial& trial)
{
  trial.MakePicture();
  VolumeCase other = trial.MakeScene();
  for (LookFunction& function : other.Look.Functions)
  {
    std::reverse(function.Color.begin(), function.Color.end());
    for (auto& point : function.Opacity)
    {
      point.Opacity *= trial.MakeRandom().Uniform();
    }
  }
  trial.GetStage().Draw(other);
  vtkVolumeProperty* property = trial.GetStage().MakeScene().GetVolume()->GetProperty();
  const auto wanted = ToProperty(trial.MakeScene().Look);
  for (int c = 0; c < static_cast<int>(trial.MakeScene().Look.Functions.size()); ++c)
  {
    property->GetScalarOpacity(c)->DeepCopy(wanted->GetScalarOpacity(c));
    property->GetRGBTransferFunction(c)->DeepCopy(wanted->GetRGBTransferFunction(c));
  }
  trial.ExpectSame(trial.GetStage().Render(), "functions edited");
}

//------------------------------------------------------------------------------
// The mapper draws something else, and then the scene again.
void CheckLaterFrames(VolumeTrial& trial)
{
  trial.MakePicture();
  VolumeStage& stage = trial.GetStage();
  const VolumeCase& scene = trial.MakeScene();
  stage.Draw(scene);
  vtkTetrahedraRayCastMapper* mapper = stage.GetMapper();
  VolumeScene& window = stage.MakeScene();
  const auto again = [&](const char* words)
  {
    stage.Render();
    scene.View.ApplyTo(window.GetRenderer());
    trial.ExpectSame(stage.Render(), words);
  };
  trial.ExpectSame(stage.Render(), "second frame");

  VolumeView elsewhere = scene.View;
  elsewhere.Eye +=
    0.2 * glm::distance(elsewhere.Eye, elsewhere.Focus) * trial.MakeRandom().GetDirection();
  elsewhere.ApplyTo(window.GetRenderer());
  again("camera moved and back");

  VolumeLook other = scene.Look;
  MapScalars(other, 1.0, 0.2, 1.0);
  const vtkSmartPointer<vtkVolumeProperty> property = window.GetVolume()->GetProperty();
  window.SetProperty(ToProperty(other));
  stage.Render();
  window.SetProperty(property);
  again("another property and back");

  window.GetWindow()->SetSize(31, 57);
  stage.Render();
  window.GetWindow()->SetSize(scene.Size, scene.Size);
  again("another size and back");

  if (scene.MakeMesh().Components == 1)
  {
    mapper->SetBlendMode(scene.Look.Blend == vtkVolumeMapper::AVERAGE_INTENSITY_BLEND
        ? vtkVolumeMapper::COMPOSITE_BLEND
        : vtkVolumeMapper::AVERAGE_INTENSITY_BLEND);
    stage.Render();
    mapper->SetBlendMode(scene.Look.Blend);
    again("another mode and back");
  }

  VolumeCase half = scene;
  half.MakeMesh().Cells.resize(1 + half.MakeMesh().Cells.size() / 2);
  half.MakeMesh().Values.resize(half.MakeMesh().Tuples() * std::size_t(half.MakeMesh().Components));
  stage.SetInput(ToGrid(half.MakeMesh(), half.Storage));
  stage.Render();
  stage.SetInput(stage.MakeGrid());
  again("another mesh and back");

  mapper->SetMembraneData(nullptr);
  stage.Render();
  mapper->SetMembraneData(scene.Membrane.Mesh);
  again("no membrane and back");

  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 3, 0.1);
  matrix->SetElement(1, 1, 1.2);
  window.GetVolume()->SetUserMatrix(matrix);
  stage.Render();
  window.GetVolume()->SetUserMatrix(nullptr);
  again("another matrix and back");

  const int usual = scene.Backend;
  mapper->SetBackend(usual == vtkTetrahedraRayCastMapper::NATIVE
      ? vtkTetrahedraRayCastMapper::OPENGL
      : vtkTetrahedraRayCastMapper::NATIVE);
  stage.Render();
  mapper->SetBackend(usual);
  again("another backend and back");
}

//------------------------------------------------------------------------------
void CheckThreads(VolumeTrial& trial)
{
  trial.MakePicture();
  // VTK's own threads are used: TBB's number of threads cannot be raised again once it was lowered.
  const std::string usual = vtkSMPTools::GetBackend();
  vtkSMPTools::SetBackend("STDThread");
  for (const int threads : { 1, 2, 3, 7 })
  {
    vtkSMPTools::Initialize(threads);
    trial.GetStage().GetMapper()->Modified(); // or the last image would be shown again
    // The same operations on the same numbers: every digit must be equal.
    trial.ExpectSame(
      trial.GetStage().Draw(trial.MakeScene()), 0.0, std::to_string(threads) + " threads");
  }
  vtkSMPTools::Initialize(0);
  vtkSMPTools::SetBackend(usual.c_str());
}

// Compares the image with the double-precision reference, which conditioning computes anyway.
void CheckExact(VolumeTrial& trial)
{
  FloatImage exact = trial.MakePicture();
  for (const auto& [y, x] : Product(exact.Height, exact.Width))
  {
    const std::array<double, 4> color = trial.GetExact(x, y);
    std::copy(color.begin(), color.end(), &exact.Rgba[4 * (std::size_t(y) * exact.Width + x)]);
  }
  trial.ExpectSame(exact, "the exact picture");
}

// Points on a coarse lattice: cells that are flat, inverted, or in the same place. There is no
// reference, but the result must be the same.
void Coarsen(VolumeCase& test, RandomNumbers& random)
{
  if (random.Below(2))
  {
    return;
  }
  double b[6];
  test.MakeMesh().GetBounds(b);
  const double step = DiagonalOf(b) / (8 + random.Below(24));
  for (glm::dvec3& p : test.MakeMesh().Points)
  {
    p = step * glm::round(p / step);
  }
}

void CheckAgain(VolumeTrial& trial)
{
  trial.MakePicture();
  for (int i = 0; i < 2; ++i)
  {
    trial.ExpectSame(trial.GetStage().Draw(trial.MakeScene()), 0.0, "drawn again");
  }
}

void UseNative(VolumeCase& test, RandomNumbers&)
{
  test.Backend = vtkTetrahedraRayCastMapper::NATIVE;
}

void UseShader(VolumeCase& test, RandomNumbers& random)
{
  test.Backend =
    random.Below(2) ? vtkTetrahedraRayCastMapper::OPENGL : vtkTetrahedraRayCastMapper::COMPUTE;
}

void CheckBackends(VolumeTrial& trial)
{
  const int native = vtkTetrahedraRayCastMapper::NATIVE;
  VolumeCase changed = trial.MakeScene();
  changed.Backend = native;
  trial.MakePicture();
  // Each image is within its own tolerance of the exact one.
  trial.ExpectSame(trial.GetStage().Draw(changed),
    PlainTolerance(native) + PlainTolerance(trial.MakeScene().Backend), "native");
}

void CheckCompactTables(VolumeTrial& trial)
{
  trial.MakePicture();
  trial.GetStage().GetPlace(trial.MakeScene());
  DeviceTableLimits::SetCompact(trial.GetStage().GetMapper(), true);
  trial.ExpectSame(trial.GetStage().Render(), "compact tables");
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<VolumeRelation> StateRelations()
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
    EditRelation({ "values", SpoilValues, EditValues }),
    EditRelation({ "points", SpoilPoints, EditPoints }),
    EditRelation({ "cells", SpoilCells, EditCells }),
    { "edits in place: functions", 3, any, CheckEditedFunctions, nullptr },
    { "later frames", 4, small, CheckLaterFrames, nullptr },
    { "exact picture", 6, exact, CheckExact, nullptr },
    { "drawn again", 4, any, CheckAgain, Coarsen },
    { "threads", 2, any, CheckThreads, UseNative },
    { "backends", 8, any, CheckBackends, UseShader },
    { "compact tables", 2, any, CheckCompactTables, UseShader },
  };
}

} // namespace meniscus::test
