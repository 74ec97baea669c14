# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Colours of a desert: sky and mountains by direction, ground by place, things in the sunlight."""
import numpy

SUN = numpy.array([-0.62, 0.47, 0.63])  # towards it
HAZE = numpy.array([0.80, 0.83, 0.86])


def mix(first, second, share):
    return first + (numpy.asarray(second) - first) * share[..., None]


def rise(begin, end, x):
    """0 below the begin, 1 above the end, smooth between them."""
    share = numpy.clip((x - begin) / (end - begin), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def make_noise(x, y, seed=0, octaves=5, gain=0.5):
    """Smooth random numbers from 0 to 1 with details of ever smaller sizes."""
    total, weight, size = 0.0, 0.0, 1.0
    x, y = numpy.broadcast_arrays(numpy.asarray(x, float), numpy.asarray(y, float))
    table = numpy.random.default_rng(seed).random((octaves, 256, 256))
    for values in table:
        column, row = numpy.floor(x), numpy.floor(y)
        u, v = rise(0.0, 1.0, x - column), rise(0.0, 1.0, y - row)
        i, j = column.astype(int) & 255, row.astype(int) & 255
        i1, j1 = (i + 1) & 255, (j + 1) & 255
        total = total + size * ((values[j, i] * (1 - u) + values[j, i1] * u) * (1 - v)
                                + (values[j1, i] * (1 - u) + values[j1, i1] * u) * v)
        weight += size
        size *= gain
        x, y = 2.03 * x + 17.3, 2.03 * y + 5.7
    return total / weight


def paint_sky(side, up):
    """The sky in a narrow view: haze at the horizon, and fair-weather clouds far away."""
    height = numpy.clip(up / 9e-3, 0.0, 1.0)
    sky = mix(numpy.array([0.80, 0.87, 0.93]), [0.30, 0.53, 0.84], height ** 0.75)
    puffs = make_noise(460.0 * side + 3.0, 900.0 * up, seed=3, octaves=6, gain=0.55)
    bank = rise(1.4e-3, 3.0e-3, up) * (1.0 - 0.75 * rise(4.5e-3, 8.0e-3, up))
    cloud = rise(0.47, 0.66, puffs) * bank
    shade = make_noise(460.0 * side + 3.2, 900.0 * up + 0.5, seed=3, octaves=6, gain=0.55)
    lit = rise(-0.10, 0.12, puffs - shade)
    return mix(sky, mix(numpy.array([0.74, 0.79, 0.86]), [0.99, 0.985, 0.97], lit), 0.9 * cloud)


RANGES = (  # height and length of the ridges, colours in the sun and in the shade, haze
    (3.4e-3, 170.0, (0.56, 0.50, 0.55), (0.43, 0.44, 0.55), 0.62, 11),
    (2.3e-3, 230.0, (0.62, 0.49, 0.42), (0.42, 0.38, 0.42), 0.42, 23),
    (1.1e-3, 330.0, (0.66, 0.51, 0.38), (0.44, 0.37, 0.34), 0.24, 37),
)


def paint_far(slopes):
    """Sky and mountains behind everything, by the slopes of the direction."""
    side, up = slopes[..., 0], slopes[..., 1]
    picture = paint_sky(side, up)
    for height, length, sunny, shady, haze, seed in RANGES:
        peaks = make_noise(length * side + seed, 0.5, seed=seed, octaves=7, gain=0.52)
        ridge = height * (0.18 + 1.35 * numpy.clip(peaks - 0.22, 0.0, 1.0))
        # Gullies run down from the ridge; a slope is in the sun where the rock falls to the left.
        down = numpy.clip((ridge - up) / height, 0.0, 1.5)
        across = 1.6 * length * side + 0.9 * down
        rock = make_noise(across, 2.2 * down, seed=seed + 1, octaves=6, gain=0.6)
        beside = make_noise(across + 0.12, 2.2 * down, seed=seed + 1, octaves=6, gain=0.6)
        color = mix(numpy.array(shady), sunny, rise(-0.035, 0.05, rock - beside))
        color = color * (0.86 + 0.28 * rock[..., None])
        color = mix(color, HAZE, numpy.clip(haze + 0.45 * rise(0.1, 1.0, down), 0.0, 0.9))
        picture = mix(picture, color, numpy.clip((ridge - up) / 1.2e-5 + 0.5, 0.0, 1.0))
    return picture


def paint_ground(x, y, half):
    """Sand with gravel, and an old road with lines; `half` is half of the road's width."""
    patches = make_noise(0.03 * x, 0.55 * y, seed=5, octaves=4)
    grit = make_noise(1.3 * x, 14.0 * y, seed=6, octaves=4, gain=0.8)
    sand = mix(numpy.array([0.62, 0.50, 0.36]), [0.82, 0.69, 0.52], rise(0.25, 0.75, patches))
    sand = sand * (0.72 + 0.5 * grit[..., None])
    tar = mix(numpy.array([0.31, 0.31, 0.315]), [0.41, 0.40, 0.385], rise(0.3, 0.7, patches))
    tracks = numpy.exp(-((abs(abs(y) - 0.5 * half) - 0.75) / 0.28) ** 2)
    road = tar * (0.80 + 0.40 * grit[..., None]) * (1.0 - 0.16 * tracks[..., None])
    seam = make_noise(0.11 * x, 3.0 * y, seed=8, octaves=3)
    road = mix(road, [0.11, 0.11, 0.115], 0.75 * rise(0.008, 0.0, abs(seam - 0.47)))
    worn = rise(0.20, 0.42, make_noise(2.0 * x, 16.0 * y, seed=9, octaves=4, gain=0.8))
    edge = abs(abs(y) - half + 0.30) < 0.08
    dash = (abs(y) < 0.08) & (x % 15.0 < 6.0)
    road = mix(road, [0.86, 0.84, 0.77], 0.92 * worn * (edge | dash))
    verge = half + 0.35 * (make_noise(0.5 * x, 0.0 * y, seed=10, octaves=4) - 0.4)
    ground = mix(road, sand, rise(-0.04, 0.04, abs(y) - verge))
    return mix(ground, HAZE, numpy.clip(1.0 - numpy.exp(-x / 2600.0), 0.0, 1.0))


def paint_around(ways):
    """Light from a direction: what polished things mirror."""
    up = ways[..., 2]
    sky = mix(numpy.array([0.88, 0.91, 0.94]), [0.36, 0.56, 0.84], rise(0.0, 0.7, up))
    earth = mix(numpy.array([0.72, 0.62, 0.48]), [0.34, 0.29, 0.24], rise(0.0, 0.6, -up))
    return mix(earth, sky, rise(-0.03, 0.05, up))


def light(color, normals, ways, gloss):
    """Sunlight, and light from above and below, on a surface that mirrors a share of it."""
    sun = SUN / numpy.linalg.norm(SUN)
    facing = (normals * ways).sum(axis=-1)
    normals = numpy.where(facing[..., None] > 0.0, -normals, normals)
    mirrored = ways - 2.0 * (normals * ways).sum(axis=-1)[..., None] * normals
    direct = numpy.clip(normals @ sun, 0.0, 1.0)
    around = 0.36 + 0.20 * normals[..., 2]
    matt = color * (0.92 * direct + around)[..., None]
    fresnel = 0.05 + 0.95 * (1.0 - abs(facing)) ** 5
    spot = numpy.clip(mirrored @ sun, 0.0, 1.0) ** 180
    shine = paint_around(mirrored) * fresnel[..., None] + 1.5 * spot[..., None]
    return matt * (1.0 - 0.5 * numpy.asarray(gloss)[..., None]) + shine * numpy.asarray(
        gloss)[..., None]
