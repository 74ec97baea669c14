// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The scenes of VTK's own tests of mappers of unstructured grids, made anew, drawn by this mapper and by
// VTK's in the same run: opaque surfaces inside, a camera among the cells, moved volumes, hexahedra,
// colours from HSV, grey levels, colours as they are, several components, concave meshes, cell data.
#include "RayCastScene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkConeSource.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkDoubleArray.h>
#include <vtkMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPointDataToCellData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProjectedTetrahedraMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridHomogeneousRayIntegrator.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkUnstructuredGridVolumeZSweepMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace meniscus::test;

namespace
{

constexpr int Size = 60;

using Mapper = vtkSmartPointer<vtkUnstructuredGridVolumeMapper>;
using MakeMapper = std::function<Mapper()>;
// Volumes and other props of a scene; called once for each mapper that draws it.
using Build = std::function<void(VolumeScene&, const MakeMapper&)>;

Mapper makeOurs()
{
  auto mapper = vtkSmartPointer<vtkTetrahedraRayCastMapper>::New();
  mapper->SetBackend(backendUnderTest());
  return mapper;
}

// A caster of VTK's whose picture can be read before it is stretched over the window.
template <typename Caster>
class OpenCaster : public Caster
{
public:
  static OpenCaster* New() { return new OpenCaster; }

  FloatImage picture() const
  {
    FloatImage image;
    image.Width = image.Height = Size;
    image.Rgba.resize(std::size_t{ 4 } * Size * Size);
    for (int y = 0; y < this->ImageInUseSize[1]; ++y)
    {
      for (int x = 0; x < this->ImageInUseSize[0]; ++x)
      {
        const unsigned char* rgba = this->Image + 4 * (y * this->ImageMemorySize[0] + x);
        float* to = &image.Rgba[4 * ((y + this->ImageOrigin[1]) * Size + x + this->ImageOrigin[0])];
        std::copy(rgba, rgba + 4, to);
      }
    }
    return image;
  }
};
using RayCaster = OpenCaster<vtkUnstructuredGridVolumeRayCastMapper>;
using Sweep = OpenCaster<vtkUnstructuredGridVolumeZSweepMapper>;
using Linear = vtkUnstructuredGridLinearRayIntegrator;
using Homogeneous = vtkUnstructuredGridHomogeneousRayIntegrator;

template <typename Caster, typename Integrator>
FloatImage drawPeer(const Build& build, double shift)
{
  VolumeScene scene(Size, Size);
  const auto mapper = vtkSmartPointer<Caster>::New();
  mapper->SetImageSampleDistance(1.0);
  mapper->AutoAdjustSampleDistancesOff();
  vtkNew<Integrator> integrator;
  mapper->SetRayIntegrator(integrator);
  build(scene, [&]() { return mapper; });
  scene.renderer()->GetActiveCamera()->SetWindowCenter(shift / Size, shift / Size);
  scene.window()->Render();
  return mapper->picture();
}

FloatImage drawOurs(const Build& build)
{
  VolumeScene scene(Size, Size);
  build(scene, makeOurs);
  return scene.renderFloat();
}

void reportFloat(const std::string& what, const FloatImage& peer, const FloatImage& ours)
{
  float lo[2] = { 0, 0 }, hi[2] = { 0, 0 };
  std::size_t covered = 0, out = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < peer.Rgba.size(); ++i)
  {
    const float d = peer.Rgba[i] - 255.0f * ours.Rgba[i];
    const int k = i % 4 == 3;
    lo[k] = std::min(lo[k], d);
    hi[k] = std::max(hi[k], d);
    covered += k && ours.Rgba[i] > 0.0f;
    out += d < -1.1 || d > 0.1;
    sum += d * d;
  }
  std::printf("%-30s covered %zu colour %.2f %.2f alpha %.2f %.2f out %zu rms %.2f\n", what.c_str(), covered, lo[0], hi[0], lo[1], hi[1], out, std::sqrt(sum / peer.Rgba.size()));
}

Mapper makeProjected()
{
  return vtkSmartPointer<vtkProjectedTetrahedraMapper>::New();
}

ByteImage draw(const Build& build, const MakeMapper& make, double shift)
{
  VolumeScene scene(Size, Size);
  build(scene, make);
  scene.renderer()->GetActiveCamera()->SetWindowCenter(shift / Size, shift / Size);
  return scene.renderBytes();
}

void addVolume(VolumeScene& scene, const MakeMapper& make, vtkUnstructuredGrid* grid,
  vtkVolumeProperty* property)
{
  const Mapper mapper = make();
  mapper->SetInputData(grid);
  scene.setMapper(mapper);
  scene.setProperty(property);
}

struct Differences
{
  std::array<std::size_t, 511> Counts{};
  std::size_t Covered = 0;
  std::size_t Pixels = 0;
};

Differences compare(const ByteImage& peer, const ByteImage& ours)
{
  Differences differences;
  for (std::size_t i = 0; i < peer.Rgb.size(); i += 3)
  {
    int worst = 0;
    bool covered = false;
    for (std::size_t c = i; c < i + 3; ++c)
    {
      const int difference = peer.Rgb[c] - ours.Rgb[c];
      worst = std::abs(difference) > std::abs(worst) ? difference : worst;
      covered = covered || ours.Rgb[c] != ours.Rgb[c - i];
    }
    ++differences.Counts[255 + worst];
    differences.Covered += covered;
    ++differences.Pixels;
  }
  return differences;
}

void report(const std::string& what, const Differences& d)
{
  std::printf("%-40s covered %zu:", what.c_str(), d.Covered);
  for (int i = 0; i < 511; ++i)
  {
    if (d.Counts[i])
    {
      std::printf(" %d:%zu", i - 255, d.Counts[i]);
    }
  }
  std::printf("\n");
}

vtkSmartPointer<vtkVolumeProperty> makeFunctions(vtkColorTransferFunction* colors,
  vtkPiecewiseFunction* opacities, double unit)
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(colors);
  property->SetScalarOpacity(opacities);
  property->SetScalarOpacityUnitDistance(unit);
  property->SetInterpolationTypeToLinear();
  return property;
}

vtkSmartPointer<vtkVolumeProperty> rainbow(double unit)
{
  vtkNew<vtkColorTransferFunction> colors;
  vtkNew<vtkPiecewiseFunction> opacities;
  colors->AddRGBPoint(-0.2, 0.0, 0.0, 0.0);
  colors->AddRGBPoint(0.1, 0.0, 0.0, 1.0);
  colors->AddRGBPoint(0.3, 1.0, 0.0, 0.0);
  colors->AddRGBPoint(0.6, 0.0, 1.0, 0.0);
  colors->AddRGBPoint(1.0, 0.0, 1.0, 1.0);
  opacities->AddPoint(-0.2, 0.0);
  opacities->AddPoint(0.1, 0.2);
  opacities->AddPoint(1.0, 0.2);
  return makeFunctions(colors, opacities, unit);
}

void addBall(VolumeScene& scene, double radius)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(24);
  ball->SetPhiResolution(24);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.renderer()->AddActor(actor);
}

} // anonymous namespace

TEST(TetrahedraRayCastPeers, Experiment)
{
  const auto function = [](int which)
  {
    vtkNew<vtkColorTransferFunction> colors;
    vtkNew<vtkPiecewiseFunction> opacities;
    colors->AddRGBPoint(-2.0, which == 1 ? 0.0 : 1.0, 0.5, 0.25);
    colors->AddRGBPoint(2.0, 1.0, 0.5, 0.25);
    opacities->AddPoint(-2.0, which == 2 ? 0.0 : 0.5);
    opacities->AddPoint(2.0, 0.5);
    return makeFunctions(colors, opacities, 0.8);
  };
  for (int which = 0; which < 8; ++which)
  {
    const auto build = [=](VolumeScene& scene, const MakeMapper& make)
    {
      addVolume(scene, make, makeBlock(4, wavyField(3.0)), which % 4 < 3 ? function(which % 4) : rainbow(0.8));
      const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
      lookAt(scene.renderer(), bounds, 20.0, 10.0, 1.0, which < 4);
    };
    const FloatImage ours = drawOurs(build);
    for (double shift : { 0.0, 1.0 })
    {
      reportFloat("ray" + std::to_string(which), drawPeer<RayCaster, Linear>(build, shift), ours);
      reportFloat("sweep" + std::to_string(which), drawPeer<Sweep, Linear>(build, shift), ours);
    }
    report("projected" + std::to_string(which), compare(draw(build, makeProjected, 0.0), draw(build, makeOurs, 0.0)));
  }
}
