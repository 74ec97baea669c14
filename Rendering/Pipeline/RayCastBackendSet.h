// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastBackend.h"
#include "Rendering/Pipeline/RayCastBackendRegistry.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkWindow;

namespace meniscus
{

/** Backend that is asked for: by its name if that is not empty, else by its number. */
struct RayCastBackendWish
{
  std::string Name;
  RayCastBackendNumber Number = RayCastBackendNumber::Automatic;
};

/** Backend that draws a frame; null if none can. */
struct RayCastBackendChoice
{
  RayCastBackend* Backend = nullptr;
  std::string Name;
  RayCastBackendNumber Number = RayCastBackendNumber::Automatic;
  /** Backends that were asked before and cannot draw, and their reasons, each once. */
  std::vector<std::string> Refused;
  std::string Reasons;
};

/** The backends of one mapper, made from the registry when first asked for a frame. */
class RayCastBackendSet
{
public:
  RayCastBackendChoice Choose(const RayCastRequest& request, const RayCastBackendWish& wish);

  /** Sums over all backends. */
  RayCastCounters GetCounters() const;
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  using EntryPointer = std::shared_ptr<const RayCastBackendEntry>;

  RayCastBackend& Get(const EntryPointer& entry);
  bool Ask(const EntryPointer& entry, const RayCastRequest& request, RayCastBackendChoice& choice);
  void ForEach(const std::function<void(RayCastResources&)>& function) const;

  RayCastSharing Sharing;
  std::map<EntryPointer, std::unique_ptr<RayCastBackend>> Backends;
};

}
