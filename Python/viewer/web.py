# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A page that shows a MeshScene, drawn by the server (trame, trame-vuetify, trame-rca)."""
import asyncio
import ipaddress
import math
import secrets
import socket
import urllib.parse

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor, vtkWindowToImageFilter

from ..names import BLEND_MODES
from .colors import find_colors, list_colors
from .reading import ReadingError
from .scene import AXES
from .pictures import make_window
from .watching import PERIOD

PACKAGES = "trame trame-vuetify trame-rca"
# Without it the page has no curve of opacity.
CURVE_PACKAGE = "trame-color-opacity-editor"


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


def _send_places(curve):
    """Points as lists, as they come back from the page."""
    return [[place, opacity] for place, opacity in curve]


def _make_histogram(scene):
    """Steps (place, height) from 0 to 1; heights are roots, as in the window."""
    volumes = scene.get_histogram()
    heights = (volumes / (volumes.max() or 1.0)) ** 0.5
    return [[index / heights.size, float(height)] for index, height in enumerate(heights)] + [
        [1.0, 0.0]]


def _make_gradient(scene, count=33):
    low, high = scene.get_range()
    colors = scene.volume.GetProperty().GetRGBTransferFunction()
    return [[index / (count - 1), list(colors.GetColor(low + (high - low) * index / (count - 1)))]
            for index in range(count)]


def _describe_colors(name, count=9):
    """An entry of the menu of colour maps, with its strip of colours for a style sheet."""
    colors = find_colors(name)
    picked = [colors[index * (len(colors) - 1) // (count - 1)] for index in range(count)]
    stops = ", ".join("rgb(%d, %d, %d)" % tuple(round(255.0 * value) for value in color)
                      for color in picked)
    return {"title": name, "value": name, "strip": f"linear-gradient(to right, {stops})"}


class _Page:
    """The settings of a MeshScene as the state of a trame server."""

    def __init__(self, server, scene):
        self.state, self.controller, self.scene = server.state, server.controller, scene
        self.state.message = ""
        self.state.trame__title = "Meniscus"
        self._bind("array", scene.array, self._set_array)
        self._bind("colors", scene.colors, scene.set_colors)
        self._bind("blend", scene.blend, scene.set_blend)
        self._bind("density", math.log10(scene.density),
                   lambda value: scene.set_density(10.0 ** float(value)))
        self._bind("lit", scene.is_lit(), scene.set_lit)
        self._bind("share", scene.clip_share, self._clip)
        self._bind("clip", scene.clip_axis or "none", self._clip)
        self._bind("step", scene.step, self._set_step)
        for name in scene.furniture.NAMES:
            self._bind(name, scene.furniture.get(name),
                       lambda shown, name=name: scene.furniture.set(name, shown))
        self._bind("curve", _send_places(scene.get_curve()), self._set_curve)
        self.send_functions()

    def _bind(self, name, value, apply):
        self.state[name] = value

        @self.state.change(name)
        def changed(**values):
            self.apply(lambda: apply(values[name]))

    def apply(self, action):
        """Changes the scene, and shows it or the reason why it cannot be changed."""
        try:
            action()
            self.state.message = ""
        except ReadingError as error:
            self.state.message = str(error)
        self.send_functions()
        self.controller.draw()

    def _set_array(self, name):
        # Setting the same one again would lose the range of the command line.
        if name != self.scene.array:
            self.scene.set_array(name)

    def _set_step(self, step):
        if int(step) != self.scene.step:
            self.scene.set_step(int(step))

    def _clip(self, _):
        axis = None if self.state.clip == "none" else self.state.clip
        self.scene.set_clip(axis, float(self.state.share))

    def _set_curve(self, points):
        if points != _send_places(self.scene.get_curve()):
            self.scene.set_curve(points)

    def reset_curve(self):
        self.apply(lambda: self.scene.set_curve(None))

    def send_functions(self):
        """The curve, its background and its labels, for the array and the mode that are shown."""
        low, high = self.scene.get_range()
        self.state.curve = _send_places(self.scene.get_curve())
        self.state.gradient = _make_gradient(self.scene)
        self.state.histogram = _make_histogram(self.scene)
        self.state.labels = [f"{low:.4g}", self.scene.get_title(), f"{high:.4g}"]


def _add_colors(scene, html, vuetify3):
    """The menu of colour maps, which can be searched by name."""
    names = dict.fromkeys([*list_colors(), scene.colors])
    items = [_describe_colors(name) for name in names]
    with vuetify3.VAutocomplete(v_model=("colors",), label="Colours", classes="colors",
                                items=("colors_items", items), density="compact"):
        with vuetify3.Template(v_slot_item="{ item, props }"):
            with vuetify3.VListItem(v_bind="props"):
                html.Div(style=("{ background: item.raw.strip, height: '8px' }",))


def _add_settings(page, html, vuetify3):
    """The drawer of the page."""
    scene, steps = page.scene, len(page.scene.series.get_times())

    def add_menu(name, label, items):
        vuetify3.VSelect(v_model=(name,), label=label, items=(name + "_items", items),
                         density="compact")

    add_menu("array", "Array", scene.get_arrays())
    _add_colors(scene, html, vuetify3)
    add_menu("blend", "Mode", list(BLEND_MODES))
    add_menu("clip", "Cut along", ["none", *AXES])
    vuetify3.VSlider(v_model=("share",), label="Cut", min=0, max=1, step=0.01, classes="cut",
                     density="compact")
    vuetify3.VSlider(v_model=("density",), label="Density", min=-2, max=2, step=0.05,
                     classes="density", density="compact")
    for name in ("lit", *scene.furniture.NAMES):
        vuetify3.VSwitch(v_model=(name,), label="Light" if name == "lit" else name.capitalize(),
                         density="compact", hide_details=True, inset=True, classes=name)
    if steps > 1:
        vuetify3.VSlider(v_model=("step",), label="Time step", min=0, max=steps - 1, step=1,
                         density="compact")
    vuetify3.VAlert("{{ message }}", v_if=("message",), type="error")


def _add_curve(page, html, vuetify3, editor):
    """The strip below the picture."""
    with html.Div(style="height: 160px; width: 100%; padding: 4px 12px", classes="curve"):
        editor.ColorOpacityEditor(
            v_model_colorNodes=("gradient",), v_model_opacityNodes=("curve",),
            scalar_range=("[0, 1]",), histograms=("histogram",), histograms_range=("[0, 1]",),
            show_histograms=("true",), background_shape="opacity", show_color_editor=("false",),
            style="height: 120px; width: 100%")
        with html.Div(classes="d-flex justify-space-between align-center text-caption"):
            html.Span("{{ labels[0] }}")
            html.Span("opacity of {{ labels[1] }}")
            vuetify3.VBtn("Default curve", click=page.reset_curve, size="x-small", variant="text")
            html.Span("{{ labels[2] }}")


def _guard(is_local):
    """A handler of requests that refuses requests of other pages in the user's browser: a socket is
    not bound to the page that opens it. is_local: the page is for this machine only."""
    from aiohttp import web

    @web.middleware
    async def check(request, handler):
        origin = request.headers.get("Origin")
        other = origin is not None and urllib.parse.urlsplit(origin).netloc != request.host
        # A foreign name that leads to this machine.
        foreign = is_local and not _is_this_machine(_name_of(request.host))
        if other or foreign:
            raise web.HTTPForbidden
        return await handler(request)

    return check


def _name_of(host):
    """A host without its port and without brackets."""
    return urllib.parse.urlsplit("//" + host).hostname or ""


def make_server(scene, is_local=True):
    """The trame server of a page with controls for the scene, and its _Page.

    is_local: the page is for this machine only.
    """
    try:
        from trame.app import get_server
        from trame.ui.vuetify3 import SinglePageWithDrawerLayout
        from trame.widgets import client, html, rca, vuetify3
    except ImportError as error:
        raise ReadingError(f"--web needs the packages {PACKAGES}: pip install {PACKAGES} ({error})"
                           ) from None
    try:
        from trame.widgets import color_opacity_editor as editor
    except ImportError:
        editor = None
    server = get_server(client_type="vue3")
    remote = _RemoteWindow(make_window(scene.renderer, (800, 600), offscreen=True))
    page = _Page(server, scene)

    @server.controller.add("on_server_bind")
    def bind(wslink_server):
        wslink_server.app.router.add_post("/paraview/", _answer_launcher)
        wslink_server.app.middlewares.append(_guard(is_local))

    with SinglePageWithDrawerLayout(server) as layout:
        layout.title.set_text("Meniscus")
        layout.footer.hide()
        client.Style("html { overflow-y: auto !important; }")  # no empty scroll bar
        with layout.drawer:
            with vuetify3.VContainer():
                _add_settings(page, html, vuetify3)
                if editor is None:
                    html.Div(f"For a curve of opacity: pip install {CURVE_PACKAGE}",
                             classes="text-caption")
        with layout.content:
            with vuetify3.VContainer(fluid=True,
                                     classes="pa-0 fill-height flex-column flex-nowrap"):
                with html.Div(style="flex: 1 1 0; min-height: 0; width: 100%; overflow: hidden"):
                    area = rca.RemoteControlledArea(
                        display="image", style="width: 100%; height: 100%",
                        image_style=("{ width: '100%', height: '100%' }",))
                view = area.create_view_handler(remote, encoder="jpeg")
                server.controller.draw = view.update
                if editor is not None:
                    _add_curve(page, html, vuetify3, editor)
    return server, page


def _is_this_machine(host):
    """Whether only this machine can reach an address."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def find_address(host):
    """The address itself, or 127.0.0.1 for a "localhost" that this system does not know: a minimal
    container has no /etc/hosts."""
    if host == "localhost":
        try:
            socket.getaddrinfo(host, None)
        except OSError:
            return "127.0.0.1"
    return host


def _check_free(host, port):
    """Raises a ReadingError if nothing can listen at an address."""
    try:
        family, kind, _, _, address = socket.getaddrinfo(
            host or None, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)[0]
        with socket.socket(family, kind) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind(address)
    except OSError as error:
        raise _unusable(host, port, error) from None


def _unusable(host, port, error):
    return ReadingError(f"The page cannot be served at {host}, port {port}: {error.strerror} "
                        "(--port NUMBER chooses another port)")


async def _follow(page, watch):
    while True:
        await asyncio.sleep(PERIOD)
        with page.state:
            answer = watch.reload()
            if answer is not None:
                page.apply(lambda: None)
                page.state.message = answer


def serve(scene, host, port, watch=None):
    """Serves the page of a scene until the process is ended.

    host: address to listen at. At an address that others can reach the page needs a secret, which
    is made here and printed once, in the address of the page.
    watch: a Watch of the scene, for files that change.
    """
    host = find_address(host)
    is_local = _is_this_machine(host)
    server, page = make_server(scene, is_local)
    _check_free(host, port)
    secret = "" if is_local else secrets.token_urlsafe(24)
    if secret:
        server.cli.set_defaults(authKey=secret)  # which the page sends before anything else
    name = host if host not in ("", "0.0.0.0", "::") else socket.gethostname()
    name = f"[{name}]" if ":" in name else name
    tasks = []

    @server.controller.add("on_server_ready")
    def ready(**_):
        query = f"?secret={secret}" if secret else ""
        print(f"The page is at http://{name}:{server.port}/{query}", flush=True)
        if watch:
            tasks.append(asyncio.get_running_loop().create_task(_follow(page, watch)))

    try:
        server.start(host=host, port=port, open_browser=False, show_connection_info=False)
    except OSError as error:
        raise _unusable(host, port, error) from None
