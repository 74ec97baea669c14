// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRefractedGeometryFilter.h"

#include "MembraneGathering.h"

#include "vtkCamera.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

vtkStandardNewMacro(vtkPVRefractedGeometryFilter);

//------------------------------------------------------------------------------
vtkPVRefractedGeometryFilter::vtkPVRefractedGeometryFilter()
{
  this->View->SetPosition(this->GetEyePosition());
  this->Superclass::SetViewCulling(false);
}

//------------------------------------------------------------------------------
vtkPVRefractedGeometryFilter::~vtkPVRefractedGeometryFilter() = default;

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetEyePosition(double x, double y, double z)
{
  this->Superclass::SetEyePosition(x, y, z);
  this->View->SetPosition(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewCulling(bool culling)
{
  this->Superclass::SetViewCulling(culling);
  this->SetCamera(culling ? this->View.Get() : nullptr);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewFocalPoint(double x, double y, double z)
{
  this->View->SetFocalPoint(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewUp(double x, double y, double z)
{
  this->View->SetViewUp(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::SetViewAngle(double degrees)
{
  this->View->SetViewAngle(degrees);
}

//------------------------------------------------------------------------------
int vtkPVRefractedGeometryFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  meniscus::AcceptComposite(info);
  return filled;
}

//------------------------------------------------------------------------------
int vtkPVRefractedGeometryFilter::FillOutputPortInformation(
  int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVRefractedGeometryFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(inputs[0], outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

//------------------------------------------------------------------------------
int vtkPVRefractedGeometryFilter::RequestDataObject(
  vtkInformationVector* inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs);
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
  if (!input)
  {
    return 0;
  }
  if (!output || !output->IsA(input->GetClassName()))
  {
    auto made = vtkSmartPointer<vtkDataObject>::Take(input->NewInstance());
    info->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVRefractedGeometryFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Each rank asks for its own piece of the membrane. All of it, as the superclass asks for, is not
  // to be had from filters that distribute data.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int succeeded = this->Superclass::RequestUpdateExtent(request, inputs, outputs);
  if (vtkInformation* membrane = inputs[1]->GetInformationObject(0))
  {
    vtkInformation* output = outputs->GetInformationObject(0);
    membrane->CopyEntry(output, Pipeline::UPDATE_PIECE_NUMBER());
    membrane->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_PIECES());
  }
  return succeeded;
}

//------------------------------------------------------------------------------
int vtkPVRefractedGeometryFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const vtkSmartPointer<vtkPolyData> membrane =
    meniscus::GatherMembrane(vtkDataObject::GetData(inputs[1]));
  if (!membrane)
  {
    vtkErrorMacro("The ranks could not exchange their parts of the membrane; the output is empty.");
    return 0;
  }
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    return this->RefractBlock(
      request, vtkPolyData::SafeDownCast(input), membrane, vtkPolyData::SafeDownCast(output));
  }
  auto* compositeOutput = vtkCompositeDataSet::SafeDownCast(output);
  compositeOutput->CopyStructure(composite);
  auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  int succeeded = 1;
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    if (auto* geometry = vtkPolyData::SafeDownCast(block->GetCurrentDataObject()))
    {
      vtkNew<vtkPolyData> refracted;
      succeeded &= this->RefractBlock(request, geometry, membrane, refracted);
      compositeOutput->SetDataSet(block, refracted);
    }
  }
  return succeeded;
}

//------------------------------------------------------------------------------
int vtkPVRefractedGeometryFilter::RefractBlock(
  vtkInformation* request, vtkPolyData* geometry, vtkPolyData* membrane, vtkPolyData* output)
{
  const vtkSmartPointer<vtkInformationVector> ports[] = { meniscus::WrapData(geometry),
    meniscus::WrapData(membrane) };
  vtkInformationVector* inputs[] = { ports[0], ports[1] };
  return this->Superclass::RequestData(request, inputs, meniscus::WrapData(output));
}

//------------------------------------------------------------------------------
void vtkPVRefractedGeometryFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View:\n";
  this->View->PrintSelf(os, indent.GetNextIndent());
}
