// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Size of tables: their memory, the compact layout, and meshes beyond the device's limits.
#include "DeviceTableLimits.h"
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 120;
constexpr double Range[2] = { -1.0, 1.0 };
constexpr int Native = vtkTetrahedraRayCastMapper::NATIVE;
constexpr int OpenGL = vtkTetrahedraRayCastMapper::OPENGL;
constexpr int Compute = vtkTetrahedraRayCastMapper::COMPUTE;

class TetrahedraRayCastMemory : public ::testing::Test
{
protected:
  TetrahedraRayCastMemory()
    : Mesh(MakeBlock(6, WavyField(3.0)))
    , Property(MakeProperty(FunctionKind::Smooth, Range, 3.5))
    , Scene(this->Mesh, this->Property, Size, Size)
    , Mapper(this->Scene.GetRayCaster())
    , Observer(vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New()))
  {
    Jitter(this->Mesh, 0.05, 5);
    this->Mesh->GetCellData()->SetScalars(MakeArray("cells", this->Mesh->GetNumberOfCells(),
      [](vtkIdType c) { return std::sin(0.05 * static_cast<double>(c)); }));
    this->Property->GetIsoSurfaceValues()->SetValue(0, 0.2);
    this->Property->GetIsoSurfaceValues()->SetValue(1, -0.4);
    this->Observer->Observe(this->Mapper);
    LookAt(this->Scene.GetRenderer(), this->Mesh->GetBounds(), 30.0, 20.0);
    this->Mapper->SetBackend(OpenGL);
  }

  /** Compares images with full and with compact tables. */
  void ExpectSamePicture(const std::string& what)
  {
    meniscus::DeviceTableLimits::SetCompact(this->Mapper, false);
    const FloatImage full = this->Scene.RenderFloat();
    meniscus::DeviceTableLimits::SetCompact(this->Mapper, true);
    const FloatImage compact = this->Scene.RenderFloat();
    EXPECT_EQ(this->Mapper->GetNumberOfLostRays(), 0);
    float opacity = 0.0f;
    for (std::size_t i = 0; i < full.Rgba.size(); ++i)
    {
      ASSERT_NEAR(compact.Rgba[i], full.Rgba[i], 2e-6) << what;
      opacity = std::max(opacity, full.Rgba[i]);
    }
    EXPECT_GT(opacity, 0.1f) << what;
  }

  vtkTypeInt64 GetCells() const { return this->Mesh->GetNumberOfCells(); }

  Grid Mesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
  RayCastScene Scene;
  vtkTetrahedraRayCastMapper* Mapper;
  vtkSmartPointer<ErrorObserver> Observer;
};

} // anonymous namespace

TEST_F(TetrahedraRayCastMemory, CompactTablesGiveTheSamePicture)
{
  struct Case
  {
    int Backend;
    bool Lit;
    int Gradients;
  };
  for (const Case& c : { Case{ OpenGL, false, 0 }, Case{ OpenGL, true, 0 }, Case{ OpenGL, true, 1 },
         Case{ Compute, false, 0 } })
  {
    this->Mapper->SetBackend(c.Backend);
    this->Property->SetShade(c.Lit);
    this->Mapper->SetGradients(c.Gradients);
    for (const int mode :
      { int(vtkVolumeMapper::COMPOSITE_BLEND), int(vtkVolumeMapper::ISOSURFACE_BLEND) })
    {
      this->Mapper->SetBlendMode(mode);
      for (const int scalars : { VTK_SCALAR_MODE_USE_POINT_DATA, VTK_SCALAR_MODE_USE_CELL_DATA })
      {
        this->Mapper->SetScalarMode(scalars);
        this->ExpectSamePicture("backend " + std::to_string(c.Backend) + " lit " +
          std::to_string(c.Lit) + " gradients " + std::to_string(c.Gradients) + " mode " +
          std::to_string(mode) + " scalars " + std::to_string(scalars));
      }
    }
  }
}

TEST_F(TetrahedraRayCastMemory, BytesAreThoseOfTheTables)
{
  // Sides of the block: two triangles for each square. Vertices are the points.
  const vtkTypeInt64 faces = 6 * 6 * 6 * 2;
  const vtkTypeInt64 points = this->Mesh->GetNumberOfPoints();
  const vtkTypeInt64 tree = (2 * faces - 1) * 32 + faces * 16;
  // Orientation and activity, in words of 64 bits.
  const vtkTypeInt64 bits = 2 * 8 * ((this->GetCells() + 63) / 64);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Mapper->GetStatistic("HostBytes"),
    32 * this->GetCells() + bits + 20 * points + 16 * faces + tree);
  const double full = this->Mapper->GetStatistic("DeviceBytes");
  const vtkTypeInt64 property = full - 32 * this->GetCells() - 32 * points - 80 * faces + 32;
  EXPECT_GT(property, 0);
  EXPECT_LT(property, 10000);
  const vtkTypeInt64 uploaded = this->Mapper->GetUploadedBytes();
  meniscus::DeviceTableLimits::SetCompact(this->Mapper, true);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(full - this->Mapper->GetStatistic("DeviceBytes"), 12 * this->GetCells());
  EXPECT_EQ(this->Mapper->GetUploadedBytes() - uploaded, 20 * this->GetCells());
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Mapper->GetUploadedBytes() - uploaded, 20 * this->GetCells());
  EXPECT_EQ(this->Mapper->GetNumberOfMeshBuilds(), 1);
  this->Mapper->ReleaseGraphicsResources(this->Scene.GetWindow());
  EXPECT_EQ(this->Mapper->GetStatistic("DeviceBytes"), 0);
}

TEST_F(TetrahedraRayCastMemory, BytesOfWhatIsOnlySometimesNeeded)
{
  // The first frame keeps all that it uploads.
  const auto expectSentAndKept = [this](const std::string& what)
  {
    const vtkTypeInt64 sent = this->Mapper->GetUploadedBytes();
    const double kept = this->Mapper->GetStatistic("DeviceBytes");
    const double host = this->Mapper->GetStatistic("HostBytes");
    this->Scene.GetWindow()->Render();
    EXPECT_GT(this->Mapper->GetUploadedBytes(), sent) << what;
    EXPECT_EQ(
      this->Mapper->GetStatistic("DeviceBytes") - kept, this->Mapper->GetUploadedBytes() - sent)
      << what;
    EXPECT_GT(this->Mapper->GetStatistic("HostBytes"), host) << what;
  };
  this->Scene.GetWindow()->Render();
  this->Mapper->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
  expectSentAndKept("pre-integration");
  this->Mapper->SetIntegration(vtkTetrahedraRayCastMapper::EXACT);
  // A change of the property uploads its table again and frees the old one.
  this->Property->ShadeOn();
  this->Mapper->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
  this->Scene.GetWindow()->Render();
  this->Mapper->SetGradients(vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS);
  expectSentAndKept("gradients");
  this->Mapper->ReleaseGraphicsResources(this->Scene.GetWindow());
  EXPECT_EQ(this->Mapper->GetStatistic("DeviceBytes"), 0);
}

TEST_F(TetrahedraRayCastMemory, MeshesBeyondTheDevicesTablesGoToTheNativeBackend)
{
  this->Mapper->SetScalarModeToUsePointData();
  meniscus::DeviceTableLimits::SetLargest(this->Mapper, 2 * this->GetCells());
  ExpectMatchesReference(this->Scene, "two texels per cell");
  EXPECT_EQ(this->Mapper->GetActiveBackend(), OpenGL);
  const double full = this->Mapper->GetStatistic("DeviceBytes");
  meniscus::DeviceTableLimits::SetLargest(this->Mapper, 2 * this->GetCells() - 1);
  ExpectMatchesReference(this->Scene, "compact, four numbers per texel");
  EXPECT_EQ(this->Mapper->GetActiveBackend(), OpenGL);
  EXPECT_EQ(full - this->Mapper->GetStatistic("DeviceBytes"), 12 * this->GetCells());
  EXPECT_TRUE(this->Observer->Warnings.empty());
  // Five numbers per compact cell, four per texel.
  const vtkTypeInt64 least = (5 * this->GetCells() + 3) / 4;
  meniscus::DeviceTableLimits::SetLargest(this->Mapper, least - 1);
  ExpectMatchesReference(this->Scene, "beyond the limit");
  EXPECT_EQ(this->Mapper->GetActiveBackend(), Native);
  ASSERT_EQ(this->Observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(this->Observer->Warnings[0], std::to_string(least)));
  EXPECT_TRUE(HasText(this->Observer->Warnings[0], std::to_string(least - 1)));
  meniscus::DeviceTableLimits::SetCompact(this->Mapper, true);
  meniscus::DeviceTableLimits::SetLargest(this->Mapper, least);
  ExpectMatchesReference(this->Scene, "compact, with just enough room");
  EXPECT_EQ(this->Mapper->GetActiveBackend(), OpenGL);
  meniscus::DeviceTableLimits::SetLargest(this->Mapper, 5 * this->GetCells());
  ExpectMatchesReference(this->Scene, "compact, one number per texel");
  EXPECT_EQ(this->Mapper->GetActiveBackend(), OpenGL);
  EXPECT_TRUE(this->Observer->Errors.empty());
}

TEST_F(TetrahedraRayCastMemory, SoDoTheirLightAndPreIntegration)
{
  this->Mapper->SetScalarModeToUsePointData();
  for (const bool shade : { true, false })
  {
    this->Property->SetShade(shade);
    this->Mapper->SetIntegration(
      shade ? vtkTetrahedraRayCastMapper::EXACT : vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
    meniscus::DeviceTableLimits::SetLargest(this->Mapper, VTK_TYPE_INT64_MAX);
    const FloatImage expected = this->Scene.RenderFloat();
    EXPECT_EQ(this->Mapper->GetActiveBackend(), OpenGL);
    meniscus::DeviceTableLimits::SetLargest(this->Mapper, 100);
    meniscus::test::ExpectSamePicture(
      this->Scene.RenderFloat(), expected, shade ? "light" : "pre-integrated");
    EXPECT_EQ(this->Mapper->GetActiveBackend(), Native);
  }
  EXPECT_TRUE(this->Observer->Errors.empty());
}
