# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Nothing in the documentation is without a test: every block of code is in a language and on a page
that a test runs; every script, preset, test program, page and picture that a page names is there.

Arguments: the root of the project, then PAGE:LANGUAGE of what is run."""
import json
import os
import re
import subprocess
import sys


def pages(root):
    listed = subprocess.run(
        ["git", "-c", "safe.directory=" + root, "-C", root, "ls-files", "--cached", "--others",
         "--exclude-standard", "*.md"], stdout=subprocess.PIPE, text=True, check=True)
    return [name for name in listed.stdout.split("\n") if os.path.exists(os.path.join(root, name))
            and name]


def check(root, page, run, presets):
    with open(os.path.join(root, page)) as file:
        text = file.read()
    faults = []
    for language in re.findall(r"^```(.+)$", text, re.MULTILINE):
        if page + ":" + language not in run:
            faults.append("a block of %s that no test runs" % language)
    for script in re.findall(r"(?:^|[\s`/])(scripts/[a-z-]+)", text):
        if not os.access(os.path.join(root, script), os.X_OK):
            faults.append("there is no " + script)
    for preset in re.findall(r"--preset ([a-z-]+)", text):
        if preset not in presets:
            faults.append("there is no preset " + preset)
    for link in re.findall(r"\]\(([^)#\s]+)\)", text):
        if "://" not in link and not os.path.exists(os.path.join(root, os.path.dirname(page), link)):
            faults.append("a link to %s, which is not there" % link)
    return ["%s: %s" % (page, fault) for fault in faults]


def main():
    root, run = sys.argv[1], set(sys.argv[2:])
    with open(os.path.join(root, "CMakePresets.json")) as file:
        presets = {preset["name"] for preset in json.load(file)["configurePresets"]}
    names = pages(root)
    faults = [fault for page in names for fault in check(root, page, run, presets)]
    faults += ["%s is not there, or has no such block" % entry for entry in run
               if not os.path.exists(os.path.join(root, entry.split(":")[0]))]
    print("%d pages" % len(names))
    sys.exit("\n".join(faults) if faults or not names else 0)


if __name__ == "__main__":
    main()
