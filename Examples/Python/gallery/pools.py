# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pools: tiles with caustics, objects in coloured water, reflection of a sky, rings that spread."""
import math

import meniscus
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkTexture

from . import common, solids

SUN = (-0.45, -0.35, 0.82)
DEPTH = 0.75  # of the pool, which is 2 wide
DECK = 0.07  # height of the deck above the water
# Amplitude, wave vector and phase of the waves.
WAVES = ((0.0075, 12.0, 5.0, 0.3), (0.0060, -7.0, 14.0, 1.7), (0.0035, 19.0, 13.0, 4.0),
         (0.0028, -21.0, 9.0, 2.2), (0.006, 3.0, -5.0, 0.8))


def mix(first, second, share):
    return tuple(a + share * (b - a) for a, b in zip(first, second))


def get_sky(direction):
    """Colour of the sky in a direction: brighter towards horizon and sun."""
    length = math.sqrt(sum(c * c for c in direction))
    x, y, z = (c / length for c in direction)
    color = mix((0.80, 0.88, 0.95), (0.16, 0.40, 0.75), max(z, 0.0) ** 0.6)
    sun = sum(a * b for a, b in zip((x, y, z), SUN)) / math.sqrt(sum(c * c for c in SUN))
    color = mix(color, (1.0, 0.93, 0.78), 0.6 * max(sun, 0.0) ** 12)
    return (1.0, 1.0, 0.95) if sun > 0.9985 else color


def make_sky(pixels=64, color_of=get_sky):
    """A cube map of the sky, z upwards, in OpenGL's layout of faces."""
    faces = (lambda s, t: (1, -t, -s), lambda s, t: (-1, -t, s), lambda s, t: (s, 1, t),
             lambda s, t: (s, -1, -t), lambda s, t: (s, -t, 1), lambda s, t: (-s, -t, -1))
    sky = vtkTexture()
    sky.CubeMapOn()
    sky.InterpolateOn()
    for number, face in enumerate(faces):
        image = vtkImageData()
        image.SetDimensions(pixels, pixels, 1)
        image.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
        for j in range(pixels):
            for i in range(pixels):
                direction = face(2 * (i + 0.5) / pixels - 1, 2 * (j + 0.5) / pixels - 1)
                for channel, value in enumerate(color_of(direction)):
                    image.SetScalarComponentFromFloat(i, j, 0, channel, round(255 * value))
        sky.SetInputDataObject(number, image)
    return sky


def make_tiles(tiles=10, pixels=256, colors=((0.42, 0.74, 0.86), (0.66, 0.90, 0.94)),
               joints=(0.93, 0.96, 0.95), width=0.07):
    """Mosaic tiles of slightly different colours between two, with joints of a width."""
    image = vtkImageData()
    image.SetDimensions(pixels, pixels, 1)
    image.AllocateScalars(VTK_UNSIGNED_CHAR, 3)
    for j in range(pixels):
        for i in range(pixels):
            u, v = tiles * i / pixels, tiles * j / pixels
            joint = min(u % 1, v % 1) < width
            chance = math.sin(12.9898 * int(u) + 78.233 * int(v)) * 43758.5453 % 1.0
            for channel, value in enumerate(joints if joint else mix(*colors, chance)):
                image.SetScalarComponentFromFloat(i, j, 0, channel, round(255 * value))
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.InterpolateOn()
    texture.MipmapOn()
    texture.RepeatOn()
    return texture


def place(mesh, length, angle, position):
    """The surface of a mesh, smooth, of a given length, turned, at a position."""
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(mesh)
    x0, x1, y0, y1, z0, z1 = mesh.GetBounds()
    scale = length / max(x1 - x0, y1 - y0, z1 - z0)
    transform = vtkTransform()
    transform.Translate(*position)
    transform.RotateZ(angle)
    transform.Scale(scale, scale, scale)
    transform.Translate(-(x0 + x1) / 2, -(y0 + y1) / 2, -(z0 + z1) / 2)
    moved = vtkTransformPolyDataFilter()
    moved.SetInputConnection(surface.GetOutputPort())
    moved.SetTransform(transform)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(moved.GetOutputPort())
    normals.SetFeatureAngle(60)
    normals.Update()
    return normals.GetOutput()


def make_ball(center, radius):
    ball = vtkSphereSource()
    ball.SetCenter(*center)
    ball.SetRadius(radius)
    ball.SetThetaResolution(60)
    ball.SetPhiResolution(40)
    ball.Update()
    return ball.GetOutput()


class Pool:
    """A pool [-1, 1]^2 below z = 0, lit by the sun through its water."""

    def __init__(self, height, attenuation, cells=128, lights=112):
        self.lights = lights  # cells along each side of the floor
        self.water = common.make_height_field(
            (-1, -1, 0), (1, -1, 0), (-1, 1, 0), (cells, cells), height)
        self.renderer = common.make_renderer(((0.80, 0.88, 0.95), (0.35, 0.58, 0.85)))
        self.renderer.AutomaticLightCreationOff()
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(*(10 * c for c in SUN))
        light.SetIntensity(1.0)
        self.renderer.AddLight(light)
        self.surface = vtkActor()
        self.surface.SetMapper(vtkPolyDataMapper())
        self.surface.GetMapper().SetInputData(self.water)
        self.refraction = meniscus.vtkRefractionPass()
        self.refraction.SetReflectionTexture(make_sky())
        self.refraction.SetAttenuationCoefficients(*attenuation)
        self.refraction.SetLightingToTrueSpace()
        self.refraction.LightAttenuationOff()
        self.refraction.ShadowsOn()
        self.renderer.SetPass(self.refraction)

    def add_sides(self, texture):
        d, top = -DEPTH, DECK
        floor = common.make_plane((-1, -1, d), (1, -1, d), (-1, 1, d), (self.lights,) * 2)
        # As many parts along the floor as it has: cells at an edge are divided alike, without gaps.
        parts = (self.lights, max(self.lights // 7, 16))
        walls = [common.make_plane(*corners, parts) for corners in (
            ((-1, 1, d), (1, 1, d), (-1, 1, top)), ((-1, -1, d), (-1, 1, d), (-1, -1, top)),
            ((1, 1, d), (1, -1, d), (1, 1, top)))]
        self.add_lit(floor, texture, 1.7)
        for wall in walls:
            self.add_lit(wall, texture, 0.9)
        self.add_deck()

    def add_deck(self):
        """Stone around the pool, in the sun."""
        w = 4.0
        slabs = make_tiles(
            2, 128, ((0.84, 0.77, 0.66), (0.90, 0.84, 0.74)), (0.72, 0.65, 0.56), 0.04)
        for x, y, width, height in ((-w, 1, 2 * w, w), (-w, -w, 2 * w, w - 1), (-w, -1, w - 1, 2),
                                    (1, -1, w - 1, 2)):
            self.add_stone(((x, y, DECK), (x + width, y, DECK), (x, y + height, DECK)),
                           (1.0, 1.0, 1.0), slabs, (width, height))
        for corner, other in (((-1, 1), (1, 1)), ((-1, -1), (-1, 1)), ((1, 1), (1, -1))):
            self.add_stone(((*corner, -DECK), (*other, -DECK), (*corner, DECK)),
                           (0.62, 0.60, 0.56))

    def add_stone(self, corners, color, slabs=None, times=(1, 1)):
        """Adds a rectangle of one colour, or of slabs, repeated so many times."""
        plane = common.make_plane(*corners, (1, 1))
        coordinates = plane.GetPointData().GetTCoords()
        for i in range(4):
            coordinates.SetTuple2(i, *(a * b for a, b in zip(coordinates.GetTuple2(i), times)))
        stone = common.make_actor(plane, color)
        stone.SetTexture(slabs)
        stone.GetProperty().LightingOff()
        self.renderer.AddActor(stone)

    def add_lit(self, data, texture, brightest):
        """Adds an object whose colours are texture times light through the water."""
        actor = self.add_data(data)
        actor.SetTexture(texture)
        look = actor.GetProperty()
        look.SetAmbient(0.38)
        look.SetDiffuse(0.62 / brightest)

    def add(self, port):
        """Adds an object and returns its actor."""
        refracted = meniscus.vtkRefractedGeometryFilter()
        refracted.SetInputConnection(port)
        refracted.SetMembraneData(self.water)
        refracted.SetCamera(self.renderer.GetActiveCamera())
        refracted.SetAngularTolerance(0.03)
        refracted.TrueGeometryOn()
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(refracted.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        self.refraction.AddRefraction(self.surface, actor, refracted)
        return actor

    def add_data(self, data):
        producer = vtkTrivialProducer()
        producer.SetOutput(data)
        return self.add(producer.GetOutputPort())

    def add_colored(self, data, color):
        """Adds an object of one colour, lit by the sun through the water."""
        actor = self.add_data(data)
        actor.GetMapper().ScalarVisibilityOff()
        look = actor.GetProperty()
        look.SetColor(*color)
        look.SetAmbient(0.25)
        look.SetDiffuse(0.9)
        look.SetSpecular(0.5)
        look.SetSpecularPower(40)
        return actor


def draw_pool(data, size):
    """The crushed can, a ball and a duck in a tiled pool under a summer sky."""
    pool = Pool(lambda x, y: sum(a * math.sin(k * x + l * y + p) for a, k, l, p in WAVES),
                (0.60, 0.10, 0.05), 128, 384)
    pool.add_sides(make_tiles())
    can = pool.add_colored(place(data.can, 1.25, 25, (0.0, -0.05, -0.42)), (0.85, 0.86, 0.88))
    can.GetProperty().SetSpecular(0.9)
    low, high = common.get_range(data.can)
    can.GetMapper().ScalarVisibilityOn()
    can.GetMapper().SetScalarModeToUsePointFieldData()
    can.GetMapper().SelectColorArray("Speed")
    can.GetMapper().SetLookupTable(common.make_colors(common.INFERNO[2:], low, high))
    pool.add_colored(make_ball((0.55, 0.55, -0.55), 0.2), (0.95, 0.35, 0.15))
    duck = place(solids.make_duck(), 0.62, -50, (-0.52, 0.42, 0.08))
    swims = pool.add_colored(duck, (1, 1, 1))
    stands_out = common.make_actor(duck)  # the part above the water, by the renderer
    stands_out.SetProperty(swims.GetProperty())
    pool.renderer.AddActor(stands_out)
    for actor in (swims, stands_out):
        actor.GetMapper().ScalarVisibilityOn()
        actor.GetMapper().SetScalarModeToUsePointFieldData()
        actor.GetMapper().SelectColorArray("Paint")
        actor.GetMapper().SetLookupTable(common.make_colors(solids.PAINT, 0.0, 1.0))
    common.look_from(pool.renderer, (0.22, -2.45, 1.85), (0.0, 0.02, -0.23), (0, 0, 1), 28.5)
    pool.renderer.ResetCameraClippingRange(-1.2, 1.2, -1.2, 1.2, -1.5, 0.5)
    return common.take(pool.renderer, size)


# Places of drops that have fallen, and how far their rings have spread.
DROPS = ((0.2, 0.1, 0.55), (-0.55, 0.5, 0.24), (-0.35, -0.55, 0.36))


def get_rings(x, y):
    """Height of the rings of all drops; the wider a ring, the lower."""
    return sum(0.0075 / math.sqrt(spread) * math.cos(26.0 * (r - spread)) * math.exp(
        -((r - spread) / 0.16) ** 2) for r, spread in (
            (math.hypot(x - a, y - b), spread) for a, b, spread in DROPS))


def draw_rings(_data, size):
    """Rings of three drops that have fallen into a pool."""
    pool = Pool(get_rings, (0.60, 0.10, 0.05), 192, 576)
    pool.add_sides(make_tiles())
    common.look_from(pool.renderer, (0.3, -2.5, 2.0), (0.0, -0.04, -0.2), (0, 0, 1), 28.0)
    pool.renderer.ResetCameraClippingRange(-1.2, 1.2, -1.2, 1.2, -1.5, 0.5)
    return common.take(pool.renderer, size)


FRAMES = 40  # of the loop, which lasts 4 seconds
# Amplitude, wave vector, phase and periods in the loop, of waves that move.
SWELL = ((0.0085, 9.0, 4.0, 0.3, 3), (0.0065, -6.0, 10.0, 1.7, 4), (0.0035, 15.0, 11.0, 4.0, 6),
         (0.0028, -17.0, 8.0, 2.2, 6), (0.007, 3.0, -4.0, 0.8, 2))


def draw_frames(size, frames):
    """The pictures of a loop: waves pass over a pool in which a ball floats and one has sunk."""
    tiles = make_tiles()
    for frame in range(frames):
        def height(x, y, turn=2.0 * math.pi * frame / frames):
            return sum(a * math.sin(k * x + l * y + p - n * turn) for a, k, l, p, n in SWELL)

        pool = Pool(height, (0.60, 0.10, 0.05), 64, 56)
        pool.refraction.SetNumberOfLightCells(20000)  # of each object, for each frame
        pool.add_sides(tiles)
        pool.add_colored(make_ball((0.45, 0.3, -0.53), 0.22), (0.95, 0.35, 0.15))
        pool.add_colored(make_ball((-0.4, -0.1, 0.04 + height(-0.4, -0.1)), 0.19),
                         (0.98, 0.80, 0.12))
        common.look_from(pool.renderer, (0.22, -2.45, 1.85), (0.0, 0.0, -0.25), (0, 0, 1), 32.0)
        pool.renderer.ResetCameraClippingRange(-1.2, 1.2, -1.2, 1.2, -1.5, 0.5)
        yield common.take(pool.renderer, size)
