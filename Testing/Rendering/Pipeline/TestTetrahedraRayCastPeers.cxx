// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes with the purposes of VTK's own tests of unstructured grid mappers, drawn by this mapper
// and by vtkUnstructuredGridVolumeRayCastMapper in the same run: meshes with cavities, opaque
// blocks, moved volumes, a close camera, grey levels, direct colours, several components, cell
// data, attenuation greater than 1, a component selected by the colour function.
//
// The tolerance follows from the errors that the peer documents in its source. Its linear
// integrator is exact for piecewise linear functions, its homogeneous one for cell data. Its image
// is made of
// - rays through the lower left corners of the pixels: the camera's window centre is moved by half
//   a pixel to compensate;
// - colours and opacities truncated to whole steps of 1/255: up to one step too small, never too
//   large;
// - rays that end at an opacity of 0.99: colour and opacity are too small by at most 0.01 more;
// - scalars interpolated linearly on the projected faces, which is exact without perspective only:
//   the scenes are parallel projections;
// - an image that is stretched over the window by n pixels to n - 1 and interpolated: it is read
//   before that.
//
// Therefore 255 times the difference of this mapper's image and the peer's lies in [0, 1], or in
// [0, 1 + 2.55] where the opacity is 0.99 or more, up to the single precision of both, 1e-4 of a
// step and more for hundreds of terms: a fiftieth of a step is allowed for that.
#include "RayCastScene.h"

#include <vtkPointDataToCellData.h>
#include <vtkUnstructuredGridHomogeneousRayIntegrator.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 90;
constexpr double Rounding = 0.02;
constexpr double EndOpacity = 0.99;

// VTK's ray caster, with access to its image before that is stretched over the window.
class PeerMapper : public vtkUnstructuredGridVolumeRayCastMapper
{
public:
  static PeerMapper* New() { return new PeerMapper; }

  FloatImage MakePicture() const
  {
    FloatImage image;
    image.Width = image.Height = Size;
    image.Rgba.resize(std::size_t{ 4 } * Size * Size);
    for (const auto& [y, x] : Product(this->ImageInUseSize[1], this->ImageInUseSize[0]))
    {
      const unsigned char* rgba = this->Image + 4 * (y * this->ImageMemorySize[0] + x);
      float* to = &image.Rgba[4 * ((y + this->ImageOrigin[1]) * Size + x + this->ImageOrigin[0])];
      std::copy(rgba, rgba + 4, to);
    }
    return image;
  }
};

struct PeerScene
{
  Grid Mesh;
  /** Used by the peer instead of the mesh, if set. */
  Grid PeerMesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
  vtkSmartPointer<vtkTransform> Transform;
  double Azimuth = 20.0;
  double Elevation = 10.0;
  double Zoom = 1.0;
  bool Cells = false;
};

void MakePlace(VolumeScene& view, const PeerScene& scene, vtkUnstructuredGridVolumeMapper* mapper)
{
  view.SetMapper(mapper);
  view.SetProperty(scene.Property);
  if (scene.Transform)
  {
    view.GetVolume()->SetUserTransform(scene.Transform);
  }
  LookAt(view.GetRenderer(), view.GetVolume()->GetBounds(), scene.Azimuth, scene.Elevation,
    scene.Zoom, true);
}

FloatImage DrawOurs(const PeerScene& scene)
{
  VolumeScene view(Size, Size);
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetBackend(BackendUnderTest());
  mapper->SetInputData(scene.Mesh);
  MakePlace(view, scene, mapper);
  return view.RenderFloat();
}

FloatImage DrawPeer(const PeerScene& scene)
{
  VolumeScene view(Size, Size);
  const auto mapper = vtkSmartPointer<PeerMapper>::Take(PeerMapper::New());
  mapper->SetImageSampleDistance(1.0);
  mapper->AutoAdjustSampleDistancesOff();
  vtkNew<vtkUnstructuredGridLinearRayIntegrator> linear;
  vtkNew<vtkUnstructuredGridHomogeneousRayIntegrator> homogeneous;
  mapper->SetRayIntegrator(linear);
  if (scene.Cells)
  {
    // The default is 1024 entries; with so many, the nearest one is exact within the accepted
    // rounding.
    homogeneous->SetTransferFunctionTableSize(1 << 20);
    mapper->SetRayIntegrator(homogeneous);
  }
  mapper->SetInputData(scene.PeerMesh ? scene.PeerMesh : scene.Mesh);
  MakePlace(view, scene, mapper);
  view.GetRenderer()->GetActiveCamera()->SetWindowCenter(1.0 / Size, 1.0 / Size);
  view.GetWindow()->Render();
  return mapper->MakePicture();
}

void ExpectPicturesMatch(const PeerScene& scene, const std::string& what)
{
  const FloatImage ours = DrawOurs(scene);
  const FloatImage peer = DrawPeer(scene);
  std::size_t covered = 0;
  std::size_t outside = 0;
  double least = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < ours.Rgba.size(); ++i)
  {
    const double opacity = ours.Rgba[i | 3];
    const double bound =
      1.0 + Rounding + (opacity >= EndOpacity ? 255.0 * (1.0 - EndOpacity) : 0.0);
    // The peer clamps colours beyond 1.
    const double difference = 255.0 * std::min(1.0f, ours.Rgba[i]) - peer.Rgba[i];
    covered += i % 4 == 3 && opacity > 0.0;
    outside += difference < -Rounding || difference > bound;
    least = std::min(least, difference);
    most = std::max(most, difference);
  }
  EXPECT_GT(covered, 1000u) << what;
  EXPECT_EQ(outside, 0u) << what << ": differences of " << least << " to " << most << ", "
                         << covered << " pixels covered";
}

vtkSmartPointer<vtkColorTransferFunction> Rainbow()
{
  const auto colors = MakeColors({ { -2.0, 0.0, 0.0, 0.0 }, { -0.2, 0.0, 0.0, 1.0 },
    { 0.1, 1.0, 0.0, 0.0 }, { 0.5, 0.0, 1.0, 0.0 }, { 2.0, 0.0, 1.0, 1.0 } });
  return colors;
}

// Nodes at the places of the colours' nodes: the peer ignores others.
vtkSmartPointer<vtkPiecewiseFunction> Ramp(double factor)
{
  const auto opacities = MakeOpacity(
    { { -2.0, 0.0 }, { -0.2, 0.1 * factor }, { 0.5, 0.5 * factor }, { 2.0, 0.2 * factor } });
  return opacities;
}

PeerScene MakeScene(const Grid& mesh, double factor = 1.0)
{
  PeerScene scene;
  scene.Mesh = mesh;
  scene.Property = vtkSmartPointer<vtkVolumeProperty>::New();
  scene.Property->SetColor(Rainbow());
  scene.Property->SetScalarOpacity(Ramp(factor));
  scene.Property->SetScalarOpacityUnitDistance(0.8);
  scene.Property->SetInterpolationTypeToLinear();
  return scene;
}

Grid MakeWavyBlock(const Region& region = nullptr)
{
  return MakeBlock(4, WavyField(3.0), region);
}

// Sets a point array of several fields: the mesh's own, a linear one and so on.
void SetComponents(const Grid& mesh, const std::vector<Field>& fields)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(ScalarName);
  array->SetNumberOfComponents(static_cast<int>(fields.size()));
  array->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType p = 0; p < mesh->GetNumberOfPoints(); ++p)
  {
    const double* x = mesh->GetPoint(p);
    for (std::size_t c = 0; c < fields.size(); ++c)
    {
      array->SetComponent(p, static_cast<int>(c), fields[c](x[0], x[1], x[2]));
    }
  }
  mesh->GetPointData()->SetScalars(array);
}

} // anonymous namespace

TEST(TetrahedraRayCastPeers, MeshesWithCavities)
{
  for (const Region& region : { Region(nullptr), Shell(0.4, 1.2), LShape() })
  {
    ExpectPicturesMatch(MakeScene(MakeWavyBlock(region)), "region");
  }
}

TEST(TetrahedraRayCastPeers, CloseCamera)
{
  PeerScene scene = MakeScene(MakeWavyBlock());
  scene.Zoom = 5.0;
  ExpectPicturesMatch(scene, "close");
}

// Opacities are attenuation per unit distance and may exceed 1; rays end early.
TEST(TetrahedraRayCastPeers, AttenuationGreaterThanOne)
{
  for (const double factor : { 5.0, 60.0 })
  {
    ExpectPicturesMatch(MakeScene(MakeWavyBlock(), factor), "factor " + std::to_string(factor));
  }
}

TEST(TetrahedraRayCastPeers, MovedVolume)
{
  PeerScene scene = MakeScene(MakeWavyBlock(LShape()));
  scene.Transform = vtkSmartPointer<vtkTransform>::New();
  scene.Transform->Translate(2.0, -3.0, 1.0);
  scene.Transform->RotateWXYZ(35.0, 1.0, 2.0, 0.5);
  ExpectPicturesMatch(scene, "moved");
}

TEST(TetrahedraRayCastPeers, GreyLevels)
{
  PeerScene scene = MakeScene(MakeWavyBlock());
  const auto grey = MakeOpacity({ { -2.0, 0.0 }, { -0.2, 0.7 }, { 0.5, 0.2 }, { 2.0, 1.0 } });
  scene.Property->SetColor(grey);
  ExpectPicturesMatch(scene, "grey");
}

// Four dependent components: colour and attenuation of each point. The peer uses no functions for
// these, so the opacity function is the identity here.
TEST(TetrahedraRayCastPeers, ColorsAsTheyAre)
{
  PeerScene scene = MakeScene(MakeWavyBlock());
  const Field wavy = WavyField(2.0);
  const auto share = [wavy](double shift)
  {
    return [=](double x, double y, double z)
    { return std::clamp(0.5 + 0.5 * wavy(x + shift, y, z), 0.0, 1.0); };
  };
  SetComponents(scene.Mesh, { share(0.0), share(0.7), share(1.6), share(2.9) });
  scene.Property->SetScalarOpacity(MakeOpacity({ { 0.0, 0.0 }, { 1.0, 1.0 } }));
  scene.Property->IndependentComponentsOff();
  ExpectPicturesMatch(scene, "colours");
}

TEST(TetrahedraRayCastPeers, CellsOfOneValue)
{
  PeerScene scene = MakeScene(MakeWavyBlock());
  vtkNew<vtkPointDataToCellData> average;
  average->SetInputData(scene.Mesh);
  average->PassPointDataOff();
  average->Update();
  scene.Mesh = vtkUnstructuredGrid::SafeDownCast(average->GetOutput());
  scene.Mesh->GetCellData()->SetActiveScalars(ScalarName);
  scene.Cells = true;
  ExpectPicturesMatch(scene, "cells");
}

// The component that the colour function selects is drawn; the peer gets that component alone.
TEST(TetrahedraRayCastPeers, ComponentOfTheColorFunction)
{
  PeerScene scene = MakeScene(MakeWavyBlock());
  scene.PeerMesh = MakeWavyBlock();
  const std::vector<Field> fields{ LinearField(0.5, 0.2, 0.1), WavyField(3.0), RadialField() };
  SetComponents(scene.Mesh, fields);
  for (int component = 0; component < 3; ++component)
  {
    SetComponents(scene.PeerMesh, { fields[component] });
    vtkColorTransferFunction* colors = scene.Property->GetRGBTransferFunction();
    colors->SetVectorModeToComponent();
    colors->SetVectorComponent(component);
    ExpectPicturesMatch(scene, "component " + std::to_string(component));
  }
}
