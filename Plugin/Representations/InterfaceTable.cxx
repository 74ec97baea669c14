// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "InterfaceTable.h"

#include "MembraneGathering.h"

#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meniscus
{

//------------------------------------------------------------------------------
InterfaceTable::InterfaceTable()
{
  this->Single->GetFirstInterface();
}

//------------------------------------------------------------------------------
bool InterfaceTable::SetNumberOfRows(int rows)
{
  const int before = this->Listed->GetNumberOfItems();
  for (int row = before; row > std::max(rows, 0); --row)
  {
    this->Listed->RemoveItem(row - 1);
  }
  for (int row = before; row < rows; ++row)
  {
    this->Listed->AddItem(vtkNew<vtkRefractingInterface>());
  }
  this->Surfaces.resize(static_cast<std::size_t>(std::max(rows, 0)), 0.0);
  this->UpdateExactSurfaces();
  return before != rows;
}

//------------------------------------------------------------------------------
bool InterfaceTable::SetRow(int row, double surface, double exterior, double interior)
{
  vtkRefractingInterface* interface = this->Listed->GetInterface(row);
  if (!interface)
  {
    return false;
  }
  double& known = this->Surfaces[static_cast<std::size_t>(row)];
  const vtkMTimeType before = interface->GetMTime();
  const bool isOther = known != surface;
  known = surface;
  interface->SetExteriorIndexOfRefraction(exterior);
  interface->SetInteriorIndexOfRefraction(interior);
  this->UpdateExactSurfaces();
  return isOther || interface->GetMTime() != before;
}

//------------------------------------------------------------------------------
void InterfaceTable::SetExactSurface(vtkImplicitFunction* function)
{
  this->Exact = function;
  this->Single->GetFirstInterface()->SetExactSurface(function);
  this->UpdateExactSurfaces();
}

//------------------------------------------------------------------------------
void InterfaceTable::UpdateExactSurfaces()
{
  for (std::size_t row = 0; row < this->Surfaces.size(); ++row)
  {
    this->Listed->GetInterface(static_cast<int>(row))
      ->SetExactSurface(this->Surfaces[row] == 0.0 ? this->Exact.Get() : nullptr);
  }
}

//------------------------------------------------------------------------------
vtkRefractingInterface* InterfaceTable::GetSingle()
{
  return this->Single->GetFirstInterface();
}

//------------------------------------------------------------------------------
vtkRefractingInterfaceCollection* InterfaceTable::GetInterfaces()
{
  return this->Surfaces.empty() ? this->Single : this->Listed;
}

//------------------------------------------------------------------------------
int InterfaceTable::GetFirstRowOfSurface(int row) const
{
  const auto at = static_cast<std::size_t>(row);
  return at < this->Surfaces.size()
    ? static_cast<int>(std::find(this->Surfaces.begin(), this->Surfaces.end(), this->Surfaces[at]) -
        this->Surfaces.begin())
    : row;
}

//------------------------------------------------------------------------------
// Text of the error for rows that do not fit the number of surfaces; empty if all do.
std::string InterfaceTable::FindFault(int surfaces) const
{
  // Written so that a NaN fails.
  const auto isSurface = [surfaces](double number)
  { return number >= 0.0 && number < surfaces && number == std::floor(number); };
  const auto bad = std::find_if_not(this->Surfaces.begin(), this->Surfaces.end(), isSurface);
  std::ostringstream text;
  if (bad != this->Surfaces.end())
  {
    text << "Row " << bad - this->Surfaces.begin() << " of the interfaces names surface " << *bad
         << "; there are " << surfaces << ", counted from 0";
    return text.str();
  }
  for (int i = 0; i < surfaces && !this->Surfaces.empty(); ++i)
  {
    if (std::find(this->Surfaces.begin(), this->Surfaces.end(), i) == this->Surfaces.end())
    {
      text << "No row of the interfaces names surface " << i;
      return text.str();
    }
  }
  return text.str();
}

//------------------------------------------------------------------------------
// Surfaces in the order of the rows; unchanged without rows.
vtkSmartPointer<vtkInformationVector> InterfaceTable::Arrange(vtkInformationVector* surfaces) const
{
  if (this->Surfaces.empty())
  {
    return surfaces;
  }
  auto arranged = vtkSmartPointer<vtkInformationVector>::New();
  for (const double number : this->Surfaces)
  {
    arranged->Append(surfaces->GetInformationObject(static_cast<int>(number)));
  }
  return arranged;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkInformationVector> InterfaceTable::GatherSurfaces(
  vtkInformationVector* port, bool isOptional, std::string& fault) const
{
  const vtkSmartPointer<vtkInformationVector> surfaces = GatherMembranes(port);
  if (!surfaces)
  {
    fault = "The ranks could not exchange their parts of the membrane";
    return nullptr;
  }
  const int number = surfaces->GetNumberOfInformationObjects();
  if (isOptional && number == 0)
  {
    return surfaces;
  }
  fault = this->FindFault(number);
  return fault.empty() ? this->Arrange(surfaces) : nullptr;
}

}
