# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin works together with another one that adds representations, and after it has been
loaded again. The second time ParaView 5.11 prints `Plugin load failed: No plugin loaded yet`, also
for its own plugins."""
import os

import PluginTesting
import TestLoadPlugin
from paraview import simple

OTHER = "EmbossingRepresentations"


def test():
    # Where ParaView keeps its own plugins, beside the library that its Python modules are made of.
    with open("/proc/self/maps") as file:
        library = next(line.split()[-1] for line in file if "libvtkRemotingViews" in line)
    other = os.path.join(os.path.dirname(library), "paraview-5.11", "plugins", OTHER, OTHER + ".so")
    beside = os.path.exists(other)
    if beside:
        simple.LoadPlugin(other, remote=False, ns=globals())
    for _ in range(2):
        PluginTesting.load_plugin()
        TestLoadPlugin.check_plugin()
    if not beside:
        PluginTesting.skip("%s is not there: loaded twice, beside no other plugin" % other)
    print("FINISHED")


if __name__ == "__main__":
    PluginTesting.run(test)
