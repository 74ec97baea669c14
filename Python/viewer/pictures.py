# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a scene without a window on the screen."""
import ctypes
import os
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter

from .files import ReadingError, collecting_reports

# Windows of VTK 9.4 and later that need no display, by their library, and the variable that selects
# one.
HEADLESS_WINDOWS = {
    "libEGL.so.1": "vtkEGLRenderWindow",
    "libOSMesa.so.8": "vtkOSOpenGLRenderWindow",
}
WINDOW_VARIABLE = "VTK_DEFAULT_OPENGL_WINDOW"
# Level of zlib. The writer's default, 5, takes a quarter longer for files that are 5 % smaller.
_COMPRESSION = 4


def _can_load(library):
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _choose_headless_window():
    """Without a display, VTK tries X first, with warnings, and crashes if libX11 is missing."""
    if (os.environ.get("DISPLAY") or os.environ.get(WINDOW_VARIABLE)
            or not sys.platform.startswith("linux")
            or vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() < 904):
        return
    for library, window in HEADLESS_WINDOWS.items():
        if _can_load(library):
            os.environ[WINDOW_VARIABLE] = window
            return
    raise ReadingError("There is no display, and neither EGL nor OSMesa to draw without one "
                       "(on Debian: apt-get install libegl1 libgl1-mesa-dri)")


def make_window(renderer, size, offscreen, transparent=False):
    """A window with a renderer. transparent: its background is, in pictures."""
    if offscreen:
        _choose_headless_window()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(offscreen)
    window.SetSize(*size)
    window.SetMultiSamples(0 if offscreen else 4)
    if transparent:
        window.SetAlphaBitPlanes(True)
        renderer.GradientBackgroundOff()
        renderer.SetBackground(0.0, 0.0, 0.0)
        renderer.SetBackgroundAlpha(0.0)
    window.SetWindowName("Meniscus")
    window.AddRenderer(renderer)
    return window


def grab_picture(window, transparent=False):
    """The picture of a window after a frame, as vtkImageData, with opacities if it is
    transparent."""
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.ShouldRerenderOff()
    if transparent:
        picture.SetInputBufferTypeToRGBA()
    picture.Update()
    return picture.GetOutput()


def check_folder(name):
    """A file whose folder does not exist is a ReadingError."""
    folder = os.path.dirname(name)
    if folder and not os.path.isdir(folder):
        raise ReadingError(f"{name}: there is no folder '{folder}'")


def check_picture(name):
    """The name of a picture that cannot be written is a ReadingError."""
    ending = os.path.splitext(name)[1]
    if ending and ending.lower() != ".png":
        raise ReadingError(f"{name}: pictures are PNG files, whose names end in '.png'")
    check_folder(name)


def write_picture(picture, name):
    """Writes a PNG file; a file that cannot be written, and the ending of another format, is a
    ReadingError."""
    check_picture(name)
    try:
        with open(name, "wb"):
            pass
    except OSError as error:
        raise ReadingError(f"{name}: {error.strerror}") from None
    writer = vtkPNGWriter()
    writer.SetInputData(picture)
    writer.SetFileName(name)
    writer.SetCompressionLevel(_COMPRESSION)
    writer.Write()


def draw_picture(scene, size, transparent=False):
    """The picture of a scene without a window on the screen, and VTK's warnings about it. A picture
    that shows nothing of the mesh is a ReadingError."""
    return draw_checked(scene, make_window(scene.renderer, size, True, transparent), transparent)


def draw_checked(scene, window, transparent=False):
    """The same as draw_picture(), in a window that exists."""
    with collecting_reports() as reports:
        picture = grab_picture(window, transparent)
        scene.volume.VisibilityOff()
        without = grab_picture(window, transparent)
        scene.volume.VisibilityOn()
        errors, warnings = reports()
    pixels = [vtk_to_numpy(image.GetPointData().GetScalars()) for image in (picture, without)]
    if (pixels[0] == pixels[1]).all():
        reasons = [errors[0] if errors else scene.explain_empty_picture(), *warnings]
        raise ReadingError("The picture shows nothing of the mesh: "
                           + ". ".join(reason.rstrip(".") for reason in reasons))
    return picture, errors + warnings
