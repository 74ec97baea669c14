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
  /** All backends of RegisterRayCastBackend(). */
  Registered = 1000
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
  /** Function that makes the backend of a mapper. */
  RayCastBackendFactory Make;
  /**
   * Name of the backend that draws a frame which this one was asked for and cannot draw. Empty, the
   * default, stands for the order of AUTOMATIC.
   */
  std::string Fallback;
  /** Value of vtkTetrahedraRayCastMapper::GetActiveBackend() after a frame of this backend. */
  RayCastBackendNumber Number;
};

/**
 * Adds a backend for all mappers of the process. AUTOMATIC asks the last backend added first, and
 * the library's backends last. Returns false, and adds nothing, if the name is empty or taken or
 * there is no factory. May be called on any thread.
 */
VTKMENISCUS_EXPORT bool RegisterRayCastBackend(const RayCastBackendEntry& entry);

/**
 * Removes a backend that was added; the library's backends stay. Returns true if it was there.
 * Mappers that made such a backend keep it, unused, until they are destroyed: the code of the
 * backend must stay loaded until then.
 */
VTKMENISCUS_EXPORT bool UnregisterRayCastBackend(const std::string& name);

/** Backends in the order in which AUTOMATIC asks them. */
VTKMENISCUS_EXPORT std::vector<std::shared_ptr<const RayCastBackendEntry>> ListRayCastBackends();

}

#endif
