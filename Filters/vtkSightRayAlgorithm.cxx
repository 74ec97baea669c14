// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSightRayAlgorithm.h"

#include "Filters/Common/Accessors.h"
#include "Filters/Common/ProgressSteps.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Filters/Interface/InterfaceProperties.h"
#include "Filters/Membrane/PointEyes.h"
#include "Filters/Membrane/RefractionScene.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace
{

// Points between two reports of progress, at least, and number of reports.
constexpr vtkIdType SmallestPointStep = 16384;
constexpr vtkIdType PointProgressSteps = 20;

}

//------------------------------------------------------------------------------
class vtkSightRayAlgorithm::vtkInternals
{
public:
  meniscus::RefractionScene Scene{ meniscus::RefractionScene::Fitting::Exact,
    meniscus::RefractionScene::Use::Rays };
};

meniscusInterfacePropertiesMacro(vtkSightRayAlgorithm);
meniscusInterfaceTimeMacro(vtkSightRayAlgorithm);
meniscusMembranePortMacro(vtkSightRayAlgorithm, 1);
meniscusGetInternalMacro(
  vtkSightRayAlgorithm, vtkTypeInt64, NumberOfPatchBuilds() const, Scene.GetNumberOfPatchBuilds());

//------------------------------------------------------------------------------
vtkSightRayAlgorithm::vtkSightRayAlgorithm()
  : Interfaces(meniscus::MakeInterfaces())
  , Internals(std::make_unique<vtkInternals>())
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkSightRayAlgorithm::~vtkSightRayAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkSightRayAlgorithm::SetEyeArrayName(const std::string& name)
{
  if (this->EyeArrayName != name)
  {
    this->EyeArrayName = name;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
std::string vtkSightRayAlgorithm::GetEyeArrayName()
{
  return this->EyeArrayName;
}

//------------------------------------------------------------------------------
void vtkSightRayAlgorithm::SetMembraneData(vtkPolyData* membrane)
{
  this->SetInputDataInternal(1, membrane);
}

//------------------------------------------------------------------------------
int vtkSightRayAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return port == 1 ? meniscus::AcceptSurfaces(info) : 1;
}

//------------------------------------------------------------------------------
int vtkSightRayAlgorithm::FillOutputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
// The executive makes an output of the type of FillOutputPortInformation().
int vtkSightRayAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

//------------------------------------------------------------------------------
// Every piece of the points needs the whole surfaces.
int vtkSightRayAlgorithm::ComputeInputUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int result = this->Superclass::ComputeInputUpdateExtent(request, inputs, outputs);
  meniscus::RequestWhole(inputs[1]);
  return result;
}

//------------------------------------------------------------------------------
bool vtkSightRayAlgorithm::UpdateScene(
  vtkPointSet* points, vtkInformationVector* membranes, meniscus::PointEyes& eyes)
{
  meniscus::SceneMessages messages;
  bool ready = false;
  if (points)
  {
    eyes = meniscus::PointEyes(this->EyePosition);
    messages.Error = eyes.UseArray(points, this->EyeArrayName);
    ready = messages.Error.empty() &&
      this->Internals->Scene.SetSurfaces({ membranes, 1, this->Interfaces }, messages);
    const double* place = this->EyePosition;
    if (ready && !eyes.IsPerPoint())
    {
      ready = this->Internals->Scene.SetEye({ place[0], place[1], place[2] }, messages);
    }
    if (ready)
    {
      this->Internals->Scene.ReportEyes(eyes.GetSample(points->GetNumberOfPoints()), messages);
    }
  }
  else
  {
    messages.Error = "The points are missing";
  }
  meniscus::Report(this, messages);
  return ready;
}

//------------------------------------------------------------------------------
bool vtkSightRayAlgorithm::RunInSteps(
  vtkIdType count, const std::function<void(vtkIdType, vtkIdType)>& body)
{
  return meniscus::RunInSteps(this, count, PointProgressSteps, SmallestPointStep, body);
}

//------------------------------------------------------------------------------
const meniscus::RefractionStack& vtkSightRayAlgorithm::GetStack() const
{
  return this->Internals->Scene.GetStack();
}

//------------------------------------------------------------------------------
const meniscus::RefractionScene& vtkSightRayAlgorithm::GetScene() const
{
  return this->Internals->Scene;
}

//------------------------------------------------------------------------------
void vtkSightRayAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EyePosition: (" << this->EyePosition[0] << ", " << this->EyePosition[1] << ", "
     << this->EyePosition[2] << ")\n";
  os << indent << "EyeArrayName: " << this->EyeArrayName << "\n";
  os << indent << "ExteriorIndexOfRefraction: " << this->GetExteriorIndexOfRefraction() << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->GetInteriorIndexOfRefraction() << "\n";
}
