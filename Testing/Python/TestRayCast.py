# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The mapper draws a tetrahedral mesh from Python and counts its work."""
import unittest

from VolumeWindow import make_wavelet, VolumeWindow

SIZE = 200


class TestRayCast(unittest.TestCase):
    def setUp(self):
        wavelet = make_wavelet(5)
        self.scene = VolumeWindow(SIZE, 37, 277, opacity=0.5)
        self.mapper = self.scene.mapper
        self.mapper.SetInputConnection(wavelet.GetOutputPort())

    def count_drawn(self):
        pixels = self.scene.draw()
        return sum(max(pixels[i:i + 3]) > 2 for i in range(0, len(pixels), 3))

    def test_draws(self):
        self.assertGreater(self.count_drawn(), 0.1 * SIZE * SIZE)
        self.assertIn(self.mapper.GetActiveBackend(), (self.mapper.OPENGL, self.mapper.NATIVE))
        self.assertEqual(self.mapper.GetNumberOfLostRays(), 0)
        self.scene.volume.VisibilityOff()
        self.assertEqual(self.count_drawn(), 0)

    def test_camera_move_rebuilds_nothing(self):
        self.scene.draw()
        builds = self.mapper.GetNumberOfMeshBuilds()
        uploaded = self.mapper.GetUploadedBytes()
        self.assertEqual(builds, 1)
        self.assertGreater(uploaded, 0)
        self.scene.renderer.GetActiveCamera().Azimuth(20)
        self.scene.draw()
        self.assertEqual(self.mapper.GetNumberOfMeshBuilds(), builds)
        self.assertEqual(self.mapper.GetUploadedBytes(), uploaded)


if __name__ == "__main__":
    unittest.main()
