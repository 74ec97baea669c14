# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A state file, that of another version, a Python script of the state and a trace give the image
that TestStateSave.py saved, bit for bit, and the eye of Refracted Geometry continues to follow the
camera; for the other version, which had no such eye, it keeps its position. The argument selects
one of them."""
import sys

import PluginTesting
import StateScene
from paraview import simple


def check_eye(view, follows):
    refracted, = [source for source in simple.GetSources().values()
                  if source.GetXMLName() == "RefractedGeometry"]
    assert refracted.FollowCamera == follows, "FollowCamera is %r" % refracted.FollowCamera
    assert list(refracted.EyePosition) == StateScene.EYE
    simple.Render(view)  # the first one resets the camera
    view.CameraPosition = [0, 3, 50]
    simple.Render(view)
    assert list(refracted.EyePosition) == ([0, 3, 50] if follows else StateScene.EYE)


def test():
    PluginTesting.load_plugin()
    saved = PluginTesting.read_pixels("State")
    kind = sys.argv[1]
    scripts = {"trace": StateScene.TRACE, "script": StateScene.SCRIPT}
    if kind in scripts:
        with open(scripts[kind]) as file:
            exec(compile(file.read(), scripts[kind], "exec"), {"__name__": kind})
    else:
        simple.LoadState({"state": StateScene.STATE, "older": StateScene.OLDER_STATE}[kind])
    view = simple.GetActiveView()
    assert view, "there is no view"
    pixels = PluginTesting.screenshot(view, "State" + kind)
    different = sum(a != b for a, b in zip(pixels, saved))
    assert not different, "%d pixels differ" % different
    check_eye(view, follows=kind != "older")


if __name__ == "__main__":
    PluginTesting.run(test)
