// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMEyeFollowingSourceProxy
 * @brief   proxy of a filter with an eye that follows the camera of a view
 *
 * Requires the properties EyePosition and FollowCamera. While FollowCamera is on, EyePosition is
 * the camera's position in the view that shows the filter's output, or the output of filters that
 * use it. If there are several such views, it is the first by name, so that a second one can be
 * rotated freely; if there is none, it is the active view. The eye follows before a view is
 * updated, so that each image belongs to its own camera, also while the camera moves. If an update
 * takes longer than MaximumUpdateTime, the eye follows only when the camera rests. The properties
 * ViewFocalPoint, ViewUp and ViewAngle follow, too, if they exist and there is no property
 * ViewCulling, or it is on.
 *
 * In a parallel view the eye is at infinity. ViewParallelProjection, ViewParallelScale,
 * ViewFocalPoint and ViewUp follow if they exist; otherwise EyePosition is a point 1e5 sizes of the
 * input Membrane away, against the direction of projection.
 *
 * Setting EyePosition by hand, by a script, a link or an animation ends following. FollowCamera is
 * on for a new filter whose XML has the hint `<FollowCamera/>`. For other filters, an eye that was
 * not set is moved once, before the first update, to the active view's camera. The default in the
 * XML must be off, because traces and states in Python omit defaults. EyePosition must precede
 * FollowCamera, because such scripts set them in that order. A state file without FollowCamera
 * turns it off.
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

  /** Longest time of an update, in seconds, for which the eye follows while the camera moves. */
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
