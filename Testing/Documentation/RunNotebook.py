# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Executes a notebook with nbclient and checks the pictures that it shows.

Arguments: the notebook; then optionally a file to write it to with its outputs. The notebook itself
is stored without outputs."""
import base64
import io
import sys

import nbformat
import numpy
from nbclient import NotebookClient
from PIL import Image

# Smallest range of pixel values in a picture, as in RunBlocks.py.
LEAST_CONTRAST = 50


def pictures_of(notebook):
    """The pictures below the cells, as arrays of RGB."""
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            data = output.get("data", {}).get("image/png")
            if data:
                yield numpy.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB"))


def main():
    notebook = nbformat.read(sys.argv[1], as_version=4)
    nbformat.validate(notebook)
    if any(cell.get("outputs") for cell in notebook.cells):
        sys.exit("%s is stored with outputs" % sys.argv[1])
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            print(output.get("text", ""), end="")
    pictures = list(pictures_of(notebook))
    for number, picture in enumerate(pictures):
        print("picture %d: %d x %d, values %d to %d" % (
            number, picture.shape[1], picture.shape[0], picture.min(), picture.max()))
        if int(picture.max()) - int(picture.min()) < LEAST_CONTRAST:
            sys.exit("it shows nothing")
    if len(pictures) != 4:
        sys.exit("%d pictures instead of 4" % len(pictures))
    # Water moves the picture: a tenth of the pixels at least.
    under_water, in_air = (picture.astype(int) for picture in pictures[2:])
    changed = (abs(under_water - in_air).max(axis=2) > 20).mean()
    if changed < 0.1:
        sys.exit("%.3f of the pixels differ under water" % changed)
    if len(sys.argv) > 2:
        nbformat.write(notebook, sys.argv[2])


if __name__ == "__main__":
    main()
