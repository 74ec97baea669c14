// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Several interfaces: what RequestData does for one.
#include "Filters/vtkRefractedGeometryFilterInternals.h"

#include "Filters/Interface/StackValidation.h"
#include "Filters/Output/VirtualPolyData.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <vector>

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::HasStack(vtkInformationVector* membranes)
{
  return this->Interfaces->GetNumberOfItems() > 1 || membranes->GetNumberOfInformationObjects() > 1;
}

//------------------------------------------------------------------------------
// Text of the error for properties that several interfaces do not support; null if there are none.
const char* vtkRefractedGeometryFilter::FindUnsupported()
{
  if (this->Mode == REFLECTION)
  {
    return "Mode REFLECTION mirrors at one interface, and the list has more";
  }
  if (this->MembraneModel == FLAT_FACETS)
  {
    return "Several refracting interfaces need the membrane model CURVED";
  }
  if (this->Images == ALL_IMAGES)
  {
    return "With several refracting interfaces, Images ALL_IMAGES is not available; choose "
           "FIRST_IMAGE";
  }
  const bool isLightAtEye =
    std::all_of(this->LightDirection, this->LightDirection + 3, [](double c) { return c == 0.0; });
  if (this->VirtualNormals && !isLightAtEye)
  {
    return "With several refracting interfaces, VirtualNormals need a light at the eye, "
           "LightDirection (0, 0, 0)";
  }
  return nullptr;
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::UpdateStack(vtkInformationVector* membranes)
{
  meniscus::SceneMessages messages;
  messages.Error =
    meniscus::FindStackFault(this->Interfaces, membranes->GetNumberOfInformationObjects());
  if (const char* unsupported = this->FindUnsupported(); unsupported && messages.Error.empty())
  {
    messages.Error = unsupported;
  }
  std::vector<vtkPolyData*> surfaces;
  for (int i = 0; i < membranes->GetNumberOfInformationObjects() && messages.Error.empty(); ++i)
  {
    surfaces.push_back(vtkPolyData::GetData(membranes, i));
    if (!surfaces.back())
    {
      messages.Error = "A surface at the membrane port is missing or is not a vtkPolyData";
    }
  }
  double eye[3];
  this->GetEye(eye);
  meniscus::StackScene& scene = this->Internals->Stack;
  const bool isReady = messages.Error.empty() &&
    scene.SetInterfaces(surfaces, this->Interfaces, messages) &&
    scene.SetEye({ eye[0], eye[1], eye[2] }, messages);
  if (!messages.Error.empty())
  {
    vtkErrorMacro(<< messages.Error << "; the output is empty.");
  }
  if (!messages.Warning.empty())
  {
    vtkWarningMacro(<< messages.Warning);
  }
  return isReady;
}

//------------------------------------------------------------------------------
int vtkRefractedGeometryFilter::RequestStack(
  vtkPolyData* input, vtkInformationVector* membranes, vtkPolyData* output)
{
  vtkInternals& internals = *this->Internals;
  if (!this->UpdateStack(membranes))
  {
    return 1;
  }
  internals.FailedInRun = 0;
  const meniscus::StackScene& scene = internals.Stack;
  const vtkTypeInt64 undecided = this->GetNumberOfUndecidedSearches();
  meniscus::SolvedBlock& block = internals.GetBlock(input);
  if (!internals.SolveStack(this, block))
  {
    return 1;
  }
  const meniscus::OutputOptions options = internals.GetStackOptions(this);
  meniscus::OutputOptions plain = options;
  plain.VirtualNormals = false;
  const meniscus::VirtualPolyDataReport report = meniscus::BuildVirtualPolyData(
    input, block.Vertices, block.Selection, scene.GetFirstMembrane(), plain, output);
  meniscus::AddStackArrays(input, block.Vertices, block.Stack, options, output);
  this->ReportUndecided(this->GetNumberOfUndecidedSearches() - undecided);
  this->ReportPoints(internals.FailedInRun, output->GetNumberOfPoints() > 0, input);
  this->ReportCells(report, input);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::vtkInternals::SolveStack(
  vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block)
{
  const vtkTypeInt64 update = this->Stack.GetNumberOfEyeUpdates();
  if (block.StackUpdate == update)
  {
    return true;
  }
  const meniscus::StackSolver& solver = this->Stack.GetSolver();
  const std::size_t count = block.Points.size() / 3;
  block.ForgetImages();
  block.Vertices.assign(count, meniscus::VirtualVertex());
  block.Stack.Points.assign(count, meniscus::StackDetail());
  block.Stack.Interfaces = solver.GetStack().GetNumberOfInterfaces();
  block.Stack.Legs.assign(count * block.Stack.Interfaces, 0.0);
  const bool done = this->Run(self, 0.0, 1.0, static_cast<vtkIdType>(count),
    static_cast<vtkIdType>(meniscus::StackSolver::Chain),
    [&block, &solver](std::size_t begin, std::size_t end)
    {
      solver.Solve(block.Points.data(), begin, end, block.Vertices.data(),
        block.Stack.Points.data(), block.Stack.Legs.data());
    });
  if (!done)
  {
    return false;
  }
  block.StackUpdate = update;
  for (const meniscus::VirtualVertex& vertex : block.Vertices)
  {
    this->Count(vertex.State);
  }
  return true;
}

//------------------------------------------------------------------------------
meniscus::OutputOptions vtkRefractedGeometryFilter::vtkInternals::GetStackOptions(
  vtkRefractedGeometryFilter* self) const
{
  meniscus::OutputOptions options = this->GetOptions(self);
  const meniscus::RefractionStack& stack = this->Stack.GetSolver().GetStack();
  options.Eye = stack.GetEye() + stack.GetOrigin();
  if (!stack.GetLinks().empty())
  {
    options.Exterior = stack.GetLinks().front().Passage.Before;
    options.Interior = stack.GetLinks().front().Passage.Behind;
  }
  return options;
}
