# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the documentation's gallery and of the README.

usage: pictures.py FIN.vtu COMBUSTOR.vtu CAN.vtu KITCHEN.vts [--output DIR] [--size N]
       [--only NAME ...]

The meshes are the blunt fin, the combustor and the crushed can, test data of VTK and ParaView, as
tetrahedra, and the air in a kitchen, one of VTK's examples. Each picture is a function of the
package `gallery`, next to this file.
"""
import argparse
import os
import types

from gallery import (
    cells, common, fire, glass, lenses, mirage, opacity, pools, rivals, rooms, shadows, solids,
    steps, through, tunnel, volumes)

PICTURES = {
    "readme-rivals": rivals.draw_rivals,
    "readme-volume": volumes.draw_flames,
    "readme-refraction": pools.draw_pool,
    "gallery-kitchen": rooms.draw_kitchen,
    "gallery-cloud": shadows.draw_cloud,
    "gallery-glass": glass.draw_glass,
    "gallery-schlieren": tunnel.draw_schlieren,
    "gallery-mirage": mirage.draw_mirage,
    "gallery-fire": fire.draw_fire,
    "gallery-luneburg": lenses.draw_luneburg,
    "true-cells": cells.draw_hexahedra,
    "gallery-radiograph": volumes.draw_radiograph,
    "gallery-cells": cells.draw_cells,
    "gallery-blow": steps.draw_blow,
    "gallery-duck": solids.draw_duck,
    "gallery-rings": pools.draw_rings,
    "gallery-lens": through.draw_lens,
    "opacity-distances": opacity.draw_distances,
    "opacity-functions": opacity.draw_functions,
    "volume-modes": volumes.draw_modes,
    "volume-shadows": shadows.draw_shadows,
}


def main():
    parser = argparse.ArgumentParser(description="The pictures of the gallery")
    for name in ("fin", "combustor", "can"):
        parser.add_argument(name, help="tetrahedra, a .vtu file")
    parser.add_argument("kitchen", help="a curvilinear grid, a .vts file")
    parser.add_argument("--output", default=".", help="existing folder for the pictures")
    parser.add_argument("--size", type=int, default=960, help="height in pixels")
    parser.add_argument("--only", nargs="+", choices=list(PICTURES), help="names of pictures")
    options = parser.parse_args()
    names = ("fin", "combustor", "can", "kitchen")
    data = types.SimpleNamespace(**{name: common.read(getattr(options, name)) for name in names})
    for name in options.only or PICTURES:
        image = PICTURES[name](data, (4 * options.size // 3, options.size))
        if image:
            common.write(image, os.path.join(options.output, name + ".png"))
        else:
            print(f"no {name}: built without TetGen")


if __name__ == "__main__":
    main()
