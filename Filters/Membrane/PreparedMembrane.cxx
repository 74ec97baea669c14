// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/PreparedMembrane.h"

#include <atomic>
#include <list>
#include <mutex>

namespace meniscus
{
namespace
{

/** Membranes that scenes have borrowed and still use. */
struct MembraneList
{
  std::mutex Mutex;
  std::list<std::weak_ptr<PreparedMembrane>> Members;
};

MembraneList& GetList()
{
  static MembraneList list;
  return list;
}

bool IsReadyFor(
  const PreparedMembrane& membrane, const MembraneOrigin& origin, const MembraneView& view)
{
  return !membrane.IsBorrowed && membrane.Surface.IsReady() && membrane.HasRays &&
    membrane.Surface.GetOrigin() == origin && membrane.View == view;
}

}

//------------------------------------------------------------------------------
vtkTypeInt64 MembraneVersion::MakeNumber()
{
  static std::atomic<vtkTypeInt64> last{ 0 };
  return ++last;
}

//------------------------------------------------------------------------------
std::shared_ptr<PreparedMembrane> BorrowMembrane(const std::shared_ptr<PreparedMembrane>& own,
  const MembraneVersion& last, const MembraneOrigin& origin, const MembraneView& view)
{
  MembraneList& list = GetList();
  const std::lock_guard<std::mutex> lock(list.Mutex);
  list.Members.remove_if([](const auto& member) { return member.expired(); });
  std::shared_ptr<PreparedMembrane> found;
  if (own && IsReadyFor(*own, origin, view))
  {
    found = own;
  }
  for (auto member = list.Members.begin(); member != list.Members.end() && !found; ++member)
  {
    const std::shared_ptr<PreparedMembrane> other = member->lock();
    if (other && IsReadyFor(*other, origin, view))
    {
      found = other;
    }
  }
  if (!found && own && !own->IsBorrowed && own->Version == last &&
    (own->Surface.GetOrigin().Source == origin.Source || own.use_count() == 1))
  {
    found = own;
  }
  if (!found)
  {
    found = std::make_shared<PreparedMembrane>();
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
void ReturnMembrane(PreparedMembrane& membrane)
{
  const std::lock_guard<std::mutex> lock(GetList().Mutex);
  membrane.IsBorrowed = false;
}

}
