// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/InputBlocks.h"

#include "Rendering/Input/CellReader.h"

#include "vtkAbstractMapper.h"
#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
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

/** Names of the numeric arrays of points, cells or fields; empty if there are none. */
std::string NamesOf(vtkFieldData* arrays)
{
  std::ostringstream names;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    // Flags of ghosts are no scalars.
    if (array &&
      std::string(vtkDataSetAttributes::GhostArrayName()) !=
        (array->GetName() ? array->GetName() : ""))
    {
      names << (names.str().empty() ? "" : ", ") << "'"
            << (array->GetName() ? array->GetName() : "without a name") << "'";
    }
  }
  return names.str();
}

/** Message about scalars that a data set does not have, with the names of those that it has. */
std::string DescribeMissing(vtkDataSet* grid, const ScalarSelection& selection)
{
  const bool byField = selection.ScalarMode == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA ||
    selection.ScalarMode == VTK_SCALAR_MODE_USE_CELL_FIELD_DATA ||
    selection.ScalarMode == VTK_SCALAR_MODE_USE_FIELD_DATA;
  std::ostringstream text;
  text << "The input has no ";
  if (!byField)
  {
    text << "active scalars";
  }
  else if (selection.AccessMode == VTK_GET_ARRAY_BY_NAME)
  {
    text << "scalar array named '" << (selection.ArrayName ? selection.ArrayName : "") << "'";
  }
  else
  {
    text << "scalar array of number " << selection.ArrayId;
  }
  switch (selection.ScalarMode)
  {
    case VTK_SCALAR_MODE_USE_POINT_DATA:
    case VTK_SCALAR_MODE_USE_POINT_FIELD_DATA:
      text << " in its point data";
      break;
    case VTK_SCALAR_MODE_USE_CELL_DATA:
    case VTK_SCALAR_MODE_USE_CELL_FIELD_DATA:
      text << " in its cell data";
      break;
    default:
      break;
  }
  const std::string ofPoints = NamesOf(grid->GetPointData());
  const std::string ofCells = NamesOf(grid->GetCellData());
  if (ofPoints.empty() && ofCells.empty())
  {
    text << " and no arrays of points or cells";
    return text.str();
  }
  text << "; there are " << (ofPoints.empty() ? "" : "point arrays ") << ofPoints
       << (ofPoints.empty() || ofCells.empty() ? "" : " and ")
       << (ofCells.empty() ? "" : "cell arrays ") << ofCells;
  return text.str();
}

FoundScalars FindScalars(vtkDataSet* grid, const ScalarSelection& selection)
{
  constexpr int cellData = 1;
  constexpr int fieldData = 2;
  FoundScalars found;
  found.Problem = DescribeFault(grid);
  if (!found.Problem.empty())
  {
    return found;
  }
  int place = 0;
  found.Scalars = vtkAbstractMapper::GetScalars(grid, selection.ScalarMode, selection.AccessMode,
    selection.ArrayId, selection.ArrayName, place);
  found.Place = place == cellData ? FieldAssociation::Cells : FieldAssociation::Points;
  std::ostringstream problem;
  if (!found.Scalars)
  {
    found.Problem = DescribeMissing(grid, selection);
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

/** Leaves that may have something to draw: surfaces if there is nothing else. */
std::vector<vtkDataSet*> LeavesOf(vtkCompositeDataSet* composite)
{
  std::vector<vtkDataSet*> leaves;
  std::vector<vtkDataSet*> surfaces;
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(composite->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataSet* grid = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject());
    if (grid && grid->GetNumberOfCells() > 0)
    {
      (vtkPolyData::SafeDownCast(grid) ? surfaces : leaves).push_back(grid);
    }
  }
  return leaves.empty() ? surfaces : leaves;
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
int AcceptDataSets(vtkInformation* port)
{
  port->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  // The executive looks at the first type only; otherwise it would iterate over the blocks.
  for (const char* type : { "vtkCompositeDataSet", "vtkDataSet" })
  {
    port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  return 1;
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

//------------------------------------------------------------------------------
InputReport CollectNamedArray(
  vtkDataObject* input, const char* name, int component, InputBlocks& parts)
{
  ScalarSelection selection;
  selection.ScalarMode = VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
  selection.AccessMode = VTK_GET_ARRAY_BY_NAME;
  selection.ArrayName = name;
  selection.Component = component;
  const InputReport ofPoints = CollectInputBlocks(input, selection, parts);
  if (ofPoints.Error.empty())
  {
    return ofPoints;
  }
  selection.ScalarMode = VTK_SCALAR_MODE_USE_CELL_FIELD_DATA;
  const InputReport ofCells = CollectInputBlocks(input, selection, parts);
  // If there is no such array of cells, the error about the array of points says more.
  return ofCells.Error.empty() ? ofCells : ofPoints;
}

//------------------------------------------------------------------------------
InputBlocks CollectGrids(vtkDataObject* input)
{
  std::vector<vtkDataSet*> grids;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    grids = LeavesOf(composite);
  }
  else if (vtkDataSet* grid = vtkDataSet::SafeDownCast(input))
  {
    grids.push_back(grid);
  }
  InputBlocks blocks;
  for (vtkDataSet* grid : grids)
  {
    if (grid->GetNumberOfCells() > 0 && DescribeFault(grid).empty())
    {
      blocks.Parts.push_back({ grid, nullptr });
    }
  }
  return blocks;
}

//------------------------------------------------------------------------------
bool HaveSameGrids(const InputBlocks& a, const InputBlocks& b)
{
  return std::equal(a.Parts.begin(), a.Parts.end(), b.Parts.begin(), b.Parts.end(),
    [](const InputPart& one, const InputPart& other) { return one.Grid == other.Grid; });
}

//------------------------------------------------------------------------------
std::vector<vtkDataSet*> GetGrids(const InputBlocks& input)
{
  std::vector<vtkDataSet*> grids;
  for (const InputPart& part : input.Parts)
  {
    grids.push_back(part.Grid);
  }
  return grids;
}

}
