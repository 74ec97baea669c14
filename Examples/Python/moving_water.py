# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Four seconds of moving water, as a loop.

usage: moving_water.py [--output DIR] [--size N] [--frames N]

Writes moving-000.png and so on and, if Pillow is installed, moving-water.webp.
"""
import argparse
import os

from gallery import common, pools

SECONDS = 4


def main():
    parser = argparse.ArgumentParser(description="Four seconds of moving water, as a loop")
    parser.add_argument("--output", default=".", help="existing folder for the pictures")
    parser.add_argument("--size", type=int, default=360, help="height in pixels")
    parser.add_argument("--frames", type=int, default=pools.FRAMES, help="number of pictures")
    options = parser.parse_args()
    names = []
    size = (4 * options.size // 3, options.size)
    for number, image in enumerate(pools.draw_frames(size, options.frames)):
        names.append(os.path.join(options.output, "moving-%03d.png" % number))
        common.write(image, names[-1])
    try:
        from PIL import Image
    except ImportError:
        print("no moving-water.webp: Pillow is not installed")
        return
    frames = [Image.open(name) for name in names]
    frames[0].save(os.path.join(options.output, "moving-water.webp"), save_all=True,
                   append_images=frames[1:], duration=1000 * SECONDS // len(frames), loop=0,
                   quality=85, method=4)


if __name__ == "__main__":
    main()
