// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Integration by the pre-integration table: its error, and when the table is built.
#include "MembraneScene.h"
#include "OpticsTruth.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;

struct Block
{
  Grid Mesh = MakeBlock(8, WavyField(3.0));
  double Range[2];

  Block() { this->Mesh->GetPointData()->GetScalars()->GetFiniteRange(this->Range); }

  vtkSmartPointer<vtkVolumeProperty> GetProperty(FunctionKind kind) const
  {
    return MakeProperty(kind, this->Range, DiagonalOf(this->Mesh->GetBounds()));
  }
};

void UsePreIntegration(RayCastScene& scene, int scalars, int lengths)
{
  scene.GetRayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
  scene.GetRayCaster()->SetPreIntegrationScalarSize(scalars);
  scene.GetRayCaster()->SetPreIntegrationLengthSize(lengths);
}

Comparison Compare(RayCastScene& scene, const SceneTruth& truth)
{
  const Comparison result =
    CompareToReference(scene.RenderFloat(), truth.Image, *truth.Integrator, truth.RayOf, 1.0);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
  return result;
}

SceneTruth TruthOf(RayCastScene& scene)
{
  scene.GetWindow()->Render();
  return MakeTruth(scene);
}

} // anonymous namespace

TEST(TetrahedraRayCastPreIntegration, ConvergesWithTheSizeOfTheTable)
{
  const Block block;
  for (const FunctionKind kind : { FunctionKind::Smooth, FunctionKind::Opaque })
  {
    RayCastScene scene(block.Mesh, block.GetProperty(kind), Size, Size);
    const SceneTruth truth = TruthOf(scene);
    double coarse = 0.0;
    double fine = 0.0;
    for (const int size : { 16, 32, 64, 128, 256, 512 })
    {
      UsePreIntegration(scene, size, size / 8);
      const Comparison result = Compare(scene, truth);
      RecordProperty((kind == FunctionKind::Smooth ? "smooth " : "opaque ") + std::to_string(size),
        result.GetText());
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
    RayCastScene scene(block.Mesh, block.GetProperty(kind), Size, Size);
    const SceneTruth truth = TruthOf(scene);
    scene.GetRayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
    const Comparison result = Compare(scene, truth);
    SCOPED_TRACE(result.GetText());
    RecordProperty("function " + std::to_string(static_cast<int>(kind)), result.GetText());
    const bool narrow = kind == FunctionKind::Sparse || kind == FunctionKind::Peaked;
    EXPECT_LT(result.Largest, narrow ? 10.0 / 255.0 : 1.0 / 255.0);
    EXPECT_LT(result.Rms, narrow ? 0.5 / 255.0 : 0.05 / 255.0);
  }
}

TEST(TetrahedraRayCastPreIntegration, ThroughAMembrane)
{
  const Block block;
  for (const MembraneCase& membrane :
    { MakePlaneCase(0.1, 4.0, 2), MakeDomeCase(1.4, 4.0, 2.8, 16) })
  {
    RayCastScene scene(block.Mesh, block.GetProperty(FunctionKind::Smooth), Size, Size);
    scene.GetRayCaster()->SetMembraneData(membrane.Mesh);
    scene.GetRayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
    LookAt(scene.GetRenderer(), block.Mesh->GetBounds(), 30.0, 50.0);
    scene.GetWindow()->Render();
    const auto integrator = MakeReference(block.Mesh);
    const auto function = ToReference(scene.GetVolume()->GetProperty());
    const TracedComparison result = ExpectTrace(scene,
      membrane.BendMembrane(
        [&](const meniscus::reference::Ray& ray) { return integrator->Trace(ray, function); }),
      "through a membrane", 1.0 / 255.0);
    EXPECT_LT(result.Rms, 0.05 / 255.0) << result.GetText();
  }
}

TEST(TetrahedraRayCastPreIntegration, CutSegmentsAndScaledVolumes)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.GetProperty(FunctionKind::Smooth), Size, Size);
  scene.GetVolume()->SetScale(-3.0, 0.4, 1.0);
  scene.GetVolume()->RotateWXYZ(30.0, 1.0, 2.0, 3.0);
  LookAt(scene.GetRenderer(), scene.GetVolume()->GetBounds(), 30.0, 20.0);
  const double distance = scene.GetRenderer()->GetActiveCamera()->GetDistance();
  scene.GetRenderer()->GetActiveCamera()->SetClippingRange(distance - 0.5, distance + 0.8);
  const SceneTruth truth = TruthOf(scene);
  scene.GetRayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
  const Comparison result = Compare(scene, truth);
  EXPECT_GT(result.Covered, 1000u);
  EXPECT_LT(result.Largest, 1.0 / 255.0) << result.GetText();
}

TEST(TetrahedraRayCastPreIntegration, TableIsMadeWhenWhatItDependsOnChanges)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.GetProperty(FunctionKind::Smooth), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  int builds = 0;
  vtkTypeInt64 bytes = mapper->GetUploadedBytes();
  const auto renderAndExpect = [&](int newBuilds, const char* what)
  {
    scene.GetWindow()->Render();
    builds += newBuilds;
    EXPECT_EQ(mapper->GetStatistic("NumberOfPreIntegrationBuilds"), builds) << what;
    EXPECT_TRUE(newBuilds > 0 || mapper->GetUploadedBytes() == bytes) << what;
    bytes = mapper->GetUploadedBytes();
  };
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfPreIntegrationBuilds"), 0) << "exact";
  bytes = mapper->GetUploadedBytes();
  UsePreIntegration(scene, 64, 8);
  renderAndExpect(1, "first use");
  // The native backend reads the table in place.
  EXPECT_TRUE(mapper->GetActiveBackend() == vtkTetrahedraRayCastMapper::NATIVE ||
    mapper->GetUploadedBytes() >= 64 * 64 * 8 * 16);
  LookAt(scene.GetRenderer(), block.Mesh->GetBounds(), 77.0, -20.0);
  renderAndExpect(0, "camera");
  scene.GetVolume()->RotateX(33.0);
  renderAndExpect(0, "turned volume");
  scene.GetVolume()->SetScale(0.5);
  renderAndExpect(0, "smaller volume");
  scene.GetVolume()->SetScale(0.1);
  renderAndExpect(1, "much smaller volume");
  scene.GetVolume()->SetScale(1.0);
  renderAndExpect(1, "larger volume");
  mapper->SetPreIntegrationScalarSize(32);
  renderAndExpect(1, "scalar size");
  mapper->SetPreIntegrationLengthSize(4);
  renderAndExpect(1, "length size");
  scene.GetVolume()->GetProperty()->GetRGBTransferFunction()->AddRGBPoint(block.Range[0], 1, 1, 0);
  renderAndExpect(1, "colour");
  scene.GetVolume()->GetProperty()->GetScalarOpacity()->AddPoint(block.Range[1], 0.9);
  renderAndExpect(1, "opacity");
  block.Mesh->GetPointData()->GetScalars()->SetComponent(5, 0, 2.0 * block.Range[1]);
  block.Mesh->GetPointData()->GetScalars()->Modified();
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfPreIntegrationBuilds"), ++builds)
    << "range of the scalars";
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
}

TEST(TetrahedraRayCastPreIntegration, ExactWhereThereIsNoTable)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.GetProperty(FunctionKind::Smooth), Size, Size);
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const auto warnings = ObserveErrors(scene.GetRayCaster());
  const auto expectSame = [&](const char* what, std::size_t expectedWarnings)
  {
    scene.GetRayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::EXACT);
    const FloatImage exact = scene.RenderFloat();
    scene.GetRayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
    EXPECT_EQ(scene.RenderFloat().Rgba, exact.Rgba) << what;
    EXPECT_EQ(warnings->Warnings.size(), expectedWarnings) << what;
  };
  scene.GetRayCaster()->SetBlendModeToMaximumIntensity();
  expectSame("maximum, which does not integrate", 0);
  scene.GetRayCaster()->SetBlendModeToComposite();
  scene.GetVolume()->GetProperty()->ShadeOn();
  expectSame("light", 1);
  expectSame("light again", 1);
  EXPECT_EQ(scene.GetRayCaster()->GetStatistic("NumberOfPreIntegrationBuilds"), 0);
}

TEST(TetrahedraRayCastPreIntegration, BackendsLookUpTheSame)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.GetProperty(FunctionKind::Opaque), Size, Size);
  const auto warnings = ObserveErrors(scene.GetRayCaster());
  // Two and three dimensions, and a coarse table, whose errors the other backend must have, too.
  const int sizes[3][2] = { { 64, 1 }, { 64, 16 }, { 8, 4 } };
  for (const auto& size : sizes)
  {
    UsePreIntegration(scene, size[0], size[1]);
    scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
    const FloatImage fragments = scene.RenderFloat();
    for (const int backend :
      { vtkTetrahedraRayCastMapper::COMPUTE, vtkTetrahedraRayCastMapper::NATIVE })
    {
      scene.GetRayCaster()->SetBackend(backend);
      ExpectSamePicture(scene.RenderFloat(), fragments,
        std::to_string(size[0]) + " scalars, " + std::to_string(size[1]) + " lengths");
      EXPECT_EQ(scene.GetRayCaster()->GetActiveBackend(), backend);
    }
  }
  EXPECT_TRUE(warnings->Warnings.empty());
}
