// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMExactVolumeRepresentationProxy.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVSessionBase.h"
#include "vtkPVXMLElement.h"
#include "vtkProcessModule.h"
#include "vtkSIProxyDefinitionManager.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSession.h"
#include "vtkSessionIterator.h"
#include "vtkSmartPointer.h"

#include <string>

vtkStandardNewMacro(vtkSMExactVolumeRepresentationProxy);

namespace
{
/** Names of the representation and of its sub-proxy in TetrahedraRayCast.xml. */
constexpr const char* ExactVolume = "Volume (Exact)";
constexpr const char* OlderName = "Tetrahedra Ray Cast";
constexpr const char* SubProxy = "TetrahedraRayCastRepresentation";

/** Element names in ParaView's XML, from which it makes names of classes. */
constexpr const char* OwnElement = "ExactVolumeRepresentationProxy";
constexpr const char* ReplacedElement = "PVRepresentationProxy";

void NameClass(vtkPVXMLElement* definition)
{
  if (definition && definition->GetName() && std::string(definition->GetName()) == ReplacedElement)
  {
    definition->SetName(OwnElement);
  }
}

/**
 * True for sessions of servers and of their clients: a server sends its definitions to clients that
 * may not know this class yet.
 */
bool IsOfServer(vtkSession* session)
{
  const auto type = vtkProcessModule::GetProcessType();
  return (session && session->IsA("vtkSMSessionClient")) ||
    type == vtkProcessModule::PROCESS_SERVER || type == vtkProcessModule::PROCESS_DATA_SERVER ||
    type == vtkProcessModule::PROCESS_RENDER_SERVER;
}

/** Names this class in a session's definition of the representations of unstructured grids. */
void NameClassIn(vtkSession* session)
{
  if (IsOfServer(session))
  {
    return;
  }
  auto* base = vtkPVSessionBase::SafeDownCast(session);
  vtkSIProxyDefinitionManager* manager = base ? base->GetProxyDefinitionManager() : nullptr;
  if (manager)
  {
    const char* group = "representations";
    const char* name = "UnstructuredGridRepresentation";
    NameClass(manager->GetProxyDefinition(group, name, false));
    // A copy, in which the definition is merged with its base's.
    NameClass(manager->GetCollapsedProxyDefinition(group, name, nullptr, false));
  }
}

void OnSessionCreated(vtkObject* caller, unsigned long vtkNotUsed(event),
  void* vtkNotUsed(clientData), void* identifier)
{
  auto* module = vtkProcessModule::SafeDownCast(caller);
  if (module && identifier)
  {
    NameClassIn(module->GetSession(*static_cast<vtkIdType*>(identifier)));
  }
}
}

//------------------------------------------------------------------------------
vtkSMExactVolumeRepresentationProxy::vtkSMExactVolumeRepresentationProxy() = default;

//------------------------------------------------------------------------------
vtkSMExactVolumeRepresentationProxy::~vtkSMExactVolumeRepresentationProxy() = default;

//------------------------------------------------------------------------------
void vtkSMExactVolumeRepresentationProxy::UseForUnstructuredGrids()
{
  vtkProcessModule* module = vtkProcessModule::GetProcessModule();
  if (!module)
  {
    return;
  }
  const auto sessions = vtkSmartPointer<vtkSessionIterator>::Take(module->NewSessionIterator());
  for (sessions->InitTraversal(); !sessions->IsDoneWithTraversal(); sessions->GoToNextItem())
  {
    NameClassIn(sessions->GetCurrentSession());
  }
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(OnSessionCreated);
  module->AddObserver(vtkCommand::ConnectionCreatedEvent, command);
}

//------------------------------------------------------------------------------
bool vtkSMExactVolumeRepresentationProxy::HasExactVolume()
{
  return this->GetSubProxy(SubProxy) != nullptr;
}

//------------------------------------------------------------------------------
int vtkSMExactVolumeRepresentationProxy::ReadXMLAttributes(
  vtkSMSessionProxyManager* manager, vtkPVXMLElement* element)
{
  if (!this->Superclass::ReadXMLAttributes(manager, element))
  {
    return 0;
  }
  vtkSMProperty* representation = this->GetProperty("Representation");
  if (representation && this->HasExactVolume())
  {
    representation->AddObserver(vtkCommand::ModifiedEvent, this,
      &vtkSMExactVolumeRepresentationProxy::OnRepresentationModified);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkSMExactVolumeRepresentationProxy::OnRepresentationModified()
{
  vtkSMPropertyHelper representation(this, "Representation");
  const char* type = representation.GetAsString();
  if (type && std::string(type) == OlderName)
  {
    representation.Set(ExactVolume);
  }
}

//------------------------------------------------------------------------------
bool vtkSMExactVolumeRepresentationProxy::SetRepresentationType(const char* type)
{
  const std::string name = type ? type : "";
  if (!this->HasExactVolume() || (name != ExactVolume && name != OlderName))
  {
    return this->Superclass::SetRepresentationType(type);
  }
  if (!this->GetUsingScalarColoring())
  {
    this->ColorByFirstArray();
  }
  return this->Superclass::SetRepresentationType(ExactVolume);
}

//------------------------------------------------------------------------------
// By the first point array or, without any, by the first cell array, as for Volume.
void vtkSMExactVolumeRepresentationProxy::ColorByFirstArray()
{
  vtkSMProperty* color = this->GetProperty("ColorArrayName");
  auto* arrays = color ? color->FindDomain<vtkSMArrayListDomain>() : nullptr;
  const unsigned int count = arrays ? arrays->GetNumberOfStrings() : 0;
  if (count == 0)
  {
    return;
  }
  unsigned int chosen = 0;
  while (chosen < count && arrays->GetFieldAssociation(chosen) != vtkDataObject::POINT)
  {
    ++chosen;
  }
  chosen = chosen < count ? chosen : 0;
  if (this->SetScalarColoring(arrays->GetString(chosen), arrays->GetFieldAssociation(chosen)))
  {
    this->RescaleTransferFunctionToDataRange(true);
  }
}
