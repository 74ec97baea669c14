# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A page that shows a MeshScene, drawn by the server (trame, trame-vuetify, trame-rca)."""
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor, vtkWindowToImageFilter

from ..names import BLEND_MODES
from .colors import COLOR_MAPS
from .reading import ReadingError
from .scene import AXES
from .window import make_window

PACKAGES = "trame trame-vuetify trame-rca"


class _RemoteWindow:
    """A render window as trame-rca asks for it: pictures out, events of mouse and size in.

    trame-rca's own class needs VTK's web module, which Debian's VTK lacks.
    """

    _EVENTS = {"LeftButtonPress", "LeftButtonRelease", "MiddleButtonPress", "MiddleButtonRelease",
               "RightButtonPress", "RightButtonRelease", "MouseMove"}

    def __init__(self, window):
        self.window = window
        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(window)
        self.interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
        self.interactor.EnableRenderOff()
        self.interactor.Initialize()
        self.picture = vtkWindowToImageFilter()
        self.picture.SetInput(window)
        self.picture.ReadFrontBufferOff()
        self.picture.ShouldRerenderOff()

    @property
    def img_cols_rows(self):
        self.window.Render()
        self.picture.Modified()
        self.picture.Update()
        image = self.picture.GetOutput()
        columns, rows, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape((rows, columns, -1))
        return pixels[::-1].copy(), columns, rows

    def process_resize_event(self, width, height):
        self.window.SetSize(width, height)
        self.interactor.UpdateSize(width, height)

    def process_interaction_event(self, event):
        kind = event["type"]
        if kind == "MouseWheel":
            up = event.get("spinY", 0.0) < 0.0
            self.interactor.InvokeEvent("MouseWheelForwardEvent" if up
                                        else "MouseWheelBackwardEvent")
        elif kind in self._EVENTS:
            self.interactor.SetEventInformation(
                int(event["x"]), int(event["y"]), int(event.get("ctrlKey", 0)),
                int(event.get("shiftKey", 0)))
            self.interactor.InvokeEvent(kind + "Event")


async def _answer_launcher(request):
    """Names the socket to the page, which asks a launcher of sessions first.

    Without an answer it connects all the same, after an error in the browser's console.
    """
    from aiohttp import web
    return web.json_response({"sessionURL": f"ws://{request.host}/ws"})


def make_server(scene):
    """The trame server of a page with controls for the scene; start it with start()."""
    try:
        from trame.app import get_server
        from trame.ui.vuetify3 import SinglePageWithDrawerLayout
        from trame.widgets import rca, vuetify3
    except ImportError as error:
        raise ReadingError(f"--web needs the packages {PACKAGES}: pip install {PACKAGES} ({error})"
                           ) from None
    server = get_server(client_type="vue3")
    state, controller = server.state, server.controller
    remote = _RemoteWindow(make_window(scene, (800, 600), offscreen=True))
    steps = len(scene.series.get_times())

    def on_change(name, apply):
        @state.change(name)
        def changed(**values):
            try:
                apply(values[name])
                state.message = ""
            except ReadingError as error:
                state.message = str(error)
            controller.draw()

    state.message = ""
    state.trame__title = "Meniscus"
    settings = (
        ("array", scene.array, scene.set_array),
        ("colors", scene.colors, scene.set_colors),
        ("blend", scene.blend, scene.set_blend),
        ("density", 0.0, lambda value: scene.set_density(10.0 ** float(value))),
        ("lit", scene.is_lit(), scene.set_lit),
        ("clip", "none", lambda axis: scene.set_clip(None if axis == "none" else axis,
                                                     float(state.share))),
        ("share", 0.5, lambda share: scene.set_clip(None if state.clip == "none" else state.clip,
                                                    float(share))),
        ("step", scene.step, lambda step: scene.set_step(int(step))),
    )
    for name, value, apply in settings:
        state[name] = value
        on_change(name, apply)

    @controller.add("on_server_bind")
    def bind(wslink_server):
        wslink_server.app.router.add_post("/paraview/", _answer_launcher)

    with SinglePageWithDrawerLayout(server) as layout:
        layout.title.set_text("Meniscus")
        layout.footer.hide()
        with layout.drawer:
            with vuetify3.VContainer():
                for name, label, items in (
                        ("array", "Array", scene.get_arrays()),
                        ("colors", "Colours", list(COLOR_MAPS)),
                        ("blend", "Mode", list(BLEND_MODES)),
                        ("clip", "Cut along", ["none", *AXES])):
                    vuetify3.VSelect(v_model=(name,), label=label, items=(name + "_items", items),
                                     density="compact")
                vuetify3.VSlider(v_model=("share",), label="Cut", min=0, max=1, step=0.01,
                                 classes="cut", density="compact")
                vuetify3.VSlider(v_model=("density",), label="Density", min=-2, max=2, step=0.05,
                                 classes="density", density="compact")
                vuetify3.VSwitch(v_model=("lit",), label="Light", density="compact")
                if steps > 1:
                    vuetify3.VSlider(v_model=("step",), label="Time step", min=0, max=steps - 1,
                                     step=1, density="compact")
                vuetify3.VAlert("{{ message }}", v_if=("message",), type="error")
        with layout.content:
            with vuetify3.VContainer(fluid=True, classes="pa-0 fill-height"):
                area = rca.RemoteControlledArea(display="image", style="width: 100%; height: 100%",
                                                image_style=("{ width: '100%', height: '100%' }",))
                view = area.create_view_handler(remote, encoder="jpeg")
                controller.draw = view.update
    return server
