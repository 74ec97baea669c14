# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The eye of Refracted Geometry follows the camera of the view that shows it: in every picture,
while the camera is moved, in one of several views, through other filters; until it is set. That of
Refraction Error Volume only begins there."""
import os
import time

import PluginTesting
from PluginTesting import SIZE, covered, screenshot
from paraview import servermanager, simple

PLACES = [(0.5, -0.4, 3.0), (1.5, 0.3, 1.5), (-1.0, 1.0, 2.0)]


def make_filter(**settings):
    ball = simple.Sphere(Center=[0, 0, -0.6], Radius=0.3, ThetaResolution=24, PhiResolution=24)
    water = simple.Plane(Origin=[-2, -2, 0], Point1=[2, -2, 0], Point2=[-2, 2, 0], XResolution=8,
                         YResolution=8)
    return simple.RefractedGeometry(Geometry=ball, Membrane=water, **settings)


def eye_of(refracted):
    return tuple(PluginTesting.value_of(refracted, "EyePosition"))


def points_of(refracted):
    data = servermanager.Fetch(refracted)
    return [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]


def place(view, position):
    view.CameraPosition = position
    view.CameraFocalPoint = [0, 0, -0.6]
    view.CameraViewUp = [0, 1, 0]


def check_pictures(view, refracted):
    """Each image equals that of an eye set to the camera's position."""
    fixed = make_filter()
    fixed.EyePosition = [0, 0, 9]
    assert not fixed.FollowCamera, "a set eye follows the camera"
    for number, position in enumerate(PLACES):
        place(view, position)
        simple.Hide(fixed, view)
        simple.Show(refracted, view)
        followed = screenshot(view, "Follow%d" % number)
        assert eye_of(refracted) == position, eye_of(refracted)
        assert len(covered(followed)) > 0.01 * SIZE**2
        simple.Hide(refracted, view)
        fixed.EyePosition = position
        simple.Show(fixed, view)
        assert screenshot(view, "FollowSet%d" % number) == followed
    simple.Delete(fixed)
    simple.Show(refracted, view)


def check_motion(view, refracted):
    """The vtkCamera is moved without its property, as by the mouse, and the view drawn
    interactively."""
    camera = view.SMProxy.GetActiveCamera()
    for position in PLACES:
        camera.SetPosition(*position)
        view.SMProxy.InteractiveRender()
        assert eye_of(refracted) == position, eye_of(refracted)
    place(view, PLACES[0])


def check_views(view, refracted):
    """If two views show the result the first counts; a view that does not show it never does."""
    other = PluginTesting.make_view()
    assert simple.GetActiveView() is other
    simple.Render(other)  # the first one resets the camera
    place(other, (3, 3, 5))
    simple.Render(other)
    simple.Render(view)
    assert eye_of(refracted) == PLACES[0]
    simple.Show(refracted, other)
    for name, shown in [("FollowAside", other), ("FollowFirst", view)]:
        screenshot(shown, name)
        assert eye_of(refracted) == PLACES[0], name
    simple.Hide(refracted, view)
    simple.Render(other)
    assert eye_of(refracted) == (3, 3, 5), (eye_of(refracted), other.CameraPosition)
    simple.Delete(other)
    simple.SetActiveView(view)
    simple.Show(refracted, view)
    simple.Render(view)
    assert eye_of(refracted) == PLACES[0]


def check_downstream(view, refracted):
    """The view may show the output of another filter applied to the result."""
    simple.Hide(refracted, view)
    higher = simple.Transform(Input=refracted)
    simple.Show(higher, view)
    place(view, PLACES[1])
    simple.Render(view)
    assert eye_of(refracted) == PLACES[1]
    simple.Hide(higher, view)
    place(view, PLACES[2])
    simple.Render(view)
    assert eye_of(refracted) == PLACES[1], "it follows a view that does not show it"
    simple.Delete(higher)
    simple.Show(refracted, view)


def check_culling(view, refracted):
    """With ViewCulling the whole camera is followed: geometry that it does not show is left out."""
    place(view, PLACES[0])
    plain = screenshot(view, "FollowNotCulled")
    refracted.ViewCulling = 1
    assert screenshot(view, "FollowCulled") == plain
    count = len(points_of(refracted))
    view.CameraFocalPoint = [0, 100, 0]  # above: of the sides the filter does not know
    simple.Render(view)
    aside = len(points_of(refracted))
    assert aside < count, "%d of %d points though the camera looks aside" % (aside, count)
    refracted.ViewCulling = 0
    place(view, PLACES[0])


def check_work(view, refracted):
    """Changes that do not move the eye do not run the filter."""
    simple.Render(view)
    algorithm = refracted.SMProxy.GetClientSideObject()
    before = algorithm.GetOutputDataObject(0).GetMTime()
    view.CameraViewAngle = 25
    view.CameraViewUp = [1, 1, 0]
    view.Background = [0.1, 0, 0]
    simple.Render(view)
    assert algorithm.GetOutputDataObject(0).GetMTime() == before, "the filter ran"
    view.Background = PluginTesting.BACKGROUND


def check_setting(view, refracted):
    refracted.EyePosition = [0, 0, 4]
    assert not refracted.FollowCamera
    place(view, PLACES[1])
    simple.Render(view)
    assert eye_of(refracted) == (0, 0, 4), "a set eye moves"
    refracted.FollowCamera = 1
    simple.Render(view)
    assert eye_of(refracted) == PLACES[1]


def check_slow(view, refracted):
    """If an update takes longer than 0.2 s, the eye follows when the camera has stopped."""
    ball = refracted.Geometry
    ball.ThetaResolution = ball.PhiResolution = 1000
    simple.Render(view)
    camera = view.SMProxy.GetActiveCamera()
    camera.SetPosition(*PLACES[0])
    start = time.time()
    simple.Render(view)
    seconds = time.time() - start
    print("%.2f s" % seconds)
    assert eye_of(refracted) == PLACES[0]
    assert seconds > 0.3, "that is not slow"
    camera.SetPosition(*PLACES[1])
    view.SMProxy.InteractiveRender()
    assert eye_of(refracted) == PLACES[0], "it follows though it is slow"
    simple.Render(view)
    assert eye_of(refracted) == PLACES[1]
    ball.ThetaResolution = ball.PhiResolution = 24
    for position in PLACES[::2]:  # the first one is timed
        camera.SetPosition(*position)
        simple.Render(view)
    camera.SetPosition(*PLACES[1])
    view.SMProxy.InteractiveRender()
    assert eye_of(refracted) == PLACES[1], "it is fast again, and does not follow"


def check_error_volume(view):
    """The eye begins at the camera and stays there, unless it is told to follow; the box lies
    around the membrane."""
    water = simple.Plane(Origin=[-2, -1, 0.5], Point1=[2, -1, 0.5], Point2=[-2, 1, 0.5])
    water.UpdatePipeline()
    place(view, PLACES[0])
    volume = simple.RefractionErrorVolume(Membrane=water, MembraneModel="Flat facets",
                                          SampleDimensions=[3, 3, 3])
    assert list(volume.ModelBounds) == [-2, 2, -2, 2, -1.5, 2.5], list(volume.ModelBounds)
    simple.Show(volume, view)
    simple.Render(view)
    place(view, PLACES[1])
    simple.Render(view)
    assert eye_of(volume) == PLACES[0]
    volume.FollowCamera = 1
    simple.Render(view)
    assert eye_of(volume) == PLACES[1]
    simple.Delete(volume)


def check_links():
    """Links of properties, as Tools > Manage Links makes them, go on to work, out of a state file,
    too."""
    view = PluginTesting.make_view()
    refracted = make_filter()
    link = servermanager.vtkSMPropertyLink()
    link.AddLinkedProperty(view.SMProxy, "CameraPosition", 1)  # input
    link.AddLinkedProperty(refracted.SMProxy, "EyePosition", 2)  # output
    servermanager.ProxyManager().RegisterLink("Eye", link)
    simple.Show(refracted, view)
    simple.Render(view)
    place(view, PLACES[0])
    assert eye_of(refracted) == PLACES[0] and not refracted.FollowCamera
    path = os.path.join(os.environ["MENISCUS_OUTPUT_DIR"], "linked.pvsm")
    simple.SaveState(path)
    simple.ResetSession()
    simple.LoadState(path)
    view = simple.GetActiveView()
    refracted = simple.FindSource("RefractedGeometry1")
    assert eye_of(refracted) == PLACES[0] and not refracted.FollowCamera
    simple.Render(view)
    place(view, PLACES[1])
    assert eye_of(refracted) == PLACES[1], eye_of(refracted)


def test():
    PluginTesting.load_plugin()
    alone = make_filter()
    assert points_of(alone) and eye_of(alone) == (0, 0, 1), "without a view"
    simple.Delete(alone)
    view = PluginTesting.make_view()
    place(view, PLACES[0])
    refracted = make_filter()
    assert refracted.FollowCamera
    refracted.UpdatePipeline()
    assert eye_of(refracted) == PLACES[0], "before it is shown the active view counts"
    simple.Show(refracted, view)
    simple.Render(view)
    check_pictures(view, refracted)
    check_motion(view, refracted)
    check_views(view, refracted)
    check_downstream(view, refracted)
    check_culling(view, refracted)
    check_work(view, refracted)
    check_setting(view, refracted)
    check_slow(view, refracted)
    check_error_volume(view)
    simple.ResetSession()
    check_links()


if __name__ == "__main__":
    PluginTesting.run(test)
