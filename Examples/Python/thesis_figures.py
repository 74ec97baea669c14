# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of the thesis "Refraction by geometric transforms" again: a triangle of different
resolutions next to a ray-traced picture (Figs. 4.9 and 4.10), the cells of diverging and converging
membranes (Figs. 3.1 and 4.8), all images of one point (Fig. 3.2), and an error volume (Fig. 4.2)
with its angles at the eye.

usage: thesis_figures.py [--output DIR] [--size N]
"""
import argparse
import math
import os

import meniscus
from gallery import common
from vtkmodules.util.vtkConstants import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData, vtkSphere
from vtkmodules.vtkFiltersCore import vtkGlyph3D, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

AIR, GLASS = 1.0, 1.51
DISC = 141.5
SPHERE = 1.05 * DISC
EYE = (0.0, 450.0, 0.0)
TRIANGLE_HEIGHT, TRIANGLE_RADIUS = -300.0, 430.0
HALF_TANGENT = 0.4
BACKGROUND, FILL, DIFFERENT = (0.09, 0.12, 0.17), (0.55, 0.75, 0.95), (255, 90, 60)


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
    renderer = vtkRenderer()
    renderer.SetBackground(*BACKGROUND)
    actor = common.make_actor(data, FILL)
    actor.GetProperty().LightingOff()
    renderer.AddActor(actor)
    common.look_from(renderer, EYE, (0, 0, 0), (0, 0, -1),
                     2.0 * math.degrees(math.atan(HALF_TANGENT)))
    renderer.GetActiveCamera().SetClippingRange(100, 2000)
    return draw(renderer, (size, size))


def is_seen(x, z):
    """Traces the ray from the eye along (x, -1, z) through the sphere itself to the triangle."""
    length = math.sqrt(x * x + 1.0 + z * z)
    ray = (x / length, -1.0 / length, z / length)
    to_center = EYE[1] - SPHERE
    middle = to_center * ray[1]
    root = middle * middle - to_center**2 + SPHERE**2
    if root < 0.0:
        return False
    far = -middle + math.sqrt(root)
    hit = [e + far * r for e, r in zip(EYE, ray)]
    if math.hypot(hit[0], hit[2]) > DISC:
        return False
    outwards = (hit[0] / SPHERE, (hit[1] - SPHERE) / SPHERE, hit[2] / SPHERE)
    # Snell's law: the part across the normal shrinks by the ratio of the indices.
    along = sum(r * o for r, o in zip(ray, outwards))
    across = [AIR / GLASS * (r - along * o) for r, o in zip(ray, outwards)]
    depth = math.sqrt(1.0 - sum(a * a for a in across))
    behind = [a + depth * o for a, o in zip(across, outwards)]
    distance = (TRIANGLE_HEIGHT - hit[1]) / behind[1]
    place = hit[0] + distance * behind[0], hit[2] + distance * behind[2]
    corners = get_corners()
    sides = [(q[0] - p[0]) * (place[1] - p[1]) - (q[1] - p[1]) * (place[0] - p[0])
             for p, q in zip(corners, corners[1:] + corners[:1])]
    return min(sides) >= 0.0 or max(sides) <= 0.0


def trace(size):
    image = vtkImageData()
    image.SetDimensions(size, size, 1)
    image.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
    scalars = image.GetPointData().GetScalars()
    for row in range(size):
        for column in range(size):
            x = HALF_TANGENT * (2.0 * (column + 0.5) / size - 1.0)
            z = -HALF_TANGENT * (2.0 * (row + 0.5) / size - 1.0)
            color = FILL if is_seen(x, z) else BACKGROUND
            scalars.SetTuple3(row * size + column, *(round(255 * c) for c in color))
    return image


def get_covered(image):
    scalars = image.GetPointData().GetScalars()
    return [scalars.GetComponent(i, 2) > 128 for i in range(scalars.GetNumberOfTuples())]


def mark(image, truth):
    """Colours the pixels that differ from the truth, and returns their number."""
    scalars, number = image.GetPointData().GetScalars(), 0
    for i, (here, there) in enumerate(zip(get_covered(image), truth)):
        if here != there:
            scalars.SetTuple3(i, *DIFFERENT)
            number += 1
    return number


def draw_resolutions(size):
    """Top: flat facets and 2, 3, 5 and 8 vertices per side. Bottom: 22 vertices, 8 vertices and
    more facets, the plain triangle with all images, and traced rays. Pixels that differ from those
    are marked."""
    coarse, fine = make_bowl(5), make_fine_bowl()
    traced = trace(size)
    truth = get_covered(traced)
    panels = []
    for side, membrane, all_images in ((2, coarse, False), (3, coarse, False), (5, coarse, False),
                                       (8, coarse, False), (22, coarse, False), (8, fine, False),
                                       (2, coarse, True)):
        image = draw_virtual(refract(make_triangle(side), membrane, all_images), size)
        number = mark(image, truth)
        print(f"{side} vertices per side, {membrane.GetNumberOfCells()} facets, "
              f"{'ALL_IMAGES' if all_images else 'FLAT_FACETS'}: {number} of {sum(truth)} pixels")
        panels.append(image)
    return common.stack(panels + [traced], 4)


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
    rays.SetRadius(2.2)
    rays.SetNumberOfSides(8)
    rays.Update()
    actor = common.make_actor(rays.GetOutput())
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("OpticalPath")
    mapper.SetLookupTable(common.make_colors(common.VIRIDIS[2:], *paths.GetRange()))
    mapper.UseLookupTableScalarRangeOn()
    renderer.AddActor(actor)
    surface = common.make_actor(membrane, (1.0, 0.85, 0.2))
    surface.GetProperty().SetOpacity(0.6)
    renderer.AddActor(surface)
    sight, points = vtkCellArray(), vtkPoints()
    eye = points.InsertNextPoint(EYE)
    for i in range(membrane.GetNumberOfPoints()):
        sight.InsertNextCell(2, (eye, points.InsertNextPoint(membrane.GetPoint(i))))
    lines = vtkPolyData()
    lines.SetPoints(points)
    lines.SetLines(sight)
    white = common.make_actor(lines, (0.9, 0.9, 0.9))
    white.GetProperty().SetOpacity(0.6)
    white.GetProperty().SetLineWidth(2.0)
    renderer.AddActor(white)


def draw_cells(size):
    """Cells of a membrane that spreads the view, and of one that focuses it."""
    panels = []
    for rise in (0.9, -0.9):
        membrane = make_disc(3, lambda r: rise * r * r / (2.0 * DISC), lambda r: rise * r / DISC)
        renderer = common.make_renderer()
        add_cells(renderer, membrane, AIR, GLASS, 420.0)
        common.add_lights(renderer, ((-0.5, 0.8, 1.0), (1.0, 1.0, 1.0), 1.0),
                          ((0.7, 0.0, 0.7), (1.0, 1.0, 1.0), 0.6))
        common.look_from(renderer, (350.0, 420.0, 1900.0), (0.0, -15.0, 0.0), (0, 1, 0), 29.0)
        renderer.ResetCameraClippingRange()
        panels.append(common.take(renderer, (2 * size, 2 * size)))
    return common.stack(panels, len(panels))


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


def draw_convergence(size):
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
    renderer = common.make_renderer()
    # The thesis's colours: sight rays light pink, refracted rays magenta, vertices white.
    renderer.AddActor(make_rays([eye] * count, sights, (1.0, 0.75, 0.8), 0.25))
    renderer.AddActor(make_rays(sights, [place] * count, (1.0, 0.2, 1.0), 0.4))
    dot = vtkSphereSource()
    dot.SetRadius(1.6)
    dots = vtkGlyph3D()
    dots.SetSourceConnection(dot.GetOutputPort())
    dots.SetInputData(images)
    dots.ScalingOff()
    dots.Update()
    white = common.make_actor(dots.GetOutput())
    white.GetMapper().ScalarVisibilityOff()
    renderer.AddActor(white)
    surface = common.make_actor(membrane, (1.0, 0.85, 0.2))
    surface.GetProperty().SetOpacity(0.5)
    renderer.AddActor(surface)
    common.add_lights(renderer, ((-0.5, 0.8, 1.0), (1.0, 1.0, 1.0), 1.0))
    common.look_from(renderer, (250.0, 130.0, 420.0), (0.0, -35.0, 0.0), (0, 1, 0), 32.0)
    renderer.ResetCameraClippingRange()
    return common.take(renderer, (3 * size, 2 * size))


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
    for i in range(output.GetNumberOfPoints()):
        if arrays.GetArray("SampleState").GetValue(i) == 0 and output.GetPoint(i)[2] < 0.0:
            points.InsertNextPoint(output.GetPoint(i))
            colors.InsertNextTuple(i, arrays.GetArray("ErrorColor"))
            angle = math.radians(arrays.GetArray("AngularError").GetValue(i))
            pixels.InsertNextValue(256.0 * math.tan(angle) / HALF_TANGENT)
    centers.SetPoints(points)
    centers.GetPointData().AddArray(colors)
    centers.GetPointData().AddArray(pixels)
    return volume.GetInputDataObject(0, 0), centers


def draw_errors(size):
    """An error volume cut open: the thesis's colours, and angles at the eye as pixels."""
    membrane, centers = make_errors()
    numbers = [centers.GetPointData().GetArray("Pixels").GetValue(i)
               for i in range(centers.GetNumberOfPoints())]
    print(f"pixels: mean {sum(numbers) / len(numbers):.3g}, largest {max(numbers):.3g}")
    look = common.make_colors(common.INFERNO[1:], 0.0, 10.0)
    panels = []
    for name in ("ErrorColor", "Pixels"):
        centers.GetPointData().SetActiveScalars(name)
        cube = vtkCubeSource()
        for axis in "XYZ":
            getattr(cube, f"Set{axis}Length")(20.0)
        blocks = vtkGlyph3D()
        blocks.SetInputData(centers)
        blocks.SetSourceConnection(cube.GetOutputPort())
        blocks.ScalingOff()
        blocks.SetColorModeToColorByScalar()
        blocks.Update()
        actor = common.make_actor(blocks.GetOutput())
        actor.GetMapper().ScalarVisibilityOn()
        if name == "Pixels":
            actor.GetMapper().SetLookupTable(look)
            actor.GetMapper().UseLookupTableScalarRangeOn()
        actor.GetProperty().SetAmbient(0.6)
        actor.GetProperty().SetDiffuse(0.7)
        renderer = common.make_renderer()
        renderer.AddActor(actor)
        surface = common.make_actor(membrane, (1.0, 1.0, 0.0))
        surface.GetProperty().SetRepresentationToWireframe()
        renderer.AddActor(surface)
        common.add_lights(renderer, ((-0.5, 0.8, 1.0), (1.0, 1.0, 1.0), 1.1))
        common.look_from(renderer, (500.0, 500.0, 2000.0), (0.0, -230.0, -150.0), (0, 1, 0), 26.0)
        renderer.ResetCameraClippingRange()
        bar = common.make_bar(look, "pixels") if name == "Pixels" else None
        panels.append(common.take(renderer, (2 * size, 2 * size), bar))
    return common.stack(panels, len(panels))


def main():
    parser = argparse.ArgumentParser(description="Figures of the thesis")
    parser.add_argument("--output", default=".", help="existing folder for the pictures")
    parser.add_argument("--size", type=int, default=256, help="height of a panel in pixels")
    options = parser.parse_args()
    for name, make in (("thesis-resolution", draw_resolutions), ("membrane-cells", draw_cells),
                       ("error-volume", draw_errors), ("zone-of-convergence", draw_convergence)):
        common.write(make(options.size), os.path.join(options.output, name + ".png"))


if __name__ == "__main__":
    main()
