# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The command `meniscus MESH [...]`.

Modules for a window, movies and comparisons are loaded when they are needed: their parts of VTK
take a third of the time in which all modules are loaded.
"""
import argparse
import math
import os
import sys

from .. import __version__
from ..names import BACKENDS, BLEND_MODES
from .colors import COLOR_MAPS
from .files import collecting_reports
from .guard import run_guarded
from .options import OptionParser
from .pictures import check_picture, draw_picture, grab_picture, write_picture
from .reading import MeshSeries, ReadingError, read_surface
from .scene import AXES, MeshScene

DESCRIPTION = """Draws a mesh of tetrahedra or other cells as a volume. Several files are the time
steps of one mesh. In the window, h shows the keys."""
EXAMPLES = """examples:
  meniscus demo                                  a mesh that comes with the package
  meniscus case.vtu --array T --cmap inferno     a window
  meniscus case.vtu --isovalues 300 350 --edges  isosurfaces
  meniscus case.vtu --shadows --output case.png  a picture, no window
  meniscus step*.vtu --movie steps.mp4           the time steps as a movie"""
# Pixels along a side that OpenGL draws everywhere at once: larger pictures are cut off, or exceed
# the memory.
_LARGEST_SIZE = 16384
_WATER = 1.333  # index of refraction


def _size(text):
    parts = text.lower().split("x")
    if len(parts) != 2 or not all(part.strip().lstrip("-").isdecimal() for part in parts):
        raise argparse.ArgumentTypeError(f"'{text}' is no size, such as 800x600")
    size = tuple(map(int, parts))
    if min(size) < 1 or max(size) > _LARGEST_SIZE:
        raise argparse.ArgumentTypeError(f"both sizes must be from 1 to {_LARGEST_SIZE}")
    return size


def _whole_number(text):
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number") from None


def _count(text):
    count = _whole_number(text)
    if count < 1:
        raise argparse.ArgumentTypeError("at least one frame is needed")
    return count


def _port(text):
    port = _whole_number(text)
    if not 0 <= port <= 65535:
        raise argparse.ArgumentTypeError("a port is a number from 0 to 65535")
    return port


def make_parser():
    parser = OptionParser(prog="meniscus", usage="meniscus [OPTION ...] MESH [MESH ...]",
                          description=DESCRIPTION, epilog=EXAMPLES,
                          formatter_class=argparse.RawDescriptionHelpFormatter)
    _add_look(parser)
    _add_view(parser)
    _add_output(parser)
    return parser


def _add_look(parser):
    parser.add_argument("mesh", nargs="*", metavar="MESH",
                        help="file of a mesh, or a collection (.pvd, .series); demo: a mesh that "
                        "comes with the package")
    parser.add_argument("--config", metavar="FILE.toml",
                        help="file with options by the names of this list, and mesh; the command "
                        "line goes before, and --no-NAME leaves out the file's option NAME")
    parser.add_argument("--version", action="version", version="meniscus " + __version__)
    parser.start_group("values, colours and opacity")
    parser.add_argument("--array", help="array to show; default: the first one")
    parser.add_argument("--range", type=float, nargs=2, metavar=("LOW", "HIGH"),
                        help="range of the colour map; default: that of the values")
    parser.add_argument("--cmap", "--colors", dest="colors", default=COLOR_MAPS[0], metavar="NAME",
                        offers=COLOR_MAPS,
                        help="colour map: " + ", ".join(COLOR_MAPS) + ", or a name of matplotlib, "
                        "cmocean, colorcet or trame-colormaps where they are installed")
    parser.add_argument("--opacity", type=float, nargs="+", metavar="VALUE",
                        help="opacities from 0 to 1 at equal distances over the range, each over a "
                        "tenth of the mesh's diagonal; default: the rarer a value, the more "
                        "opaque")
    parser.add_argument("--blend", metavar="MODE", offers=BLEND_MODES,
                        help="blend mode: " + ", ".join(BLEND_MODES) + "; default: composite, with "
                        "--isovalues isosurface")
    parser.add_argument("--isovalues", type=float, nargs="+", metavar="VALUE",
                        help="isosurfaces of these values")
    parser.add_argument("--density", type=float, default=1.0, metavar="FACTOR",
                        help="makes the volume denser (above 1) or thinner; default: 1")
    parser.add_argument("--light", action="store_true", help="lights the volume")
    parser.add_argument("--shadows", action="store_true",
                        help="lights the volume, which casts shadows into itself")
    parser.start_group("what is shown with it")
    parser.add_argument("--outline", action="store_true", help="shows the box around the mesh")
    parser.add_argument("--axes", action="store_true", help="shows axes with numbers")
    parser.add_argument("--edges", action="store_true", help="shows the edges of the surface")
    parser.add_argument("--units", nargs="+", default=(), metavar="UNIT",
                        help="units of lengths, and of the array: --units m K")


def _add_view(parser):
    parser.start_group("part and view")
    parser.add_argument("--clip", metavar="AXIS[:SHARE]",
                        help="removes the part below a share (default 0.5) of the extent along "
                        + ", ".join(AXES))
    parser.add_argument("--step", type=_whole_number, default=0, metavar="NUMBER",
                        help="time step, from 0; negative: from the last one back")
    parser.add_argument("--water", metavar="SURFACE",
                        help="file of a refracting surface through which the volume is seen; its "
                        "normals point to the eye's side")
    parser.add_argument("--index", type=float,
                        help=f"index of refraction behind the surface; default: {_WATER}")
    parser.add_argument("--backend", default="automatic", metavar="NAME", offers=BACKENDS,
                        help="caster of rays: " + ", ".join(BACKENDS))
    parser.add_argument("--view", type=float, nargs=3, metavar=("X", "Y", "Z"),
                        default=(1.0, 0.7, 1.0),
                        help="vector from the mesh to the eye; default: 1 0.7 1")
    parser.add_argument("--zoom", type=float, default=1.0, metavar="FACTOR",
                        help="enlarges the mesh; default: 1, all of it fits into the picture")
    parser.add_argument("--up", choices=list(AXES), default="y", help="upward axis; default: y")
    parser.add_argument("--size", type=_size, default=(1024, 768), metavar="WxH",
                        help="size of the window or picture; default: 1024x768")


def _add_output(parser):
    parser.start_group("pictures, movies, pages")
    parser.add_argument("--output", metavar="PICTURE.png",
                        help="writes a picture and opens no window")
    parser.add_argument("--transparent", action="store_true",
                        help="pictures have a transparent background")
    parser.add_argument("--orbit", type=_count, metavar="FRAMES",
                        help="so many pictures, or frames of the movie, once around the mesh")
    parser.add_argument("--movie", metavar="FILE.mp4",
                        help="writes a movie of the time steps or of an orbit (.mp4, .gif, ...)")
    parser.add_argument("--watch", action="store_true",
                        help="reads the files again when they change")
    parser.add_argument("--compare", action="store_true",
                        help="draws the mesh with VTK's mappers and with this one, side by side, "
                        "with milliseconds and differences")
    parser.add_argument("--web", action="store_true", help="serves the window as a page")
    parser.add_argument("--port", type=_port, default=8080, help="port of the page; default: 8080")
    parser.add_argument("--host", default="localhost",
                        help="address at which the page is served; default: localhost, for this "
                        "machine only. Others get a secret, which the address of the page carries")


def _split_clip(text):
    axis, _, share = text.partition(":")
    try:
        return axis, float(share) if share else 0.5
    except ValueError:
        raise ReadingError(f"--clip: '{share}' is not a number") from None


def check(options):
    """What needs no mesh, before one is read, which may take minutes: a ReadingError about options
    that exclude each other, and files that cannot be written."""
    if options.isovalues and options.blend not in (None, "isosurface"):
        raise ReadingError("--isovalues are those of --blend isosurface, not of --blend "
                           + options.blend)
    if options.index is not None and not options.water:
        raise ReadingError("--index is that behind a surface, which --water SURFACE names")
    if len(options.units) > 2:
        raise ReadingError("--units takes at most two: of lengths and of the array")
    if not 0.0 < math.hypot(*options.view) < math.inf:
        raise ReadingError("--view {:g} {:g} {:g} is no direction".format(*options.view))
    if options.compare and (options.orbit or options.movie or options.web):
        raise ReadingError("--compare makes a picture; it goes without --orbit, --movie and --web")
    if options.orbit and not (options.compare or options.output or options.movie):
        raise ReadingError("--orbit needs --output PICTURE.png or --movie FILE.mp4")
    if options.watch and (options.output or options.movie):
        raise ReadingError("--watch goes with the window or --web")
    if not (options.output or options.movie or options.web or options.compare or _has_display()):
        raise ReadingError("There is no display; use --output PICTURE.png or --web")
    if options.movie:
        from .movies import check_movie
        check_movie(options.movie)
    elif options.output:
        check_picture(options.output)


def make_scene(options, report=lambda line: None):
    """The scene of the options. report: see MeshScene."""
    limits = options.range and tuple(options.range)
    series = MeshSeries(options.mesh)
    steps = len(series.get_times())
    if not -steps <= options.step < steps:
        raise ReadingError(f"There is no time step {options.step}; the mesh has {steps}")
    step = options.step % steps
    scene = MeshScene(series, options.array, limits, report, step)
    if step != scene.step:
        scene.set_step(step)
    scene.set_colors(options.colors)
    scene.set_density(options.density)
    scene.set_opacities(options.opacity)
    scene.set_blend(options.blend or "composite")
    if options.isovalues:
        scene.set_isovalues(options.isovalues)
    scene.set_lit(options.light or options.shadows)
    scene.set_shadows(1.0 if options.shadows else 0.0)
    scene.set_backend(options.backend)
    # Shaders and rays behind a surface take 16 times the time for it; a page is drawn while it
    # moves; VTK's mappers have one ray per pixel.
    scene.set_rays_at_edges(options.backend in ("automatic", "native")
                            and not (options.water or options.web or options.compare))
    if options.clip is not None:
        scene.set_clip(*_split_clip(options.clip))
    if options.water:
        scene.set_surface(read_surface(options.water),
                          _WATER if options.index is None else options.index)
    scene.set_units(*options.units)
    for name in scene.furniture.NAMES:
        scene.furniture.set(name, getattr(options, name))
    scene.set_zoom(options.zoom)
    scene.reset_camera(options.view, AXES[options.up])
    return scene


def _make_reported_scene(options):
    """The scene of the options; VTK's warnings about it are printed."""
    with collecting_reports() as reports:
        scene = make_scene(options, lambda line: print(line, flush=True))
        errors, warnings = reports()
    _print_warnings(errors + warnings)
    return scene


def _print_warnings(warnings, of=""):
    for warning in dict.fromkeys(warnings):
        print(f"meniscus: warning: {of}{warning}", file=sys.stderr)


def _has_display():
    return bool(os.environ.get("DISPLAY")) or not sys.platform.startswith("linux")


def _compare(scene, options):
    from .contest import TITLE, compare_on, format_row, make_panels, show_panels
    pairs = []
    with collecting_reports() as reports:
        for found, picture in compare_on(scene, options.size):
            if not pairs:
                print(TITLE)
            print(format_row(found), flush=True)
            pairs.append((found, picture))
        errors, warnings = reports()
    _print_warnings(errors + warnings, "VTK: ")
    if options.output:
        write_picture(grab_picture(make_panels(pairs, offscreen=True)), options.output)
    elif _has_display():
        show_panels(make_panels(pairs, offscreen=False))


def _make_watch(scene):
    from .watching import Watch
    return Watch(scene)


def _write_views(scene, options):
    from .movies import write_movie, write_pictures
    if options.movie:
        write_movie(scene, options.size, options.movie, options.orbit)
    else:
        write_pictures(scene, options.size, options.output, options.orbit, options.transparent)


def _show(scene, options):
    watch = _make_watch(scene) if options.watch else None
    if options.compare:
        _compare(scene, options)
    elif options.movie or options.orbit:
        _write_views(scene, options)
    elif options.output:
        picture, warnings = draw_picture(scene, options.size, options.transparent)
        write_picture(picture, options.output)
        _print_warnings(warnings)
    elif options.web:
        from .web import serve
        serve(scene, options.host, options.port, watch)
    else:
        from .window import Window
        Window(scene, options.size, watch=watch).start()


def main(arguments=None):
    """Runs the command; returns its exit status."""
    parser = make_parser()
    parser.complete()
    try:
        options = parser.parse(arguments)
        check(options)
        _show(_make_reported_scene(options), options)
    except ReadingError as error:
        print(f"meniscus: {error}", file=sys.stderr)
        return 1
    return 0


def program():
    """The command as a process of its own; returns its exit status."""
    return run_guarded(main)
