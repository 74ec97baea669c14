# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filters' part of RunRanks.py in ParaView, on each number of ranks: refracted geometry,
refracted light and error volumes, behind a membrane that one rank has and one of which each has a
part. Numbers are written with all their bits, in hexadecimal."""
import os

from paraview import servermanager, simple

FOLDER = os.environ["MENISCUS_OUTPUT_DIR"]
WAVES = "coords+kHat*(0.3*sin(coordsX)*cos(coordsY))"


def sheet(half, height):
    """Triangles at a height, seen from above, of which each rank has a part."""
    low = int(height - 0.5)
    field = simple.Calculator(
        Input=simple.Wavelet(WholeExtent=[-half, half, -half, half, low, low + 1]),
        ResultArrayName="Depth", Function="-coordsZ")
    return simple.Contour(Input=field, ContourBy=["POINTS", "Depth"], Isosurfaces=[-height],
                          ComputeNormals=0)


def plane(resolution):
    """As above, on one rank, with the given number of squares along each side."""
    return simple.Plane(Origin=[-8, -8, 0.5], Point1=[8, -8, 0.5], Point2=[-8, 8, 0.5],
                        XResolution=resolution, YResolution=resolution)


def waves(surface):
    return simple.Calculator(Input=surface, CoordinateResults=1, Function=WAVES)


def hexed(numbers):
    return " ".join(float(number).hex() for number in numbers)


def write_lines(name, lines):
    with open(os.path.join(FOLDER, name), "w") as file:
        file.writelines(line + "\n" for line in lines)


def write_refracted(name, membrane):
    """Points of all ranks, with the depth behind the membrane."""
    block = simple.Wavelet(WholeExtent=[-4, 4, -4, 4, -5, -1])
    vertices = simple.MaskPoints(
        Input=block, OnRatio=1, MaximumNumberofPoints=100000, GenerateVertices=1,
        SingleVertexPerCell=1, ProportionallyDistributeMaximumNumberOfPoints=0)
    refracted = simple.RefractedGeometry(Geometry=vertices, Membrane=membrane)
    refracted.EyePosition = [1, -3, 12]
    data = servermanager.Fetch(refracted)
    depths = data.GetPointData().GetArray("RefractionDepth")
    write_lines(name + ".points", (
        hexed(data.GetPoint(i) + (depths.GetValue(i),)) for i in range(data.GetNumberOfPoints())))


def write_light(name, membrane):
    """Writes the light on cells, by their points, and the light on points, from a light at
    infinity. The floor extends beyond the membrane, so that the bounds of its parts differ from
    those of the whole."""
    light = simple.RefractedLight(Geometry=sheet(10, -3.5), Membrane=membrane)
    light.LightPosition = [0.2, -0.1, 1]
    data = servermanager.Fetch(light)
    cells = data.GetCellData().GetArray("RefractionIrradiance")
    points = data.GetPointData().GetArray("RefractionIrradiance")

    def corners(cell):
        ids = data.GetCell(cell).GetPointIds()
        found = sorted(data.GetPoint(ids.GetId(i)) for i in range(ids.GetNumberOfIds()))
        return [x for point in found for x in point]

    write_lines(name + "Cells.light", (
        hexed(corners(i) + [cells.GetValue(i)]) for i in range(data.GetNumberOfCells())))
    write_lines(name + "Points.light", (
        hexed(data.GetPoint(i) + (points.GetValue(i),)) for i in range(data.GetNumberOfPoints())))


# Run by each rank: its samples, by their indices, and the statistics in its field data.
WRITE_SAMPLES = """
import os
from paraview.modules.vtkRemotingCore import vtkProcessModule
data = self.GetInputDataObject(0, 0)
rank = vtkProcessModule.GetProcessModule().GetPartitionId()
errors = data.GetPointData().GetArray("RefractionError")
states = data.GetPointData().GetArray("SampleState")
with open(os.path.join(%r, "%s-%%d.samples" %% rank), "w") as file:
    low = data.GetExtent()[::2]
    size = data.GetDimensions()
    for i in range(data.GetNumberOfPoints()):
        place = (low[0] + i %% size[0], low[1] + i // size[0] %% size[1],
                 low[2] + i // (size[0] * size[1]))
        file.write("%%d %%d %%d " %% place + errors.GetValue(i).hex()
                   + " %%d\\n" %% states.GetValue(i))
    for name in ("NumberOfMeasuredSamples", "LargestError", "MeanError", "StandardDeviation"):
        file.write(name + " " + data.GetFieldData().GetArray(name).GetTuple1(0).hex() + "\\n")
"""


def write_errors(name, membrane, finer, model, samples):
    volume = simple.RefractionErrorVolume(Membrane=membrane, FinerMembrane=finer)
    volume.EyePosition = [1, -3, 12]
    volume.MembraneModel = model
    volume.ModelBounds = [-3, 3, -4, 4, -5, -1]
    volume.SampleDimensions = samples
    write = simple.ProgrammableFilter(Input=volume, Script=WRITE_SAMPLES % (FOLDER, name))
    write.UpdatePipeline()
    simple.Delete(write)


def main(prefix):
    finer = waves(plane(96))
    for name, surface in [("OneRank", plane(24)), ("AllRanks", sheet(8, 0.5))]:
        membrane = waves(surface)
        write_refracted(prefix + name, membrane)
        write_light(prefix + "Light" + name, membrane)
        for model in ("Flat facets", "Curved"):
            write_errors(prefix + "Errors" + model.split()[0] + name, membrane, finer, model,
                         [12, 11, 9])
    # Fewer samples than ranks.
    write_errors(prefix + "ErrorsOfTwo", membrane, finer, "Flat facets", [1, 2, 1])
