// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractionPass.h"

#include "Rendering/Pass/PictureSize.h"
#include "Rendering/Pass/RefractionMedium.h"
#include "Rendering/Pass/RefractionTarget.h"
#include "Rendering/Pass/ViewBounds.h"

#include "vtkRefractedGeometryFilter.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkRefractionMembraneFS.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataObject.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLTexture.h"
#include "vtkPolyDataMapper.h"
#include "vtkProp3D.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"
#include "vtkTranslucentPass.h"
#include "vtkVolume.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkRefractionPass);

namespace
{

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper* RayCasterOf(vtkVolume* volume)
{
  return vtkTetrahedraRayCastMapper::SafeDownCast(volume->GetMapper());
}

//------------------------------------------------------------------------------
bool Append(std::string& shader, const std::string& tag, const std::string& code)
{
  return vtkShaderProgram::Substitute(shader, tag, tag + "\n" + code + "\n", false);
}

} // anonymous namespace

//------------------------------------------------------------------------------
class vtkRefractionPass::vtkInternals
{
public:
  struct Refraction
  {
    vtkSmartPointer<vtkActor> Membrane;
    /** Actor of a filter's virtual geometry, or a volume. */
    vtkSmartPointer<vtkProp3D> Object;
    vtkSmartPointer<vtkRefractedGeometryFilter> Filter;
    bool IsReflection = false; ///< seen in the membrane, not through it

    vtkVolume* GetVolume() const { return vtkVolume::SafeDownCast(this->Object); }
    double GetRelativeIndex() const;
  };
  enum class Stages
  {
    Objects,
    Mirrored,
    Membrane
  };

  std::vector<Refraction> Refractions;
  vtkSmartPointer<vtkRenderPass> ScenePass;
  vtkSmartPointer<vtkTexture> Reflection;
  vtkNew<vtkOpaquePass> Opaque;
  vtkNew<vtkTranslucentPass> Translucent;
  /** Draws the membrane's mapper, independently of the property of the membrane's actor. */
  vtkNew<vtkActor> Surface;
  Stages Stage = Stages::Objects;

  meniscus::RefractionMedium Medium;
  meniscus::RefractionTarget Objects;
  meniscus::RefractionTarget Mirrored;
  meniscus::RefractionTarget Membrane;
  std::unique_ptr<vtkOpenGLQuadHelper> Composers[2]; // without and with a cube map

  vtkTypeInt64 Drawn = 0;
  vtkTypeInt64 Skipped = 0;

  void AdjustClippingRange(vtkRenderer* renderer) const;
  std::vector<vtkActor*> ListMembranes() const;
  std::vector<vtkProp*> ListObjects(vtkActor* membrane, bool areReflections) const;
  vtkTexture* FindCubeMap(vtkRenderer* renderer) const;
};

//------------------------------------------------------------------------------
/** Index of the interior relative to the exterior. */
double vtkRefractionPass::vtkInternals::Refraction::GetRelativeIndex() const
{
  vtkRefractingInterfaceCollection* interfaces = nullptr;
  if (this->Filter)
  {
    return this->Filter->GetRelativeIndexOfRefraction();
  }
  if (vtkTetrahedraRayCastMapper* mapper = RayCasterOf(this->GetVolume()))
  {
    interfaces = mapper->GetInterfaces();
  }
  if (!interfaces)
  {
    return 1.0;
  }
  vtkRefractingInterface* first = interfaces->GetFirstInterface();
  return first->GetInteriorIndexOfRefraction() / first->GetExteriorIndexOfRefraction();
}

//------------------------------------------------------------------------------
/** Membranes come first: objects behind a membrane that is out of view are ignored. */
void vtkRefractionPass::vtkInternals::AdjustClippingRange(vtkRenderer* renderer) const
{
  for (vtkActor* membrane : this->ListMembranes())
  {
    const double* bounds = membrane->GetVisibility() ? membrane->GetBounds() : nullptr;
    if (!bounds)
    {
      continue;
    }
    meniscus::HoldInClippingRange(renderer, bounds);
    const bool inView = bounds[0] <= bounds[1] && meniscus::MayBeInView(renderer, bounds);
    for (const Refraction& refraction : this->Refractions)
    {
      if (inView && refraction.Membrane == membrane && refraction.Object->GetVisibility())
      {
        meniscus::HoldInClippingRange(renderer, refraction.Object->GetBounds());
      }
    }
  }
}

//------------------------------------------------------------------------------
/** Membranes in the order in which they were added. */
std::vector<vtkActor*> vtkRefractionPass::vtkInternals::ListMembranes() const
{
  std::vector<vtkActor*> membranes;
  for (const Refraction& refraction : this->Refractions)
  {
    if (std::find(membranes.begin(), membranes.end(), refraction.Membrane) == membranes.end())
    {
      membranes.push_back(refraction.Membrane);
    }
  }
  return membranes;
}

//------------------------------------------------------------------------------
/** Visible objects, without volumes. */
std::vector<vtkProp*> vtkRefractionPass::vtkInternals::ListObjects(
  vtkActor* membrane, bool areReflections) const
{
  std::vector<vtkProp*> props;
  for (const Refraction& refraction : this->Refractions)
  {
    if (refraction.Filter && refraction.IsReflection == areReflections &&
      refraction.Membrane == membrane && refraction.Object->GetVisibility())
    {
      props.push_back(refraction.Object);
    }
  }
  return props;
}

//------------------------------------------------------------------------------
vtkTexture* vtkRefractionPass::vtkInternals::FindCubeMap(vtkRenderer* renderer) const
{
  vtkTexture* texture =
    this->Reflection ? this->Reflection.Get() : renderer->GetEnvironmentTexture();
  return texture && texture->GetCubeMap() ? texture : nullptr;
}

//------------------------------------------------------------------------------
vtkRefractionPass::vtkRefractionPass()
  : Internals(std::make_unique<vtkInternals>())
{
  this->Internals->ScenePass = vtkSmartPointer<vtkRenderStepsPass>::New();
}

//------------------------------------------------------------------------------
vtkRefractionPass::~vtkRefractionPass() = default;

//------------------------------------------------------------------------------
void vtkRefractionPass::SetScenePass(vtkRenderPass* pass)
{
  if (pass != this->Internals->ScenePass)
  {
    this->Internals->ScenePass = pass;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkRenderPass* vtkRefractionPass::GetScenePass()
{
  return this->Internals->ScenePass;
}

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
    mapper->MapDataArrayToVertexAttribute(
      "refractionDepth", "RefractionDepth", vtkDataObject::FIELD_ASSOCIATION_POINTS);
    // Without this array, behind one interface, OpenGL reads 0.
    mapper->MapDataArrayToVertexAttribute(
      "innerReflectance", "InnerReflectance", vtkDataObject::FIELD_ASSOCIATION_POINTS);
  }
  this->Internals->Refractions.push_back({ membrane, object, filter });
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
  this->Internals->Refractions.push_back({ membrane, object, filter, true });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractionPass::AddVolume(vtkActor* membrane, vtkVolume* volume)
{
  if (!membrane || !volume || !RayCasterOf(volume))
  {
    vtkErrorMacro("AddVolume needs a membrane, and a volume with a vtkTetrahedraRayCastMapper.");
    return;
  }
  this->Internals->Refractions.push_back({ membrane, volume, nullptr });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractionPass::RemoveRefraction(vtkProp3D* object)
{
  auto& all = this->Internals->Refractions;
  all.erase(std::remove_if(all.begin(), all.end(),
              [object](const vtkInternals::Refraction& one) { return one.Object == object; }),
    all.end());
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkRefractionPass::RemoveAllRefractions()
{
  this->Internals->Refractions.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
int vtkRefractionPass::GetNumberOfRefractions()
{
  return static_cast<int>(this->Internals->Refractions.size());
}

//------------------------------------------------------------------------------
void vtkRefractionPass::SetReflectionTexture(vtkTexture* texture)
{
  if (texture != this->Internals->Reflection)
  {
    this->Internals->Reflection = texture;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkTexture* vtkRefractionPass::GetReflectionTexture()
{
  return this->Internals->Reflection;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractionPass::GetNumberOfMembranesDrawn() const
{
  return this->Internals->Drawn;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkRefractionPass::GetNumberOfMembranesSkipped() const
{
  return this->Internals->Skipped;
}

//------------------------------------------------------------------------------
bool vtkRefractionPass::PreReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper*, vtkProp*)
{
  if (this->Internals->Stage == vtkInternals::Stages::Mirrored)
  {
    return true; // no medium is in front of what a membrane reflects
  }
  const std::string light = "  //VTK::Light::Impl";
  if (this->Internals->Stage == vtkInternals::Stages::Membrane)
  {
    Append(fragmentShader, light, "  gl_FragData[0] = vec4(normalVCVSOutput, 1.0);");
    return true;
  }
  const std::string declarations = "//VTK::Normal::Dec";
  const std::string code = "//VTK::Normal::Impl";
  std::string inFragment;
  for (const std::string name : { "refractionDepth", "innerReflectance" })
  {
    const std::string fromVertex = name + "VSOutput";
    const std::string fromGeometry = name + "GSOutput";
    Append(vertexShader, declarations, "in float " + name + ";\nout float " + fromVertex + ";");
    Append(vertexShader, code, "  " + fromVertex + " = " + name + ";");
    Append(geometryShader, declarations,
      "in float " + fromVertex + "[];\nout float " + fromGeometry + ";");
    Append(geometryShader, code, fromGeometry + " = " + fromVertex + "[i];");
    inFragment += "in float " + fromVertex + ";\n";
  }
  Append(fragmentShader, declarations,
    inFragment + "uniform float innerReflects;\n" + meniscus::RefractionMedium::DeclareInShader());
  Append(fragmentShader, light,
    "  gl_FragData[0].rgb = (1.0 - innerReflects * innerReflectanceVSOutput) *\n"
    "    inMedium(gl_FragData[0].rgb, max(refractionDepthVSOutput, 0.0));");
  return true;
}

//------------------------------------------------------------------------------
bool vtkRefractionPass::SetShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper*, vtkProp*, vtkOpenGLVertexArrayObject*)
{
  this->Internals->Medium.SetUniforms(program);
  if (program->IsUniformUsed("innerReflects"))
  {
    program->SetUniformf("innerReflects", this->ReflectanceModel == NONE ? 0.0f : 1.0f);
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
    vtkErrorMacro(<< fault << "; the medium is drawn clear.");
    medium = meniscus::RefractionMedium();
  }
  this->Internals->Medium = medium;
}

//------------------------------------------------------------------------------
void vtkRefractionPass::Render(const vtkRenderState* state)
{
  vtkInternals& internals = *this->Internals;
  vtkRenderer* renderer = state->GetRenderer();
  if (this->AdjustClippingRange)
  {
    internals.AdjustClippingRange(renderer);
  }
  this->UpdateMedium();
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
  for (vtkActor* membrane : internals.ListMembranes())
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
/**
 * Draws the part of the volumes in front of the membrane or next to it to the framebuffer of the
 * scene.
 */
void vtkRefractionPass::DrawInFront(
  const vtkRenderState* drawn, vtkOpenGLRenderWindow* window, vtkActor* membrane)
{
  const meniscus::PictureSize picture(drawn);
  vtkOpenGLState* state = window->GetState();
  state->Push();
  picture.Set(state);
  this->DrawVolumes(drawn->GetRenderer(), membrane, vtkTetrahedraRayCastMapper::IN_FRONT);
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
  state->Push();
  state->PushFramebufferBindings();
  const bool ready = internals.Objects.Ready(window, size[0], size[1], VTK_UNSIGNED_CHAR) &&
    (internals.ListObjects(membrane, true).empty() ||
      internals.Mirrored.Ready(window, size[0], size[1], VTK_UNSIGNED_CHAR)) &&
    internals.Membrane.Ready(window, size[0], size[1], VTK_FLOAT);
  if (ready)
  {
    this->DrawObjects(renderer, state, membrane);
    this->DrawSurface(renderer, state, membrane);
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
  picture.Set(state);
  this->Compose(renderer, window, membrane);
  state->Pop();
  vtkOpenGLCheckErrorMacro("failed after drawing a membrane");
}

//------------------------------------------------------------------------------
/** Draws the virtual geometry behind the membrane: the refracted one and the mirror images. */
void vtkRefractionPass::DrawObjects(
  vtkRenderer* renderer, vtkOpenGLState* state, vtkActor* membrane)
{
  vtkInternals& internals = *this->Internals;
  for (const bool areReflections : { true, false })
  {
    std::vector<vtkProp*> props = internals.ListObjects(membrane, areReflections);
    if (areReflections && props.empty())
    {
      continue;
    }
    meniscus::RefractionTarget& target = areReflections ? internals.Mirrored : internals.Objects;
    target.Begin(state);
    internals.Stage =
      areReflections ? vtkInternals::Stages::Mirrored : vtkInternals::Stages::Objects;
    vtkRenderState objects(renderer);
    objects.SetPropArrayAndCount(props.data(), static_cast<int>(props.size()));
    objects.SetFrameBuffer(target.Buffer);
    this->PreRender(&objects);
    internals.Opaque->Render(&objects);
    internals.Translucent->Render(&objects);
    this->PostRender(&objects);
    this->NumberOfRenderedProps += internals.Opaque->GetNumberOfRenderedProps();
  }
  this->DrawVolumes(renderer, membrane, vtkTetrahedraRayCastMapper::BEHIND);
}

//------------------------------------------------------------------------------
/** Draws a part of the membrane's volumes over the contents of the framebuffer. */
void vtkRefractionPass::DrawVolumes(vtkRenderer* renderer, vtkActor* membrane, int part)
{
  for (const auto& refraction : this->Internals->Refractions)
  {
    vtkVolume* volume = refraction.GetVolume();
    if (volume && refraction.Membrane == membrane && volume->GetVisibility())
    {
      // The renderer does the same for its own props.
      volume->SetAllocatedRenderTime(renderer->GetAllocatedRenderTime(), renderer);
      volume->Update();
      if (vtkTetrahedraRayCastMapper* mapper = RayCasterOf(volume))
      {
        mapper->RenderPart(renderer, volume, part);
        ++this->NumberOfRenderedProps;
      }
    }
  }
}

//------------------------------------------------------------------------------
/** Draws the membrane's normals and depths. */
void vtkRefractionPass::DrawSurface(
  vtkRenderer* renderer, vtkOpenGLState* state, vtkActor* membrane)
{
  vtkInternals& internals = *this->Internals;
  internals.Membrane.Begin(state);
  state->vtkglDisable(GL_BLEND);
  internals.Stage = vtkInternals::Stages::Membrane;
  internals.Surface->SetMapper(membrane->GetMapper());
  internals.Surface->SetUserMatrix(membrane->GetMatrix());
  vtkProp* prop = internals.Surface;
  vtkRenderState surface(renderer);
  surface.SetPropArrayAndCount(&prop, 1);
  surface.SetFrameBuffer(internals.Membrane.Buffer);
  this->PreRender(&surface);
  internals.Opaque->Render(&surface);
  this->PostRender(&surface);
}

//------------------------------------------------------------------------------
/** Composites the membrane's pixels over the framebuffer of the scene. */
void vtkRefractionPass::Compose(
  vtkRenderer* renderer, vtkOpenGLRenderWindow* window, vtkActor* membrane)
{
  vtkInternals& internals = *this->Internals;
  vtkTexture* cubeMap = internals.FindCubeMap(renderer);
  if (cubeMap)
  {
    cubeMap->Render(renderer);
  }
  auto& composer = internals.Composers[cubeMap ? 1 : 0];
  if (!composer)
  {
    std::string source = vtkRefractionMembraneFS;
    const auto define = [](const char* name, int value)
    { return "#define " + std::string(name) + " " + std::to_string(value) + "\n"; };
    vtkShaderProgram::Substitute(source, "//VTK::Environment::Dec",
      define("HAS_ENVIRONMENT", cubeMap ? 1 : 0) + define("NO_REFLECTANCE", NONE) +
        define("SCHLICK", SCHLICK) + define("MIRROR", MIRROR));
    composer = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, source.c_str(), "");
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(composer->Program);
  }
  if (!composer->Program || !composer->Program->GetCompiled())
  {
    vtkErrorMacro("The shader of membranes does not compile on this graphics device.");
    return;
  }
  vtkOpenGLState* state = window->GetState();
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDisable(GL_BLEND);
  vtkTextureObject* const color = internals.Objects.Color;
  const bool mirrors = !internals.ListObjects(membrane, true).empty();
  vtkTextureObject* const mirrored = mirrors ? internals.Mirrored.Color.Get() : color;
  vtkTextureObject* const normal = internals.Membrane.Color;
  vtkTextureObject* const depth = internals.Membrane.Depth;
  const auto bind = [&composer](vtkTextureObject* texture, const char* name)
  {
    texture->Activate();
    composer->Program->SetUniformi(name, texture->GetTextureUnit());
  };
  bind(color, "refracted");
  bind(mirrored, "mirroredScene"); // any image if it is not read
  composer->Program->SetUniformi("mirrorsScene", mirrors);
  bind(normal, "membraneNormal");
  bind(depth, "membraneDepth");
  if (cubeMap)
  {
    composer->Program->SetUniformi("environment", cubeMap->GetTextureUnit());
  }
  this->SetOptics(renderer, membrane, composer->Program);
  composer->Render();
  if (cubeMap)
  {
    cubeMap->PostRender(renderer);
  }
  for (vtkTextureObject* texture : { color, mirrored, normal, depth })
  {
    texture->Deactivate();
  }
}

//------------------------------------------------------------------------------
void vtkRefractionPass::SetOptics(
  vtkRenderer* renderer, vtkActor* membrane, vtkShaderProgram* program)
{
  const auto& refractions = this->Internals->Refractions;
  const auto ofMembrane = std::find_if(refractions.begin(), refractions.end(),
    [membrane](const vtkInternals::Refraction& one) { return one.Membrane == membrane; });
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> clipToView;
  clipToView->DeepCopy(
    camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  clipToView->Invert();
  clipToView->Transpose(); // OpenGL's order
  vtkMatrix4x4* worldToView = camera->GetModelViewTransformMatrix();
  vtkNew<vtkMatrix3x3> viewToWorld;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      // The inverse of a rotation in OpenGL's order.
      viewToWorld->SetElement(i, j, worldToView->GetElement(i, j));
    }
  }
  program->SetUniformMatrix("clipToView", clipToView);
  if (program->IsUniformUsed("viewToWorld"))
  {
    program->SetUniformMatrix("viewToWorld", viewToWorld);
  }
  double behind[3];
  float background[3];
  float backdrop[3];
  renderer->GetBackground(behind);
  const std::array<double, 3> seen = this->Internals->Medium.BackdropOf(behind);
  std::copy_n(behind, 3, background);
  std::copy_n(seen.begin(), 3, backdrop);
  program->SetUniform3f("background", background);
  program->SetUniform3f("backdrop", backdrop);
  program->SetUniformi("parallelView", camera->GetParallelProjection());
  program->SetUniformi("reflectanceModel", this->ReflectanceModel);
  program->SetUniformf("relativeIndex", static_cast<float>(ofMembrane->GetRelativeIndex()));
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
  for (auto& refraction : internals.Refractions)
  {
    refraction.Object->ReleaseGraphicsResources(window);
  }
  if (internals.Reflection)
  {
    internals.Reflection->ReleaseGraphicsResources(window);
  }
  internals.Objects.Release(window);
  internals.Mirrored.Release(window);
  internals.Membrane.Release(window);
  for (auto& composer : internals.Composers)
  {
    composer.reset();
  }
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
  os << indent << "AdjustClippingRange: " << (this->AdjustClippingRange ? "on" : "off") << "\n";
  os << indent << "NumberOfMembranesDrawn: " << this->GetNumberOfMembranesDrawn() << "\n";
  os << indent << "NumberOfMembranesSkipped: " << this->GetNumberOfMembranesSkipped() << "\n";
}
