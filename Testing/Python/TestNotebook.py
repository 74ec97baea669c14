# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""mesh.meniscus.plot() in a notebook: an interactive view by PyVista's and trame's server, also in
a headless Chromium where selenium and chromedriver are installed, and a picture. Skipped without
pyvista[jupyter], nbclient and ipykernel, and without the accessor.

The exit status is then 125, which CTest counts as skipped.
"""
import base64
import html
import importlib.util
import io
import re
import shutil
import sys
import time
import unittest

NEEDED = ("pyvista", "trame", "trame_vtk", "trame_vuetify", "ipywidgets", "nbclient", "ipykernel")
if any(importlib.util.find_spec(name) is None for name in NEEDED):
    print("skipped: needs " + ", ".join(NEEDED))
    sys.exit(125)

import nbclient
import nbformat
import numpy
import pyvista
from PIL import Image

if not hasattr(pyvista, "register_dataset_accessor"):
    print("skipped: PyVista 0.48 has accessors")
    sys.exit(125)

PLOT = """
import meniscus
import pyvista
mesh = pyvista.ImageData(dimensions=(9, 9, 9)).to_tetrahedra()
mesh["height"] = mesh.points[:, 2]
mesh.meniscus.plot("height", window_size=(300, 200), %s)
"""
# Asks the server for the page of the view.
PAGE = """
import asyncio
import urllib.request
from trame.app import get_server

server = get_server(pyvista.global_theme.trame.jupyter_server_name)
address = "http://localhost:%d/index.html" % server.port
page = await asyncio.to_thread(lambda: urllib.request.urlopen(address, timeout=20).read())
print(server.running, b"trame" in page)
"""


def outputs_of(*cells):
    """The outputs of the last cell of a notebook, as dictionaries by type, and what it prints."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(notebook, timeout=100, kernel_name="python3").execute()
    outputs = notebook.cells[-1].outputs
    return [each.data for each in outputs if "data" in each], "".join(
        each.text for each in outputs if each.output_type == "stream" and each.name == "stdout")


def open_browser():
    from selenium import webdriver
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
                     "--window-size=600,500"):
        options.add_argument(argument)
    options.binary_location = shutil.which("chromium")
    return webdriver.Chrome(
        options=options, service=webdriver.ChromeService(shutil.which("chromedriver")))


def has_browser():
    return bool(importlib.util.find_spec("selenium") and shutil.which("chromium")
                and shutil.which("chromedriver"))


class TestNotebook(unittest.TestCase):
    @unittest.skipUnless(has_browser(), "needs selenium, chromium and chromedriver")
    def test_view_in_chromium(self):
        """The view of a running notebook shows the volume, orange or blue, in a browser."""
        cell = nbformat.v4.new_code_cell(PLOT % "cmap='coolwarm', jupyter_backend='server'")
        client = nbclient.NotebookClient(nbformat.v4.new_notebook(cells=[cell]), timeout=100,
                                         kernel_name="python3")
        browser = open_browser()
        self.addCleanup(browser.quit)
        with client.setup_kernel():
            client.execute_cell(cell, 0)
            shown = next(each.data["text/plain"] for each in cell.outputs if "data" in each
                         and "<iframe" in each.data.get("text/plain", ""))
            address = re.search(r'src=\\?"([^"\\]+)', html.unescape(shown)).group(1)
            browser.get(address)
            end, share = time.monotonic() + 60.0, 0.0
            while share < 0.05 and time.monotonic() < end:
                time.sleep(0.5)
                page = Image.open(io.BytesIO(browser.get_screenshot_as_png())).convert("HSV")
                share = float((numpy.asarray(page)[:, :, 1] > 60).mean())
        self.assertGreater(share, 0.05)

    def test_interactive_view(self):
        """The default."""
        shown, _ = outputs_of(PLOT % "")
        self.assertTrue(any("application/vnd.jupyter.widget-view+json" in data for data in shown))
        self.assertTrue(any("<iframe" in data["text/plain"] for data in shown), shown)
        _, printed = outputs_of(PLOT % "jupyter_backend='server'", PAGE)
        self.assertIn("True True", printed)

    def test_picture(self):
        shown, _ = outputs_of(PLOT % "jupyter_backend='static'")
        data = base64.b64decode(next(data["image/png"] for data in shown if "image/png" in data))
        picture = numpy.asarray(Image.open(io.BytesIO(data)))
        self.assertEqual(picture.shape[:2], (200, 300))
        self.assertGreater(int(picture.max()) - int(picture.min()), 100)

    def test_browser(self):
        with self.assertRaisesRegex(nbclient.exceptions.CellExecutionError, "draws in the browser"):
            outputs_of(PLOT % "jupyter_backend='client'")


if __name__ == "__main__":
    unittest.main()
