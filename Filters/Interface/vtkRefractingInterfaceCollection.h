// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractingInterfaceCollection
 * @brief   the interfaces that a ray meets, in the order of the list
 *
 * Filters and mapper refract at all of them, and each has a port for as many surfaces. One list may
 * be shared by any number of them. It is never shorter than one: without any, the first is one with
 * default values.
 *
 * A ray meets the first interface from either side. It meets a further one at the first
 * intersection behind the last point of refraction at which it arrives in the medium of that side;
 * intersections from the other side do not count. So a closed surface, such as a glass ball, is
 * listed twice, with the same indices: it is entered and left. The medium behind each interface
 * must be one of the two media of the next interface, otherwise the list is an error. Rays may come
 * from the interior of the first interface if the media match in that order. A ray that is totally
 * reflected at an interface ends there; one that misses an interface ends at the last one that it
 * met, and shows nothing behind it. Interfaces with equal indices are left out.
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
   * surface point to and on the other side, adds it at the end of the list, and returns it. Media
   * have no numbers of their own: which side of an interface is the medium before it depends on the
   * normals.
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
