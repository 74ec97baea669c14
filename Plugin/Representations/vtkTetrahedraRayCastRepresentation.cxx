// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastRepresentation.h"

#include "MembraneGathering.h"

#include "vtkBoundingBox.h"
#include "vtkColorTransferFunction.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkExtractBlockUsingDataAssembly.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkMergeBlocks.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODVolume.h"
#include "vtkPVRenderView.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolumeRepresentationPreprocessor.h"

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkTetrahedraRayCastRepresentation);

namespace
{
/** First port of a membrane; its data object, on all ports, is delivered as that of this port. */
constexpr int MembranePort = 1;
constexpr int NumberOfPorts = 4;

/** A membrane of the table's row, or null if it is in an earlier row. */
vtkPolyData* GetBlock(vtkMultiBlockDataSet* membranes, int row)
{
  return vtkPolyData::SafeDownCast(membranes->GetBlock(static_cast<unsigned int>(row)));
}

/** No membrane: one block without cells. */
vtkSmartPointer<vtkMultiBlockDataSet> MakeNoMembranes()
{
  auto membranes = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  membranes->SetBlock(0, vtkNew<vtkPolyData>());
  return membranes;
}

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
  : Membranes(MakeNoMembranes())
{
  this->SetNumberOfInputPorts(NumberOfPorts);
  this->AddVolumeMapper("Tetrahedra ray cast", this->Mapper);
  this->Mapper->SetInterfaces(this->Table.GetInterfaces());
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastRepresentation::~vtkTetrahedraRayCastRepresentation() = default;

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastRepresentation::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port < MembranePort)
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
    double drawn[6];
    this->Measuring->GetBounds(drawn);
    if (vtkBoundingBox(drawn).IsValid())
    {
      vtkNew<vtkMatrix4x4> place;
      this->GetActor()->GetMatrix(place);
      vtkPVRenderView::SetGeometryBounds(inputs, this, drawn, place);
    }
    // Every rank has the whole membranes: a client gets those of one of them.
    vtkPVView::SetPiece(inputs, this, this->Membranes, 0, MembranePort);
    vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(
      inputs, this, true, false, MembranePort);
    double bounds[6];
    this->Membranes->GetBounds(bounds);
    if (vtkBoundingBox(bounds).IsValid())
    {
      vtkPVRenderView::SetGeometryBounds(inputs, this, bounds, nullptr, MembranePort);
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    this->LetViewPeelVolumes(false);
    this->Mapper->SetColorBias(ChooseColorBias());
    auto* delivered =
      vtkMultiBlockDataSet::SafeDownCast(vtkPVView::GetDeliveredPiece(inputs, this, MembranePort));
    if (delivered)
    {
      this->SetMapperMembranes(delivered);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
// Changes the mapper's inputs only if they are other ones.
void vtkTetrahedraRayCastRepresentation::SetMapperMembranes(vtkMultiBlockDataSet* delivered)
{
  std::vector<vtkPolyData*> surfaces;
  for (int row = 0; row < static_cast<int>(delivered->GetNumberOfBlocks()); ++row)
  {
    surfaces.push_back(GetBlock(delivered, this->Table.GetFirstRowOfSurface(row)));
  }
  if (surfaces.size() == 1 && (!surfaces[0] || surfaces[0]->GetNumberOfCells() == 0))
  {
    surfaces.clear(); // rays are straight
  }
  const auto count = static_cast<int>(surfaces.size());
  bool isSame = this->Mapper->GetNumberOfMembranes() == count;
  for (int i = 0; isSame && i < count; ++i)
  {
    isSame = this->Mapper->GetMembrane(i) == surfaces[static_cast<std::size_t>(i)];
  }
  if (!isSame)
  {
    this->Mapper->RemoveAllMembranes();
    std::for_each(surfaces.begin(), surfaces.end(),
      [this](vtkPolyData* surface) { this->Mapper->AddMembraneData(surface); });
  }
  // A table without surfaces has no effect: rays are straight.
  this->Mapper->SetInterfaces(
    surfaces.empty() ? this->Table.GetSingleList() : this->Table.GetInterfaces());
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
  this->Measuring->SetInputData(
    vtkUnstructuredGrid::SafeDownCast(this->Preprocessor->GetOutputDataObject(0)));
  return this->UpdateMembranes(inputs) ? succeeded : 0;
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
  // The superclass delivers the output of this filter, which is filled here and not executed.
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
bool vtkTetrahedraRayCastRepresentation::UpdateMembranes(vtkInformationVector** inputs)
{
  this->Membranes = MakeNoMembranes();
  vtkNew<vtkInformationVector> ports;
  vtkMTimeType time = 0;
  for (int port = MembranePort; port < NumberOfPorts; ++port)
  {
    if (inputs[port]->GetNumberOfInformationObjects() > 0)
    {
      ports->Append(inputs[port]->GetInformationObject(0));
      vtkDataObject* source = vtkDataObject::GetData(inputs[port]);
      time = std::max(time, source ? source->GetMTime() : 0);
    }
  }
  std::string fault;
  const auto gathered = this->Table.GatherSurfaces(ports, true, fault);
  if (!gathered)
  {
    vtkErrorMacro(<< fault << "; rays are straight.");
    return false;
  }
  for (int row = 0; row < gathered->GetNumberOfInformationObjects(); ++row)
  {
    vtkPolyData* surface = vtkPolyData::GetData(gathered, row);
    if (surface->GetNumberOfCells() == 0)
    {
      vtkWarningMacro("The membrane has no cells; rays are straight.");
    }
    // Copied, since the time of a new object tells that it has to be delivered.
    vtkNew<vtkPolyData> block;
    block->ShallowCopy(surface);
    const bool isFirst = this->Table.GetFirstRowOfSurface(row) == row;
    this->Membranes->SetBlock(static_cast<unsigned int>(row), isFirst ? block.Get() : nullptr);
  }
  this->WarnOfOrder(time);
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::WarnOfOrder(vtkMTimeType time)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool tells =
    controller && controller->GetNumberOfProcesses() > 1 && controller->GetLocalProcessId() == 0;
  if (!tells || time == this->MembraneTime)
  {
    return;
  }
  this->MembraneTime = time;
  bool keepsOrder = true;
  for (int row = 0; row < static_cast<int>(this->Membranes->GetNumberOfBlocks()); ++row)
  {
    vtkPolyData* surface = GetBlock(this->Membranes, row);
    keepsOrder = keepsOrder &&
      (!surface || surface->GetNumberOfCells() == 0 || meniscus::IsPlaneAcrossAxis(surface));
  }
  if (!keepsOrder)
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
void vtkTetrahedraRayCastRepresentation::SetNumberOfInterfaceRows(int rows)
{
  if (this->Table.SetNumberOfRows(rows))
  {
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::SetInterfaceRow(
  int row, double surface, double exterior, double interior)
{
  if (this->Table.SetRow(row, surface, exterior, interior))
  {
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mapper:\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}
