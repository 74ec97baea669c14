// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pipeline/RayCastBackendSet.h"

#include <algorithm>

namespace meniscus
{
namespace
{

using EntryPointer = std::shared_ptr<const RayCastBackendEntry>;

/** Finds an entry by name or number; null if there is none or AUTOMATIC is wished. */
EntryPointer Find(const std::vector<EntryPointer>& entries, const RayCastBackendWish& wish)
{
  const auto found = std::find_if(entries.begin(), entries.end(),
    [&wish](const EntryPointer& entry)
    { return wish.Name.empty() ? entry->Number == wish.Number : entry->Name == wish.Name; });
  return found == entries.end() ? nullptr : *found;
}

bool WasRefused(const RayCastBackendChoice& choice, const std::string& name)
{
  return std::find(choice.Refused.begin(), choice.Refused.end(), name) != choice.Refused.end();
}

/** Notes why a backend cannot draw; a reason that several have stands once. */
void Refuse(RayCastBackendChoice& choice, const std::string& name, const std::string& reason)
{
  choice.Refused.push_back(name);
  if (choice.Reasons.find(reason) == std::string::npos)
  {
    choice.Reasons += (choice.Reasons.empty() ? "" : "; ") + reason;
  }
}

}

//------------------------------------------------------------------------------
RayCastBackend& RayCastBackendSet::Get(const EntryPointer& entry)
{
  std::unique_ptr<RayCastBackend>& backend = this->Backends[entry];
  if (!backend)
  {
    backend = entry->Make(this->Sharing);
  }
  return *backend;
}

//------------------------------------------------------------------------------
/** Chooses a backend if it can draw; else notes why not and returns false. */
bool RayCastBackendSet::Ask(
  const EntryPointer& entry, const RayCastRequest& request, RayCastBackendChoice& choice)
{
  RayCastBackend& backend = this->Get(entry);
  const std::string reason = backend.CanDraw(request);
  if (!reason.empty())
  {
    Refuse(choice, entry->Name, reason);
    return false;
  }
  choice.Backend = &backend;
  choice.Name = entry->Name;
  choice.Number = entry->Number;
  return true;
}

//------------------------------------------------------------------------------
RayCastBackendChoice RayCastBackendSet::Choose(
  const RayCastRequest& request, const RayCastBackendWish& wish)
{
  const std::vector<EntryPointer> entries = ListRayCastBackends();
  RayCastBackendChoice choice;
  EntryPointer wished = Find(entries, wish);
  if (!wished && !wish.Name.empty())
  {
    Refuse(choice, wish.Name, "no backend is registered as '" + wish.Name + "'");
  }
  while (wished && !WasRefused(choice, wished->Name))
  {
    if (this->Ask(wished, request, choice))
    {
      return choice;
    }
    const std::string& next = wished->Fallback;
    wished = next.empty() ? nullptr : Find(entries, { next, RayCastBackendNumber::Automatic });
  }
  for (const EntryPointer& entry : entries)
  {
    if (!WasRefused(choice, entry->Name) && this->Get(entry).IsAutomatic(request) &&
      this->Ask(entry, request, choice))
    {
      return choice;
    }
  }
  return choice;
}

//------------------------------------------------------------------------------
void RayCastBackendSet::ForEach(const std::function<void(RayCastResources&)>& function) const
{
  for (const auto& shared : this->Sharing.GetObjects())
  {
    function(*shared.second);
  }
  for (const auto& backend : this->Backends)
  {
    function(*backend.second);
  }
}

//------------------------------------------------------------------------------
RayCastCounters RayCastBackendSet::GetCounters() const
{
  RayCastCounters sum;
  this->ForEach(
    [&sum](RayCastResources& resources)
    {
      const RayCastCounters counters = resources.GetCounters();
      sum.UploadedBytes += counters.UploadedBytes;
      sum.HostBytes += counters.HostBytes;
      sum.DeviceBytes += counters.DeviceBytes;
      sum.EntryListBuilds += counters.EntryListBuilds;
      sum.RefractedEntryLists += counters.RefractedEntryLists;
      sum.CastPixels += counters.CastPixels;
    });
  return sum;
}

//------------------------------------------------------------------------------
void RayCastBackendSet::ReleaseGraphicsResources(vtkWindow* window)
{
  this->ForEach(
    [window](RayCastResources& resources) { resources.ReleaseGraphicsResources(window); });
}

}
