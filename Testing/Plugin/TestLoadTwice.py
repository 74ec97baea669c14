# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin works together with another plugin that adds representations, and after it was loaded
again. At the second time ParaView 5.11 logs `Plugin load failed: No plugin loaded yet`, as for its
own plugins."""
import os

import PluginTesting
import TestFilters
from paraview import simple

OTHER = "EmbossingRepresentations"


def test():
    # ParaView's own plugins are in a folder next to the library of its Python modules.
    with open("/proc/self/maps") as file:
        library = next(line.split()[-1] for line in file if "libvtkRemotingViews" in line)
    version = simple.GetParaViewVersion()
    folder = "paraview-%d.%d" % (version.major, version.minor)
    other = os.path.join(os.path.dirname(library), folder, "plugins", OTHER, OTHER + ".so")
    found = os.path.exists(other)
    if found:
        simple.LoadPlugin(other, remote=False, ns=globals())
    for _ in range(2):
        PluginTesting.load_again()
        TestFilters.test()
    if not found:
        PluginTesting.skip("there is no %s: loaded twice, without another plugin" % other)
    print("FINISHED")


if __name__ == "__main__":
    PluginTesting.run(test)
