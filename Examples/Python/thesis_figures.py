# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of the thesis "Refraction by geometric transforms" again: a triangle of different
resolutions next to a ray-traced picture (Figs. 4.9 and 4.10), the cells of diverging and converging
membranes (Figs. 3.1 and 4.8), all images of one point (Fig. 3.2), and an error volume (Fig. 4.2)
with its angles at the eye.

usage: thesis_figures.py [--output DIR] [--width N]
"""
import argparse
import math
import os

import meniscus
import numpy
from gallery import common, sheets
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkSphere
from vtkmodules.vtkFiltersCore import vtkGlyph3D, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

AIR, GLASS = 1.0, 1.51
DISC = 141.5
SPHERE = 1.05 * DISC
EYE = (0.0, 450.0, 0.0)
TRIANGLE_HEIGHT, TRIANGLE_RADIUS = -300.0, 430.0
HALF_TANGENT = 0.4
FILL, DIFFERENT, WATER = (0.30, 0.50, 0.74), (0.87, 0.20, 0.10), (0.45, 0.72, 0.85)
SAMPLES = 4  # along a side of a pixel
ACROSS = 78  # samples of the error volume along a side; an even number leaves out its axis
PATHS = 400.0, 1200.0  # shown range of optical paths
MEASURED = 256  # pixels along a side of the pictures whose pixels are counted


def make_disc(rings, height, slope):
    """The thesis's disc: ring k has 2^(k+1) vertices. `height` and its derivative `slope` are
    functions of the distance from the axis."""
    return make_rings([2**(k + 1) for k in range(1, rings + 1)], height, slope)


def make_rings(numbers, height, slope):
    """A disc of rings with these numbers of vertices."""
    points, normals, triangles = vtkPoints(), vtkDoubleArray(), vtkCellArray()
    points.SetDataTypeToDouble()
    normals.SetNumberOfComponents(3)
    normals.SetName("Normals")

    def add(radius, angle):
        points.InsertNextPoint(radius * math.cos(angle), height(radius), radius * math.sin(angle))
        length = math.hypot(1.0, slope(radius))
        normals.InsertNextTuple3(-slope(radius) * math.cos(angle) / length, 1.0 / length,
                                 -slope(radius) * math.sin(angle) / length)

    add(0.0, 0.0)
    first, count = 0, 1
    for ring, number in enumerate(numbers, 1):
        outer = first + count
        for k in range(number):
            add(DISC * ring / len(numbers), 2.0 * math.pi * k / number)
        # From one spoke to the next, on the ring whose next vertex comes first.
        i = j = 0
        while j < number or (count > 1 and i < count):
            a, d = first + i % count, outer + j % number
            if count == 1 or (2 * j + 1) * count < (2 * i + 1) * number:
                triangles.InsertNextCell(3, (a, outer + (j + 1) % number, d))
                j += 1
            else:
                triangles.InsertNextCell(3, (a, first + (i + 1) % count, d))
                i += 1
        first, count = outer, number
    disc = vtkPolyData()
    disc.SetPoints(points)
    disc.SetPolys(triangles)
    disc.GetPointData().SetNormals(normals)
    return disc


SPHERICAL = (lambda r: SPHERE - math.sqrt(SPHERE**2 - r * r),
             lambda r: r / math.sqrt(SPHERE**2 - r * r))


def make_bowl(rings):
    return make_disc(rings, *SPHERICAL)


def make_fine_bowl():
    """A bowl of even rings with as many facets as the thesis's fine one, 3,279."""
    return make_rings([round(6.2 * ring) for ring in range(1, 24)], *SPHERICAL)


def get_corners():
    return [(TRIANGLE_RADIUS * math.cos(angle), TRIANGLE_RADIUS * math.sin(angle))
            for angle in (math.pi / 2 + 2.0 * math.pi * k / 3 for k in range(3))]


def make_triangle(side):
    """A triangle with `side` vertices along each side."""
    points, triangles, numbers = vtkPoints(), vtkCellArray(), {}
    points.SetDataTypeToDouble()
    a, b, c = get_corners()
    last = side - 1
    for i in range(side):
        for j in range(side - i):
            share = i / last, j / last
            x, z = (a[k] + share[0] * (b[k] - a[k]) + share[1] * (c[k] - a[k]) for k in range(2))
            numbers[i, j] = points.InsertNextPoint(x, TRIANGLE_HEIGHT, z)
    for i, j in numbers:
        if i + j < last:
            triangles.InsertNextCell(3, (numbers[i, j], numbers[i + 1, j], numbers[i, j + 1]))
            if i + j < last - 1:
                triangles.InsertNextCell(
                    3, (numbers[i + 1, j], numbers[i + 1, j + 1], numbers[i, j + 1]))
    triangle = vtkPolyData()
    triangle.SetPoints(points)
    triangle.SetPolys(triangles)
    return triangle


def refract(triangle, membrane, all_images):
    refraction = meniscus.vtkRefractedGeometryFilter()
    refraction.SetInputData(triangle)
    refraction.SetMembraneData(membrane)
    refraction.SetEyePosition(*EYE)
    refraction.SetExteriorIndexOfRefraction(AIR)
    refraction.SetInteriorIndexOfRefraction(GLASS)
    if not all_images:
        refraction.SetMembraneModelToFlatFacets()
        refraction.SetImagesToFirstImage()
    refraction.Update()
    return refraction.GetOutput()


def draw(renderer, size):
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    window.Finalize()
    return picture.GetOutput()


def draw_virtual(data, size):
    """Which of size x size pixels show the data, in rows upwards."""
    renderer = vtkRenderer()
    actor = common.make_actor(data)
    actor.GetProperty().LightingOff()
    renderer.AddActor(actor)
    common.look_from(renderer, EYE, (0, 0, 0), (0, 0, -1),
                     2.0 * math.degrees(math.atan(HALF_TANGENT)))
    renderer.GetActiveCamera().SetClippingRange(100, 2000)
    return sheets.to_rows(draw(renderer, (size, size)))[..., 2] > 0.5


def trace(size):
    """Traces the rays of the pixels through the sphere itself to the triangle."""
    at = HALF_TANGENT * (2.0 * (numpy.arange(size) + 0.5) / size - 1.0)
    x, z = numpy.meshgrid(at, -at)
    ray = numpy.stack([x, -numpy.ones_like(x), z])
    ray /= numpy.linalg.norm(ray, axis=0)
    eye = numpy.array(EYE)[:, None, None]
    center = numpy.array((0.0, SPHERE, 0.0))[:, None, None]
    middle = (EYE[1] - SPHERE) * ray[1]
    root = middle**2 - (EYE[1] - SPHERE)**2 + SPHERE**2
    hit = eye + (-middle + numpy.sqrt(numpy.maximum(root, 0.0))) * ray
    outwards = (hit - center) / SPHERE
    # Snell's law: the part across the normal shrinks by the ratio of the indices.
    along = (ray * outwards).sum(axis=0)
    across = AIR / GLASS * (ray - along * outwards)
    behind = across + numpy.sqrt(1.0 - (across**2).sum(axis=0)) * outwards
    distance = (TRIANGLE_HEIGHT - hit[1]) / behind[1]
    place = [hit[k] + distance * behind[k] for k in (0, 2)]
    corners = get_corners()
    sides = numpy.array([(q[0] - p[0]) * (place[1] - p[1]) - (q[1] - p[1]) * (place[0] - p[0])
                         for p, q in zip(corners, corners[1:] + corners[:1])])
    inside = (sides.min(axis=0) >= 0.0) | (sides.max(axis=0) <= 0.0)
    return inside & (root >= 0.0) & (numpy.hypot(hit[0], hit[2]) <= DISC)


def paint(covered, truth):
    """The middle of a picture, with samples that differ from the truth in another colour."""
    size = covered.shape[0]
    share = size // SAMPLES // 12
    colors = numpy.where((covered & truth)[..., None], FILL, common.PAPER[1])
    colors[covered != truth] = DIFFERENT
    pixels = sheets.shrink(colors, SAMPLES)
    return pixels[:10 * share, share:11 * share]


def draw_resolutions(width):
    """Top: flat facets and 2, 3, 5 and 8 vertices per side. Bottom: 22 vertices, 8 vertices and
    more facets, the plain triangle with all images, and traced rays. What differs from those is
    marked."""
    coarse, fine = make_bowl(5), make_fine_bowl()
    size = sheets.get_panel_width(width, 4) // 10 * 12
    counted, truth = trace(MEASURED), trace(SAMPLES * size)
    panels, titles = [], []
    for side, membrane, all_images in ((2, coarse, False), (3, coarse, False), (5, coarse, False),
                                       (8, coarse, False), (22, coarse, False), (8, fine, False),
                                       (2, coarse, True)):
        data = refract(make_triangle(side), membrane, all_images)
        number = (draw_virtual(data, MEASURED) != counted).sum()
        print(f"{side} vertices per side, {membrane.GetNumberOfCells()} facets, "
              f"{'ALL_IMAGES' if all_images else 'FLAT_FACETS'}: {number} of {counted.sum()} "
              "pixels")
        panels.append(paint(draw_virtual(data, SAMPLES * size), truth))
        titles.append(f"{side} vertices a side, {membrane.GetNumberOfCells():,} facets\n" +
                      ("all images: " if all_images else "") + f"{number:,} pixels differ")
    panels.append(paint(truth, truth))
    titles.append("traced")
    return sheets.make_sheet(panels, titles, 4)


def add_cells(renderer, membrane, exterior, interior, length):
    """The cells of a membrane, the rays from the eye, and the membrane."""
    cells = meniscus.vtkMembraneCellFilter()
    cells.AddMembraneData(membrane)
    cells.SetEyePosition(*EYE)
    cells.SetExteriorIndexOfRefraction(exterior)
    cells.SetInteriorIndexOfRefraction(interior)
    cells.SetCellLength(length)
    cells.Update()
    grid = cells.GetOutput()
    print(f"{grid.GetNumberOfCells()} cells, {cells.GetNumberOfTotallyReflectedFacets()} facets "
          "totally reflected")
    paths = grid.GetPointData().GetArray("OpticalPath")
    edges = common.vtkExtractEdges()
    edges.SetInputData(grid)
    rays = vtkTubeFilter()
    rays.SetInputConnection(edges.GetOutputPort())
    rays.SetRadius(1.8)
    rays.SetNumberOfSides(12)
    rays.Update()
    actor = common.make_actor(rays.GetOutput())
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("OpticalPath")
    mapper.SetLookupTable(common.make_colors(common.VIRIDIS[:7], *PATHS))
    mapper.UseLookupTableScalarRangeOn()
    renderer.AddActor(actor)
    print(f"optical paths {paths.GetRange()[0]:.3g} to {paths.GetRange()[1]:.3g}")
    surface = common.make_actor(membrane, WATER)
    surface.GetProperty().SetOpacity(0.6)
    renderer.AddActor(surface)
    count = membrane.GetNumberOfPoints()
    renderer.AddActor(make_rays([EYE] * count, [membrane.GetPoint(i) for i in range(count)],
                                (0.72, 0.74, 0.78), 0.8))
    renderer.AddActor(make_ball(EYE, 12.0, common.INK))


def draw_cells(width):
    """Cells of a membrane that spreads the view, and of one that focuses it."""
    size = sheets.get_panel_width(width, 2)
    panels = []
    for rise in (0.9, -0.9):
        membrane = make_disc(3, lambda r: rise * r * r / (2.0 * DISC), lambda r: rise * r / DISC)
        renderer = common.make_renderer(common.PAPER)
        add_cells(renderer, membrane, AIR, GLASS, 420.0)
        common.add_lights(renderer, ((-0.5, 0.8, 1.0), (1.0, 1.0, 1.0), 1.0),
                          ((0.7, 0.0, 0.7), (1.0, 1.0, 1.0), 0.5))
        common.look_from(renderer, (350.0, 420.0, 1900.0), (0.0, -5.0, 0.0), (0, 1, 0), 29.0)
        renderer.ResetCameraClippingRange()
        panels.append(sheets.to_rows(common.take(renderer, (size, size))))
    sheet = sheets.make_sheet(
        panels, ("A hollow surface of glass spreads the view", "a round one focuses it"), 2)
    marks = [((path - PATHS[0]) / (PATHS[1] - PATHS[0]), f"{path:.0f}") for path in PATHS]
    return sheets.add_scale(
        sheet, [(0.5, 0.3, common.VIRIDIS[:7], marks, "optical path from the eye")])


def make_waves(cells, side, amplitude, wave_number):
    """Waves amplitude sin(k x) sin(k z) over a square, with exact normals."""
    points, normals, triangles = vtkPoints(), vtkDoubleArray(), vtkCellArray()
    points.SetDataTypeToDouble()
    normals.SetNumberOfComponents(3)
    normals.SetName("Normals")
    for j in range(cells + 1):
        for i in range(cells + 1):
            x, z = side * (i / cells - 0.5), side * (j / cells - 0.5)
            sines = math.sin(wave_number * x), math.sin(wave_number * z)
            slope = amplitude * wave_number
            dx = slope * math.cos(wave_number * x) * sines[1]
            dz = slope * sines[0] * math.cos(wave_number * z)
            length = math.sqrt(1.0 + dx * dx + dz * dz)
            points.InsertNextPoint(x, amplitude * sines[0] * sines[1], z)
            normals.InsertNextTuple3(-dx / length, 1.0 / length, -dz / length)
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            b = a + cells + 1
            triangles.InsertNextCell(3, (a, b, a + 1))
            triangles.InsertNextCell(3, (a + 1, b, b + 1))
    waves = vtkPolyData()
    waves.SetPoints(points)
    waves.SetPolys(triangles)
    waves.GetPointData().SetNormals(normals)
    return waves


def make_ball(center, radius, color):
    ball = vtkSphereSource()
    ball.SetCenter(center)
    ball.SetRadius(radius)
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(16)
    ball.Update()
    return common.make_actor(ball.GetOutput(), color)


def make_rays(starts, ends, color, radius):
    points, lines = vtkPoints(), vtkCellArray()
    for pair in zip(starts, ends):
        lines.InsertNextCell(2, [points.InsertNextPoint(p) for p in pair])
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetLines(lines)
    tubes = vtkTubeFilter()
    tubes.SetInputData(data)
    tubes.SetRadius(radius)
    tubes.SetNumberOfSides(8)
    tubes.Update()
    actor = common.make_actor(tubes.GetOutput(), color)
    actor.GetProperty().LightingOff()
    return actor


def draw_convergence(width):
    """All images of one point below short waves: sight rays, refracted rays, virtual vertices."""
    eye, place = (20.0, 300.0, 10.0), (0.0, -150.0, 0.0)
    membrane = make_waves(128, 200.0, 4.0, 0.09 * math.pi)
    point, points, verts = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    verts.InsertNextCell(1, (points.InsertNextPoint(place),))
    point.SetPoints(points)
    point.SetVerts(verts)
    refraction = meniscus.vtkRefractedGeometryFilter()
    refraction.SetInputData(point)
    refraction.SetMembraneData(membrane)
    refraction.SetEyePosition(*eye)
    refraction.SetExteriorIndexOfRefraction(AIR)
    refraction.SetInteriorIndexOfRefraction(1.333)
    refraction.Update()
    images = refraction.GetOutput()
    count = images.GetNumberOfPoints()
    print(f"{count} virtual vertices of one point")
    sights = [images.GetPointData().GetArray("SightPoint").GetTuple3(i) for i in range(count)]
    size = sheets.get_panel_width(width, 2)
    panels = []
    for position, focus, angle, scale in (
            ((420.0, 230.0, 720.0), (0.0, 72.0, 0.0), 35.0, 1.0),
            ((140.0, -40.0, 240.0), (0.0, -122.0, 0.0), 15.0, 0.3)):
        renderer = common.make_renderer(common.PAPER)
        renderer.AddActor(make_rays([eye] * count, sights, (0.95, 0.62, 0.35), 0.4))
        renderer.AddActor(make_rays(sights, [place] * count, (0.80, 0.10, 0.55), 0.4 * scale))
        for i in range(count):
            renderer.AddActor(make_ball(images.GetPoint(i), 1.7 * scale**0.5, FILL))
        renderer.AddActor(make_ball(place, 3.0 * scale**0.5, common.INK))
        renderer.AddActor(make_ball(eye, 4.0, common.INK))
        surface = common.make_actor(membrane, WATER)
        surface.GetProperty().SetOpacity(0.45)
        surface.GetProperty().SetSpecular(0.4)
        surface.GetProperty().SetSpecularPower(30.0)
        renderer.AddActor(surface)
        common.add_lights(renderer, ((-0.5, 0.8, 1.0), (1.0, 1.0, 1.0), 1.0))
        common.look_from(renderer, position, focus, (0, 1, 0), angle)
        renderer.ResetCameraClippingRange()
        panels.append(sheets.to_rows(common.take(renderer, (size, size))))
    return sheets.make_sheet(panels, (
        "From one eye through waves to one point, black",
        f"the point, and its {count} virtual vertices, blue"), 2)


def make_errors():
    """The error volume of a hemisphere with flat facets, with angles as pixels of 512 rows."""
    exact = vtkSphere()
    exact.SetCenter(0.0, DISC, 0.0)
    exact.SetRadius(DISC)
    volume = meniscus.vtkRefractionErrorVolume()
    # The rim of the hemisphere is vertical: its slope there is a large number instead.
    volume.AddMembraneData(make_disc(5, lambda r: DISC - math.sqrt(DISC**2 - r * r),
                                     lambda r: r / math.sqrt(max(DISC**2 - r * r, 1e-12))))
    volume.SetExactMembrane(exact)
    volume.SetMembraneModelToFlatFacets()
    volume.SetEyePosition(EYE)
    volume.SetInteriorIndexOfRefraction(GLASS)
    volume.SetModelBounds(-390, 390, DISC - 790, DISC - 10, -390, 390)
    volume.SetSampleDimensions(ACROSS, ACROSS, ACROSS)
    volume.AngularErrorsOn()
    volume.Update()
    print(f"hemisphere: mean error {volume.GetMeanError():.3g}")
    output = volume.GetOutput()
    arrays = output.GetPointData()
    centers, points = vtkPolyData(), vtkPoints()
    colors, pixels = vtkUnsignedCharArray(), vtkDoubleArray()
    colors.SetNumberOfComponents(3)
    colors.SetName("ErrorColor")
    pixels.SetName("Pixels")
    step = output.GetSpacing()[0]
    for i in range(output.GetNumberOfPoints()):
        point = output.GetPoint(i)
        # Blocks about samples next to the facets would come through them.
        is_clear = math.dist(point, exact.GetCenter()) > DISC + step
        if arrays.GetArray("SampleState").GetValue(i) == 0 and point[2] < 0.0 and is_clear:
            points.InsertNextPoint(point)
            colors.InsertNextTuple(i, arrays.GetArray("ErrorColor"))
            angle = math.radians(arrays.GetArray("AngularError").GetValue(i))
            pixels.InsertNextValue(256.0 * math.tan(angle) / HALF_TANGENT)
    centers.SetPoints(points)
    centers.GetPointData().AddArray(colors)
    centers.GetPointData().AddArray(pixels)
    return volume.GetInputDataObject(0, 0), centers


def draw_errors(width):
    """An error volume cut open: the thesis's colours, and angles at the eye as pixels."""
    membrane, centers = make_errors()
    numbers = [centers.GetPointData().GetArray("Pixels").GetValue(i)
               for i in range(centers.GetNumberOfPoints())]
    print(f"pixels: mean {sum(numbers) / len(numbers):.3g}, largest {max(numbers):.3g}")
    size = sheets.get_panel_width(width, 2)
    panels = []
    for name in ("ErrorColor", "Pixels"):
        centers.GetPointData().SetActiveScalars(name)
        cube = vtkCubeSource()
        for axis in "XYZ":
            getattr(cube, f"Set{axis}Length")(780.0 / (ACROSS - 1))
        blocks = vtkGlyph3D()
        blocks.SetInputData(centers)
        blocks.SetSourceConnection(cube.GetOutputPort())
        blocks.ScalingOff()
        blocks.SetColorModeToColorByScalar()
        blocks.Update()
        actor = common.make_actor(blocks.GetOutput())
        actor.GetMapper().ScalarVisibilityOn()
        if name == "Pixels":
            actor.GetMapper().SetLookupTable(common.make_colors(common.INFERNO[1:], 0.0, 10.0))
            actor.GetMapper().UseLookupTableScalarRangeOn()
        actor.GetProperty().SetAmbient(0.6)
        actor.GetProperty().SetDiffuse(0.5)
        renderer = common.make_renderer(common.PAPER)
        renderer.AddActor(actor)
        surface = common.make_actor(membrane, WATER)
        surface.GetProperty().SetOpacity(0.8)
        surface.GetProperty().EdgeVisibilityOn()
        surface.GetProperty().SetEdgeColor(0.2, 0.35, 0.45)
        renderer.AddActor(surface)
        common.add_lights(renderer, ((-0.5, 0.8, 1.0), (1.0, 1.0, 1.0), 1.1))
        common.look_from(renderer, (500.0, 500.0, 2000.0), (0.0, -230.0, -150.0), (0, 1, 0), 24.0)
        renderer.ResetCameraClippingRange()
        panels.append(sheets.to_rows(common.take(renderer, (size, size))))
    sheet = sheets.make_sheet(panels, ("ErrorColor: units of length",
                                       "AngularError: pixels of a picture of 512 rows"), 2)
    shades = numpy.linspace(0.31, 1.0, 100)[:, None]
    bands = numpy.concatenate([shades * color for color in numpy.eye(3)[[1, 2, 0]]])
    return sheets.add_scale(sheet, [
        (0.22, 0.28, bands,
         ((0.0, "0"), (0.33, "1"), (0.67, "10"), (1.0, "100")), "units"),
        (0.72, 0.28, common.INFERNO[1:],
         ((0.0, "0"), (0.5, "5"), (1.0, "10 and more")), "pixels")])


def main():
    parser = argparse.ArgumentParser(description="Figures of the thesis")
    parser.add_argument("--output", default=".", help="existing folder for the pictures")
    parser.add_argument("--width", type=int, default=1280, help="of the pictures, in pixels")
    options = parser.parse_args()
    for name, make in (("thesis-resolution", draw_resolutions), ("membrane-cells", draw_cells),
                       ("error-volume", draw_errors), ("zone-of-convergence", draw_convergence)):
        common.write(sheets.to_image(make(options.width)),
                     os.path.join(options.output, name + ".png"))


if __name__ == "__main__":
    main()
