# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A window with keys and sliders."""
import itertools
import math
import os

from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkInteractionWidgets import vtkSliderRepresentation2D, vtkSliderWidget
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindowInteractor, vtkTextActor

from .. import vtkTetrahedraVolumePicker
from ..names import BLEND_MODES
from .chart import HEIGHT, OpacityChart
from .colors import COLOR_MAPS
from .files import ReadingError
from .furniture import INK
from .pictures import grab_picture, make_window, write_picture
from .scene import AXES, shorten
from .watching import PERIOD

KEYS = """a      next array
c      next colour map
b      next blend mode
i      isosurfaces
l      light
+ -    denser, thinner
x y z  cut at the middle, or no cut
< >    move the cut
, .    time step
v      value under the cursor
o g e  outline, axes, edges
t      histogram and curve
d      default curve
r      whole mesh
s      save picture
h      this help
q      quit"""
DENSITY_STEP = 1.25
CLIP_STEP = 0.05
# Height of the sliders above the strip, as a share of the window's.
_SLIDER_HEIGHT = 0.09


def _next_of(names, name, forward=True):
    names = list(names)
    if name not in names:
        return names[0]
    return names[(names.index(name) + (1 if forward else -1)) % len(names)]


class Window:
    """A MeshScene in a window with the keys of KEYS, sliders for density and time, and a strip with
    the histogram and the curve of opacity."""

    def __init__(self, scene, size=(1024, 768), offscreen=False, watch=None):
        """watch: a Watch of the scene, for files that change."""
        self.scene = scene
        self.watch = watch
        self.window = make_window(scene.renderer, size, offscreen)
        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self._trackball = vtkInteractorStyleTrackballCamera()
        self.chart = OpacityChart(scene, self._tell)
        self.window.AddRenderer(self.chart.renderer)
        # Replaces the styles' own keys.
        for style in (self._trackball, self.chart.style):
            style.AddObserver("CharEvent", lambda *_: None)
        self.interactor.SetInteractorStyle(self._trackball)
        # Before the styles, whose priority is 0.
        for event in ("MouseMoveEvent", "EnterEvent"):
            self.interactor.AddObserver(event, self._choose_style, 1.0)
        self._buttons, self._on_chart = set(), False
        for name in ("Left", "Middle", "Right"):
            self.interactor.AddObserver(name + "ButtonPressEvent", self._note_button, 1.0)
            self.interactor.AddObserver(name + "ButtonReleaseEvent", self._note_button, 1.0)
        self.interactor.AddObserver("KeyPressEvent", self._press)
        self.window.AddObserver("AbortCheckEvent", self._check_abort)
        self.message = vtkTextActor()
        self.message.GetTextProperty().SetColor(*INK)
        self.message.GetTextProperty().SetFontSize(16)
        self.message.SetPosition(12, 12)
        self.scene.renderer.AddViewProp(self.message)
        self.help = vtkTextActor()
        self.help.SetInput(KEYS)
        text = self.help.GetTextProperty()
        text.SetFontFamilyToCourier()
        text.SetFontSize(16)
        text.SetColor(*INK)
        text.SetVerticalJustificationToTop()
        self.help.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
        self.help.SetPosition(0.02, 0.97)
        self.help.VisibilityOff()
        self.scene.renderer.AddViewProp(self.help)
        self.actions = self._make_actions()
        # Sliders are wrong in renderers that do not begin in the corner of the window.
        self._overlay = vtkRenderer()
        self._overlay.SetLayer(1)
        self._overlay.InteractiveOff()
        self.window.SetNumberOfLayers(2)
        self.window.AddRenderer(self._overlay)
        self._sliders = []
        self._show_chart(True)
        self._density = self._add_slider("density", -2.0, 2.0, math.log10(scene.density), 0.10,
                                         self._slide_density)
        self._time = None
        self._update_time()
        self._tell()

    def _update_time(self):
        """Shows the time step, if there are several."""
        last = len(self.scene.series.get_times()) - 1
        if last > 0 and self._time is None:
            self._time = self._add_slider("time step", 0, last, 0, 0.40, self._slide_time)
        if self._time is not None:
            self._time.SetMaximumValue(max(last, 1))
            self._time.SetValue(self.scene.step)

    def _show_chart(self, shown):
        self._has_chart = shown
        self.chart.set_visible(shown)
        self.scene.renderer.SetViewport(0.0, HEIGHT if shown else 0.0, 1.0, 1.0)
        for slider in self._sliders:
            self._place(slider.GetRepresentation())

    def _place(self, look):
        """Puts a slider above the strip."""
        height = _SLIDER_HEIGHT + (HEIGHT if self._has_chart else 0.0)
        for point in (look.GetPoint1Coordinate(), look.GetPoint2Coordinate()):
            point.SetValue(point.GetValue()[0], height)
        look.Modified()

    def _note_button(self, _interactor, event):
        name, pressed = event.split("Button")[0], "Press" in event
        (self._buttons.add if pressed else self._buttons.discard)(name)

    @staticmethod
    def _check_abort(window, _event):
        """Gives up a still picture when a button is pressed; the next one goes on with it."""
        if window.GetEventPending():
            window.SetAbortRender(1)

    def _choose_style(self, interactor, _event):
        """The strip and the volume have different styles; what a drag begins with, it keeps."""
        if self._buttons:
            return
        on_chart = (self._has_chart
                    and interactor.GetEventPosition()[1] < HEIGHT * self.window.GetSize()[1])
        if on_chart and not self._on_chart:
            self.chart.activate(interactor)
        elif self._on_chart and not on_chart:
            self.chart.deactivate(interactor, self._trackball)
        self._on_chart = on_chart

    def _make_actions(self):
        scene = self.scene
        actions = {
            "a": lambda: scene.set_array(_next_of(scene.get_arrays(), scene.array)),
            "c": lambda: scene.set_colors(_next_of(COLOR_MAPS, scene.colors)),
            "b": lambda: scene.set_blend(_next_of(BLEND_MODES, scene.blend)),
            "i": self._toggle_isosurfaces,
            "l": lambda: scene.set_lit(not scene.is_lit()),
            "plus": lambda: self._change_density(DENSITY_STEP),
            "minus": lambda: self._change_density(1.0 / DENSITY_STEP),
            "less": lambda: self._move_clip(-CLIP_STEP),
            "greater": lambda: self._move_clip(CLIP_STEP),
            "comma": lambda: self._go_by(-1),
            "period": lambda: self._go_by(1),
            "r": scene.reset_camera,
            "v": self._pick,
            "t": lambda: self._show_chart(not self._has_chart),
            "d": lambda: scene.set_curve(None),
            "s": self._save,
            "h": lambda: self.help.SetVisibility(not self.help.GetVisibility()),
            "q": self.interactor.TerminateApp,
        }
        for axis in AXES:
            actions[axis] = lambda axis=axis: scene.set_clip(
                None if scene.clip_axis == axis else axis)
        for key, name in (("o", "outline"), ("g", "axes"), ("e", "edges")):
            actions[key] = lambda name=name: scene.furniture.set(
                name, not scene.furniture.get(name))
        return actions

    def _add_slider(self, title, low, high, value, left, changed):
        look = vtkSliderRepresentation2D()
        look.SetMinimumValue(low)
        look.SetMaximumValue(high)
        look.SetValue(value)
        look.SetTitleText(title)
        look.ShowSliderLabelOff()
        look.SetTubeWidth(0.004)
        look.SetSliderLength(0.012)
        look.SetSliderWidth(0.018)
        look.SetEndCapWidth(0.0)
        look.SetTitleHeight(0.018)
        look.GetTitleProperty().SetColor(*INK)
        look.GetTitleProperty().ShadowOff()
        look.GetTubeProperty().SetColor(0.5, 0.55, 0.6)
        look.GetSliderProperty().SetColor(0.1, 0.35, 0.65)
        for point, x in ((look.GetPoint1Coordinate(), left), (look.GetPoint2Coordinate(),
                                                              left + 0.25)):
            point.SetCoordinateSystemToNormalizedDisplay()
            point.SetValue(x, 0.0)
        self._place(look)
        widget = vtkSliderWidget()
        widget.SetInteractor(self.interactor)
        widget.SetDefaultRenderer(self._overlay)
        widget.SetCurrentRenderer(self._overlay)
        widget.SetRepresentation(look)
        widget.SetAnimationModeToJump()
        widget.AddObserver("InteractionEvent", lambda *_: self._apply(changed))
        widget.EnabledOn()
        self._sliders.append(widget)
        return look

    def _slide_density(self):
        self.scene.set_density(10.0 ** self._density.GetValue())

    def _slide_time(self):
        step = round(self._time.GetValue())
        if step != self.scene.step:
            self.scene.set_step(step)

    def _change_density(self, factor):
        self.scene.set_density(self.scene.density * factor)

    def _toggle_isosurfaces(self):
        self.scene.set_blend("composite" if self.scene.blend == "isosurface" else "isosurface")

    def _move_clip(self, change):
        if self.scene.clip_axis is not None:
            share = min(1.0, max(0.0, self.scene.clip_share + change))
            self.scene.set_clip(self.scene.clip_axis, share)

    def _go_by(self, change):
        steps = len(self.scene.series.get_times())
        self.scene.set_step((self.scene.step + change) % steps)
        self._update_time()

    def _pick(self):
        picker = vtkTetrahedraVolumePicker()
        if not picker.Pick(*self.interactor.GetEventPosition(), 0, self.scene.renderer):
            return "Nothing is under the cursor"
        place = ", ".join(f"{x:.4g}" for x in picker.GetPickPosition())
        name = self.scene.shown.name_of(shorten(self.scene.array))
        return f"{name} {picker.GetValue():.5g} at ({place}), cell {picker.GetCellId()}"

    def _save(self):
        """Writes a picture to a new file."""
        names = itertools.chain(["meniscus.png"], (f"meniscus-{n}.png" for n in itertools.count(2)))
        name = next(name for name in names if not os.path.exists(name))
        write_picture(grab_picture(self.window), name)
        return f"wrote {name}"

    def _apply(self, action):
        """Runs an action; shows the text that it returns, or the state of the scene."""
        try:
            answer = action()
            if isinstance(answer, str):
                self.message.SetInput(answer)
            else:
                self._tell()
        except ReadingError as error:
            self.message.SetInput(str(error))
        self.window.Render()

    def _press(self, interactor, _event):
        action = self.actions.get(interactor.GetKeySym())
        if action is not None:
            self._apply(action)

    def _tell(self):
        scene = self.scene
        parts = [shorten(scene.array), scene.blend]
        times = scene.series.get_times()
        if len(times) > 1:
            parts.append(f"time {times[scene.step]:g} ({scene.step + 1} of {len(times)})")
        if scene.clip_axis is not None:
            parts.append(f"cut along {scene.clip_axis}")
        self.message.SetInput("   ".join(parts) + "   (h: help)")
        self.chart.update()

    def look(self, *_):
        """Shows the files again if they have changed."""
        answer = self.watch.reload()
        if answer is not None:
            self._update_time()
            self._apply(lambda: answer or None)

    def start(self):
        """Shows the window until q is pressed or the window is closed."""
        try:
            self._interact()
        finally:
            self.close()

    def close(self):
        """Releases the graphics context now. The window and its observers refer to each other, so
        that Python would destroy them at any later time, perhaps while another window draws."""
        self.interactor.SetInteractorStyle(None)
        self.window.Finalize()

    def _interact(self):
        self.window.Render()
        if self.watch:
            self.interactor.Initialize()
            self.interactor.AddObserver("TimerEvent", self.look)
            self.interactor.CreateRepeatingTimer(int(1000 * PERIOD))
        self.interactor.Start()
