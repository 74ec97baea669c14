# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs tests one after the other in one process, since ParaView takes seconds to start: for each
argument NAME, test() of TestNAME.py, in a session of its own. Fails if any of them does."""
import importlib
import sys
import time
import traceback

import PluginTesting
from paraview import simple


def test():
    failed = []
    for name in sys.argv[1:]:
        print("== Test%s.py" % name, flush=True)
        start = time.time()
        try:
            importlib.import_module("Test" + name).test()
        except BaseException:
            traceback.print_exc()
            failed.append(name)
        for view in simple.GetRenderViews():
            simple.Delete(view)
        simple.ResetSession()
        print("== %.1f s" % (time.time() - start), flush=True)
    assert not failed, "failed: " + ", ".join(failed)


if __name__ == "__main__":
    PluginTesting.run(test)
