# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The film of the thesis "Refraction by geometric transforms", Figs. 5.1 and 5.2: a triangle that
moves through the zone of convergence behind a convex membrane, with the first image of each vertex,
with all images, and traced. Popping is the largest change of a pixel from one frame to the next.

usage: thesis_film.py [--output DIR] [--width N] [--size N] [--frames N]
"""
import argparse
import os

import meniscus
import numpy
from gallery import common, sheets
from thesis_figures import (
    AIR, DISC, EYE, FILL, GLASS, HALF_TANGENT, SAMPLES, SPHERE, TRIANGLE_HEIGHT, TRIANGLE_RADIUS,
    draw_virtual, make_disc, make_triangle)

RADIUS = 60.0  # of the triangle
SHOWN = 6  # frames of the contact sheet
DOME = (0.87, 0.92, 0.95)
# Places of the triangle's middle in the first and the last frame.
FILMS = {"depth": ((0.0, -150.0, 0.0), (0.0, -500.0, 0.0)),
         "aside": ((-60.0, -300.0, 15.0), (60.0, -300.0, 15.0))}


def make_dome(rings):
    """The cap of a sphere, convex to the eye, its top at the origin."""
    return make_disc(rings, lambda r: (SPHERE**2 - r * r)**0.5 - SPHERE,
                     lambda r: -r / (SPHERE**2 - r * r)**0.5)


def get_place(film, share):
    first, last = FILMS[film]
    return tuple(a + share * (b - a) for a, b in zip(first, last))


def place(triangle, middle):
    """A triangle of make_triangle, smaller and elsewhere."""
    points = triangle.GetPoints()
    for i in range(points.GetNumberOfPoints()):
        x, y, z = points.GetPoint(i)
        scale = RADIUS / TRIANGLE_RADIUS
        points.SetPoint(i, scale * x + middle[0], y - TRIANGLE_HEIGHT + middle[1],
                        scale * z + middle[2])
    return triangle


def refract(triangle, membrane, model, all_images):
    refraction = meniscus.vtkRefractedGeometryFilter()
    refraction.SetInputData(triangle)
    refraction.SetMembraneData(membrane)
    refraction.SetEyePosition(*EYE)
    refraction.SetExteriorIndexOfRefraction(AIR)
    refraction.SetInteriorIndexOfRefraction(GLASS)
    refraction.SetMembraneModel(model)
    refraction.SetImages(refraction.ALL_IMAGES if all_images else refraction.FIRST_IMAGE)
    refraction.Update()
    return refraction.GetOutput()


def hit_dome(size):
    """Rays of the samples, the places where they meet the sphere, and whether the cap is there."""
    at = HALF_TANGENT * (2.0 * (numpy.arange(size) + 0.5) / size - 1.0)
    x, z = numpy.meshgrid(at, -at)
    ray = numpy.stack([x, -numpy.ones_like(x), z])
    ray /= numpy.linalg.norm(ray, axis=0)
    to_eye = numpy.array(EYE) - (0.0, -SPHERE, 0.0)
    along = numpy.tensordot(to_eye, ray, 1)
    root = along**2 - to_eye @ to_eye + SPHERE**2
    hits = root > 0.0
    near = -along - numpy.sqrt(numpy.where(hits, root, 0.0))
    hit = numpy.array(EYE)[:, None, None] + near * ray
    return ray, hit, hits & (numpy.hypot(hit[0], hit[2]) <= DISC)


def trace(middle, size):
    """Samples that show the triangle, in rows upwards, by rays through the sphere itself."""
    ray, hit, hits = hit_dome(size)
    normal = (hit - numpy.array((0.0, -SPHERE, 0.0))[:, None, None]) / SPHERE
    cosine = -(ray * normal).sum(axis=0)
    ratio = AIR / GLASS
    inner = numpy.sqrt(1.0 - ratio**2 * (1.0 - cosine**2))
    behind = ratio * ray + (ratio * cosine - inner) * normal
    distance = (middle[1] - hit[1]) / behind[1]
    hits &= distance > 0.0
    places = [hit[k] + distance * behind[k] - middle[k] for k in (0, 2)]
    seen = hits
    angles = numpy.pi / 2 + 2.0 * numpy.pi * numpy.arange(3) / 3
    for angle in angles + numpy.pi:  # outward normals of the sides, at half of the radius
        side = numpy.cos(angle) * places[0] + numpy.sin(angle) * places[1]
        seen = seen & (side <= 0.5 * RADIUS)
    return seen


def make_film(film, size, shares):
    """Frames of the three ways as covered parts of pixels, and the samples that differ from the
    traced ones in the worst frame. `shares` are the places of the frames on the way, 0 to 1."""
    coarse, fine = make_dome(5), make_dome(8)
    model = meniscus.vtkRefractedGeometryFilter
    ways = {"first image": (8, coarse, model.FLAT_FACETS, False),
            "all images": (2, fine, model.CURVED, True)}
    films = {name: [] for name in ("traced", *ways)}
    worst = dict.fromkeys(ways, 0)
    for share in shares:
        middle = get_place(film, share)
        truth = trace(middle, SAMPLES * size)
        films["traced"].append(sheets.shrink(truth, SAMPLES))
        for name, (side, membrane, kind, all_images) in ways.items():
            data = refract(place(make_triangle(side), middle), membrane, kind, all_images)
            samples = draw_virtual(data, SAMPLES * size)
            worst[name] = max(worst[name], int((samples != truth).sum()))
            films[name].append(sheets.shrink(samples, SAMPLES))
    return films, worst


def get_popping(frames):
    """Largest change of a pixel, and of the covered area in pixels, between two frames."""
    changes = [numpy.abs(b - a) for a, b in zip(frames, frames[1:])]
    return max(c.max() for c in changes), max(c.sum() for c in changes)


def draw_sheet(film, width):
    """Some frames, from left to right: with first images, with all images, and traced."""
    panel = sheets.get_panel_width(width, SHOWN)
    size = panel * 4 // 3
    edge = (size - panel) // 2
    shares = numpy.linspace(0.0, 1.0, SHOWN)
    films, _ = make_film(film, size, shares)
    dome = sheets.shrink(hit_dome(SAMPLES * size)[2], SAMPLES)[..., None]
    empty = 1.0 + dome * (numpy.array(DOME) - 1.0)
    panels, titles = [], []
    for name in ("first image", "all images", "traced"):
        for share, pixels in zip(shares, films[name]):
            colors = empty + pixels[..., None] * (FILL - empty)
            panels.append(colors[edge:edge + panel, edge:edge + panel])
            x, height, _ = get_place(film, share)
            titles.append(f"{name}\n" + (f"{-height:g} deep" if film == "depth" else f"at {x:g}"))
    return sheets.make_sheet(panels, titles, SHOWN)


def main():
    parser = argparse.ArgumentParser(description="A triangle in a zone of convergence")
    parser.add_argument("--output", default=".", help="existing folder for the pictures")
    parser.add_argument("--width", type=int, default=1280, help="of the pictures, in pixels")
    parser.add_argument("--size", type=int, default=48, help="height of a measured frame in pixels")
    parser.add_argument("--frames", type=int, default=360, help="number of measured frames")
    options = parser.parse_args()
    for film in FILMS:
        films, worst = make_film(
            film, options.size, numpy.linspace(0.0, 1.0, options.frames))
        for name, frames in films.items():
            change, area = get_popping(frames)
            print(f"{film}, {name}: largest change of a pixel {change:.2f}, of a frame "
                  f"{area:.1f} pixels" +
                  (f", {worst[name]} samples wrong in the worst frame" if name in worst else ""))
        common.write(sheets.to_image(draw_sheet(film, options.width)),
                     os.path.join(options.output, f"thesis-film-{film}.png"))


if __name__ == "__main__":
    main()
