# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that everything in the documentation is tested: every block of code is in a language and on a
page that a test runs; every line of an indented block is a command that a script or test also runs,
or whose parts exist; every script, preset, page and image that a page names exists.

Arguments: the root of the project, then PAGE:LANGUAGE of the blocks that are run.
"""
import json
import os
import re
import subprocess
import sys


# Commands, and the files whose scripts or tests run the program of each.
COMMANDS = [
    (r"scripts/[a-z-]+( |$)", []),  # looked for below
    (r"cmake --preset [a-z]+( |$)", []),  # looked for below
    (r"cmake --build build(-[a-z]+)?$", ["scripts/common.sh"]),
    (r"cmake --install build --prefix ", ["Testing/InstallFresh.cmake"]),
    (r"cmake -S \. -B build && cmake --build build && build/tutorial$",
     ["Testing/Consumer/CMakeLists.txt"]),
    (r"cmake -DVTK_MODULE_ENABLE_VTK_Meniscus=YES ", ["scripts/remote"]),
    (r"(xvfb-run -a -s -noreset )?ctest ", ["scripts/test"]),
    (r"mpirun -np 4 pvbatch ", ["Testing/Plugin/RunRanks.py"]),
    (r"mpirun -np 2 pvserver$", ["Testing/Plugin/RunServer.py"]),
    (r"/usr/bin/python3 -m venv --system-site-packages ", ["scripts/wheel"]),
    (r"env/bin/pip install ", ["scripts/wheel"]),
]
# Programs of ours, with the folders in whose sources their options are.
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
    """Describes the error in a line of an indented block, which must be a command."""
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
    files = [files for pattern, files in COMMANDS if re.match(pattern, command)]
    if not files:
        return ["no test runs: " + command]
    return ["there is no " + name for name in files[0]
            if not os.path.exists(os.path.join(root, name))]


def indented_commands(text):
    """Lines of indented blocks outside of fenced ones, without comments, continued lines joined."""
    fenced = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    joined = re.sub(r"\\\n *", "", fenced)
    for line in re.findall(r"^ {4}(.*\S)", joined, re.MULTILINE):
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


def check(root, page, run, presets):
    with open(os.path.join(root, page)) as file:
        text = file.read()
    faults = []
    for language in re.findall(r"^```(.+)$", text, re.MULTILINE):
        if page + ":" + language not in run:
            faults.append("a block of %s that no test runs" % language)
    for language in ("cpp", "cmake"):  # of these the tests take a page's first
        if len(re.findall(r"^```%s$" % language, text, re.MULTILINE)) > 1:
            faults.append("only the first block of %s is run" % language)
    for command in indented_commands(text):
        faults += command_faults(root, command)
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
