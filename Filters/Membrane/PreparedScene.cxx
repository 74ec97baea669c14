// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/PreparedScene.h"

#include <algorithm>
#include <atomic>
#include <list>
#include <mutex>

namespace meniscus
{
namespace
{

/** Surfaces that scenes have borrowed and still use. */
struct SceneList
{
  std::mutex Mutex;
  std::list<std::weak_ptr<PreparedScene>> Members;
};

SceneList& GetList()
{
  static SceneList list;
  return list;
}

bool IsReadyFor(
  const PreparedScene& scene, const std::vector<MembraneOrigin>& origins, const SceneView& view)
{
  const auto isReady = [](const PreparedSurface& surface, const MembraneOrigin& origin)
  { return surface.Source.IsReady() && surface.Source.GetOrigin() == origin; };
  return !scene.IsBorrowed && scene.HasRays && scene.View == view &&
    std::equal(
      scene.Surfaces.begin(), scene.Surfaces.end(), origins.begin(), origins.end(), isReady);
}

/** True if the surfaces were read from the same objects, whatever their values are now. */
bool HasSameSources(const PreparedScene& scene, const std::vector<MembraneOrigin>& origins)
{
  return std::equal(scene.Surfaces.begin(), scene.Surfaces.end(), origins.begin(), origins.end(),
    [](const PreparedSurface& surface, const MembraneOrigin& origin)
    { return surface.Source.GetOrigin().Source == origin.Source; });
}

}

//------------------------------------------------------------------------------
vtkTypeInt64 SceneVersion::MakeNumber()
{
  static std::atomic<vtkTypeInt64> last{ 0 };
  return ++last;
}

//------------------------------------------------------------------------------
std::shared_ptr<PreparedScene> BorrowScene(const std::shared_ptr<PreparedScene>& own,
  const SceneVersion& last, const std::vector<MembraneOrigin>& origins, const SceneView& view)
{
  SceneList& list = GetList();
  const std::lock_guard<std::mutex> lock(list.Mutex);
  list.Members.remove_if([](const auto& member) { return member.expired(); });
  std::shared_ptr<PreparedScene> found;
  if (own && IsReadyFor(*own, origins, view))
  {
    found = own;
  }
  for (auto member = list.Members.begin(); member != list.Members.end() && !found; ++member)
  {
    const std::shared_ptr<PreparedScene> other = member->lock();
    if (other && IsReadyFor(*other, origins, view))
    {
      found = other;
    }
  }
  if (!found && own && !own->IsBorrowed && own->Version == last &&
    (HasSameSources(*own, origins) || own.use_count() == 1))
  {
    found = own;
  }
  if (!found)
  {
    found = std::make_shared<PreparedScene>();
  }
  if (!found->IsListed)
  {
    list.Members.emplace_back(found);
    found->IsListed = true;
  }
  found->IsBorrowed = true;
  return found;
}

//------------------------------------------------------------------------------
void ReturnScene(PreparedScene& scene)
{
  const std::lock_guard<std::mutex> lock(GetList().Mutex);
  scene.IsBorrowed = false;
}

}
