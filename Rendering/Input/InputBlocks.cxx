// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/InputBlocks.h"

#include "vtkAbstractMapper.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <sstream>

namespace meniscus
{
namespace
{

/** Scalars of a data set, or the reason why they cannot be drawn. */
struct FoundScalars
{
  vtkDataArray* Scalars = nullptr;
  FieldAssociation Place = FieldAssociation::Points;
  std::string Problem;
};

FoundScalars FindScalars(vtkDataSet* grid, const ScalarSelection& selection)
{
  constexpr int cellData = 1;
  constexpr int fieldData = 2;
  FoundScalars found;
  int place = 0;
  found.Scalars = vtkAbstractMapper::GetScalars(grid, selection.ScalarMode, selection.AccessMode,
    selection.ArrayId, selection.ArrayName, place);
  found.Place = place == cellData ? FieldAssociation::Cells : FieldAssociation::Points;
  std::ostringstream problem;
  if (!found.Scalars)
  {
    problem << "The input has no scalar array";
    if (selection.AccessMode == VTK_GET_ARRAY_BY_NAME && selection.ArrayName)
    {
      problem << " named '" << selection.ArrayName << "'";
    }
    found.Problem = problem.str();
    return found;
  }
  const char* name = found.Scalars->GetName();
  problem << "The array '" << (name ? name : "without a name") << "' ";
  const auto fail = [&found, &problem]()
  {
    found.Problem = problem.str();
    return found;
  };
  const int components = found.Scalars->GetNumberOfComponents();
  const bool ofCells = found.Place == FieldAssociation::Cells;
  const vtkIdType size = ofCells ? grid->GetNumberOfCells() : grid->GetNumberOfPoints();
  if (place == fieldData)
  {
    problem << "is field data; point or cell data is needed";
    return fail();
  }
  if (selection.Component >= components)
  {
    problem << "has " << components << " components, none of number " << selection.Component;
    return fail();
  }
  if (found.Scalars->GetNumberOfTuples() != size)
  {
    problem << "has " << found.Scalars->GetNumberOfTuples() << " values for " << size
            << (ofCells ? " cells" : " points");
    return fail();
  }
  return found;
}

/** Leaves that may have something to draw. */
std::vector<vtkDataSet*> LeavesOf(vtkCompositeDataSet* composite)
{
  std::vector<vtkDataSet*> leaves;
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(composite->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataSet* grid = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject());
    if (grid && !vtkPolyData::SafeDownCast(grid) && grid->GetNumberOfCells() > 0)
    {
      leaves.push_back(grid);
    }
  }
  return leaves;
}

InputReport CollectLeaves(
  const std::vector<vtkDataSet*>& leaves, const ScalarSelection& selection, InputBlocks& parts)
{
  InputReport report;
  std::string firstProblem;
  for (vtkDataSet* leaf : leaves)
  {
    FoundScalars found = FindScalars(leaf, selection);
    if (found.Problem.empty() && !parts.Parts.empty() && found.Place != parts.Place)
    {
      found.Problem = "An array is point data of one and cell data of another data set";
    }
    if (found.Problem.empty())
    {
      parts.Parts.push_back({ leaf, found.Scalars });
      parts.Place = found.Place;
    }
    else if (firstProblem.empty())
    {
      firstProblem = found.Problem;
    }
  }
  const std::size_t omitted = leaves.size() - parts.Parts.size();
  if (omitted == leaves.size())
  {
    report.Error = firstProblem;
  }
  else if (omitted > 0)
  {
    report.Warning = std::to_string(omitted) + " of " + std::to_string(leaves.size()) +
      " data sets are left out. " + firstProblem + ".";
  }
  return report;
}

}

//------------------------------------------------------------------------------
InputReport CollectInputBlocks(
  vtkDataObject* input, const ScalarSelection& selection, InputBlocks& parts)
{
  parts = InputBlocks();
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    return CollectLeaves(LeavesOf(composite), selection, parts);
  }
  InputReport report;
  vtkDataSet* grid = vtkDataSet::SafeDownCast(input);
  if (!grid)
  {
    report.Error = input ? std::string("The input is a ") + input->GetClassName() +
        ", neither a vtkDataSet nor a vtkCompositeDataSet"
                         : std::string("No input");
    return report;
  }
  if (grid->GetNumberOfCells() == 0)
  {
    return report;
  }
  FoundScalars found = FindScalars(grid, selection);
  report.Error = found.Problem;
  if (found.Problem.empty())
  {
    parts.Parts.push_back({ grid, found.Scalars });
    parts.Place = found.Place;
  }
  return report;
}

}
