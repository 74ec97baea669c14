# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Saves a scene as a state file, as the state file of another version, as a Python script of the
state and as the trace of a user's actions; TestStateLoad.py loads them in new processes."""
import re

import PluginTesting
import StateScene
from paraview import simple, smstate, smtrace

# Properties, at their defaults in the scene, that a version without them would not have written.
MISSING = ["PreIntegrationScalarSize", "OutputPointsPrecision", "ViewCulling", "FollowCamera"]
# Properties of other versions: one of an older and one of a newer one.
UNKNOWN = """
      <Property name="CompactTables" id="%s.CompactTables" number_of_elements="1">
        <Element index="0" value="1"/>
      </Property>
      <Property name="NotYetInvented" id="%s.NotYetInvented" number_of_elements="1">
        <Element index="0" value="1"/>
      </Property>"""


def write_older_state():
    """Takes properties away and adds one that nobody knows."""
    with open(StateScene.STATE) as file:
        text = file.read()
    for name in MISSING:
        text, count = re.subn(
            r' *<Property name="%s" .*?</Property>\n' % name, "", text, flags=re.DOTALL)
        assert count > 0, "%s is not in the state file" % name
    text, count = re.subn(
        r'(<Proxy group="(?:representations|filters)" '
        r'type="(?:UnstructuredGridRepresentation|RefractedGeometry)" id="(\d+)"[^>]*>)',
        lambda match: match.group(1) + UNKNOWN % (match.group(2), match.group(2)), text)
    assert count >= 2, "the state file has %d proxies of ours" % count
    with open(StateScene.OLDER_STATE, "w") as file:
        file.write(text)


def test():
    PluginTesting.load_plugin()
    smtrace.start_trace()
    view = StateScene.make_scene()
    trace = smtrace.stop_trace()
    with open(StateScene.TRACE, "w") as file:
        file.write(trace)
    pixels = PluginTesting.screenshot(view, "State")
    assert len(PluginTesting.covered(pixels)) > 0.1 * PluginTesting.SIZE**2
    with open(StateScene.SCRIPT, "w") as file:
        file.write(smstate.get_state())
    simple.SaveState(StateScene.STATE)
    write_older_state()


if __name__ == "__main__":
    PluginTesting.run(test)
