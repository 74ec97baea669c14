// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastRepresentation.h"

#include "MembraneGathering.h"

#include "vtkColorTransferFunction.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkExtractBlockUsingDataAssembly.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMergeBlocks.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolumeProperty.h"
#include "vtkVolumeRepresentationPreprocessor.h"

vtkStandardNewMacro(vtkTetrahedraRayCastRepresentation);

namespace
{
constexpr int MembranePort = 1;

/** Bias for the fractions that IceT truncates when it composites the images of the ranks. */
double ChooseColorBias()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const double pictures = controller ? controller->GetNumberOfProcesses() : 1;
  return 0.5 * (pictures - 1) / pictures;
}
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastRepresentation::vtkTetrahedraRayCastRepresentation()
  : Membrane(vtkSmartPointer<vtkPolyData>::New())
{
  this->SetNumberOfInputPorts(2);
  this->AddVolumeMapper("Tetrahedra ray cast", this->Mapper);
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastRepresentation::~vtkTetrahedraRayCastRepresentation() = default;

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastRepresentation::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port != MembranePort)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  meniscus::AcceptComposite(info);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inputs, vtkInformation* outputs)
{
  if (!this->Superclass::ProcessViewRequest(request, inputs, outputs))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    vtkPVRenderView::SetRedistributionModeToSplitBoundaryCells(inputs, this);
    // Every rank has the whole membrane: a client gets that of one of them.
    vtkPVView::SetPiece(inputs, this, this->Membrane, 0, MembranePort);
    vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(
      inputs, this, true, false, MembranePort);
    if (this->Membrane->GetNumberOfPoints() > 0)
    {
      double bounds[6];
      this->Membrane->GetBounds(bounds);
      vtkPVRenderView::SetGeometryBounds(inputs, this, bounds, nullptr, MembranePort);
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    this->LetViewPeelVolumes(false);
    this->Mapper->SetColorBias(ChooseColorBias());
    auto* membrane =
      vtkPolyData::SafeDownCast(vtkPVView::GetDeliveredPiece(inputs, this, MembranePort));
    membrane = membrane && membrane->GetNumberOfCells() > 0 ? membrane : nullptr;
    if (this->Mapper->GetMembrane() != membrane)
    {
      this->Mapper->SetMembraneData(membrane);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetVisibility(bool visible)
{
  if (!visible)
  {
    this->LetViewPeelVolumes(true);
  }
  this->Superclass::SetVisibility(visible);
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastRepresentation::RemoveFromView(vtkView* view)
{
  this->LetViewPeelVolumes(true);
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::LetViewPeelVolumes(bool peel)
{
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  vtkRenderer* renderer = view ? view->GetRenderer() : nullptr;
  // Peeling that was off before stays off.
  const bool changes =
    renderer && (peel ? this->HasStoppedPeeling : renderer->GetUseDepthPeelingForVolumes());
  if (changes)
  {
    renderer->SetUseDepthPeelingForVolumes(peel);
    this->HasStoppedPeeling = !peel;
  }
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Without the superclass's own step, which divides the cells.
  const int succeeded = this->TakeWholeCells(inputs[0])
    ? this->vtkVolumeRepresentation::RequestData(request, inputs, outputs)
    : this->Superclass::RequestData(request, inputs, outputs);
  this->LeaveOutWithoutArray();
  return this->UpdateMembrane(inputs[MembranePort]) ? succeeded : 0;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastRepresentation::TakeWholeCells(vtkInformationVector* input)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool isAlone = !controller || controller->GetNumberOfProcesses() == 1;
  if (!isAlone || this->GetActiveVolumeMapper() != this->Mapper ||
    input->GetNumberOfInformationObjects() != 1)
  {
    return false;
  }
  vtkSmartPointer<vtkDataObject> cells = vtkDataObject::GetData(input);
  if (vtkCompositeDataSet::SafeDownCast(cells))
  {
    this->Blocks->SetInputData(cells);
    this->Blocks->Update();
    vtkNew<vtkMergeBlocks> merge;
    merge->SetInputData(this->Blocks->GetOutputDataObject(0));
    merge->MergePointsOff();
    merge->Update();
    this->Blocks->SetInputData(nullptr);
    cells = merge->GetOutputDataObject(0);
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(cells);
  // The superclass delivers what is the output of this filter, which is not executed here.
  this->Preprocessor->SetInputConnection(this->GetInternalOutputPort());
  auto* output = vtkUnstructuredGrid::SafeDownCast(this->Preprocessor->GetOutputDataObject(0));
  if (!grid || !output)
  {
    return false;
  }
  output->ShallowCopy(grid);
  output->GetBounds(this->DataBounds);
  if (this->UseSeparateOpacityArray)
  {
    this->AppendOpacityComponent(output);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetActiveAssembly(const char* name)
{
  this->Blocks->SetAssemblyName(name);
  this->Superclass::SetActiveAssembly(name);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::AddBlockSelector(const char* selector)
{
  this->Blocks->AddSelector(selector);
  this->Superclass::AddBlockSelector(selector);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::RemoveAllBlockSelectors()
{
  this->Blocks->ClearSelectors();
  this->Superclass::RemoveAllBlockSelectors();
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastRepresentation::UpdateMembrane(vtkInformationVector* input)
{
  this->Membrane = vtkSmartPointer<vtkPolyData>::New();
  if (input->GetNumberOfInformationObjects() == 0)
  {
    return true;
  }
  auto membrane = meniscus::GatherMembrane(vtkDataObject::GetData(input));
  if (!membrane)
  {
    vtkErrorMacro("The ranks could not exchange their parts of the membrane; rays are straight.");
    return false;
  }
  if (membrane->GetNumberOfCells() == 0)
  {
    vtkWarningMacro("The membrane has no cells; rays are straight.");
  }
  this->Membrane->ShallowCopy(membrane);
  this->WarnOfOrder(vtkDataObject::GetData(input));
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::WarnOfOrder(vtkDataObject* source)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool tells =
    controller && controller->GetNumberOfProcesses() > 1 && controller->GetLocalProcessId() == 0;
  if (!tells || !source || source->GetMTime() == this->MembraneTime)
  {
    return;
  }
  this->MembraneTime = source->GetMTime();
  if (this->Membrane->GetNumberOfCells() > 0 && !meniscus::IsPlaneAcrossAxis(this->Membrane))
  {
    vtkWarningMacro("The membrane is not a plane across an axis: the pictures of several ranks are "
                    "composited in the order of straight rays, which may not be that of bent ones, "
                    "so that some pixels may be wrong; load the data on one rank to be sure.");
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::LeaveOutWithoutArray()
{
  vtkDataSet* grid = vtkDataSet::SafeDownCast(this->Preprocessor->GetOutputDataObject(0));
  vtkInformation* info = this->GetInputArrayInformation(0);
  if (!grid || !info || !info->Has(vtkDataObject::FIELD_NAME()))
  {
    return;
  }
  std::string name = info->Get(vtkDataObject::FIELD_NAME());
  if (name.empty())
  {
    return;
  }
  name += this->UseSeparateOpacityArray ? "_and_opacity" : "";
  const int place = info->Get(vtkDataObject::FIELD_ASSOCIATION());
  vtkDataSetAttributes* arrays = grid->GetAttributes(place);
  vtkDataArray* array = arrays ? arrays->GetArray(name.c_str()) : nullptr;

  // Type and number of components, which a rank without the array has to receive.
  int shape[2] = { array ? array->GetDataType() : 0, array ? array->GetNumberOfComponents() : 0 };
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const int ranks = controller ? controller->GetNumberOfProcesses() : 1;
  if (ranks > 1)
  {
    const int local[2] = { shape[0], shape[1] };
    controller->AllReduce(local, shape, 2, vtkCommunicator::MAX_OP);
  }
  if (array || !arrays)
  {
    return;
  }
  if (grid->GetNumberOfCells() > 0)
  {
    vtkWarningMacro("There is no array '"
      << name << "' on rank " << (ranks > 1 ? controller->GetLocalProcessId() : 0) << "; its "
      << grid->GetNumberOfCells() << " cells are left out.");
  }
  grid->Initialize();
  if (shape[0] != 0)
  {
    auto empty = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(shape[0]));
    empty->SetName(name.c_str());
    empty->SetNumberOfComponents(shape[1]);
    arrays->AddArray(empty);
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::UpdateMapperParameters()
{
  this->Superclass::UpdateMapperParameters();
  const bool mixes =
    !this->MapScalars || this->MultiComponentsMapping || this->UseSeparateOpacityArray;
  vtkColorTransferFunction* colors = this->Property->GetRGBTransferFunction();
  this->Property->SetIndependentComponents(!mixes);
  if (mixes || !colors)
  {
    this->Mapper->SetVectorMode(vtkTetrahedraRayCastMapper::DISABLED);
    return;
  }
  const bool component = colors->GetVectorMode() == vtkScalarsToColors::COMPONENT;
  this->Mapper->SetVectorComponent(component ? colors->GetVectorComponent() : 0);
  this->Mapper->SetVectorMode(
    component ? vtkTetrahedraRayCastMapper::COMPONENT : vtkTetrahedraRayCastMapper::MAGNITUDE);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetBackend(int backend)
{
  this->Mapper->SetBackend(backend);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetBlendMode(int mode)
{
  this->Mapper->SetBlendMode(mode);
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool composites = vtkTetrahedraRayCastMapper::CanRanksComposite(mode);
  if (!composites && controller && controller->GetNumberOfProcesses() > 1 &&
    controller->GetLocalProcessId() == 0)
  {
    vtkWarningMacro("Pictures of several ranks are composited one over the other, which is right "
                    "for the blend modes Composite and Isosurface only; load the data on one rank "
                    "for the others.");
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetIntegration(int integration)
{
  this->Mapper->SetIntegration(integration);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetPreIntegrationScalarSize(int size)
{
  this->Mapper->SetPreIntegrationScalarSize(size);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetPreIntegrationLengthSize(int size)
{
  this->Mapper->SetPreIntegrationLengthSize(size);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetOpacityModel(int model)
{
  this->Mapper->SetOpacityModel(model);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetGradients(int location)
{
  this->Mapper->SetGradients(location);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetEarlyTerminationOpacity(double opacity)
{
  this->Mapper->SetEarlyTerminationOpacity(opacity);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetAutoAdjustSampleDistances(bool adjust)
{
  this->Mapper->SetAutoAdjustSampleDistances(adjust);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetImageSampleDistance(double distance)
{
  this->Mapper->SetImageSampleDistance(static_cast<float>(distance));
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetMaximumImageSampleDistance(double distance)
{
  this->Mapper->SetMaximumImageSampleDistance(static_cast<float>(distance));
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetCompactTables(bool compact)
{
  this->Mapper->SetCompactTables(compact);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetExteriorIndexOfRefraction(double index)
{
  this->Mapper->SetExteriorIndexOfRefraction(index);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetInteriorIndexOfRefraction(double index)
{
  this->Mapper->SetInteriorIndexOfRefraction(index);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetShade(bool shade)
{
  this->Property->SetShade(shade);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetAmbient(double ambient)
{
  this->Property->SetAmbient(ambient);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetDiffuse(double diffuse)
{
  this->Property->SetDiffuse(diffuse);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetSpecular(double specular)
{
  this->Property->SetSpecular(specular);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetSpecularPower(double power)
{
  this->Property->SetSpecularPower(power);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetNumberOfIsosurfaces(int number)
{
  this->Property->GetIsoSurfaceValues()->SetNumberOfContours(number);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetIsosurfaceValue(int number, double value)
{
  this->Property->GetIsoSurfaceValues()->SetValue(number, value);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mapper:\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}
