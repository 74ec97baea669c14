// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DemoVolumeInput.h"

#include "DemoProgress.h"

#include "vtkCellData.h"
#include "vtkCellDataToPointData.h"
#include "vtkClipDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <cmath>
#include <cstdio>

namespace
{

constexpr double Pi = 3.14159265358979323846;

/** Negative inside a ring of radius 1 with five lobes, thickness about 0.35. */
double RingFunction(double x, double y, double z)
{
  const double angle = std::atan2(y, x);
  const double radius = std::hypot(x, y) - 1.0 - 0.12 * std::cos(5.0 * angle);
  const double height = z - 0.15 * std::sin(5.0 * angle);
  return std::hypot(radius, height) - 0.32 - 0.05 * std::cos(10.0 * angle);
}

/** A field that varies along and across the ring. */
double RingField(double x, double y, double z)
{
  const double angle = std::atan2(y, x);
  const double across = std::hypot(std::hypot(x, y) - 1.0, z);
  return std::sin(4.0 * angle + 9.0 * z) * std::exp(-3.0 * across) + 0.6 * std::cos(Pi * x);
}

vtkDataArray* FirstScalars(vtkDataSetAttributes* attributes)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i);
    if (array && array->GetName() && array->GetNumberOfComponents() == 1)
    {
      return array;
    }
  }
  return nullptr;
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkUnstructuredGrid> MakeDemoMesh()
{
  const int size[3] = { 70, 70, 26 };
  const double spacing = 3.2 / (size[0] - 1);
  vtkNew<vtkImageData> lattice;
  lattice->SetDimensions(size);
  lattice->SetSpacing(spacing, spacing, spacing);
  lattice->SetOrigin(-1.6, -1.6, -0.5 * spacing * (size[2] - 1));

  vtkNew<vtkFloatArray> surface;
  surface->SetName("Ring");
  surface->SetNumberOfValues(lattice->GetNumberOfPoints());
  vtkNew<vtkFloatArray> field;
  field->SetName("Field");
  field->SetNumberOfValues(lattice->GetNumberOfPoints());
  for (vtkIdType p = 0; p < lattice->GetNumberOfPoints(); ++p)
  {
    double x[3];
    lattice->GetPoint(p, x);
    surface->SetValue(p, static_cast<float>(RingFunction(x[0], x[1], x[2])));
    field->SetValue(p, static_cast<float>(RingField(x[0], x[1], x[2])));
  }
  lattice->GetPointData()->SetScalars(surface);
  lattice->GetPointData()->AddArray(field);

  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputData(lattice);
  vtkNew<vtkClipDataSet> inside;
  inside->SetInputConnection(tetrahedra->GetOutputPort());
  inside->InsideOutOn();
  inside->SetValue(0.0);
  UpdateWithProgress(tetrahedra, "Tetrahedralising a lattice");
  UpdateWithProgress(inside, "Cutting out the closed surface");
  // Clipping leaves wedges, which the mapper divides.
  vtkSmartPointer<vtkUnstructuredGrid> mesh = inside->GetOutput();
  mesh->GetPointData()->SetActiveScalars("Field");
  return mesh;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkUnstructuredGrid> ReadDemoMesh(const std::string& file)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  UpdateWithProgress(reader, "Reading the mesh");
  vtkUnstructuredGrid* input = reader->GetOutput();
  if (reader->GetErrorCode() != 0 || input->GetNumberOfCells() == 0)
  {
    std::fprintf(stderr, "error: no mesh in %s\n", file.c_str());
    return nullptr;
  }
  vtkSmartPointer<vtkUnstructuredGrid> mesh = input;
  if (!FirstScalars(input->GetPointData()))
  {
    vtkNew<vtkCellDataToPointData> toPoints;
    toPoints->SetInputData(input);
    UpdateWithProgress(toPoints, "Taking cell data to the points");
    mesh = toPoints->GetUnstructuredGridOutput();
  }
  vtkDataArray* scalars = FirstScalars(mesh->GetPointData());
  if (!scalars)
  {
    std::fprintf(stderr, "error: %s has no array of one component\n", file.c_str());
    return nullptr;
  }
  mesh->GetPointData()->SetActiveScalars(scalars->GetName());
  return mesh;
}
