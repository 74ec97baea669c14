// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMExactVolumeRepresentationProxy
 * @brief   proxy of a mesh's representations, one of which is Volume (Exact)
 *
 * ParaView colours a mesh by its first point array if a user chooses Volume for a mesh without
 * colours. This class does so for Volume (Exact) as well: ParaView compares the representation with
 * a fixed list of names in vtkSMPVRepresentationProxy::SetRepresentationType(), which this class
 * overrides. It also accepts the name `Tetrahedra Ray Cast`, which Volume (Exact) had before, in
 * states, traces and scripts, and replaces it by the new name.
 *
 * XML can extend a definition of ParaView, but not change its class. UseForUnstructuredGrids(),
 * which the plugin calls when it is loaded, does so for the definition
 * `UnstructuredGridRepresentation` of every session without a server.
 */
#ifndef vtkSMExactVolumeRepresentationProxy_h
#define vtkSMExactVolumeRepresentationProxy_h

#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkSMPVRepresentationProxy.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkSMExactVolumeRepresentationProxy
  : public vtkSMPVRepresentationProxy
{
public:
  static vtkSMExactVolumeRepresentationProxy* New();
  vtkTypeMacro(vtkSMExactVolumeRepresentationProxy, vtkSMPVRepresentationProxy);

  /** Names this class in the definitions of all sessions, those to come included. */
  static void UseForUnstructuredGrids();

  bool SetRepresentationType(const char* type) override;

protected:
  vtkSMExactVolumeRepresentationProxy();
  ~vtkSMExactVolumeRepresentationProxy() override;

  int ReadXMLAttributes(vtkSMSessionProxyManager* manager, vtkPVXMLElement* element) override;

private:
  vtkSMExactVolumeRepresentationProxy(const vtkSMExactVolumeRepresentationProxy&) = delete;
  void operator=(const vtkSMExactVolumeRepresentationProxy&) = delete;

  bool HasExactVolume();
  void OnRepresentationModified();
  void ColorByFirstArray();
};

#endif
