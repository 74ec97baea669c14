# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView finds the plugin by PV_PLUGIN_PATH, without LoadPlugin in the script."""
import PluginTesting
import TestFilters
from paraview import simple


def test():
    assert hasattr(simple, "RefractedGeometry"), "the plugin was not loaded at the start"
    TestFilters.test()


if __name__ == "__main__":
    PluginTesting.run(test)
