// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVTetrahedraMirage.h"

#include "vtkColorTransferFunction.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkTexture.h"
#include "vtkVolumeProperty.h"

vtkStandardNewMacro(vtkPVTetrahedraMirage);

//------------------------------------------------------------------------------
vtkPVTetrahedraMirage::vtkPVTetrahedraMirage()
{
  this->SetNumberOfInputPorts(3);
  this->SetCamera(vtkNew<vtkCamera>());
}

//------------------------------------------------------------------------------
vtkPVTetrahedraMirage::~vtkPVTetrahedraMirage() = default;

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetShowVolume(bool isShown)
{
  this->SetVolumeProperty(isShown ? this->Functions.Get() : nullptr);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetVolumeColors(vtkColorTransferFunction* colors)
{
  this->Functions->SetColor(colors);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetVolumeOpacity(vtkPiecewiseFunction* opacity)
{
  this->Functions->SetScalarOpacity(opacity);
}

//------------------------------------------------------------------------------
void vtkPVTetrahedraMirage::SetScalarOpacityUnitDistance(double distance)
{
  this->Functions->SetScalarOpacityUnitDistance(distance);
}

//------------------------------------------------------------------------------
int vtkPVTetrahedraMirage::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

//------------------------------------------------------------------------------
int vtkPVTetrahedraMirage::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // The time of this change is before that of the output, so it is not computed again.
  vtkImageData* image = vtkImageData::GetData(inputs[2]);
  if (image)
  {
    this->Picture->SetInputData(image);
  }
  this->SetTexture(image ? this->Picture.Get() : nullptr);
  return this->Superclass::RequestData(request, inputs, outputs);
}
