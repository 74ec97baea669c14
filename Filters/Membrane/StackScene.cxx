// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/StackScene.h"

#include "Filters/Common/ThreadedLoop.h"

#include "vtkImplicitFunction.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
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
  std::vector<InterfaceMedia> media;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    vtkRefractingInterface* interface = interfaces->GetInterface(static_cast<int>(i));
    media.push_back(
      { interface->GetExteriorIndexOfRefraction(), interface->GetInteriorIndexOfRefraction() });
    vtkImplicitFunction* function =
      this->UsedFitting == Fitting::Exact ? interface->GetExactSurface() : nullptr;
    if (!this->UpdateEntry(i, surfaces[i], function, isNew, messages))
    {
      return false;
    }
  }
  const auto same = [](const InterfaceMedia& a, const InterfaceMedia& b)
  { return a.Exterior == b.Exterior && a.Interior == b.Interior; };
  if (!isNew && media.size() == this->Media.size() &&
    std::equal(media.begin(), media.end(), this->Media.begin(), same))
  {
    return true;
  }
  std::vector<StackInterface> list;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    list.push_back({ this->Entries[i].Surface, media[i] });
  }
  this->Media = std::move(media);
  this->IsEyeReady = false;
  this->Solver.SetInterfaces(list);
  return true;
}

//------------------------------------------------------------------------------
// Reads one surface again if its values have changed. An earlier entry with the same values shares
// its surface.
bool StackScene::UpdateEntry(std::size_t index, vtkPolyData* source, vtkImplicitFunction* function,
  bool& isNew, SceneMessages& messages)
{
  Entry& entry = this->Entries[index];
  const vtkMTimeType sourceTime = GetMembraneTime(source);
  const vtkMTimeType functionTime = function ? function->GetMTime() : 0;
  const auto isCurrent = [=](const Entry& known)
  {
    return known.Surface && known.Source == source && known.SourceTime == sourceTime &&
      known.Function == function && known.FunctionTime == functionTime;
  };
  if (isCurrent(entry))
  {
    return true;
  }
  const auto end = this->Entries.begin() + static_cast<std::ptrdiff_t>(index);
  const auto earlier = std::find_if(this->Entries.begin(), end, isCurrent);
  if (earlier != end)
  {
    isNew = isNew || entry.Surface != earlier->Surface;
    entry = *earlier;
    return true;
  }
  MembraneArrays arrays = ExtractMembrane(source);
  const std::size_t lost = function ? FitToFunction(function, arrays) : 0;
  entry.Source = source;
  entry.SourceTime = sourceTime;
  entry.Function = function;
  entry.FunctionTime = functionTime;
  if (entry.Surface && arrays == entry.Arrays)
  {
    return true;
  }
  isNew = true;
  entry.Arrays = std::move(arrays);
  auto surface = std::make_shared<StackSurface>();
  const MembraneStatus status = surface->SetMembrane(entry.Arrays.AsInput(), FacetLoop);
  ++this->PatchBuilds;
  SceneMessages own;
  const bool isReady =
    ReportMembrane(status, surface->GetMembrane().GetReport(), entry.Arrays, lost, own);
  entry.Surface = isReady ? surface : nullptr;
  if (!isReady)
  {
    this->Media.clear(); // so that the next list is new
  }
  std::ostringstream place;
  place << "Interface " << index << ": ";
  messages.Error += own.Error.empty() ? "" : place.str() + own.Error;
  messages.Warning += own.Warning.empty() ? "" : place.str() + own.Warning;
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
  const EyeStatus status = this->Solver.SetEye(position, FacetLoop);
  this->Eye = eye;
  this->IsEyeReady = status == EyeStatus::Ready;
  if (!this->IsEyeReady)
  {
    messages.Error = DescribeBadEye(status, position);
    return false;
  }
  ++this->EyeUpdates;
  const RefractionStack& stack = this->Solver.GetStack();
  if (stack.GetNumberOfInterfaces() > 0 && !stack.HasPassage())
  {
    messages.Warning =
      "No ray from the eye passes the surfaces in the order of the list. Do they "
      "cross, does one of them lie behind the eye or out of the others' way, or is the list "
      "in another order?";
  }
  return true;
}

//------------------------------------------------------------------------------
const Membrane& StackScene::GetFirstMembrane() const
{
  const std::vector<RefractionStack::Link>& links = this->Solver.GetStack().GetLinks();
  return (links.empty() ? this->Entries.front().Surface : links.front().Surface)->GetMembrane();
}

}
