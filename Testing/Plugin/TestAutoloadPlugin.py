# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView finds the plugin by PV_PLUGIN_PATH, without LoadPlugin in the script."""
import PluginTesting
import TestLoadPlugin

if __name__ == "__main__":
    PluginTesting.run(TestLoadPlugin.check_plugin)
