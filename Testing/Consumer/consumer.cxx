// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Uses both classes of an installed Meniscus, one refracts a sphere, the other draws a volume; and
// registers a backend of its own.
#include <RayCastBackend.h>
#include <RayCastBackendRegistry.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkRTAnalyticSource.h>
#include <vtkRefractedGeometryFilter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace
{
bool Refract()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0, 0, -1);
  vtkNew<vtkPlaneSource> membrane;
  membrane->SetOrigin(-2, -2, 0);
  membrane->SetPoint1(2, -2, 0);
  membrane->SetPoint2(-2, 2, 0);
  vtkNew<vtkRefractedGeometryFilter> filter;
  filter->SetInputConnection(0, sphere->GetOutputPort());
  filter->SetInputConnection(1, membrane->GetOutputPort());
  filter->SetEyePosition(0, 0, 3);
  filter->Update();
  const auto count = filter->GetOutput()->GetNumberOfPoints();
  std::cout << filter->GetClassName() << ": " << count << " virtual points\n";
  return count > 0;
}

/** Fills the image with white. */
class White : public meniscus::RayCastBackend
{
public:
  std::string CanDraw(const meniscus::RayCastRequest& request) override
  {
    return request.GetMesh().NumberOfCells > 0 ? "" : "there is no mesh";
  }
  std::string Cast(const meniscus::RayCastRequest&, meniscus::RayCastTarget& target) override
  {
    return target.WriteImage(
      std::vector<float>(std::size_t{ 4 } * target.GetWidth() * target.GetHeight(), 1.0f));
  }
};

/** @param backend  name of the one to draw with; empty for the library's choice. */
bool Draw(const std::string& backend, double least, double most)
{
  vtkNew<vtkRTAnalyticSource> field;
  field->SetWholeExtent(-4, 4, -4, 4, -4, 4);
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputConnection(field->GetOutputPort());
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputConnection(tetrahedra->GetOutputPort());
  mapper->SetBackendName(backend.c_str());
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->GetScalarOpacity()->AddSegment(0, 0, 300, 1);
  volume->GetProperty()->SetColor(volume->GetProperty()->GetScalarOpacity());
  vtkNew<vtkRenderer> renderer;
  renderer->AddVolume(volume);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(200, 200);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, 199, 199, 0, pixels);
  const double brightest = pixels->GetMaxNorm();
  std::cout << mapper->GetClassName() << " by " << mapper->GetActiveBackendName()
            << ": brightest pixel " << brightest << " of 442\n";
  return brightest > least && brightest < most &&
    (backend.empty() || backend == mapper->GetActiveBackendName());
}

/** The file that the tutorial's program reads. */
bool WriteMesh()
{
  vtkNew<vtkRTAnalyticSource> field;
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputConnection(field->GetOutputPort());
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputConnection(tetrahedra->GetOutputPort());
  writer->SetFileName("mesh.vtu");
  return writer->Write() != 0;
}
}

int main()
{
  const bool drawn = Draw("", 100.0, 443.0);
  const bool registered = meniscus::RegisterRayCastBackend(
    { "White", [](meniscus::RayCastSharing&) { return std::make_unique<White>(); } });
  const bool drawnWhite = registered && Draw("White", 440.0, 443.0);
  return Refract() && drawn && drawnWhite && WriteMesh() ? EXIT_SUCCESS : EXIT_FAILURE;
}
