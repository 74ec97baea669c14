// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMEyeFollowingSourceProxy.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMInputProperty.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyIterator.h"
#include "vtkSMProxyManager.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <vector>

vtkStandardNewMacro(vtkSMEyeFollowingSourceProxy);

namespace
{

/** True if a representation, or the representation to which it belongs, is visible. */
bool IsVisible(vtkSMProxy* representation)
{
  return vtkSMPropertyHelper(representation->GetTrueParentProxy(), "Visibility", true).GetAsInt() !=
    0;
}

/** Adds the views in which an output of the proxy, or of filters that use it, is visible. */
void AddShowingViews(vtkSMProxy* proxy, std::set<vtkSMProxy*>& views)
{
  for (unsigned int i = 0; i < proxy->GetNumberOfConsumers(); ++i)
  {
    vtkSMProxy* consumer = proxy->GetConsumerProxy(i); // null if it has been deleted
    if (vtkSMRenderViewProxy::SafeDownCast(consumer))
    {
      views.insert(consumer);
    }
    else if (vtkSMRepresentationProxy::SafeDownCast(consumer)
        ? IsVisible(consumer)
        : vtkSMSourceProxy::SafeDownCast(consumer) != nullptr)
    {
      AddShowingViews(consumer, views);
    }
  }
}

/** Distance of the eye of a parallel view in sizes of the surfaces, as in the library. */
constexpr double FarAway = 1e5;

/** Bounds of the refracting surfaces of a filter. */
vtkBoundingBox MeasureMembranes(vtkSMProxy* filter)
{
  vtkBoundingBox box;
  auto* membranes = vtkSMInputProperty::SafeDownCast(filter->GetProperty("Membrane"));
  const unsigned int count = membranes ? membranes->GetNumberOfProxies() : 0;
  for (unsigned int i = 0; i < count; ++i)
  {
    auto* source = vtkSMSourceProxy::SafeDownCast(membranes->GetProxy(i));
    if (source)
    {
      source->UpdatePipeline();
      const unsigned int port = membranes->GetOutputPortForConnection(i);
      box.AddBounds(source->GetDataInformation(port)->GetBounds());
    }
  }
  return box;
}

/** Position of the eye of a view: the camera, or in parallel projection a point far behind it. */
std::array<double, 3> PlaceEye(vtkCamera* camera, vtkSMProxy* filter)
{
  std::array<double, 3> eye;
  camera->GetPosition(eye.data());
  const bool isParallel = camera->GetParallelProjection() != 0;
  const vtkBoundingBox box = isParallel ? MeasureMembranes(filter) : vtkBoundingBox();
  if (box.IsValid() && box.GetDiagonalLength() > 0.0)
  {
    box.GetCenter(eye.data());
    for (std::size_t i = 0; i < 3; ++i)
    {
      eye[i] -= FarAway * box.GetDiagonalLength() * camera->GetDirectionOfProjection()[i];
    }
  }
  return eye;
}

/** Sets a property if its values differ; an equal value must not modify the pipeline. */
bool SetIfOther(vtkSMProxy* proxy, const char* name, const double* values, unsigned int number)
{
  vtkSMPropertyHelper helper(proxy, name);
  const std::vector<double> old = helper.GetDoubleArray();
  if (old.size() == number && std::equal(old.begin(), old.end(), values))
  {
    return false;
  }
  helper.Set(values, number);
  return true;
}

}

//------------------------------------------------------------------------------
vtkSMEyeFollowingSourceProxy::vtkSMEyeFollowingSourceProxy() = default;

//------------------------------------------------------------------------------
vtkSMEyeFollowingSourceProxy::~vtkSMEyeFollowingSourceProxy() = default;

//------------------------------------------------------------------------------
int vtkSMEyeFollowingSourceProxy::ReadXMLAttributes(
  vtkSMSessionProxyManager* manager, vtkPVXMLElement* element)
{
  if (!this->Superclass::ReadXMLAttributes(manager, element))
  {
    return 0;
  }
  vtkSMProperty* eye = this->GetProperty("EyePosition");
  if (!eye || !this->GetProperty("FollowCamera"))
  {
    vtkErrorMacro("The properties EyePosition and FollowCamera are needed.");
    return 0;
  }
  eye->AddObserver(vtkCommand::ModifiedEvent, this, &vtkSMEyeFollowingSourceProxy::OnEyeModified);
  if (this->GetHints() && this->GetHints()->FindNestedElementByName("FollowCamera"))
  {
    vtkSMPropertyHelper(this, "FollowCamera").Set(1);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::CreateVTKObjects()
{
  const bool isNew = !this->ObjectsCreated;
  this->Superclass::CreateVTKObjects();
  if (isNew && this->ObjectsCreated)
  {
    this->ObserveViews();
  }
}

//------------------------------------------------------------------------------
int vtkSMEyeFollowingSourceProxy::LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator)
{
  // For a state without the property the eye keeps its position.
  vtkSMPropertyHelper(this, "FollowCamera").Set(0);
  this->EyeIsSet = true;
  return this->Superclass::LoadXMLState(element, locator);
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::ObserveViews()
{
  vtkSMSessionProxyManager* manager = this->GetSessionProxyManager();
  manager->AddObserver(
    vtkCommand::RegisterEvent, this, &vtkSMEyeFollowingSourceProxy::OnProxyRegistered);
  vtkNew<vtkSMProxyIterator> views;
  views->SetSessionProxyManager(manager);
  for (views->Begin("views"); !views->IsAtEnd(); views->Next())
  {
    this->ObserveView(views->GetProxy());
  }
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::ObserveView(vtkSMProxy* proxy)
{
  if (vtkSMRenderViewProxy::SafeDownCast(proxy))
  {
    proxy->AddObserver(vtkCommand::StartEvent, this, &vtkSMEyeFollowingSourceProxy::OnViewStarts);
  }
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::OnProxyRegistered(
  vtkObject* vtkNotUsed(caller), unsigned long vtkNotUsed(event), void* information)
{
  using Registered = vtkSMProxyManager::RegisteredProxyInformation;
  const auto* registered = static_cast<Registered*>(information);
  if (registered && registered->Type == Registered::PROXY &&
    std::strcmp(registered->GroupName, "views") == 0)
  {
    this->ObserveView(registered->Proxy);
  }
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::OnViewStarts(
  vtkObject* caller, unsigned long vtkNotUsed(event), void* interactive)
{
  const bool isMoving = interactive && *static_cast<int*>(interactive) != 0;
  auto* view = vtkSMRenderViewProxy::SafeDownCast(caller);
  if (!this->Follows() || (isMoving && this->UpdateTime > MaximumUpdateTime) ||
    view != this->FindShowingView())
  {
    return;
  }
  if (this->MoveEye(view))
  {
    // The view would update next; the update is done here to measure its time.
    const double start = vtkTimerLog::GetUniversalTime();
    view->Update();
    this->UpdateTime = vtkTimerLog::GetUniversalTime() - start;
  }
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::OnEyeModified()
{
  if (!this->IsMovingEye)
  {
    this->EyeIsSet = true;
    vtkSMPropertyHelper(this, "FollowCamera").Set(0);
    // A position that is set is one of an eye at this place.
    if (this->GetProperty("ViewParallelProjection"))
    {
      vtkSMPropertyHelper(this, "ViewParallelProjection").Set(0);
    }
  }
}

//------------------------------------------------------------------------------
bool vtkSMEyeFollowingSourceProxy::Follows()
{
  return vtkSMPropertyHelper(this, "FollowCamera").GetAsInt() != 0;
}

//------------------------------------------------------------------------------
vtkSMRenderViewProxy* vtkSMEyeFollowingSourceProxy::FindShowingView()
{
  std::set<vtkSMProxy*> showing;
  AddShowingViews(this, showing);
  vtkNew<vtkSMProxyIterator> views;
  views->SetSessionProxyManager(this->GetSessionProxyManager());
  for (views->Begin("views"); !views->IsAtEnd(); views->Next())
  {
    if (showing.count(views->GetProxy()) > 0)
    {
      return vtkSMRenderViewProxy::SafeDownCast(views->GetProxy());
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
vtkSMRenderViewProxy* vtkSMEyeFollowingSourceProxy::FindActiveView()
{
  vtkSMProxySelectionModel* active =
    this->GetSessionProxyManager()->GetSelectionModel("ActiveView");
  return vtkSMRenderViewProxy::SafeDownCast(active ? active->GetCurrentProxy() : nullptr);
}

//------------------------------------------------------------------------------
bool vtkSMEyeFollowingSourceProxy::MoveEye(vtkSMRenderViewProxy* view)
{
  vtkCamera* camera = view->GetActiveCamera();
  if (!camera)
  {
    return false;
  }
  // Filters without this property take a point far away; the other one also has to know how large
  // an angle is in the picture.
  const bool knowsParallel = this->GetProperty("ViewParallelProjection") != nullptr;
  const int isParallel = camera->GetParallelProjection() != 0 ? 1 : 0;
  std::array<double, 3> eye;
  camera->GetPosition(eye.data());
  eye = knowsParallel ? eye : PlaceEye(camera, this);
  this->IsMovingEye = true;
  bool moved = SetIfOther(this, "EyePosition", eye.data(), 3);
  this->IsMovingEye = false;
  if (knowsParallel)
  {
    const double scale = camera->GetParallelScale();
    vtkSMPropertyHelper parallel(this, "ViewParallelProjection");
    moved |= parallel.GetAsInt() != isParallel;
    parallel.Set(isParallel);
    moved |= isParallel && SetIfOther(this, "ViewParallelScale", &scale, 1);
  }
  // Unused values must not make the filter run again.
  const bool usesView = this->GetProperty("ViewCulling")
    ? vtkSMPropertyHelper(this, "ViewCulling").GetAsInt() != 0
    : this->GetProperty("ViewAngle") != nullptr;
  if (usesView || (knowsParallel && isParallel))
  {
    moved |= SetIfOther(this, "ViewFocalPoint", camera->GetFocalPoint(), 3);
    moved |= SetIfOther(this, "ViewUp", camera->GetViewUp(), 3);
  }
  if (usesView)
  {
    const double angle = camera->GetViewAngle();
    moved |= SetIfOther(this, "ViewAngle", &angle, 1);
  }
  if (moved)
  {
    this->UpdateVTKObjects();
  }
  return moved;
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::MoveEyeBeforeUpdate()
{
  vtkSMRenderViewProxy* view = nullptr;
  if (this->Follows())
  {
    view = this->FindShowingView();
    view = view ? view : this->FindActiveView();
  }
  else if (!this->EyeIsSet)
  {
    view = this->FindActiveView();
  }
  if (view)
  {
    this->MoveEye(view);
    this->EyeIsSet = true;
  }
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::UpdatePipeline()
{
  this->MoveEyeBeforeUpdate();
  this->Superclass::UpdatePipeline();
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::UpdatePipeline(double time)
{
  this->MoveEyeBeforeUpdate();
  this->Superclass::UpdatePipeline(time);
}

//------------------------------------------------------------------------------
void vtkSMEyeFollowingSourceProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EyeIsSet: " << this->EyeIsSet << "\n";
  os << indent << "UpdateTime: " << this->UpdateTime << "\n";
}
