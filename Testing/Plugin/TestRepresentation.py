# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A tetrahedral mesh drawn by our representation looks like ParaView's own volume: same silhouette,
same opacity and colours. ParaView's result (projected tetrahedra) has an error of a few units."""
import PluginTesting
from paraview import simple

# The two mappers may disagree in pixels that the silhouette only touches.
LEAST_OVERLAP = 0.97
# Mean difference, in steps of 255, over the pixels that either mapper covers.
MOST_MEAN_DIFFERENCE = 4


def mean_difference(one, other, where):
    differences = [max(abs(a - b) for a, b in zip(one[i], other[i])) for i in where]
    return sum(differences) / len(differences)


def test():
    PluginTesting.load_plugin()
    grid = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-6, 6] * 3))
    view = PluginTesting.make_view()
    display = simple.Show(grid, view)
    # The default up to ParaView 5.13; that of 6.1 has more contrast, which makes the error larger.
    simple.GetColorTransferFunction("RTData").ApplyPreset("Cool to Warm")
    pictures = {}
    for representation in ["Volume", "Volume (Exact)"]:
        display.SetRepresentationType(representation)
        simple.ColorBy(display, ("POINTS", "RTData"))
        simple.ResetCamera(view)
        view.CameraPosition = [25, 18, 40]
        view.CameraFocalPoint = [0, 0, 0]
        name = "Representation" + representation.replace(" ", "")
        pictures[representation] = PluginTesting.screenshot(view, name)

    theirs = PluginTesting.covered(pictures["Volume"])
    ours = PluginTesting.covered(pictures["Volume (Exact)"])
    overlap = len(theirs & ours) / max(1, len(theirs | ours))
    print("covered pixels: %d, built-in %d, overlap %.4f" % (len(ours), len(theirs), overlap))
    assert len(ours) > 0.05 * PluginTesting.SIZE**2, "the picture is all but empty"
    assert overlap > LEAST_OVERLAP, "the silhouette is not the mesh's"
    difference = mean_difference(*pictures.values(), theirs | ours)
    print("mean difference %.2f of 255" % difference)
    assert difference < MOST_MEAN_DIFFERENCE, "opacity or colours are not those of the volume"

    simple.Hide(grid, view)
    hidden = PluginTesting.covered(PluginTesting.screenshot(view, "RepresentationHidden"))
    assert not hidden, "%d pixels are drawn though the mesh is hidden" % len(hidden)


if __name__ == "__main__":
    PluginTesting.run(test)
