// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Several interfaces: scenes and samples of the error volume.
#include "Filters/vtkRefractionErrorVolumeInternals.h"

#include "Filters/Membrane/ImplicitSurface.h"
#include "Filters/Membrane/StackInput.h"
#include "Refraction/Stack/StackInverse.h"

#include "vtkImageData.h"
#include "vtkInformationVector.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace
{

using Links = std::vector<meniscus::RefractionStack::Link>;

//------------------------------------------------------------------------------
/** Exact surfaces of a stack's links: a function where there is one, otherwise finer patches. */
class ExactSurfaces : public meniscus::StackSurfaces
{
public:
  ExactSurfaces(vtkRefractingInterfaceCollection* interfaces,
    const meniscus::RefractionStack& stack, const meniscus::RefractionStack& finer)
    : Finer(finer)
  {
    for (const meniscus::RefractionStack::Link& link : stack.GetLinks())
    {
      this->Functions.emplace_back();
      vtkRefractingInterface* interface = interfaces->GetInterface(static_cast<int>(link.Index));
      if (interface->GetExactSurface())
      {
        this->Functions.back() = std::make_unique<meniscus::ImplicitSurface>(
          interface->GetExactSurface(), link.Surface->GetMembrane(), glm::dvec3(0.0));
        if (!link.Passage.FromFront)
        {
          this->Functions.back()->Turn();
        }
      }
    }
  }

  bool Meet(std::size_t link, const glm::dvec3& origin, const glm::dvec3& direction,
    const glm::dvec3& near, meniscus::PatchPoint& at) const override
  {
    return this->Functions[link] ? this->Functions[link]->MeetNear(origin, direction, near, at)
                                 : this->Finer.Meet(link, origin, direction, near, at);
  }

private:
  std::vector<std::unique_ptr<meniscus::ImplicitSurface>> Functions;
  meniscus::StackPatches Finer;
};

//------------------------------------------------------------------------------
bool HasAllFunctions(vtkRefractingInterfaceCollection* interfaces)
{
  for (int i = 0; i < interfaces->GetNumberOfItems(); ++i)
  {
    if (!interfaces->GetInterface(i)->GetExactSurface())
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** True if two stacks pass the same interfaces of a list in the same way. */
bool PassAlike(const Links& a, const Links& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const auto& one, const auto& other)
    { return one.Index == other.Index && one.Passage.FromFront == other.Passage.FromFront; });
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool vtkRefractionErrorVolume::UpdateStacks(
  vtkInformationVector* membranes, vtkInformationVector* references)
{
  vtkInternals& internals = *this->Internals;
  const std::array<double, 3> eye = { this->EyePosition[0], this->EyePosition[1],
    this->EyePosition[2] };
  meniscus::SceneMessages messages;
  messages.Error = meniscus::FindModelFault(this->MembraneModel == CURVED);
  bool ready =
    meniscus::UpdateStack(internals.Stack, membranes, 0, this->Interfaces, eye, messages);
  const bool hasFunctions = HasAllFunctions(this->Interfaces);
  internals.HasStackReference = !hasFunctions && references->GetNumberOfInformationObjects() > 0;
  if (ready && internals.HasStackReference)
  {
    ready = meniscus::UpdateStack(
      internals.StackReference, references, 1, this->Interfaces, eye, messages);
    if (ready &&
      !PassAlike(internals.Stack.GetSolver().GetStack().GetLinks(),
        internals.StackReference.GetSolver().GetStack().GetLinks()))
    {
      messages.Error = "The eye lies between a membrane and the finer one";
      ready = false;
    }
  }
  meniscus::Report(this, messages);
  if (ready && !hasFunctions && !internals.HasStackReference && !internals.WarnedOfNoReference)
  {
    internals.WarnedOfNoReference = true;
    vtkWarningMacro("Interfaces without an exact surface are compared with themselves: set exact "
                    "surfaces, or finer membranes on port 1, to measure the error of the meshes.");
  }
  return ready;
}

//------------------------------------------------------------------------------
// Returns false after an abort.
bool vtkRefractionErrorVolume::MeasureStack(vtkImageData* output)
{
  vtkInternals& internals = *this->Internals;
  const meniscus::StackSolver& solver = internals.Stack.GetSolver();
  const meniscus::StackSolver& finer =
    internals.HasStackReference ? internals.StackReference.GetSolver() : solver;
  const ExactSurfaces exact(this->Interfaces, solver.GetStack(), finer.GetStack());
  const meniscus::StackErrorSampler sampler(solver, exact, this->AngularErrors);
  return this->RunOverSamples(output->GetNumberOfPoints(),
    [&internals, &sampler, output](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        glm::dvec3 point;
        output->GetPoint(i, &point.x);
        internals.Samples[static_cast<std::size_t>(i)] = sampler.Measure(point);
      }
    });
}
