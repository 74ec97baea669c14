// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/StackScene.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/StackValidation.h"
#include "Filters/Membrane/PreparedMembrane.h"

#include "vtkImplicitFunction.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace meniscus
{

//------------------------------------------------------------------------------
bool StackScene::SetInterfaces(const std::vector<vtkPolyData*>& surfaces,
  vtkRefractingInterfaceCollection* interfaces, SceneMessages& messages)
{
  bool isNew = this->Entries.size() != surfaces.size();
  this->Entries.resize(surfaces.size());
  std::vector<InterfaceMedia> media = ListMedia(interfaces);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    vtkRefractingInterface* interface = interfaces->GetInterface(static_cast<int>(i));
    vtkImplicitFunction* function =
      this->UsedFitting == Fitting::Exact ? interface->GetExactSurface() : nullptr;
    bool& turns = this->Entries[i].Turns;
    this->IsEyeReady = this->IsEyeReady && turns == interface->GetTurnTowardsEye();
    turns = interface->GetTurnTowardsEye();
    if (!this->UpdateEntry(i, surfaces[i], function, isNew, messages))
    {
      return false;
    }
  }
  if (!isNew && media == this->Media)
  {
    return true;
  }
  this->Media = std::move(media);
  this->SetSolverInterfaces();
  return true;
}

//------------------------------------------------------------------------------
void StackScene::SetSolverInterfaces()
{
  std::vector<Interface> list;
  for (std::size_t i = 0; i < this->Media.size(); ++i)
  {
    SourceSurface& source = this->Entries[i].Source;
    source.GetSurface()->Prepare(SurfaceParts::Crossings, FacetLoop);
    list.push_back({ source.GetSurface(), this->Media[i] });
  }
  this->IsEyeReady = false;
  this->AreEyesExamined = false;
  this->AreEyesBehind = false;
  this->Solver.SetInterfaces(list);
}

//------------------------------------------------------------------------------
/**
 * True if an open surface shows the eye its other side only, when rays pass the list from the
 * exterior of the first interface. False for an eye that is not finite.
 */
bool StackScene::IsOnWrongSide(std::size_t index, const glm::dvec3& eye) const
{
  const Membrane& surface = this->Entries[index].Source.GetMembrane();
  const glm::dvec3 local = eye - surface.GetOrigin();
  const MediaChain chain(this->Media);
  return this->Media[index].IsRefracting() && !chain.Ways.empty() && !surface.IsClosed() &&
    std::isfinite(local.x + local.y + local.z) &&
    !surface.ShowsSide(local, chain.Ways.front()[index].FromFront ? 1.0 : -1.0);
}

//------------------------------------------------------------------------------
/** Turns surfaces round whose interfaces say so, or back. */
void StackScene::TurnSurfaces(const glm::dvec3& eye)
{
  bool isNew = false;
  for (std::size_t i = 0; i < this->Entries.size(); ++i)
  {
    Entry& entry = this->Entries[i];
    const bool isTurned = entry.Turns && entry.Source.IsTurned() != this->IsOnWrongSide(i, eye);
    if (isTurned != entry.Source.IsTurned())
    {
      entry.Source.Turn();
      ++this->PatchBuilds;
      isNew = true;
    }
  }
  if (isNew)
  {
    this->SetSolverInterfaces();
  }
}

//------------------------------------------------------------------------------
/** Text of the warning about interfaces that the eye is behind or sees from their wrong side. */
std::string StackScene::DescribeSides()
{
  const RefractionStack& stack = this->Solver.GetStack();
  const bool isBlocked = stack.GetNumberOfInterfaces() > 0 && !stack.HasPassage();
  const std::size_t behind = stack.GetNumberOfInterfaces() - stack.GetLinks().size();
  const bool isBehind = behind > this->InterfacesBehindEye;
  this->InterfacesBehindEye = behind;
  std::ostringstream text;
  if (isBlocked)
  {
    text << "No ray from the eye passes the surfaces in the order of the list. Do they cross, does "
            "one of them lie behind the eye or out of the others' way, or is the list in another "
            "order? ";
  }
  if (isBehind)
  {
    const std::size_t last = stack.GetLinks().front().Index - 1;
    text << "The eye is behind interface " << (last > 0 ? "0 to " : "") << last
         << ", and nothing is refracted there. If the eye is in front, surfaces are in the wrong "
            "order, normals point to the wrong side, or indices of refraction are exchanged. ";
  }
  const glm::dvec3 eye(this->Eye[0], this->Eye[1], this->Eye[2]);
  for (std::size_t i = 0; (isBlocked || isBehind) && i < this->Entries.size(); ++i)
  {
    if (this->IsOnWrongSide(i, eye))
    {
      text
        << "Interface " << i
        << " shows the eye the side of the medium behind it: unless the eye is there, reverse its "
           "normals, exchange its indices, or use TurnTowardsEye of the vtkRefractingInterface. ";
    }
  }
  return text.str();
}

//------------------------------------------------------------------------------
// Reads one surface again if its values have changed. An earlier entry with the same values shares
// its surface.
bool StackScene::UpdateEntry(std::size_t index, vtkPolyData* source, vtkImplicitFunction* function,
  bool& isNew, SceneMessages& messages)
{
  SourceSurface& own = this->Entries[index].Source;
  const MembraneOrigin origin(source, function, true);
  const auto isCurrent = [&origin, isTurned = own.IsTurned()](const Entry& entry)
  {
    return entry.Source.IsReady() && entry.Source.GetOrigin() == origin &&
      entry.Source.IsTurned() == isTurned;
  };
  const auto end = this->Entries.begin() + static_cast<std::ptrdiff_t>(index);
  const auto earlier = std::find_if(this->Entries.begin(), end, isCurrent);
  if (earlier != end && !isCurrent(this->Entries[index]))
  {
    isNew = isNew || own.GetSurface() != earlier->Source.GetSurface();
    own = earlier->Source;
    return true;
  }
  if (!own.Update(source, function, true))
  {
    return true;
  }
  isNew = true;
  ++this->PatchBuilds;
  SceneMessages read;
  const bool isReady = own.Report(read);
  if (!isReady)
  {
    this->Media.clear(); // so that the next list is new
  }
  const std::string place = "Interface " + std::to_string(index) + ": ";
  messages.Error += read.Error.empty() ? "" : place + read.Error;
  messages.Warning += read.Warning.empty() ? "" : place + read.Warning;
  return isReady;
}

//------------------------------------------------------------------------------
bool StackScene::SetEye(const std::array<double, 3>& eye, SceneMessages& messages)
{
  if (this->IsEyeReady && eye == this->Eye)
  {
    return true;
  }
  const glm::dvec3 position(eye[0], eye[1], eye[2]);
  this->TurnSurfaces(position);
  const EyeStatus status = this->UsedFor == Use::Rays ? this->Solver.PlaceEye(position)
                                                      : this->Solver.SetEye(position, FacetLoop);
  this->AreEyesExamined = false;
  this->Eye = eye;
  this->IsEyeReady = status == EyeStatus::Ready;
  if (!this->IsEyeReady)
  {
    messages.Error = DescribeBadEye(status, position);
    return false;
  }
  ++this->EyeUpdates;
  this->Rays = MembraneVersion::MakeNumber();
  messages.Warning += this->DescribeSides();
  return true;
}

//------------------------------------------------------------------------------
void StackScene::ReportEyes(const std::vector<glm::dvec3>& eyes, SceneMessages& messages)
{
  const auto first = std::find_if(this->Media.begin(), this->Media.end(),
    [](const InterfaceMedia& media) { return media.IsRefracting(); });
  if (this->AreEyesExamined || eyes.empty() || first == this->Media.end())
  {
    return;
  }
  const auto index = static_cast<std::size_t>(first - this->Media.begin());
  const bool areBehind = std::all_of(eyes.begin(), eyes.end(),
    [this, index](const glm::dvec3& eye) { return this->IsOnWrongSide(index, eye); });
  if (areBehind && !this->AreEyesBehind)
  {
    messages.Warning +=
      "No facet of the first membrane faces an eye: its normals point to the other side. Unless "
      "the eyes are really behind it, reverse the normals and the order of the corners. ";
  }
  this->AreEyesExamined = true;
  this->AreEyesBehind = areBehind;
}

//------------------------------------------------------------------------------
const Membrane& StackScene::GetFirstMembrane() const
{
  const std::vector<RefractionStack::Link>& links = this->Solver.GetStack().GetLinks();
  return links.empty() ? this->Entries.front().Source.GetMembrane()
                       : links.front().Surface->GetMembrane();
}

}
