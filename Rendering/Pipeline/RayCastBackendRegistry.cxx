// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pipeline/RayCastBackendRegistry.h"

#include "Rendering/Backends/Native/RayCastNative.h"
#include "Rendering/Backends/OpenGL/OpenGLBackends.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace meniscus
{
namespace
{

using Number = RayCastBackendNumber;
using EntryPointer = std::shared_ptr<const RayCastBackendEntry>;

EntryPointer Entry(
  const char* name, RayCastBackendFactory make, const char* fallback, Number number)
{
  return std::make_shared<RayCastBackendEntry>(name, std::move(make), fallback, number);
}

/** All backends of the process; the library's own to begin with, those preferred first. */
struct Registry
{
  std::mutex Mutex;
  std::vector<EntryPointer> Entries{
    Entry("Compute", MakeComputeBackend, "OpenGL", Number::Compute),
    Entry("OpenGL", MakeFragmentBackend, "", Number::OpenGL),
    Entry("Native", MakeNativeBackend, "", Number::Native),
  };

  std::vector<EntryPointer>::iterator Find(const std::string& name)
  {
    return std::find_if(this->Entries.begin(), this->Entries.end(),
      [&name](const EntryPointer& entry) { return entry->Name == name; });
  }

  static Registry& Get()
  {
    static Registry registry;
    return registry;
  }
};

}

//------------------------------------------------------------------------------
bool RegisterRayCastBackend(const RayCastBackendEntry& entry)
{
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  if (entry.Name.empty() || !entry.Make || registry.Find(entry.Name) != registry.Entries.end())
  {
    return false;
  }
  const auto added = std::make_shared<RayCastBackendEntry>(entry);
  added->Number = Number::Registered;
  registry.Entries.insert(registry.Entries.begin(), added);
  return true;
}

//------------------------------------------------------------------------------
bool UnregisterRayCastBackend(const std::string& name)
{
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  const auto entry = registry.Find(name);
  if (entry == registry.Entries.end() || (*entry)->Number != Number::Registered)
  {
    return false;
  }
  registry.Entries.erase(entry);
  return true;
}

//------------------------------------------------------------------------------
std::vector<std::shared_ptr<const RayCastBackendEntry>> ListRayCastBackends()
{
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  return registry.Entries;
}

}
