# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of the thesis "Refraction by geometric transforms" about accuracy, again: an attenuating
medium at three depths (Fig. 3.4), rings of accuracy (Figs. 4.4 and 4.5), the facets of its disc and
its worst case (Figs. 4.6 and 4.7), next to traced rays.

usage: thesis_accuracy.py [--output DIR] [--width N]
"""
import argparse
import os

import meniscus
import numpy
from gallery import common, sheets
from thesis_figures import AIR, DIFFERENT, DISC, GLASS, SAMPLES, draw, make_bowl, make_disc
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane, vtkSphere
from vtkmodules.vtkFiltersSources import vtkPlaneSource

LOW_EYE = (0.0, 150.0, 0.0)
BOTTOM = -780.0  # of the error volume
SHALLOW = 5.0 * DISC  # radius of a slightly curved membrane
LIGHT, DARK = (0.95, 0.85, 0.55), (0.30, 0.45, 0.75)
BACKGROUND = (1.0, 1.0, 1.0)
MEDIUM, ATTENUATION = (0.22, 0.50, 0.56), 1.0 / 400.0
MEASURED = 320  # pixels along a side of the pictures whose pixels are counted
ERRORS = 0.01, 10.0  # shown range


def make_shallow_bowl():
    return make_disc(5, lambda r: SHALLOW - (SHALLOW**2 - r * r)**0.5,
                     lambda r: r / (SHALLOW**2 - r * r)**0.5)


def take_slice(membrane, exact, eye, bounds, size):
    """Errors of a slice of the error volume, as colours of their logarithms."""
    volume = meniscus.vtkRefractionErrorVolume()
    volume.AddMembraneData(membrane)
    volume.SetExactMembrane(exact)
    volume.SetMembraneModelToFlatFacets()
    volume.SetEyePosition(*eye)
    volume.SetExteriorIndexOfRefraction(AIR)
    volume.SetInteriorIndexOfRefraction(GLASS)
    volume.SetModelBounds(*bounds)
    volume.SetSampleDimensions(*(1 if bounds[2 * k] == bounds[2 * k + 1] else size
                                 for k in range(3)))
    volume.Update()
    arrays = volume.GetOutput().GetPointData()
    counts = vtk_to_numpy(arrays.GetArray("SampleState")) == 0
    errors = vtk_to_numpy(arrays.GetArray("RefractionError"))
    print(f"slice: {counts.sum()} samples, mean error {errors[counts].mean():.3g}, largest "
          f"{errors[counts].max():.3g}")
    lowest, highest = numpy.log10(ERRORS)
    level = (numpy.log10(numpy.clip(errors, *ERRORS)) - lowest) / (highest - lowest)
    palette = numpy.array(common.VIRIDIS)
    colors = numpy.stack([numpy.interp(level, numpy.linspace(0.0, 1.0, len(palette)), channel)
                          for channel in palette.T], axis=-1)
    colors[~counts] = common.PAPER[1]
    return colors.reshape(size, size, 3)


def draw_rings(width):
    """Left: the bottom of the error volume of a flat disc, the eye 150 above its middle. Middle and
    right: the bottom and an upright slice for a slightly curved one, the eye aside by 400."""
    plane = vtkPlane()
    plane.SetNormal(0.0, 1.0, 0.0)
    sphere = vtkSphere()
    sphere.SetCenter(0.0, SHALLOW, 0.0)
    sphere.SetRadius(SHALLOW)
    flat = make_disc(5, lambda r: 0.0, lambda r: 0.0)
    aside = (400.0, 450.0, 0.0)
    size = sheets.get_panel_width(width, 3)
    # Aside by 1, because a sample behind an edge of facets has several images.
    slices = ((flat, plane, LOW_EYE, (-400, 400, -800, -800, -399, 401)),
              (make_shallow_bowl(), sphere, aside, (-780, 20, -800, -800, -400, 400)),
              (make_shallow_bowl(), sphere, aside, (-780, 20, -800, 0, 7, 7)))
    panels = [sheets.shrink(take_slice(*place, 2 * size), 2) for place in slices]
    sheet = sheets.make_sheet(panels, ("Flat disc, 800 below it", "Curved disc, 800 below it",
                                       "Curved disc, upright slice"), 3)
    marks = [(power / 3.0, f"{10.0**(power - 2):g}") for power in range(4)]
    return sheets.add_scale(sheet, [(0.5, 0.4, common.VIRIDIS, marks, "error in units of length")])


def is_light(x, z, squares):
    return (numpy.floor(x / squares) + numpy.floor(z / squares)) % 2 == 0


def make_board(bounds, height, squares):
    """A checkered rectangle; bounds are those of x and z."""
    board = vtkPlaneSource()
    board.SetOrigin(bounds[0], height, bounds[2])
    board.SetPoint1(bounds[0], height, bounds[3])
    board.SetPoint2(bounds[1], height, bounds[2])
    board.SetResolution(round((bounds[3] - bounds[2]) / squares),
                        round((bounds[1] - bounds[0]) / squares))
    board.Update()
    data = board.GetOutput()
    corners = numpy.array([data.GetCell(i).GetBounds() for i in range(data.GetNumberOfCells())])
    light = is_light(corners[:, :2].mean(axis=1), corners[:, 4:].mean(axis=1), squares)
    colors = numpy.where(light[:, None], numpy.round(255 * numpy.array(LIGHT)),
                         numpy.round(255 * numpy.array(DARK))).astype(numpy.uint8)
    data.GetPointData().Initialize()
    data.GetCellData().SetScalars(numpy_to_vtk(colors, deep=True))
    return data


class View:
    """A camera of square pictures, and its rays."""

    def __init__(self, eye, focus, up, angle):
        self.eye, self.focus, self.up, self.angle = (
            numpy.array(eye), numpy.array(focus), numpy.array(up), angle)

    def apply(self, renderer):
        common.look_from(renderer, self.eye, self.focus, self.up, self.angle)
        renderer.ResetCameraClippingRange()

    def get_rays(self, size):
        """Unit vectors, components first, in rows upwards."""
        forward = self.focus - self.eye
        forward = forward / numpy.linalg.norm(forward)
        right = numpy.cross(forward, self.up)
        right = right / numpy.linalg.norm(right)
        above = numpy.cross(right, forward)
        edge = numpy.tan(numpy.radians(self.angle / 2))
        at = edge * (2.0 * (numpy.arange(size) + 0.5) / size - 1.0)
        x, y = numpy.meshgrid(at, at)
        rays = (forward[:, None, None] + right[:, None, None] * x + above[:, None, None] * y)
        return rays / numpy.linalg.norm(rays, axis=0)


def trace(view, size, radius, height, bounds, squares):
    """Pixels that the disc covers, those of them that show the board, the board's colours, and the
    way behind the membrane; by the plane itself or, with a radius, by the sphere."""
    rays = view.get_rays(size)
    eye = view.eye[:, None, None]
    if radius:
        center = numpy.array((0.0, radius, 0.0))[:, None, None]
        along = ((eye - center) * rays).sum(axis=0)
        root = along**2 - ((eye - center)**2).sum(axis=0) + radius**2
        way = -along + numpy.sqrt(numpy.maximum(root, 0.0))
        hit = eye + way * rays
        normal = (center - hit) / radius
        covered = (root > 0.0) & (hit[1] < radius)
    else:
        way = -eye[1] / rays[1]
        hit = eye + way * rays
        normal = numpy.zeros_like(hit)
        normal[1] = 1.0
        covered = way > 0.0
    covered &= numpy.hypot(hit[0], hit[2]) <= DISC
    cosine = -(rays * normal).sum(axis=0)
    inner = numpy.sqrt(1.0 - (AIR / GLASS)**2 * (1.0 - cosine**2))
    behind = AIR / GLASS * rays + (AIR / GLASS * cosine - inner) * normal
    depth = (height - hit[1]) / behind[1]
    x, z = (hit[k] + depth * behind[k] for k in (0, 2))
    shown = (covered & (depth > 0.0) & (x >= bounds[0]) & (x <= bounds[1]) & (z >= bounds[2]) &
             (z <= bounds[3]))
    colors = numpy.where(is_light(x, z, squares)[..., None], LIGHT, DARK)
    return covered, shown, colors, depth


def refract(board, membrane, eye, first):
    """The filter with flat facets and first images, as the thesis has them, or with all images."""
    refraction = meniscus.vtkRefractedGeometryFilter()
    refraction.SetInputData(board)
    refraction.SetMembraneData(membrane)
    refraction.SetEyePosition(*eye)
    refraction.SetExteriorIndexOfRefraction(AIR)
    refraction.SetInteriorIndexOfRefraction(GLASS)
    if first:
        refraction.SetMembraneModelToFlatFacets()
        refraction.SetImagesToFirstImage()
    refraction.Update()
    return refraction


def make_board_actor(data):
    actor = common.make_actor(data)
    actor.GetMapper().ScalarVisibilityOn()
    actor.GetMapper().SetScalarModeToUseCellData()
    actor.GetProperty().LightingOff()
    return actor


def mark(here, there):
    """Pixels that differ, red, before a pale picture; and their number."""
    differs = numpy.abs(here - there).max(axis=2) > 8.0 / 255.0
    return numpy.where(differs[..., None], DIFFERENT, 0.75 + 0.25 * there), differs.sum()


def draw_facets(membrane, size):
    facets = common.vtkExtractEdges()
    facets.SetInputData(membrane)
    facets.Update()
    renderer = common.make_renderer((BACKGROUND, BACKGROUND))
    edges = common.make_actor(facets.GetOutput(), common.INK)
    edges.GetProperty().LightingOff()
    edges.GetProperty().SetLineWidth(2.5)
    renderer.AddActor(edges)
    common.look_from(renderer, (0.0, 600.0, 0.0), (0.0, 0.0, 0.0), (0, 0, -1), 28.0)
    return sheets.to_rows(common.take(renderer, (size, size)))


def draw_worst(width):
    """The facets of the flat disc; its worst case, an object at the bottom and at the far side seen
    from an eye low above the middle, by flat facets and traced; pixels that differ."""
    flat = make_disc(5, lambda r: 0.0, lambda r: 0.0)
    bounds, squares = (-240.0, 240.0, -400.0, 80.0), 40.0
    view = View(LOW_EYE, (0.0, 0.0, -37.0), (0.0, 0.0, -1.0), 34.0)
    virtual = refract(make_board(bounds, BOTTOM, squares), flat, LOW_EYE, True)

    def see(size):
        renderer = common.make_renderer((BACKGROUND, BACKGROUND))
        renderer.AddActor(make_board_actor(virtual.GetOutput()))
        view.apply(renderer)
        _, shown, colors, _ = trace(view, size, 0.0, BOTTOM, bounds, squares)
        return (sheets.to_rows(draw(renderer, (size, size))),
                numpy.where(shown[..., None], colors, BACKGROUND), shown.sum())

    drawn, traced, covered = see(MEASURED)
    number = mark(drawn, traced)[1]
    print(f"worst case: {number} of {covered} pixels differ")
    size = sheets.get_panel_width(width, 4)
    marked = mark(*see(size)[:2])[0]
    drawn, traced = (sheets.shrink(rows, SAMPLES) for rows in see(SAMPLES * size)[:2])
    return sheets.make_sheet([draw_facets(flat, size), drawn, traced, marked],
                             ("The disc's facets", "Flat facets", "Traced", "Difference"), 4)


def draw_attenuation(width):
    """A board below the tip of a bowl in an attenuating medium, at depths of 700, 400 and 100: the
    pass above, traced below."""
    bowl, bounds, squares = make_bowl(7), (-150.0, 150.0, -150.0, 150.0), 30.0
    view = View((0.0, 450.0, 260.0), (0.0, 20.0, 0.0), (0.0, 1.0, 0.0), 38.0)

    def see(depth, size):
        filter_ = refract(make_board(bounds, -depth, squares), bowl, view.eye, False)
        renderer = common.make_renderer((BACKGROUND, BACKGROUND))
        membrane = common.make_actor(bowl)
        renderer.AddActor(membrane)
        view.apply(renderer)
        scene = meniscus.vtkRefractionPass()
        scene.AddRefraction(membrane, make_board_actor(filter_.GetOutput()), filter_)
        scene.SetReflectanceModelToNone()
        scene.SetAttenuationCoefficients(ATTENUATION, ATTENUATION, ATTENUATION)
        scene.SetMediumColor(*MEDIUM)
        scene.InfiniteMediumOn()
        renderer.SetPass(scene)
        covered, shown, colors, way = trace(view, size, 1.05 * DISC, -depth, bounds, squares)
        passing = numpy.exp(-ATTENUATION * way)[..., None]
        seen = numpy.where(shown[..., None], passing * colors + (1.0 - passing) * MEDIUM, MEDIUM)
        return (sheets.to_rows(draw(renderer, (size, size))),
                numpy.where(covered[..., None], seen, BACKGROUND), covered.sum())

    size = sheets.get_panel_width(width, 3)
    panels, titles = [[], []], [[], []]
    for depth in (700.0, 400.0, 100.0):
        drawn, traced, covered = see(depth, MEASURED)
        number = mark(drawn, traced)[1]
        print(f"depth {depth:g}: {number} of {covered} pixels differ")
        for row, (title, rows) in enumerate(zip(("refraction pass", "traced"),
                                                see(depth, SAMPLES * size))):
            pixels = sheets.shrink(rows, SAMPLES)
            panels[row].append(pixels[size // 8:])
            titles[row].append(f"{depth:g} below, {title}")
    return sheets.make_sheet(panels[0] + panels[1], titles[0] + titles[1], 3)


def main():
    parser = argparse.ArgumentParser(description="Figures of the thesis about accuracy")
    parser.add_argument("--output", default=".", help="existing folder for the pictures")
    parser.add_argument("--width", type=int, default=1280, help="of the pictures, in pixels")
    options = parser.parse_args()
    for name, make in (("thesis-rings", draw_rings), ("thesis-worst-case", draw_worst),
                       ("thesis-attenuation", draw_attenuation)):
        common.write(sheets.to_image(make(options.width)),
                     os.path.join(options.output, name + ".png"))


if __name__ == "__main__":
    main()
