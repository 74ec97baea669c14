// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractingInterfaceCollection
 * @brief   the interfaces that a ray meets, in the order of the list
 *
 * Filters and mappers that refract have such a list, and a port with one surface per interface.
 * They may share a list. An empty list stands for a list of one interface with default values.
 *
 * A ray meets the first interface from either side. It meets each further interface at its nearest
 * intersection behind the last point of refraction, among the intersections with the side of the
 * surface that is in the ray's medium; others do not count. So a closed surface, such as a glass
 * ball, is listed twice, with the same indices: it is entered and left. The medium behind each
 * interface must be one of the two media of the next interface, otherwise the list is an error.
 * Rays may come from the interior of the first interface if the media match in that order. A ray
 * that is totally reflected at an interface ends there; a ray that misses an interface ends at the
 * last interface that it met, and shows nothing behind it. Interfaces with equal indices are left
 * out.
 *
 * @sa vtkRefractingInterface
 */
#ifndef vtkRefractingInterfaceCollection_h
#define vtkRefractingInterfaceCollection_h

#include "vtkCollection.h"
#include "vtkMeniscusModule.h" // for export macro

class vtkRefractingInterface;

class VTKMENISCUS_EXPORT vtkRefractingInterfaceCollection : public vtkCollection
{
public:
  static vtkRefractingInterfaceCollection* New();
  vtkTypeMacro(vtkRefractingInterfaceCollection, vtkCollection);

  /** Adds an interface at the end of the list. */
  void AddItem(vtkRefractingInterface* interface);

  /**
   * Makes an interface with these indices of refraction, on the side that the normals of its
   * surface point to and on the other side, adds it at the end of the list, and returns it. The
   * normals decide which side of an interface has the medium in front of it; media have no numbers
   * of their own.
   */
  vtkRefractingInterface* AddInterface(double exterior, double interior);

  /** Interface of number `i`, counted from 0, or null if there is none. */
  vtkRefractingInterface* GetInterface(int i);

  /** First interface; made with default values if the list is empty. */
  vtkRefractingInterface* GetFirstInterface();

  /** Latest modification time of the list, its interfaces and their exact surfaces. */
  vtkMTimeType GetMTime() override;

protected:
  vtkRefractingInterfaceCollection() = default;
  ~vtkRefractingInterfaceCollection() override = default;

private:
  vtkRefractingInterfaceCollection(const vtkRefractingInterfaceCollection&) = delete;
  void operator=(const vtkRefractingInterfaceCollection&) = delete;

  // Hidden: the list has interfaces only.
  void AddItem(vtkObject* object) { this->vtkCollection::AddItem(object); }
};

#endif
