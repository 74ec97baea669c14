# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sheets of paper with panels, their titles and scales. Pictures are arrays of colours between 0
and 1, in rows upwards."""
import numpy
from gallery import common
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTextProperty, vtkTextRenderer

GAP = 16  # pixels between panels
TEXT = 20  # height of letters in pixels
LINE = 26  # distance of lines of text in pixels
DPI = 72


def to_image(rows):
    image = vtkImageData()
    image.SetDimensions(rows.shape[1], rows.shape[0], 1)
    levels = numpy.round(255 * rows).astype(numpy.uint8).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(numpy.ascontiguousarray(levels), deep=True))
    return image


def to_rows(image):
    size = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(size[1], size[0], -1) / 255.0


def shrink(rows, finer):
    """The means of `finer` x `finer` pixels."""
    height, width = (side // finer for side in rows.shape[:2])
    return rows.reshape(height, finer, width, finer, *rows.shape[2:]).mean(axis=(1, 3))


def get_panel_width(width, columns):
    """Width of the panels of a sheet of that width."""
    return (width - (columns + 1) * GAP) // columns


def make_paper(height, width):
    return numpy.ones((height, width, 3))


def add_text(paper, text, x, y, justification="Left"):
    """Writes lines of text whose upper edge is at y, to the right of x or centred about it."""
    letters = vtkTextProperty()
    letters.SetFontSize(TEXT)
    letters.SetColor(*common.INK)
    for row, line in enumerate(text.split("\n")):
        image, size = vtkImageData(), [0, 0]
        vtkTextRenderer.GetInstance().RenderString(letters, line, image, size, DPI)
        ink = to_rows(image)[:size[1], :size[0]]
        bounds = [0] * 4
        vtkTextRenderer.GetInstance().GetBoundingBox(letters, line, bounds, DPI)
        left = x - (ink.shape[1] // 2 if justification == "Centered" else 0)
        bottom = y - row * LINE - TEXT + bounds[2]
        place = paper[max(bottom, 0):bottom + ink.shape[0], max(left, 0):left + ink.shape[1]]
        ink = ink[max(-bottom, 0):, max(-left, 0):][:place.shape[0], :place.shape[1]]
        place += ink[..., 3:] * (ink[..., :3] - place)


def make_sheet(panels, titles, columns):
    """Panels of one size in rows, from the upper left one, below their titles."""
    height, width = panels[0].shape[:2]
    title = LINE * max(text.count("\n") + 1 for text in titles)
    row_height = title + height + GAP
    rows = -(-len(panels) // columns)
    paper = make_paper(rows * row_height + GAP, columns * (width + GAP) + GAP)
    for index, (panel, text) in enumerate(zip(panels, titles)):
        left = GAP + index % columns * (width + GAP)
        top = paper.shape[0] - GAP - index // columns * row_height
        add_text(paper, text, left, top)
        paper[top - title - height:top - title, left:left + width] = panel
    return paper


def add_scale(sheet, bars):
    """The sheet above horizontal scales. Each has the middle and the width of its bar as shares of
    the sheet, the colours of the bar from left to right, and labels at shares of the bar."""
    paper = make_paper(2 * LINE + GAP, sheet.shape[1])
    for middle, share, colors, labels, title in bars:
        width = round(share * sheet.shape[1])
        left = round(middle * sheet.shape[1]) - width // 2
        at = numpy.linspace(0.0, len(colors) - 1, width)
        for channel in range(3):
            paper[GAP + LINE:GAP + 2 * LINE - 4, left:left + width, channel] = numpy.interp(
                at, numpy.arange(len(colors)), numpy.array(colors)[:, channel])
        for place, label in labels:
            add_text(paper, label, left + round(place * width), GAP + LINE - 4, "Centered")
        add_text(paper, title, left + width + GAP, GAP + 2 * LINE - 4)
    return numpy.concatenate((paper, sheet))
