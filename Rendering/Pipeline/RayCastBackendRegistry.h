// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Registration of backends for vtkTetrahedraRayCastMapper; see Documentation/extending.md. */
#ifndef meniscus_Rendering_Pipeline_RayCastBackendRegistry_h
#define meniscus_Rendering_Pipeline_RayCastBackendRegistry_h

#include "RayCastBackend.h"

#include "vtkMeniscusModule.h" // For export macro

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace meniscus
{

/** Makes a backend for one mapper. */
using RayCastBackendFactory = std::function<std::unique_ptr<RayCastBackend>(RayCastSharing&)>;

/** Numbers of backends; the same as in vtkTetrahedraRayCastMapper. */
enum class RayCastBackendNumber
{
  Automatic = 0,
  OpenGL = 1,
  Native = 2,
  Compute = 3,
  /** Every one that is not of the library. */
  Registered = 4
};

/** A backend as the registry keeps it. */
struct RayCastBackendEntry
{
  RayCastBackendEntry(std::string name, RayCastBackendFactory make, std::string fallback = "",
    RayCastBackendNumber number = RayCastBackendNumber::Registered)
    : Name(std::move(name))
    , Make(std::move(make))
    , Fallback(std::move(fallback))
    , Number(number)
  {
  }

  /** Name for vtkTetrahedraRayCastMapper::SetBackendName(). */
  std::string Name;
  RayCastBackendFactory Make;
  /** Backend asked next where this one was asked for and cannot draw; empty: as AUTOMATIC. */
  std::string Fallback;
  RayCastBackendNumber Number;
};

/**
 * Adds a backend for all mappers of the process. AUTOMATIC asks the last backend added first, and
 * the library's backends last. Returns false, and adds nothing, if the name is empty or taken or
 * there is no factory. May be called on any thread.
 */
VTKMENISCUS_EXPORT bool RegisterRayCastBackend(const RayCastBackendEntry& entry);

/**
 * Removes a backend that was added; the library's backends stay. Returns whether it was there.
 * Mappers that made such a backend keep it, unused, until they are destroyed: the code of the
 * backend must stay loaded as long.
 */
VTKMENISCUS_EXPORT bool UnregisterRayCastBackend(const std::string& name);

/** Backends in the order in which AUTOMATIC asks them. */
VTKMENISCUS_EXPORT std::vector<std::shared_ptr<const RayCastBackendEntry>> ListRayCastBackends();

}

#endif
