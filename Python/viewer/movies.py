# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Views that turn and time steps, as numbered pictures or as a movie."""
import importlib
import os
import tempfile

from vtkmodules.util.numpy_support import vtk_to_numpy

from .files import ReadingError
from .pictures import check_folder, draw_checked, grab_picture, make_window, write_picture

ORBIT_FRAMES = 120
FRAMES_PER_SECOND = 25
MOVIE_ENDINGS = (".mp4", ".gif", ".webm", ".mov", ".avi")


def _draw_frames(scene, size, orbit, transparent):
    """Yields the pictures of an orbit of so many frames around the upward axis, or of all time
    steps if orbit is None."""
    window = make_window(scene.renderer, size, offscreen=True, transparent=transparent)
    count = orbit or len(scene.series.get_times())
    if orbit:
        scene.reset_camera(turns=orbit)
    else:
        scene.set_step(0)
    yield draw_checked(scene, window, transparent)[0]
    for frame in range(1, count):
        if orbit:
            scene.renderer.GetActiveCamera().Azimuth(360.0 / orbit)
            scene.renderer.ResetCameraClippingRange()
        else:
            scene.set_step(frame)
        yield grab_picture(window, transparent)


def write_pictures(scene, size, name, orbit, transparent):
    """Writes NAME-000.png, NAME-001.png and so on for NAME.png."""
    stem, ending = os.path.splitext(name)
    for number, picture in enumerate(_draw_frames(scene, size, orbit, transparent)):
        write_picture(picture, f"{stem}-{number:03d}{ending or '.png'}")


def check_movie(name):
    """A movie that cannot be written is a ReadingError: its name, or the package that writes it."""
    try:
        importlib.import_module("imageio.v2")
    except ImportError:
        raise ReadingError("--movie needs the package imageio: pip install 'imageio[ffmpeg]'"
                           ) from None
    if os.path.splitext(name)[1].lower() not in MOVIE_ENDINGS:
        raise ReadingError(f"{name}: the ending of a movie is one of " + ", ".join(MOVIE_ENDINGS))
    check_folder(name)


def write_movie(scene, size, name, orbit):
    """Writes a movie by the package imageio. One time step and no orbit mean an orbit."""
    check_movie(name)
    import imageio.v2 as imageio
    if not orbit and len(scene.series.get_times()) == 1:
        orbit = ORBIT_FRAMES
    even = tuple(max(2, length - length % 2) for length in size)  # as codecs need it
    gif = name.lower().endswith(".gif")
    settings = {"duration": 1.0 / FRAMES_PER_SECOND, "loop": 0} if gif else {
        "fps": FRAMES_PER_SECOND}
    try:
        # The file gets its name when it is complete, so that one of before is not lost to an error.
        with tempfile.TemporaryDirectory(dir=os.path.dirname(os.path.abspath(name))) as folder:
            part = os.path.join(folder, os.path.basename(name))
            with imageio.get_writer(part, **settings) as writer:
                for picture in _draw_frames(scene, even, orbit, False):
                    pixels = vtk_to_numpy(picture.GetPointData().GetScalars())
                    writer.append_data(pixels.reshape(even[1], even[0], -1)[::-1, :, :3])
            os.replace(part, name)
    except (OSError, ValueError, ImportError, RuntimeError) as error:
        raise ReadingError(f"{name} cannot be written: {error} "
                           "(pip install 'imageio[ffmpeg]' brings an encoder)") from None
