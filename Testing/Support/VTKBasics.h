// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** @file
 * Headers of VTK that most programs of the tests use, those of MathBasics.h, and
 * PointOf(), TupleOf(), MapPoints(), MakeBlocks(), ValuesOf() and
 * MakeArray().
 */

#include "MathBasics.h"

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkColorTransferFunction.h>
#include <vtkCommand.h>
#include <vtkContourValues.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkLight.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRectilinearGrid.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkSphere.h>
#include <vtkSphereSource.h>
#include <vtkStringArray.h>
#include <vtkTransform.h>
#include <vtkTriangle.h>
#include <vtkTrivialProducer.h>
#include <vtkType.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

namespace meniscus::test
{

/** Coordinates of a point of a data set or of vtkPoints. */
template <typename Points>
glm::dvec3 PointOf(const Points& points, vtkIdType i)
{
  glm::dvec3 point;
  points->GetPoint(i, &point.x);
  return point;
}

/** A tuple of three components. */
template <typename Array>
glm::dvec3 TupleOf(const Array& array, vtkIdType i)
{
  glm::dvec3 tuple;
  array->GetTuple(i, &tuple.x);
  return tuple;
}

/** Moves all points of a data set to a function of their places. */
template <typename PointSet, typename Map>
void MapPoints(const PointSet& set, const Map& map)
{
  vtkPoints* points = set->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 moved = map(PointOf(points, i));
    points->SetPoint(i, &moved.x);
  }
  points->Modified();
}

/** A data set of blocks. */
template <typename Data = vtkSmartPointer<vtkDataObject>>
vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks(const std::vector<Data>& parts)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const auto& part : parts)
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), part);
  }
  return blocks;
}

/** The values of an array, one component after the other; none if the array is null. */
inline std::vector<double> ValuesOf(vtkDataArray* array)
{
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    values.push_back(array->GetVariantValue(i).ToDouble());
  }
  return values;
}

/** The values of all arrays of numbers, one array after the other. */
inline std::vector<double> ValuesOf(vtkDataSetAttributes* attributes)
{
  std::vector<double> all;
  for (int a = 0; a < attributes->GetNumberOfArrays(); ++a)
  {
    const std::vector<double> values = ValuesOf(attributes->GetArray(a));
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

/**
 * An array of `count` tuples: numbers or vectors of GLM. `value` is a function of the tuple's
 * index, or the same value for all.
 */
template <typename Array = vtkDoubleArray, typename Value>
vtkSmartPointer<Array> MakeArray(const char* name, vtkIdType count, const Value& value)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  const auto add = [&array](const auto& tuple)
  {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(tuple)>>)
    {
      array->InsertNextTuple1(static_cast<double>(tuple));
    }
    else
    {
      array->SetNumberOfComponents(tuple.length());
      array->InsertNextTuple(&tuple[0]);
    }
  };
  for (vtkIdType i = 0; i < count; ++i)
  {
    if constexpr (std::is_invocable_v<Value, vtkIdType>)
    {
      add(value(i));
    }
    else
    {
      add(value);
    }
  }
  return array;
}

} // namespace meniscus::test
