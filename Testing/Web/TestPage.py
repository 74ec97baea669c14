# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of `meniscus MESH --web` in a headless Chromium: it draws, a slider changes the picture,
so does an orbit, and the console has no errors. `scripts/web` runs it.

usage: TestPage.py [--mesh MESH] [--screenshot FILE.png]
"""
import argparse
import io
import os
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import numpy
from PIL import Image
from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

OPTIONS = argparse.Namespace(mesh=None, screenshot=None)
# Seconds until a step counts as failed; frames take far less, start-up the longest.
PATIENCE = 60


def write_mesh(name):
    """A wavelet on voxels."""
    from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
    writer = vtkXMLImageDataWriter()
    writer.SetInputConnection(vtkRTAnalyticSource().GetOutputPort())
    writer.SetFileName(name)
    writer.Write()


def find_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def wait_for(condition, words):
    """The first value of a condition that is neither None nor False."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        value = condition()
        if value is not None and value is not False:
            return value
        time.sleep(0.2)
    raise AssertionError(f"{words}: not within {PATIENCE} s")


def answers(port):
    with socket.socket() as probe:
        return probe.connect_ex(("localhost", port)) == 0


class TestPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        mesh = OPTIONS.mesh
        if mesh is None:
            mesh = os.path.join(cls.folder.name, "wavelet.vti")
            write_mesh(mesh)
        port = find_port()
        cls.server = subprocess.Popen(
            [sys.executable, "-m", "meniscus", mesh, "--web", "--port", str(port)])
        wait_for(lambda: answers(port), "server")
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--window-size=1200,800",
                         "--disable-dev-shm-usage"):
            options.add_argument(argument)
        options.binary_location = "/usr/bin/chromium"
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = webdriver.ChromeService("/usr/bin/chromedriver")
        cls.browser = webdriver.Chrome(options=options, service=service)
        cls.browser.get(f"http://localhost:{port}/")

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.server.terminate()
        cls.server.wait()
        cls.folder.cleanup()

    def get_picture(self):
        """Pixels of the volume's part of the page; None while there is none."""
        images = self.browser.find_elements(By.CSS_SELECTOR, "main img")
        if not images or not images[0].size["height"]:
            return None
        pixels = numpy.asarray(Image.open(io.BytesIO(images[0].screenshot_as_png)).convert("RGB"))
        return pixels.astype(int)

    def get_settled(self, words):
        """The picture, once it does not change any more."""
        last = wait_for(lambda: self.get_drawn(), words)
        while True:
            time.sleep(1.0)
            now = self.get_drawn()
            if now.shape == last.shape and abs(now - last).max() == 0:
                return now
            last = now

    def get_drawn(self):
        """The picture if it shows something; an empty background varies by less than 60."""
        picture = self.get_picture()
        return picture if picture is not None and numpy.ptp(picture) > 60 else None

    def test_page(self):
        first = self.get_settled("first picture")
        slider = self.browser.find_element(By.CSS_SELECTOR, ".density [role=slider]")
        slider.click()
        slider.send_keys(*[Keys.ARROW_RIGHT] * 12)
        denser = self.get_settled("slider")
        self.assertGreater((abs(denser - first).max(axis=2) > 8).mean(), 0.01)
        area = self.browser.find_element(By.CSS_SELECTOR, "main img")
        drag = ActionChains(self.browser).move_to_element(area).click_and_hold()
        for _ in range(10):
            drag.move_by_offset(15, 4)
        drag.release().perform()
        turned = self.get_settled("orbit")
        self.assertGreater((abs(turned - denser).max(axis=2) > 8).mean(), 0.01)
        if OPTIONS.screenshot:
            self.browser.save_screenshot(OPTIONS.screenshot)
        self.assertEqual(
            [entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"], [])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--mesh")
    parser.add_argument("--screenshot")
    OPTIONS = parser.parse_args()
    unittest.main(argv=sys.argv[:1])
