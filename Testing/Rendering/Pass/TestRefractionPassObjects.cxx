// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// How vtkRefractionPass draws objects: the state and the shaders with which VTK's mapper does.
#include "FlatPool.h"

#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkOpenGLError.h> // OpenGL itself, with whichever loader VTK uses
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkShaderProgram.h>
#include <vtkShaderProperty.h>
#include <vtkTexture.h>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

namespace
{

/** State and shader of the floor's draw in the last frame. */
class DrawWatch
{
public:
  explicit DrawWatch(Pool& pool)
    : Owner(pool)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback([](vtkObject*, unsigned long, void* watch, void* program)
      { static_cast<DrawWatch*>(watch)->Read(static_cast<vtkShaderProgram*>(program)); });
    pool.Floor->GetMapper()->AddObserver(vtkCommand::UpdateShaderEvent, command);
  }

  ByteImage Render()
  {
    this->Draws = 0;
    return this->Owner.Render();
  }

  int Draws = 0;
  bool Blends = false;
  bool ReadsMedium = false;
  bool ReadsInterfaces = false;

private:
  void Read(vtkShaderProgram* program)
  {
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(this->Owner.Scene.GetWindow());
    ++this->Draws;
    this->Blends = window->GetState()->GetEnumState(GL_BLEND);
    this->ReadsMedium = program->IsUniformUsed("mediumAttenuation");
    this->ReadsInterfaces = program->IsAttributeUsed("innerReflectance");
  }

  Pool& Owner;
};

vtkSmartPointer<vtkTexture> MakeTexture(int components)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(8, 8, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  for (int j = 0; j < 8; ++j)
  {
    for (int i = 0; i < 8; ++i)
    {
      auto* texel = static_cast<unsigned char*>(image->GetScalarPointer(i, j, 0));
      for (int c = 0; c < components; ++c)
      {
        // VTK draws a texture as opaque if each texel is opaque or not there.
        texel[c] = c == 3 ? (i % 2 ? 0 : 255) : static_cast<unsigned char>(20 * i + 10 * j);
      }
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->InterpolateOn();
  return texture;
}

} // anonymous namespace

TEST(RefractionPassObjects, WhatHidesAllBehindItIsNotBlended)
{
  Pool pool;
  DrawWatch watch(pool);
  const auto expect = [&](bool isBlended, const char* what)
  {
    ByteImage image = watch.Render();
    EXPECT_EQ(watch.Draws, 1) << what;
    EXPECT_EQ(watch.Blends, isBlended) << what;
    return image;
  };
  const ByteImage plain = expect(false, "plain");
  vtkShaderProperty* shader = pool.Floor->GetShaderProperty();
  shader->AddFragmentShaderReplacement(
    "//VTK::Light::Impl", true, "//VTK::Light::Impl\n  gl_FragData[0].a *= 1.0;", false);
  EXPECT_EQ(expect(true, "own shader").Rgb, plain.Rgb);
  shader->ClearAllFragmentShaderReplacements();
  EXPECT_EQ(expect(false, "plain again").Rgb, plain.Rgb);
  pool.Floor->GetProperty()->SetOpacity(0.5);
  expect(true, "translucent");
  pool.Floor->GetProperty()->SetOpacity(1.0);
  pool.Floor->SetTexture(MakeTexture(3));
  expect(false, "texture");
  pool.Floor->SetTexture(MakeTexture(4));
  expect(true, "texture with holes");
}

// A second object that may let light through has the first one blended as well.
TEST(RefractionPassObjects, OneObjectThatMayBeSeenThroughHasAllBlended)
{
  Pool pool;
  DrawWatch watch(pool);
  vtkSmartPointer<vtkActor> other = MakeActor(pool.Filter->GetOutputPort());
  other->SetTexture(MakeTexture(4));
  pool.Pass->AddRefraction(pool.Membrane, other, pool.Filter);
  watch.Render();
  EXPECT_TRUE(watch.Blends);
  other->VisibilityOff();
  watch.Render();
  EXPECT_FALSE(watch.Blends);
}

TEST(RefractionPassObjects, AClearMediumCostsNoShaderCode)
{
  Pool pool;
  DrawWatch watch(pool);
  const ByteImage clear = watch.Render();
  EXPECT_FALSE(watch.ReadsMedium);
  pool.Pass->SetAttenuationCoefficients(0.8, 0.2, 0.0);
  EXPECT_NE(watch.Render().Rgb, clear.Rgb);
  EXPECT_TRUE(watch.ReadsMedium);
  // Light does not come from a clear medium either.
  pool.Pass->SetMediumColor(0.2, 0.9, 0.5);
  pool.Pass->SetAttenuationCoefficients(0.0, 0.0, 0.0);
  EXPECT_EQ(watch.Render().Rgb, clear.Rgb);
  EXPECT_FALSE(watch.ReadsMedium);
  pool.Pass->SetMediumModel(vtkRefractionPass::LINEAR);
  EXPECT_NE(watch.Render().Rgb, clear.Rgb);
}

TEST(RefractionPassObjects, OneInterfaceCostsNoShaderCodeOfOthers)
{
  Pool pool;
  DrawWatch watch(pool);
  const ByteImage one = watch.Render();
  EXPECT_FALSE(watch.ReadsInterfaces);
  vtkNew<vtkRefractingInterface> glass;
  vtkNew<vtkPlaneSource> lower;
  lower->SetOrigin(-3.0, -3.0, -0.2);
  lower->SetPoint1(3.0, -3.0, -0.2);
  lower->SetPoint2(-3.0, 3.0, -0.2);
  pool.Filter->AddInputConnection(1, lower->GetOutputPort());
  glass->SetExteriorIndexOfRefraction(Water);
  glass->SetInteriorIndexOfRefraction(1.0);
  pool.Filter->GetInterfaces()->AddItem(glass);
  EXPECT_NE(watch.Render().Rgb, one.Rgb);
  EXPECT_TRUE(watch.ReadsInterfaces);
}
