"""A triangle that moves through a zone of convergence (thesis, Figs. 5.1 and 5.2): with all images
it is as traced in each frame, and with the first image of each vertex it pops."""
import os
import sys

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "Examples", "Python"))

import thesis_film  # noqa: E402

SIZE = 32
# Depths of 311 to 339, where corners of the triangle meet the zone.
DEPTHS = numpy.linspace(0.46, 0.54, 29)


def test_depth():
    films, worst = thesis_film.make_film("depth", SIZE, DEPTHS)
    samples = films["traced"][0].size * thesis_film.SAMPLES**2
    assert worst["all images"] <= 0.001 * samples, worst
    assert worst["first image"] >= 0.05 * samples, worst
    traced, all_images, first = (
        thesis_film.get_popping(films[name]) for name in ("traced", "all images", "first image"))
    # The traced film changes gently, and that with all images by no more than a sample besides.
    assert traced[0] <= 0.3, traced
    assert all_images[0] <= traced[0] + 1.0 / thesis_film.SAMPLES**2, (all_images, traced)
    assert all_images[1] <= 1.1 * traced[1], (all_images, traced)
    # Vertices jump: pixels change from nothing to everything, and many at once.
    assert first[0] == 1.0, first
    assert first[1] >= 3.0 * traced[1], (first, traced)


def test_aside():
    """Fig. 5.2: the body and the sliver at the far side."""
    films, worst = thesis_film.make_film("aside", SIZE, (0.2, 0.8))
    samples = films["traced"][0].size * thesis_film.SAMPLES**2
    assert worst["all images"] <= 0.001 * samples, worst
    assert worst["first image"] >= 0.02 * samples, worst


def main():
    test_depth()
    test_aside()
    return 0


if __name__ == "__main__":
    sys.exit(main())
