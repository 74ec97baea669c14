// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Integration by the pre-integration table: its error, and when the table is built.
#include "MembraneScene.h"
#include "OpticsTruth.h"
#include "RayCastScene.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>

using namespace meniscus::test;

namespace
{

constexpr int Size = 160;

struct Block
{
  Grid Mesh = makeBlock(8, wavyField(3.0));
  double Range[2];

  Block() { this->Mesh->GetPointData()->GetScalars()->GetFiniteRange(this->Range); }

  vtkSmartPointer<vtkVolumeProperty> property(FunctionKind kind) const
  {
    return makeProperty(kind, this->Range, diagonalOf(this->Mesh->GetBounds()));
  }
};

void usePreIntegration(RayCastScene& scene, int scalars, int lengths)
{
  scene.rayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
  scene.rayCaster()->SetPreIntegrationScalarSize(scalars);
  scene.rayCaster()->SetPreIntegrationLengthSize(lengths);
}

Comparison compare(RayCastScene& scene, const SceneTruth& truth)
{
  const Comparison result =
    compareToReference(scene.renderFloat(), truth.Image, *truth.Integrator, truth.RayOf, 1.0);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfLostRays(), 0);
  return result;
}

SceneTruth truthOf(RayCastScene& scene)
{
  scene.window()->Render();
  return makeTruth(scene);
}

} // anonymous namespace

TEST(TetrahedraRayCastPreIntegration, ConvergesWithTheSizeOfTheTable)
{
  const Block block;
  for (const FunctionKind kind : { FunctionKind::Smooth, FunctionKind::Opaque })
  {
    RayCastScene scene(block.Mesh, block.property(kind), Size, Size);
    lookAt(scene.renderer(), block.Mesh->GetBounds(), 30.0, 20.0);
    const SceneTruth truth = truthOf(scene);
    double coarse = 0.0;
    double fine = 0.0;
    for (const int size : { 16, 32, 64, 128, 256, 512 })
    {
      usePreIntegration(scene, size, size / 8);
      const Comparison result = compare(scene, truth);
      RecordProperty((kind == FunctionKind::Smooth ? "smooth " : "opaque ") + std::to_string(size),
        result.text());
      coarse = size == 16 ? result.Rms : coarse;
      fine = result.Rms;
    }
    // Five doublings of both sizes.
    const double order = std::log2(coarse / fine) / 5.0;
    RecordProperty("order", std::to_string(order));
    EXPECT_GT(order, 1.0) << coarse << " to " << fine;
  }
}

// A table cannot resolve peaks of the width of a few samples: a single pixel may have a larger
// error.
TEST(TetrahedraRayCastPreIntegration, DefaultSizesAreCloseToTheReference)
{
  const Block block;
  for (const FunctionKind kind :
    { FunctionKind::Smooth, FunctionKind::Opaque, FunctionKind::Sparse, FunctionKind::Peaked })
  {
    RayCastScene scene(block.Mesh, block.property(kind), Size, Size);
    lookAt(scene.renderer(), block.Mesh->GetBounds(), 30.0, 20.0);
    const SceneTruth truth = truthOf(scene);
    scene.rayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
    const Comparison result = compare(scene, truth);
    SCOPED_TRACE(result.text());
    RecordProperty("function " + std::to_string(static_cast<int>(kind)), result.text());
    const bool narrow = kind == FunctionKind::Sparse || kind == FunctionKind::Peaked;
    EXPECT_LT(result.Largest, narrow ? 10.0 / 255.0 : 1.0 / 255.0);
    EXPECT_LT(result.Rms, narrow ? 0.5 / 255.0 : 0.05 / 255.0);
  }
}

TEST(TetrahedraRayCastPreIntegration, ThroughAMembrane)
{
  const Block block;
  for (const MembraneCase& membrane :
    { makePlaneCase(0.1, 4.0, 2), makeDomeCase(1.4, 4.0, 2.8, 16) })
  {
    RayCastScene scene(block.Mesh, block.property(FunctionKind::Smooth), Size, Size);
    scene.rayCaster()->SetMembraneData(membrane.Mesh);
    scene.rayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
    lookAt(scene.renderer(), block.Mesh->GetBounds(), 30.0, 50.0);
    scene.window()->Render();
    const auto integrator = makeReference(block.Mesh);
    const auto function = toReference(scene.volume()->GetProperty());
    const TracedComparison result = expectTrace(scene,
      membrane.bend(
        [&](const meniscus::reference::Ray& ray) { return integrator->trace(ray, function); }),
      "through a membrane", 1.0 / 255.0);
    EXPECT_LT(result.Rms, 0.05 / 255.0) << result.text();
  }
}

TEST(TetrahedraRayCastPreIntegration, CutSegmentsAndScaledVolumes)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.property(FunctionKind::Smooth), Size, Size);
  scene.volume()->SetScale(-3.0, 0.4, 1.0);
  scene.volume()->RotateWXYZ(30.0, 1.0, 2.0, 3.0);
  lookAt(scene.renderer(), scene.volume()->GetBounds(), 30.0, 20.0);
  const double distance = scene.renderer()->GetActiveCamera()->GetDistance();
  scene.renderer()->GetActiveCamera()->SetClippingRange(distance - 0.5, distance + 0.8);
  const SceneTruth truth = truthOf(scene);
  scene.rayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
  const Comparison result = compare(scene, truth);
  EXPECT_GT(result.Covered, 1000u);
  EXPECT_LT(result.Largest, 1.0 / 255.0) << result.text();
}

TEST(TetrahedraRayCastPreIntegration, TableIsMadeWhenWhatItDependsOnChanges)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.property(FunctionKind::Smooth), Size, Size);
  lookAt(scene.renderer(), block.Mesh->GetBounds(), 30.0, 20.0);
  vtkTetrahedraRayCastMapper* mapper = scene.rayCaster();
  int builds = 0;
  vtkTypeInt64 bytes = mapper->GetUploadedBytes();
  const auto renderAndExpect = [&](int newBuilds, const char* what)
  {
    scene.window()->Render();
    builds += newBuilds;
    EXPECT_EQ(mapper->GetNumberOfPreIntegrationBuilds(), builds) << what;
    EXPECT_TRUE(newBuilds > 0 || mapper->GetUploadedBytes() == bytes) << what;
    bytes = mapper->GetUploadedBytes();
  };
  scene.window()->Render();
  EXPECT_EQ(mapper->GetNumberOfPreIntegrationBuilds(), 0) << "exact";
  bytes = mapper->GetUploadedBytes();
  usePreIntegration(scene, 64, 8);
  renderAndExpect(1, "first use");
  // The native backend reads the table in place.
  EXPECT_TRUE(mapper->GetActiveBackend() == vtkTetrahedraRayCastMapper::NATIVE ||
    mapper->GetUploadedBytes() >= 64 * 64 * 8 * 16);
  lookAt(scene.renderer(), block.Mesh->GetBounds(), 77.0, -20.0);
  renderAndExpect(0, "camera");
  scene.volume()->RotateX(33.0);
  renderAndExpect(0, "turned volume");
  scene.volume()->SetScale(0.5);
  renderAndExpect(0, "smaller volume");
  scene.volume()->SetScale(0.1);
  renderAndExpect(1, "much smaller volume");
  scene.volume()->SetScale(1.0);
  renderAndExpect(1, "larger volume");
  mapper->SetPreIntegrationScalarSize(32);
  renderAndExpect(1, "scalar size");
  mapper->SetPreIntegrationLengthSize(4);
  renderAndExpect(1, "length size");
  scene.volume()->GetProperty()->GetRGBTransferFunction()->AddRGBPoint(block.Range[0], 1, 1, 0);
  renderAndExpect(1, "colour");
  scene.volume()->GetProperty()->GetScalarOpacity()->AddPoint(block.Range[1], 0.9);
  renderAndExpect(1, "opacity");
  block.Mesh->GetPointData()->GetScalars()->SetComponent(5, 0, 2.0 * block.Range[1]);
  block.Mesh->GetPointData()->GetScalars()->Modified();
  scene.window()->Render();
  EXPECT_EQ(mapper->GetNumberOfPreIntegrationBuilds(), ++builds) << "range of the scalars";
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
}

TEST(TetrahedraRayCastPreIntegration, ExactWhereThereIsNoTable)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.property(FunctionKind::Smooth), Size, Size);
  lookAt(scene.renderer(), block.Mesh->GetBounds(), 30.0, 20.0);
  scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const auto warnings = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  warnings->observe(scene.rayCaster());
  const auto expectSame = [&](const char* what, std::size_t expectedWarnings)
  {
    scene.rayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::EXACT);
    const FloatImage exact = scene.renderFloat();
    scene.rayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
    EXPECT_EQ(scene.renderFloat().Rgba, exact.Rgba) << what;
    EXPECT_EQ(warnings->Warnings.size(), expectedWarnings) << what;
  };
  scene.rayCaster()->SetBlendModeToMaximumIntensity();
  expectSame("maximum, which does not integrate", 0);
  scene.rayCaster()->SetBlendModeToComposite();
  scene.volume()->GetProperty()->ShadeOn();
  expectSame("light", 1);
  expectSame("light again", 1);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfPreIntegrationBuilds(), 0);
}

TEST(TetrahedraRayCastPreIntegration, NativeLooksUpTheSame)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.property(FunctionKind::Opaque), Size, Size);
  lookAt(scene.renderer(), block.Mesh->GetBounds(), 30.0, 20.0);
  const auto warnings = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  warnings->observe(scene.rayCaster());
  // Two and three dimensions, and a coarse table, whose errors the other backend must have, too.
  const int sizes[3][2] = { { 64, 1 }, { 64, 16 }, { 8, 4 } };
  for (const auto& size : sizes)
  {
    usePreIntegration(scene, size[0], size[1]);
    scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
    const FloatImage fragments = scene.renderFloat();
    scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::NATIVE);
    expectSamePicture(scene.renderFloat(), fragments,
      std::to_string(size[0]) + " scalars, " + std::to_string(size[1]) + " lengths");
    EXPECT_EQ(scene.rayCaster()->GetActiveBackend(), vtkTetrahedraRayCastMapper::NATIVE);
  }
  EXPECT_TRUE(warnings->Warnings.empty());
}

TEST(TetrahedraRayCastPreIntegration, ComputeShadersDrawTheSame)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.property(FunctionKind::Smooth), Size, Size);
  lookAt(scene.renderer(), block.Mesh->GetBounds(), 30.0, 20.0);
  usePreIntegration(scene, 64, 16);
  scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const FloatImage fragments = scene.renderFloat();
  scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::COMPUTE);
  const FloatImage compute = scene.renderFloat();
  double largest = 0.0;
  for (std::size_t i = 0; i < compute.Rgba.size(); ++i)
  {
    largest = std::max(largest, std::fabs(double{ compute.Rgba[i] } - fragments.Rgba[i]));
  }
  EXPECT_LT(largest, 2e-5);
}
