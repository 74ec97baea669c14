// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Refracting interfaces as properties of a proxy: two indices, or a table with a row for each. */
#ifndef InterfaceTable_h
#define InterfaceTable_h

#include "vtkNew.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImplicitFunction;
class vtkInformationVector;

/** Declares in a class the methods that meniscusInterfaceTableMacro defines. */
#define meniscusInterfaceTableDeclarations()                                                       \
  void SetNumberOfInterfaceRows(int rows);                                                         \
  void SetInterfaceRow(int row, double surface, double exterior, double interior);                 \
  void SetExteriorIndexOfRefraction(double index) override;                                        \
  double GetExteriorIndexOfRefraction() override;                                                  \
  void SetInteriorIndexOfRefraction(double index) override;                                        \
  double GetInteriorIndexOfRefraction() override

/**
 * Defines the methods of a class with the member `meniscus::InterfaceTable Table`, whose superclass
 * has a list of interfaces. The two indices count for a filter without a table; they do not
 * change the table.
 */
#define meniscusInterfaceTableMacro(className)                                                     \
  void className::SetNumberOfInterfaceRows(int rows)                                               \
  {                                                                                                \
    if (this->Table.SetNumberOfRows(rows))                                                         \
    {                                                                                              \
      this->SetInterfaces(this->Table.GetInterfaces());                                            \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  void className::SetInterfaceRow(int row, double surface, double exterior, double interior)       \
  {                                                                                                \
    if (this->Table.SetRow(row, surface, exterior, interior))                                      \
    {                                                                                              \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  void className::SetExteriorIndexOfRefraction(double index)                                       \
  {                                                                                                \
    this->Table.GetSingle()->SetExteriorIndexOfRefraction(index);                                  \
  }                                                                                                \
  double className::GetExteriorIndexOfRefraction()                                                 \
  {                                                                                                \
    return this->GetInterfaces()->GetFirstInterface()->GetExteriorIndexOfRefraction();             \
  }                                                                                                \
  void className::SetInteriorIndexOfRefraction(double index)                                       \
  {                                                                                                \
    this->Table.GetSingle()->SetInteriorIndexOfRefraction(index);                                  \
  }                                                                                                \
  double className::GetInteriorIndexOfRefraction()                                                 \
  {                                                                                                \
    return this->GetInterfaces()->GetFirstInterface()->GetInteriorIndexOfRefraction();             \
  }

namespace meniscus
{

/**
 * Interfaces in the order in which rays meet them. A row has the number of a surface, counted from
 * 0 in the order of the connections, and the indices of refraction on the side that its normals
 * point to and on the other side. A closed body is one surface in two rows. Without rows there is
 * one interface, with indices of its own.
 */
class InterfaceTable
{
public:
  InterfaceTable();

  /** Sets the number of rows; returns false if it does not change. */
  bool SetNumberOfRows(int rows);
  /** Sets a row; returns false if nothing changes. */
  bool SetRow(int row, double surface, double exterior, double interior);
  /** Sets the exact form of surface 0 in all rows with it. */
  void SetExactSurface(vtkImplicitFunction* function);

  /** The interface that is used without rows. */
  vtkRefractingInterface* GetSingle();
  /** List of the rows' interfaces; of the single interface if there are no rows. */
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** List of the interface that is used without rows. */
  vtkRefractingInterfaceCollection* GetSingleList() { return this->Single; }

  /** First row with the surface of a row; the row itself without rows. */
  int GetFirstRowOfSurface(int row) const;

  /**
   * Surfaces of a port, with the parts of all ranks, in the order of the rows; without rows,
   * in the order of the connections. Null, with the text of an error, if the ranks cannot exchange
   * their parts or the rows do not fit the number of surfaces. An optional port may be empty.
   */
  vtkSmartPointer<vtkInformationVector> GatherSurfaces(
    vtkInformationVector* port, bool isOptional, std::string& fault) const;

private:
  std::string FindFault(int surfaces) const;
  vtkSmartPointer<vtkInformationVector> Arrange(vtkInformationVector* surfaces) const;
  void UpdateExactSurfaces();

  vtkNew<vtkRefractingInterfaceCollection> Single;
  vtkNew<vtkRefractingInterfaceCollection> Listed;
  std::vector<double> Surfaces; ///< number of the surface of each row
  vtkSmartPointer<vtkImplicitFunction> Exact;
};

}

#endif
