# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of `meniscus MESH --web` in a headless Chromium: it draws, a slider changes the picture,
so do an orbit, the curve of opacity and a file that changes, and the console has no errors. At an
address that others can reach it needs a secret. `scripts/web` runs it.

usage: TestPage.py [--mesh MESH] [--screenshot FILE.png]
"""
import argparse
import asyncio
import io
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import aiohttp
import msgpack
import numpy
from PIL import Image
from selenium import webdriver
from selenium.common.exceptions import StaleElementReferenceException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from wslink.chunking import UnChunker, generate_chunks

OPTIONS = argparse.Namespace(mesh=None, screenshot=None)
# Seconds until a step counts as failed; frames take far less, start-up the longest.
PATIENCE = 60


def write_mesh(name, frequency=60.0):
    """A wavelet on voxels."""
    from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
    source = vtkRTAnalyticSource()
    source.SetXFreq(frequency)
    writer = vtkXMLImageDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
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


class Server:
    """The command, with a page on a free port."""

    def __init__(self, *arguments):
        self.port = find_port()
        self.process = subprocess.Popen(
            [sys.executable, "-m", "meniscus", *arguments, "--web", "--port", str(self.port)],
            stdout=subprocess.PIPE, text=True)
        wait_for(lambda: answers(self.port), "server")

    def read_address(self):
        """The address that the command prints."""
        for line in self.process.stdout:
            found = re.search(r"The page is at (http://\S+)", line)
            if found:
                return found.group(1)
        raise AssertionError("no address was printed")

    def stop(self):
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()


class PageCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.mesh = OPTIONS.mesh
        if cls.mesh is None:
            cls.mesh = os.path.join(cls.folder.name, "wavelet.vti")
            write_mesh(cls.mesh)
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--window-size=1200,1000",
                         "--disable-dev-shm-usage"):
            options.add_argument(argument)
        options.binary_location = "/usr/bin/chromium"
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = webdriver.ChromeService("/usr/bin/chromedriver")
        cls.browser = webdriver.Chrome(options=options, service=service)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    def serve(self, *arguments):
        server = Server(*arguments)
        self.addCleanup(server.stop)
        return server

    def get_picture(self):
        """Pixels of the volume's part of the page; None while there is none."""
        images = self.browser.find_elements(By.CSS_SELECTOR, "main img")
        try:
            if not images or not images[0].size["height"]:
                return None
            shown = images[0].screenshot_as_png
        except StaleElementReferenceException:  # the page has just been replaced
            return None
        pixels = numpy.asarray(Image.open(io.BytesIO(shown)).convert("RGB"))
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

    def get_changed(self, picture, words):
        """The settled picture, once it differs from another one."""
        def differs():
            now = self.get_drawn()
            return now is not None and (abs(now - picture).max(axis=2) > 8).mean() > 0.01

        wait_for(differs, words)
        return self.get_settled(words)


class TestPage(PageCase):
    def test_page(self):
        mesh = os.path.join(self.folder.name, "mesh" + os.path.splitext(self.mesh)[1])
        shutil.copy(self.mesh, mesh)
        server = self.serve(mesh, "--watch")
        self.browser.get(f"http://localhost:{server.port}/")
        first = self.get_settled("first picture")
        slider = self.browser.find_element(By.CSS_SELECTOR, ".density [role=slider]")
        slider.click()
        slider.send_keys(*[Keys.ARROW_RIGHT] * 12)
        denser = self.get_changed(first, "slider")
        area = self.browser.find_element(By.CSS_SELECTOR, "main img")
        drag = ActionChains(self.browser).move_to_element(area).click_and_hold()
        for _ in range(10):
            drag.move_by_offset(15, 4)
        turned = self.drop(drag, denser, "orbit")
        # A point in the middle of the curve, to the top.
        curve = self.browser.find_element(By.CSS_SELECTOR, ".curve canvas.controls-canvas:not("
                                          ".picking-canvas)")
        drag = ActionChains(self.browser).move_to_element(curve).double_click()
        drag.click_and_hold()
        for _ in range(5):
            drag.move_by_offset(0, -8)
        curved = self.drop(drag, turned, "curve")
        if OPTIONS.screenshot:
            self.browser.save_screenshot(OPTIONS.screenshot)
        self.browser.find_element(By.CSS_SELECTOR, ".curve button").click()
        default = self.get_changed(curved, "default curve")
        default = self.choose_colors("Cool to Warm", default)
        self.browser.find_element(By.CSS_SELECTOR, ".outline input").click()
        outlined = self.get_changed(default, "outline")
        if not OPTIONS.mesh:
            write_mesh(mesh, 20.0)
            self.get_changed(outlined, "file")
        self.assertEqual(
            [entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"], [])

    def choose_colors(self, name, picture):
        """Chooses a preset in the menu, by a part of its name."""
        field = self.browser.find_element(By.CSS_SELECTOR, ".colors input")
        field.click()
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(name)
        entry = wait_for(lambda: next(iter(self.browser.find_elements(
            By.XPATH, "//*[contains(@class, 'v-list-item-title') and .='%s']" % name)), None),
            "menu of colour maps")
        entry.click()
        return self.get_changed(picture, "colours")

    def drop(self, drag, picture, words):
        drag.release().perform()
        return self.get_changed(picture, words)


def call(port, secret, method):
    """The answer to a call by a client that first says a secret."""
    async def talk():
        async with aiohttp.ClientSession() as session:
            async with session.ws_connect(f"http://localhost:{port}/ws") as socket:
                for number, (name, arguments) in enumerate((
                        ("wslink.hello", [{"secret": secret}]), (method, []))):
                    kind = "rpc" if number else "system"
                    message = {"wslink": "1.0", "id": f"{kind}:c0:{number}", "method": name,
                               "args": arguments, "kwargs": {}}
                    for chunk in generate_chunks(msgpack.packb(message), 1 << 20):
                        await socket.send_bytes(chunk)
                chunks, answers = UnChunker(), {}
                chunks.set_max_message_size(1 << 30)
                while len(answers) < 2:
                    reply = chunks.process_chunk((await socket.receive()).data)
                    if reply is not None and "id" in reply:
                        answers[reply["id"]] = reply
                return answers["rpc:c0:1"]

    return asyncio.run(asyncio.wait_for(talk(), PATIENCE))


class TestSecret(PageCase):
    def test_who_may_come_in(self):
        server = self.serve(self.mesh, "--host", "0.0.0.0")
        address = server.read_address()
        secret = address.split("?secret=")[1]
        self.assertGreaterEqual(len(secret), 32)
        method = "trame.state.get"
        for wrong in ("", "wslink-secret", secret[:-1], None):
            self.assertNotIn("result", call(server.port, wrong, method))
        self.assertIn("result", call(server.port, secret, method))
        page = f"http://localhost:{server.port}/"
        self.browser.get(page)
        time.sleep(5.0)
        self.assertIsNone(self.get_picture())
        self.browser.get(f"{page}?secret={secret}")
        self.get_settled("picture with the secret")

    def test_pages_of_others(self):
        """A page of another server in the same browser gets no socket, and neither does a foreign
        name that leads here."""
        server = self.serve(self.mesh)
        address = f"http://localhost:{server.port}"

        async def get_status(**headers):
            async with aiohttp.ClientSession() as session:
                async with session.get(address + "/index.html", headers=headers) as answer:
                    return answer.status

        for headers, status in (({}, 200), ({"Origin": address}, 200),
                                ({"Host": f"127.0.0.1:{server.port}"}, 200),
                                ({"Host": f"[::1]:{server.port}"}, 200),
                                ({"Origin": "http://example.org"}, 403), ({"Origin": "null"}, 403),
                                ({"Host": f"example.org:{server.port}"}, 403)):
            self.assertEqual(asyncio.run(get_status(**headers)), status, headers)

    def test_a_busy_port(self):
        with socket.socket() as busy:
            busy.bind(("localhost", 0))
            busy.listen()
            port = busy.getsockname()[1]
            done = subprocess.run(
                [sys.executable, "-m", "meniscus", self.mesh, "--web", "--port", str(port)],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, f"^meniscus: .* port {port}: .*in use.*--port")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--mesh")
    parser.add_argument("--screenshot")
    OPTIONS = parser.parse_args()
    unittest.main(argv=sys.argv[:1])
