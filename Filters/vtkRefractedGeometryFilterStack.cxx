// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Several interfaces: what RequestData does for one.
#include "Filters/vtkRefractedGeometryFilterInternals.h"

#include "Filters/Membrane/StackInput.h"
#include "Filters/Output/VirtualPolyData.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <vector>

//------------------------------------------------------------------------------
// Text of the error for properties that several interfaces do not support; empty if none.
std::string vtkRefractedGeometryFilter::FindUnsupported()
{
  const std::string model = meniscus::FindModelFault(this->MembraneModel == CURVED);
  if (!model.empty())
  {
    return model;
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
  return std::string();
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::UpdateStack(vtkInformationVector* membranes)
{
  double eye[3];
  this->GetEye(eye);
  meniscus::SceneMessages messages;
  messages.Error = this->FindUnsupported();
  const bool isReady = meniscus::UpdateStack(
    this->Internals->Stack, membranes, 1, this->Interfaces, { eye[0], eye[1], eye[2] }, messages);
  meniscus::Report(this, messages);
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

//------------------------------------------------------------------------------
double vtkRefractedGeometryFilter::GetRelativeIndexOfRefraction()
{
  const auto& links = this->Internals->Stack.GetSolver().GetStack().GetLinks();
  if (this->Interfaces->GetNumberOfItems() > 1 && !links.empty())
  {
    return links.front().Passage.Behind / links.front().Passage.Before;
  }
  return this->GetInteriorIndexOfRefraction() / this->GetExteriorIndexOfRefraction();
}
