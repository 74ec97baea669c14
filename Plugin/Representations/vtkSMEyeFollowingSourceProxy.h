// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMEyeFollowingSourceProxy
 * @brief   ParaView's proxy of a filter with an eye that follows the camera of a view
 *
 * Needs the properties EyePosition and FollowCamera. While FollowCamera is on, EyePosition is where
 * the camera is of the view that shows what the filter makes, or what other filters make of it: of
 * several such views the first by name, so that a second one can be turned freely. As long as none
 * does, of the active view. It follows before a view updates what it shows, so that each picture is
 * of its own camera, while the camera is moved as well: unless an update takes longer than
 * MaximumUpdateTime, then when it rests. If the properties ViewCulling, ViewFocalPoint, ViewUp and
 * ViewAngle are there and ViewCulling is on, the latter follow, too.
 *
 * Setting EyePosition by hand, by a script, a link or an animation ends following. FollowCamera is
 * on for a new filter whose XML says so by the hint `<FollowCamera/>`; of others, an eye that was
 * not set goes once, before the first update, to where the active view's camera is. The default in
 * the XML must be off: traces and states in Python leave out defaults. EyePosition must stand
 * before FollowCamera, for such scripts set them in that order. A state file without FollowCamera
 * has it off.
 */
#ifndef vtkSMEyeFollowingSourceProxy_h
#define vtkSMEyeFollowingSourceProxy_h

#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkSMSourceProxy.h"

class vtkSMRenderViewProxy;

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkSMEyeFollowingSourceProxy : public vtkSMSourceProxy
{
public:
  static vtkSMEyeFollowingSourceProxy* New();
  vtkTypeMacro(vtkSMEyeFollowingSourceProxy, vtkSMSourceProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Seconds that an update may take for the eye to follow while the camera is moved. */
  static constexpr double MaximumUpdateTime = 0.2;

  void UpdatePipeline() override;
  void UpdatePipeline(double time) override;

  int LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator) override;

protected:
  vtkSMEyeFollowingSourceProxy();
  ~vtkSMEyeFollowingSourceProxy() override;

  int ReadXMLAttributes(vtkSMSessionProxyManager* manager, vtkPVXMLElement* element) override;
  void CreateVTKObjects() override;

private:
  vtkSMEyeFollowingSourceProxy(const vtkSMEyeFollowingSourceProxy&) = delete;
  void operator=(const vtkSMEyeFollowingSourceProxy&) = delete;

  void ObserveViews();
  void ObserveView(vtkSMProxy* proxy);
  void OnProxyRegistered(vtkObject* caller, unsigned long event, void* information);
  void OnViewStarts(vtkObject* caller, unsigned long event, void* interactive);
  void OnEyeModified();

  bool Follows();
  vtkSMRenderViewProxy* FindShowingView();
  vtkSMRenderViewProxy* FindActiveView();
  bool MoveEye(vtkSMRenderViewProxy* view);
  void MoveEyeBeforeUpdate();

  bool IsMovingEye = false;
  bool EyeIsSet = false;
  double UpdateTime = 0.0;
};

#endif
