// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractionPass.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"
#include "Rendering/Pass/LightForNormals.h"
#include "Rendering/Pass/ObjectShader.h"
#include "Rendering/Pass/OpaqueObjects.h"
#include "Rendering/Pass/PictureSize.h"
#include "Rendering/Pass/PlateUniforms.h"
#include "Rendering/Pass/ViewBounds.h"
#include "Rendering/Property/MediumUniforms.h"
#include "Rendering/RefractionPassInternals.h"
#include "Volume/Refracted/RayLegs.h"

#include "vtkRefractedGeometryFilter.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPolyDataMapper.h"
#include "vtkProp3D.h"
#include "vtkProperty.h"
#include "vtkRect.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTextureObject.h"
#include "vtkVolume.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkRefractionPass);
meniscusSetClampMacro(vtkRefractionPass, ReflectanceModel, int, FRESNEL, MIRROR);
meniscusSetClampMacro(vtkRefractionPass, NumberOfLightCells, int, 0, 4000000);
meniscusSetClampMacro(vtkRefractionPass, Lighting, int, VIRTUAL_SPACE, TRUE_SPACE);
meniscusSetClampMacro(vtkRefractionPass, MediumModel, int, EXPONENTIAL, LINEAR);

meniscusObjectMacro(vtkRefractionPass, ScenePass, vtkRenderPass, Internals->ScenePass);
meniscusGetInternalMacro(vtkRefractionPass, int, NumberOfRefractions(), Refractions.All.size());
meniscusObjectMacro(vtkRefractionPass, ReflectionTexture, vtkTexture, Internals->Reflection);
meniscusGetInternalMacro(vtkRefractionPass, vtkTypeInt64, NumberOfMembranesDrawn() const, Drawn);
meniscusGetInternalMacro(
  vtkRefractionPass, vtkTypeInt64, NumberOfMembranesSkipped() const, Skipped);
meniscusGetInternalMacro(
  vtkRefractionPass, vtkTypeInt64, NumberOfLightUpdates() const, LightUpdates);
meniscusGetInternalMacro(
  vtkRefractionPass, vtkTypeInt64, NumberOfShadowUpdates() const, ShadowUpdates);
meniscusGetInternalMacro(
  vtkRefractionPass, vtkTypeInt64, NumberOfSkippedLights() const, SkippedLights);
meniscusGetInternalMacro(vtkRefractionPass, vtkMTimeType, ShaderStageMTime(), ShaderTime);

//------------------------------------------------------------------------------
vtkRefractionPass::vtkRefractionPass()
  : Internals(std::make_unique<vtkInternals>())
{
  this->Internals->ScenePass = vtkSmartPointer<vtkRenderStepsPass>::New();
}

//------------------------------------------------------------------------------
vtkRefractionPass::~vtkRefractionPass() = default;

//------------------------------------------------------------------------------
void vtkRefractionPass::AddRefraction(
  vtkActor* membrane, vtkActor* object, vtkRefractedGeometryFilter* filter)
{
  if (!membrane || !object || !filter ||
    filter->GetMode() != vtkRefractedGeometryFilter::REFRACTION)
  {
    vtkErrorMacro("A refraction needs a membrane, an object and a filter in Mode REFRACTION.");
    return;
  }
  if (auto* mapper = vtkPolyDataMapper::SafeDownCast(object->GetMapper()))
  {
    meniscus::MapMediumArrays(mapper);
  }
  this->Internals->Refractions.All.push_back({ membrane, object, filter });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractionPass::AddReflection(
  vtkActor* membrane, vtkActor* object, vtkRefractedGeometryFilter* filter)
{
  if (!membrane || !object || !filter ||
    filter->GetMode() != vtkRefractedGeometryFilter::REFLECTION)
  {
    vtkErrorMacro("A reflection needs a membrane, an object and a filter in Mode REFLECTION.");
    return;
  }
  this->Internals->Refractions.All.push_back({ membrane, object, filter, true });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractionPass::AddVolume(vtkActor* membrane, vtkVolume* volume)
{
  if (!membrane || !volume || !meniscus::RayCasterOf(volume))
  {
    vtkErrorMacro("AddVolume needs a membrane, and a volume with a vtkTetrahedraRayCastMapper.");
    return;
  }
  this->Internals->Refractions.All.push_back({ membrane, volume, nullptr });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractionPass::RemoveRefraction(vtkProp3D* object)
{
  this->Internals->Refractions.Remove(object);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractionPass::RemoveAllRefractions()
{
  this->Internals->Refractions.All.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkRefractionPass::PreReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper*, vtkProp* prop)
{
  const meniscus::ShaderSources sources{ vertexShader, geometryShader, fragmentShader };
  switch (this->Internals->Stage)
  {
    case vtkInternals::Stages::Mirrored:
      break; // no medium is in front of reflected objects
    case vtkInternals::Stages::Membrane:
      meniscus::AppendToShader(
        fragmentShader, "  //VTK::Light::Impl", "  gl_FragData[0] = vec4(normalVCVSOutput, 1.0);");
      break;
    case vtkInternals::Stages::Objects:
    {
      const meniscus::Refraction* refraction = this->Internals->Refractions.Find(prop);
      if (refraction && refraction->IsLitInTrueSpace)
      {
        meniscus::LightInTrueSpace(sources, refraction->ReadsTables, refraction->HasShadows);
      }
      meniscus::SeeThroughMedium(sources, refraction ? refraction->Seen : meniscus::SeenThrough());
      break;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRefractionPass::SetShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop, vtkOpenGLVertexArrayObject*)
{
  vtkInternals& internals = *this->Internals;
  meniscus::SetMediumUniforms(program, internals.Medium);
  if (program->IsUniformUsed("innerReflects"))
  {
    program->SetUniformf("innerReflects", this->ReflectanceModel == NONE ? 0.0f : 1.0f);
  }
  const meniscus::Refraction* refraction = internals.Refractions.Find(prop);
  auto* object = vtkActor::SafeDownCast(prop);
  if (refraction && object)
  {
    const glm::dvec3 origin = meniscus::LocalPlaces::OriginOf(mapper, "truePosition");
    internals.Lighting.SetUniforms(
      program, object, refraction->ListRelativeIndices(), this->LightAttenuation, origin);
    internals.ActivateTables(refraction, program, origin);
  }
  return true;
}

//------------------------------------------------------------------------------
/** Takes the properties of the medium over; reports those that have no meaning. */
void vtkRefractionPass::UpdateMedium()
{
  meniscus::RefractionMedium medium;
  medium.Kind = this->MediumModel == LINEAR ? meniscus::RefractionMedium::Model::Linear
                                            : meniscus::RefractionMedium::Model::Exponential;
  std::copy_n(this->AttenuationCoefficients, 3, medium.Attenuation.begin());
  std::copy_n(this->MediumRange, 2, medium.Range.begin());
  std::copy_n(this->MediumColor, 3, medium.Color.begin());
  medium.IsInfinite = this->InfiniteMedium;
  const std::string fault = medium.DescribeFault();
  if (!fault.empty())
  {
    // Once for each change, not for each frame.
    if (this->GetMTime() != this->Internals->MediumFaultTime)
    {
      vtkErrorMacro(<< fault << "; the medium is drawn clear.");
    }
    this->Internals->MediumFaultTime = this->GetMTime();
    medium = meniscus::RefractionMedium();
  }
  this->Internals->Medium = medium;
}

//------------------------------------------------------------------------------
void vtkRefractionPass::Render(const vtkRenderState* state)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkInternals& internals = *this->Internals;
  vtkRenderer* renderer = state->GetRenderer();
  if (this->AdjustClippingRange)
  {
    internals.Refractions.AdjustClippingRange(renderer);
  }
  this->UpdateMedium();
  this->ChooseLighting();
  internals.ForgetCasters(this->Shadows && this->Lighting == TRUE_SPACE);
  this->NumberOfRenderedProps = 0;
  if (internals.ScenePass)
  {
    internals.ScenePass->Render(state);
    this->NumberOfRenderedProps = internals.ScenePass->GetNumberOfRenderedProps();
  }
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window || renderer->GetSelector())
  {
    return;
  }
  for (vtkActor* membrane : internals.Refractions.ListMembranes())
  {
    const double* bounds = membrane->GetVisibility() ? membrane->GetBounds() : nullptr;
    if (bounds && bounds[0] <= bounds[1] && meniscus::MayBeInView(renderer, bounds))
    {
      ++internals.Drawn;
      this->DrawMembrane(state, window, membrane);
    }
    else
    {
      ++internals.Skipped;
    }
    this->DrawInFront(state, window, membrane);
  }
}

//------------------------------------------------------------------------------
/** Draws the part of the volumes in front of the membrane, or next to it, over the scene. */
void vtkRefractionPass::DrawInFront(
  const vtkRenderState* drawn, vtkOpenGLRenderWindow* window, vtkActor* membrane)
{
  const meniscus::PictureSize picture(drawn);
  vtkOpenGLState* state = window->GetState();
  state->Push();
  picture.Set(state);
  this->DrawVolumes(drawn->GetRenderer(), membrane, meniscus::MembranePart::InFront);
  state->Pop();
}

//------------------------------------------------------------------------------
void vtkRefractionPass::DrawMembrane(
  const vtkRenderState* drawn, vtkOpenGLRenderWindow* window, vtkActor* membrane)
{
  vtkInternals& internals = *this->Internals;
  vtkOpenGLClearErrorMacro();
  vtkRenderer* renderer = drawn->GetRenderer();
  const meniscus::PictureSize picture(drawn);
  const int(&size)[2] = picture.Size;
  vtkOpenGLState* state = window->GetState();
  // Volumes are cast to images of their own, which the limits of this one must not cut.
  const vtkRecti part = internals.Refractions.HasVolume(membrane)
    ? vtkRecti(0, 0, size[0], size[1])
    : meniscus::FindPixels(renderer, membrane->GetBounds(), size);
  state->Push();
  state->PushFramebufferBindings();
  const bool ready = internals.Objects.Ready(window, size[0], size[1], VTK_UNSIGNED_CHAR) &&
    (internals.Refractions.ListObjects(membrane, true).empty() ||
      internals.Mirrored.Ready(window, size[0], size[1], VTK_UNSIGNED_CHAR)) &&
    internals.Membrane.Ready(window, size[0], size[1], VTK_FLOAT);
  if (ready)
  {
    this->UpdateLighting(renderer, membrane);
    this->DrawObjects(renderer, state, membrane, part);
    this->DrawSurface(renderer, state, membrane, part);
  }
  state->PopFramebufferBindings();
  state->Pop();
  if (!ready)
  {
    vtkErrorMacro("Nothing is drawn behind a membrane: no framebuffer of "
      << size[0] << " x " << size[1] << " pixels could be created.");
    return;
  }
  state->Push();
  picture.Set(state, part);
  state->vtkglEnable(GL_SCISSOR_TEST);
  this->Compose(renderer, window, membrane);
  state->Pop();
  vtkOpenGLCheckErrorMacro("failed after drawing a membrane");
}

//------------------------------------------------------------------------------
/** Draws the virtual geometry behind the membrane: the refracted one and the mirror images. */
void vtkRefractionPass::DrawObjects(
  vtkRenderer* renderer, vtkOpenGLState* state, vtkActor* membrane, const vtkRecti& part)
{
  vtkInternals& internals = *this->Internals;
  for (const bool areReflections : { true, false })
  {
    std::vector<vtkProp*> props = internals.Refractions.ListObjects(membrane, areReflections);
    if (areReflections && props.empty())
    {
      continue;
    }
    meniscus::RefractionTarget& target = areReflections ? internals.Mirrored : internals.Objects;
    target.Begin(state, part);
    internals.Stage =
      areReflections ? vtkInternals::Stages::Mirrored : vtkInternals::Stages::Objects;
    vtkRenderState objects(renderer);
    objects.SetPropArrayAndCount(props.data(), static_cast<int>(props.size()));
    objects.SetFrameBuffer(target.Buffer);
    this->PreRender(&objects);
    meniscus::DrawOpaque(internals.Opaque, &objects, state);
    internals.Translucent->Render(&objects);
    this->PostRender(&objects);
    internals.ActivateTables(nullptr, nullptr, glm::dvec3(0.0));
    this->NumberOfRenderedProps += internals.Opaque->GetNumberOfRenderedProps();
  }
  internals.Places.Clear();
  this->DrawVolumes(renderer, membrane, meniscus::MembranePart::Behind);
}

//------------------------------------------------------------------------------
/** Draws a part of the membrane's volumes over the contents of the framebuffer. */
void vtkRefractionPass::DrawVolumes(
  vtkRenderer* renderer, vtkActor* membrane, meniscus::MembranePart part)
{
  for (const auto& refraction : this->Internals->Refractions.All)
  {
    vtkVolume* volume = refraction.GetVolume();
    if (volume && refraction.Membrane == membrane && volume->GetVisibility())
    {
      // The renderer does the same for its own props.
      volume->SetAllocatedRenderTime(renderer->GetAllocatedRenderTime(), renderer);
      volume->Update();
      if (vtkTetrahedraRayCastMapper* mapper = meniscus::RayCasterOf(volume))
      {
        mapper->RenderPart(renderer, volume, part, this->Internals->Medium);
        ++this->NumberOfRenderedProps;
      }
    }
  }
}

//------------------------------------------------------------------------------
/** Draws the membrane's normals and depths. */
void vtkRefractionPass::DrawSurface(
  vtkRenderer* renderer, vtkOpenGLState* state, vtkActor* membrane, const vtkRecti& part)
{
  vtkInternals& internals = *this->Internals;
  internals.Membrane.Begin(state, part);
  state->vtkglDisable(GL_BLEND);
  internals.Stage = vtkInternals::Stages::Membrane;
  internals.Surface->SetMapper(membrane->GetMapper());
  internals.Surface->SetUserMatrix(membrane->GetMatrix());
  vtkProp* prop = internals.Surface;
  vtkRenderState surface(renderer);
  surface.SetPropArrayAndCount(&prop, 1);
  surface.SetFrameBuffer(internals.Membrane.Buffer);
  const meniscus::LightForNormals light(renderer);
  this->PreRender(&surface);
  internals.Opaque->Render(&surface);
  this->PostRender(&surface);
}

//------------------------------------------------------------------------------
void vtkRefractionPass::ReportPlates(std::size_t interfaces)
{
  if (interfaces > meniscus::LargestNumberOfPlates &&
    interfaces != this->Internals->ReportedInterfaces)
  {
    vtkWarningMacro("Reflections at the first "
      << meniscus::LargestNumberOfPlates << " of " << interfaces
      << " interfaces are computed; those at the others are left out.");
  }
  this->Internals->ReportedInterfaces = interfaces;
}

//------------------------------------------------------------------------------
/** Composites the membrane's pixels over the framebuffer of the scene. */
void vtkRefractionPass::Compose(
  vtkRenderer* renderer, vtkOpenGLRenderWindow* window, vtkActor* membrane)
{
  vtkInternals& internals = *this->Internals;
  double background[3];
  renderer->GetBackground(background);
  meniscus::MembraneLook look;
  look.Behind = internals.Objects.Color;
  look.Mirrored = internals.Refractions.ListObjects(membrane, true).empty()
    ? nullptr
    : internals.Mirrored.Color.Get();
  look.Normal = internals.Membrane.Color;
  look.Depth = internals.Membrane.Depth;
  look.CubeMap = meniscus::FindCubeMap(renderer, internals.Reflection);
  look.Backdrop = internals.Medium.BackdropOf(background);
  using Model = meniscus::MembraneLook::Reflectances;
  static_assert(int(Model::None) == NONE && int(Model::Schlick) == SCHLICK &&
      int(Model::Fresnel) == FRESNEL && int(Model::Mirror) == MIRROR,
    "the same numbers");
  look.Reflectance = static_cast<Model>(this->ReflectanceModel);
  look.RelativeIndices = internals.Refractions.FirstOf(membrane).ListRelativeIndices();
  this->ReportPlates(look.RelativeIndices.size());
  const std::string error = internals.Composer.Compose(renderer, window, look);
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
}

//------------------------------------------------------------------------------
/**
 * Chooses for each object the space it is lit in, and the media and interfaces it is seen through.
 * Shaders that depend on a choice that has changed are compiled again.
 */
void vtkRefractionPass::ChooseLighting()
{
  vtkInternals& internals = *this->Internals;
  for (meniscus::Refraction& refraction : internals.Refractions.All)
  {
    const bool before = refraction.IsLitInTrueSpace;
    const meniscus::SeenThrough seen = refraction.Seen;
    const std::string error = refraction.ChooseLighting(this->Lighting == TRUE_SPACE);
    if (!error.empty())
    {
      vtkErrorMacro(<< error << ". The object is lit in virtual space.");
    }
    refraction.Seen = refraction.ListSeenThrough(internals.Medium);
    if (before != refraction.IsLitInTrueSpace || !(seen == refraction.Seen))
    {
      internals.ShaderTime.Modified();
    }
  }
}

//------------------------------------------------------------------------------
void vtkRefractionPass::ReleaseGraphicsResources(vtkWindow* window)
{
  vtkInternals& internals = *this->Internals;
  if (internals.ScenePass)
  {
    internals.ScenePass->ReleaseGraphicsResources(window);
  }
  internals.Opaque->ReleaseGraphicsResources(window);
  internals.Translucent->ReleaseGraphicsResources(window);
  internals.Surface->ReleaseGraphicsResources(window);
  for (auto& refraction : internals.Refractions.All)
  {
    refraction.Object->ReleaseGraphicsResources(window);
    if (refraction.Waves)
    {
      refraction.Waves->Release(window);
    }
  }
  for (auto& entry : internals.Casters)
  {
    entry.second.Release(window);
  }
  if (internals.Reflection)
  {
    internals.Reflection->ReleaseGraphicsResources(window);
  }
  internals.Objects.Release(window);
  internals.Mirrored.Release(window);
  internals.Membrane.Release(window);
  internals.Composer.Release();
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkRefractionPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRefractions: " << this->GetNumberOfRefractions() << "\n";
  os << indent << "ReflectanceModel: " << this->ReflectanceModel << "\n";
  os << indent << "AttenuationCoefficients: " << this->AttenuationCoefficients[0] << " "
     << this->AttenuationCoefficients[1] << " " << this->AttenuationCoefficients[2] << "\n";
  os << indent << "MediumModel: " << this->MediumModel << "\n";
  os << indent << "MediumRange: " << this->MediumRange[0] << " " << this->MediumRange[1] << "\n";
  os << indent << "MediumColor: " << this->MediumColor[0] << " " << this->MediumColor[1] << " "
     << this->MediumColor[2] << "\n";
  os << indent << "InfiniteMedium: " << (this->InfiniteMedium ? "on" : "off") << "\n";
  os << indent << "Lighting: " << (this->Lighting == TRUE_SPACE ? "TRUE_SPACE" : "VIRTUAL_SPACE")
     << "\n";
  os << indent << "LightAttenuation: " << (this->LightAttenuation ? "on" : "off") << "\n";
  os << indent << "Shadows: " << (this->Shadows ? "on" : "off") << "\n";
  os << indent << "NumberOfLightCells: " << this->NumberOfLightCells << "\n";
  os << indent << "NumberOfLightUpdates: " << this->GetNumberOfLightUpdates() << "\n";
  os << indent << "NumberOfShadowUpdates: " << this->GetNumberOfShadowUpdates() << "\n";
  os << indent << "NumberOfSkippedLights: " << this->GetNumberOfSkippedLights() << "\n";
  os << indent << "AdjustClippingRange: " << (this->AdjustClippingRange ? "on" : "off") << "\n";
  os << indent << "NumberOfMembranesDrawn: " << this->GetNumberOfMembranesDrawn() << "\n";
  os << indent << "NumberOfMembranesSkipped: " << this->GetNumberOfMembranesSkipped() << "\n";
}
