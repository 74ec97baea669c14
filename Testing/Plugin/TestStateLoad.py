# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A state file, that of another version, a Python script of the state and a trace give the picture
that TestStateSave.py saved, bit for bit. The argument says which of them."""
import sys

import PluginTesting
import StateScene
from paraview import simple


def test():
    PluginTesting.load_plugin()
    saved = PluginTesting.read_pixels("State")
    what = sys.argv[1]
    scripts = {"trace": StateScene.TRACE, "script": StateScene.SCRIPT}
    if what in scripts:
        with open(scripts[what]) as file:
            exec(compile(file.read(), scripts[what], "exec"), {"__name__": what})
    else:
        simple.LoadState({"state": StateScene.STATE, "older": StateScene.OLDER_STATE}[what])
    view = simple.GetActiveView()
    assert view, "there is no view"
    pixels = PluginTesting.screenshot(view, "State" + what)
    different = sum(a != b for a, b in zip(pixels, saved))
    assert not different, "%d pixels differ" % different


if __name__ == "__main__":
    PluginTesting.run(test)
