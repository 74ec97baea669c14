// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBentMediumAlgorithm.h"

#include "Filters/Common/Accessors.h"
#include "Rendering/Integral/BentMedium.h"
#include "Rendering/Integral/ImagePlace.h"

#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

#include <cmath>

meniscusSetClampMacro(vtkBentMediumAlgorithm, Quantity, int, DENSITY, REFRACTIVE_INDEX);
meniscusSetClampMacro(vtkBentMediumAlgorithm, OutsideIndex, double, 0.0, VTK_DOUBLE_MAX);

//------------------------------------------------------------------------------
vtkBentMediumAlgorithm::vtkBentMediumAlgorithm(int port)
  : Medium(new meniscus::BentMedium)
  , GladstoneDale(meniscus::GladstoneDaleOfAir)
{
  this->SetInputArrayToProcess(
    0, port, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkBentMediumAlgorithm::~vtkBentMediumAlgorithm() = default;

//------------------------------------------------------------------------------
int vtkBentMediumAlgorithm::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  return meniscus::AcceptDataSets(info);
}

//------------------------------------------------------------------------------
int vtkBentMediumAlgorithm::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputs, vtkInformationVector* vtkNotUsed(outputs))
{
  meniscus::RequestWholeInputs(inputs, this->GetNumberOfInputPorts());
  return 1;
}

//------------------------------------------------------------------------------
bool vtkBentMediumAlgorithm::TellError(const std::string& error)
{
  if (!error.empty())
  {
    vtkErrorMacro(<< error << "; the output is empty.");
  }
  return error.empty();
}

//------------------------------------------------------------------------------
bool vtkBentMediumAlgorithm::UpdateMedium(vtkDataObject* mesh, double share)
{
  if (!std::isfinite(this->GladstoneDale))
  {
    return this->TellError("The Gladstone-Dale constant is not finite");
  }
  const meniscus::InputReport report = this->Medium->Update(mesh, this->GetInputArrayInformation(0),
    { this->Quantity == DENSITY, this->GladstoneDale },
    [this, share](double fraction)
    {
      this->UpdateProgress(share * fraction);
      return !this->GetAbortExecute();
    });
  if (!report.Warning.empty())
  {
    vtkWarningMacro(<< report.Warning);
  }
  return !this->GetAbortExecute() && this->TellError(report.Error);
}

//------------------------------------------------------------------------------
void vtkBentMediumAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Quantity: " << (this->Quantity == DENSITY ? "DENSITY" : "REFRACTIVE_INDEX")
     << "\n";
  os << indent << "GladstoneDale: " << this->GladstoneDale << "\n";
  os << indent << "OutsideIndex: " << this->OutsideIndex << "\n";
}
