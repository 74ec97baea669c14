// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// An error volume drawn as the thesis's figure 4.2 draws it: a cube of 400 flush with the top of a
// hemisphere (yellow), one block per sample, green below one unit, blue below 10, red below 100,
// white above, darker for smaller errors within each colour; cut open in the middle.
#include "RefractionPicture.h"
#include "StrictImage.h"
#include "VTKTestBasics.h"

#include <vtkGlyph3D.h>
#include <vtkRefractionErrorVolume.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 300;
constexpr int Threshold = 1; // grey levels: rounding to 8 bits
constexpr int Samples = 20;
constexpr double Spacing = 20.0;
constexpr double Radius = 141.5;

/** The blocks behind the plane z = 0 that were measured. */
vtkSmartPointer<vtkPolyData> MakeBlocks(vtkImageData* volume)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  vtkDataArray* errors = volume->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < volume->GetNumberOfPoints(); ++i)
  {
    double p[3];
    volume->GetPoint(i, p);
    if (p[2] <= 0.0 && std::isfinite(errors->GetTuple1(i)))
    {
      points->InsertNextPoint(p);
      colours->InsertNextTuple(i, volume->GetPointData()->GetArray("ErrorColor"));
    }
  }
  vtkNew<vtkPolyData> centres;
  centres->SetPoints(points);
  centres->GetPointData()->SetScalars(colours);
  vtkNew<vtkCubeSource> cube;
  cube->SetXLength(Spacing);
  cube->SetYLength(Spacing);
  cube->SetZLength(Spacing);
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(centres);
  glyphs->SetSourceConnection(cube->GetOutputPort());
  glyphs->SetColorModeToColorByScalar();
  glyphs->ScalingOff();
  glyphs->Update();
  return glyphs->GetOutput();
}

void AddActor(vtkRenderer* renderer, vtkPolyData* data, bool isMembrane)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  if (isMembrane)
  {
    actor->GetProperty()->SetRepresentationToWireframe();
    actor->GetProperty()->SetColor(1.0, 1.0, 0.0);
  }
  renderer->AddActor(actor);
}

/**
 * Errors grow from the axis, along which rays are not refracted, to the rim. They are mostly below
 * 10 units, and have the same sum in each quarter of the disc.
 */
void ExpectErrorsOfTheThesis(vtkImageData* volume)
{
  vtkDataArray* errors = volume->GetPointData()->GetScalars();
  double sum[2] = { 0.0, 0.0 }; // within half of the radius, and beyond
  int count[2] = { 0, 0 };
  int below = 0;
  double quarters[4] = { 0.0, 0.0, 0.0, 0.0 };
  for (vtkIdType i = 0; i < volume->GetNumberOfPoints(); ++i)
  {
    const double error = errors->GetTuple1(i);
    if (!std::isfinite(error))
    {
      continue;
    }
    const glm::dvec3 p = PointOf(volume, i);
    const int part = std::hypot(p[0], p[2]) > 0.5 * Radius ? 1 : 0;
    sum[part] += error;
    ++count[part];
    below += error < 10.0;
    quarters[(p[0] > 0.0 ? 1 : 0) + (p[2] > 0.0 ? 2 : 0)] += error;
  }
  ASSERT_GT(count[0], 100);
  ASSERT_GT(count[1], 100);
  EXPECT_GT(below, 0.95 * (count[0] + count[1]));
  EXPECT_LT(sum[0] / count[0], 0.5 * sum[1] / count[1]);
  // The disc's mesh is the same after a quarter turn, up to rounding.
  for (const double quarter : quarters)
  {
    EXPECT_NEAR(quarter, quarters[0], 1e-6 * quarters[0]);
  }
}

} // anonymous namespace

TEST(RefractionErrorVolumeImage, LooksLikeTheThesis)
{
  const auto membrane =
    meniscus::test::MakeMembrane(meniscus::reference::MakeDisc(Radius, 5, Radius), false);
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(0.0, Radius, 0.0);
  sphere->SetRadius(Radius);
  vtkNew<vtkRefractionErrorVolume> volume;
  volume->SetInputData(membrane);
  volume->SetExactMembrane(sphere);
  volume->SetMembraneModelToFlatFacets();
  volume->SetEyePosition(0.0, 450.0, 0.0);
  volume->SetInteriorIndexOfRefraction(1.51);
  const double half = 0.5 * Spacing * (Samples - 1);
  volume->SetModelBounds(
    -half, half, Radius - Spacing * (Samples - 0.5), Radius - 0.5 * Spacing, -half, half);
  volume->SetSampleDimensions(Samples, Samples, Samples);
  volume->Update();
  // Mostly below 10 units; above that far below the rim, where rays turn the most.
  EXPECT_GT(volume->GetNumberOfMeasuredSamples(), 1000);
  EXPECT_GT(volume->GetLargestError(), 10.0);
  ExpectErrorsOfTheThesis(volume->GetOutput());

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(Size, Size);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  AddActor(renderer, MakeBlocks(volume->GetOutput()), false);
  AddActor(renderer, membrane, true);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(250.0, 250.0, 900.0);
  camera->SetFocalPoint(0.0, -30.0, 0.0);
  renderer->ResetCamera();
  camera->Zoom(1.3);
  window->Render();

  const ByteImage image = ReadBytes(window);
  const BaselineResult result = CompareToBaseline(image, "RefractionErrorVolume", Threshold);
  EXPECT_TRUE(result.Passed) << result.Message;
}
