// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Depths that frames write, and picks that end at opaque geometry: these need a window.
#include "RayCastScene.h"

#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkTetrahedraVolumePicker.h>
#include <vtkWorldPointPicker.h>

using namespace meniscus::test;
using Mapper = vtkTetrahedraRayCastMapper;

namespace
{

constexpr int Size = 64;
constexpr double Near = 2.0;
constexpr double Far = 9.0;

/** A cube in which attenuation is the way t from its front; seen along -z from a distance of 5. */
struct DepthScene
{
  explicit DepthScene(bool parallel)
    : Scene(MakeBlock(3, [](double, double, double z) { return 0.5 - 0.5 * z; }),
        MakeConstantProperty(1.0, 1.0, 1.0, 1.0, 0.5), Size, Size)
  {
    this->Scene.GetVolume()->GetProperty()->SetScalarOpacity(
      MakeOpacity({ { 0.0, 0.0 }, { 1.0, 1.0 } }));
    this->Scene.GetRayCaster()->SetBackend(BackendUnderTest());
    vtkCamera* camera = this->Scene.GetRenderer()->GetActiveCamera();
    camera->SetParallelProjection(parallel);
    camera->SetPosition(0.0, 0.0, 5.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetParallelScale(1.5);
    camera->SetClippingRange(Near, Far);
  }
  double RenderAndRead(int column, int row)
  {
    this->Scene.GetWindow()->Render();
    return this->Scene.GetRenderer()->GetZ(column, row);
  }

  RayCastScene Scene;
};

/** Window depth of a distance in front of the camera. */
double WindowDepth(bool parallel, double z)
{
  return parallel ? (z - Near) / (Far - Near) : Far * (z - Near) / (z * (Far - Near));
}

/**
 * Depths are stored with 24 bits at least and read as floats: half a unit each. The caster's own
 * error is 1e-6 of the diagonal, sqrt(12), at most; the derivative of the window depth by z is at
 * most Far / (Near (Far - Near)).
 */
const double Tolerance =
  std::ldexp(1.0, -24) + 1.0e-6 * std::sqrt(12.0) * Far / (Near * (Far - Near));

}

//------------------------------------------------------------------------------
TEST(TetrahedraRayCastDepth, ClosedForm)
{
  for (const bool parallel : { true, false })
  {
    DepthScene scene(parallel);
    Mapper* mapper = scene.Scene.GetRayCaster();
    // The ray of this pixel is parallel to the axis up to half a pixel.
    const int middle = Size / 2;
    EXPECT_EQ(scene.RenderAndRead(middle, middle), 1.0);
    const PixelRays rays(scene.Scene.GetRenderer());
    const auto direction = rays.GetRay(middle, middle).Direction;
    const double oblique = std::sqrt(
      direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
    mapper->SetDepthWriting(Mapper::FIRST_VISIBLE_DEPTH);
    EXPECT_NEAR(scene.RenderAndRead(middle, middle), WindowDepth(parallel, 4.0), Tolerance);
    EXPECT_EQ(scene.RenderAndRead(0, 0), 1.0);
    // The same frame again.
    EXPECT_NEAR(scene.RenderAndRead(middle, middle), WindowDepth(parallel, 4.0), Tolerance);
    mapper->SetDepthWriting(Mapper::OPACITY_DEPTH);
    for (const double opacity : { 0.5, 0.3 })
    {
      mapper->SetDepthOpacity(opacity);
      // 1 - exp(-oblique t t / 2) = opacity.
      const double z = 4.0 + std::sqrt(-2.0 * std::log1p(-opacity) / oblique);
      EXPECT_NEAR(scene.RenderAndRead(middle, middle), WindowDepth(parallel, z), Tolerance)
        << parallel << " " << opacity;
    }
    // Never reached: 1 - exp(-2).
    mapper->SetDepthOpacity(0.9);
    EXPECT_EQ(scene.RenderAndRead(middle, middle), 1.0);
    mapper->SetDepthWriting(Mapper::NO_DEPTH);
    EXPECT_EQ(scene.RenderAndRead(middle, middle), 1.0);
  }
}

//------------------------------------------------------------------------------
/**
 * Behind refracting planes a place is drawn on the straight ray, at the lengths of the legs times
 * n0 / n (Eq. 2.4), whatever the pixel.
 */
TEST(TetrahedraRayCastDepth, BehindRefractingSurfaces)
{
  struct Plane
  {
    double Z;
    double Index; ///< behind it
  };
  const std::vector<Plane> water{ { 1.5, 1.333 } };
  const std::vector<Plane> pane{ { 2.0, 1.5 }, { 1.75, 1.333 } };
  for (const std::vector<Plane>& planes : { water, pane })
  {
    DepthScene scene(false);
    Mapper* mapper = scene.Scene.GetRayCaster();
    vtkNew<vtkRefractingInterfaceCollection> interfaces;
    double before = 1.0;
    for (const Plane& plane : planes)
    {
      const auto surface = MakePlane(9.0, plane.Z, 1);
      surface->Update();
      mapper->AddMembraneData(surface->GetOutput());
      vtkNew<vtkRefractingInterface> item;
      item->SetExteriorIndexOfRefraction(before);
      item->SetInteriorIndexOfRefraction(plane.Index);
      interfaces->AddItem(item);
      before = plane.Index;
    }
    mapper->SetInterfaces(interfaces);
    for (const int column : { Size / 2, Size / 2 + 9 })
    {
      const int row = Size / 2 - 5;
      const PixelRays rays(scene.Scene.GetRenderer());
      const auto direction = rays.GetRay(column, row).Direction;
      const double across = std::hypot(direction[0], direction[1]);
      const double cosine = 1.0 / std::hypot(1.0, across);
      const double sine = across * cosine;
      const auto cosineIn = [sine](double index)
      { return std::sqrt(1.0 - sine * sine / (index * index)); };
      // Depth at which a place at this true z is drawn.
      const auto drawn = [&](double z)
      {
        double length = (5.0 - planes.front().Z) / cosine;
        for (std::size_t k = 0; k < planes.size(); ++k)
        {
          const double end = k + 1 < planes.size() ? planes[k + 1].Z : z;
          length += (planes[k].Z - end) / cosineIn(planes[k].Index) / planes[k].Index;
        }
        return WindowDepth(false, length * cosine);
      };
      mapper->SetDepthWriting(Mapper::FIRST_VISIBLE_DEPTH);
      EXPECT_NEAR(scene.RenderAndRead(column, row), drawn(1.0), Tolerance);
      mapper->SetDepthWriting(Mapper::OPACITY_DEPTH);
      mapper->SetDepthOpacity(0.5);
      const double t = std::sqrt(2.0 * std::log(2.0) * cosineIn(planes.back().Index));
      EXPECT_NEAR(scene.RenderAndRead(column, row), drawn(1.0 - t), Tolerance);
    }
  }
}

//------------------------------------------------------------------------------
TEST(TetrahedraRayCastDepth, OtherPickersSeeTheVolume)
{
  DepthScene scene(false);
  scene.Scene.GetRayCaster()->SetDepthWriting(Mapper::OPACITY_DEPTH);
  scene.Scene.GetWindow()->Render();
  vtkNew<vtkWorldPointPicker> other;
  vtkNew<vtkTetrahedraVolumePicker> picker;
  picker->SetPlaceToOpacityReached();
  const int middle = Size / 2;
  vtkRenderer* renderer = scene.Scene.GetRenderer();
  ASSERT_EQ(picker->Pick(middle, middle, 0.0, renderer), 1);
  other->Pick(middle, middle, 0.0, renderer);
  // Depth 24 bits, times the largest derivative of z by the window depth.
  EXPECT_NEAR(other->GetPickPosition()[2], picker->GetPickPosition()[2],
    2.0 * Tolerance * Far * (Far - Near) / Near);
}

//------------------------------------------------------------------------------
/** The picture is the same with depths, and nearer opaque geometry keeps its depth. */
TEST(TetrahedraRayCastDepth, PictureAndOpaqueGeometry)
{
  DepthScene scene(false);
  const FloatImage without = scene.Scene.RenderFloat();
  scene.Scene.GetRayCaster()->SetDepthWriting(Mapper::FIRST_VISIBLE_DEPTH);
  ExpectSamePicture(without, scene.Scene.RenderFloat(), "with depths");
  const int middle = Size / 2;
  vtkRenderer* renderer = scene.Scene.GetRenderer();
  const double distance = AddBlackSquare(renderer, -1.5);
  renderer->GetActiveCamera()->SetClippingRange(Near, Far);
  EXPECT_NEAR(scene.RenderAndRead(middle, middle), WindowDepth(false, distance), Tolerance);
}

//------------------------------------------------------------------------------
TEST(TetrahedraRayCastDepth, PicksEndAtOpaqueGeometry)
{
  DepthScene scene(true);
  vtkRenderer* renderer = scene.Scene.GetRenderer();
  const double distance = AddBlackSquare(renderer, -0.5);
  renderer->GetActiveCamera()->SetClippingRange(Near, Far);
  EXPECT_DOUBLE_EQ(distance, 4.5);
  vtkNew<vtkTetrahedraVolumePicker> picker;
  const int middle = Size / 2;
  using Picker = vtkTetrahedraVolumePicker;
  const double half = 4.0 + std::sqrt(2.0 * std::log(2.0));
  // Without a frame there is no depth to end at.
  picker->UseOpaqueDepthOn();
  ASSERT_EQ(picker->Pick(middle, middle, 0.0, renderer), 1);
  EXPECT_NEAR(picker->GetDepthOf(Picker::OPACITY_REACHED), half, 4.0e-6);
  scene.Scene.GetWindow()->Render();
  picker->UseOpaqueDepthOff();
  ASSERT_EQ(picker->Pick(middle, middle, 0.0, renderer), 1);
  EXPECT_NEAR(picker->GetDepthOf(Picker::OPACITY_REACHED), half, 4.0e-6);
  picker->UseOpaqueDepthOn();
  ASSERT_EQ(picker->Pick(middle, middle, 0.0, renderer), 1);
  EXPECT_TRUE(std::isnan(picker->GetDepthOf(Picker::OPACITY_REACHED)));
  EXPECT_NEAR(picker->GetDepthOf(Picker::FIRST_VISIBLE), 4.0, 4.0e-6);
  // Attenuation rises up to the square.
  EXPECT_NEAR(picker->GetDepth(), 4.5, 4.0e-6);
}
