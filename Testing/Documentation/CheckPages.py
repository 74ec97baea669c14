# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the documentation is covered by tests: every block of code is in a language and on a
page that a test runs; every line of an indented block is a command that a script or test runs, or
whose parts exist; every script, preset, page, heading and picture that a page names exists.

Arguments: the root of the project, then PAGE:LANGUAGE for each language that is run."""
import json
import os
import re
import subprocess
import sys
import xml.etree.ElementTree

NUMBERS = ("no one two three four five six seven eight nine ten eleven twelve thirteen "
           "fourteen").split()

# Commands, and the files that run each of them.
COMMANDS = [
    (r"scripts/[a-z0-9-]+( |$)", []),  # checked below
    (r"cmake --preset [a-z]+( |$)", []),  # checked below
    (r"cmake --build build(-[a-z]+)?$", ["scripts/common.sh"]),
    (r"cmake --install build --prefix ", ["Testing/InstallFresh.cmake"]),
    (r"cmake -S \. -B build && cmake --build build && build/(tutorial|underwater)$",
     ["Testing/Consumer/CMakeLists.txt"]),
    (r"cmake -DVTK_MODULE_ENABLE_VTK_Meniscus=YES ", ["scripts/remote"]),
    (r"(xvfb-run -a -s -noreset )?ctest ", ["scripts/test"]),
    (r"mpirun -np 4 pvbatch ", ["Testing/Plugin/RunRanks.py"]),
    (r"mpirun -np 2 pvserver$", ["Testing/Plugin/RunServer.py"]),
    (r"/usr/bin/python3 -m venv --system-site-packages ", ["scripts/wheel"]),
    (r"env/bin/pip install ", ["scripts/wheel"]),
    (r"pip install trame trame-vuetify trame-rca "
     r"trame-color-opacity-editor trame-colormaps$", ["scripts/web"]),
]
# Programs of the project, with the folders whose sources contain their options.
PROGRAMS = {
    "meniscus_benchmark_volume": ["Benchmarks"],
    "meniscus_benchmark_refraction": ["Benchmarks"],
    "meniscus_stress_volume": ["Testing/Stress", "Testing/Support"],
    "meniscus_metamorphic_volume": ["Testing/Metamorphic", "Testing/Support"],
    "meniscus_metamorphic_refraction": ["Testing/Metamorphic", "Testing/Support"],
}


def text_below(root, folder):
    texts = []
    for place, _, names in os.walk(os.path.join(root, folder)):
        for name in sorted(names):
            if re.search(r"\.(cxx|h|sh)$|^[a-z-]+$", name):
                with open(os.path.join(place, name)) as file:
                    texts.append(file.read())
    return "\n".join(texts)


def command_faults(root, command):
    """Faults of a line of an indented block, which must be a command."""
    if command.startswith("apt-get install "):
        scripts = text_below(root, "scripts")
        packages = [word for word in command.split()[2:] if not word.startswith("-")]
        return ["no script installs " + name for name in packages
                if not re.search(r"[\s(]%s[\s)]" % re.escape(name), scripts)]
    program = re.match(r"(?:xvfb-run -a -s -noreset )?build/bin/(\w+)( |$)", command)
    if program:
        if program.group(1) not in PROGRAMS:
            return ["%s is run by nothing" % program.group(1)]
        sources = "\n".join(text_below(root, folder) for folder in PROGRAMS[program.group(1)])
        return ["%s has no option %s" % (program.group(1), option)
                for option in re.findall(r"--[a-z]+", command) if option not in sources]
    if command.startswith("meniscus "):
        # Testing/Python/TestViewer.py runs the options, scripts/web runs --web.
        with open(os.path.join(root, "Python/viewer/command.py")) as file:
            known = file.read()
        return ["meniscus has no option " + option
                for option in re.findall(r"--[a-z]+", command) if '"%s"' % option not in known]
    files = [files for pattern, files in COMMANDS if re.match(pattern, command)]
    if not files:
        return ["no test runs: " + command]
    return ["there is no " + name for name in files[0]
            if not os.path.exists(os.path.join(root, name))]


def indented_commands(text):
    """Lines of indented blocks outside fenced ones, without comments, continued lines joined. An
    indented line after text continues its paragraph or list item."""
    fenced = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    joined = re.sub(r"\\\n *", "", fenced)
    for block in re.split(r"\n\s*\n", joined):
        if block.startswith("    "):
            for line in block.strip().split("\n"):
                yield re.sub(r" +#.*", "", line.strip())


def pages(root):
    """The pages of the repository or, without one, of the source tree."""
    if not os.path.exists(os.path.join(root, ".git")):
        return [os.path.relpath(os.path.join(folder, name), root)
                for folder, folders, names in os.walk(root)
                for name in names if name.endswith(".md")
                and not os.path.relpath(folder, root).startswith("build")]
    listed = subprocess.run(
        ["git", "-c", "safe.directory=" + root, "-C", root, "ls-files", "--cached", "--others",
         "--exclude-standard", "*.md"], stdout=subprocess.PIPE, text=True, check=True)
    return [name for name in listed.stdout.split("\n") if os.path.exists(os.path.join(root, name))
            and name]


def anchors(root, page):
    """Anchors of the page's headings, as GitHub makes them."""
    with open(os.path.join(root, page)) as file:
        text = re.sub(r"^```.*?^```$", "", file.read(), flags=re.DOTALL | re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
            for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE)}


def check(root, page, run, presets):
    with open(os.path.join(root, page)) as file:
        text = file.read()
    faults = []
    for language in re.findall(r"^```(.+)$", text, re.MULTILINE):
        if page + ":" + language not in run:
            faults.append("a block of %s that no test runs" % language)
    for language in ("cpp", "cmake"):  # the tests run the first block of a page only
        if len(re.findall(r"^```%s$" % language, text, re.MULTILINE)) > 1:
            faults.append("only the first block of %s is run" % language)
    for command in indented_commands(text):
        faults += command_faults(root, command)
    for script in re.findall(r"(?:^|[\s`/])(scripts/[a-z0-9-]+)", text):
        if not os.access(os.path.join(root, script), os.X_OK):
            faults.append("there is no " + script)
    for preset in re.findall(r"--preset ([a-z0-9-]+)", text):
        if preset not in presets:
            faults.append("there is no preset " + preset)
    for link in re.findall(r"\]\(([^)#\s]+)\)", text):
        target = os.path.join(root, os.path.dirname(page), link)
        if "://" not in link and not os.path.exists(target):
            faults.append("a link to %s, which does not exist" % link)
    for link, anchor in re.findall(r"\]\(([^)#\s]*)#([^)\s]+)\)", text):
        target = os.path.normpath(os.path.join(os.path.dirname(page), link)) if link else page
        if "://" not in link and os.path.exists(os.path.join(root, target)) and (
                anchor not in anchors(root, target)):
            faults.append("a link to the heading %s#%s, which does not exist" % (link, anchor))
    return ["%s: %s" % (page, fault) for fault in faults]


def plugin_faults(root):
    """The page of the plugin has a heading for each of its filters, and the pages that give their
    number have it right."""
    labels, folder = [], os.path.join(root, "Plugin")
    for name in sorted(os.listdir(folder)):
        if name.endswith(".xml"):
            filters = xml.etree.ElementTree.parse(os.path.join(folder, name)).getroot()
            labels += [one.get("label") for one in filters.findall("ProxyGroup[@name='filters']/*")]
    faults = []
    for page in ("README.md", "Plugin/README.md", "Documentation/paraview.md"):
        with open(os.path.join(root, page)) as file:
            text = file.read()
        if not re.search(r"\b%s\s+filters" % NUMBERS[len(labels)], text):
            faults.append("%s: the plugin has %s filters" % (page, NUMBERS[len(labels)]))
    headings = re.findall(r"^## (.*)$", text, re.MULTILINE)
    return faults + ["Documentation/paraview.md: no heading " + label for label in labels
                     if label not in headings]


def main():
    root, run = sys.argv[1], set(sys.argv[2:])
    with open(os.path.join(root, "CMakePresets.json")) as file:
        presets = {preset["name"] for preset in json.load(file)["configurePresets"]}
    names = pages(root)
    faults = [fault for page in names for fault in check(root, page, run, presets)]
    faults += ["%s does not exist" % entry for entry in run
               if not os.path.exists(os.path.join(root, entry.split(":")[0]))]
    faults += plugin_faults(root)
    print("%d pages" % len(names))
    sys.exit("\n".join(faults) if faults or not names else 0)


if __name__ == "__main__":
    main()
