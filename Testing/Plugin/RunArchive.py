# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the archive of the plugin, unpacks it into a fresh home folder and draws with it there: in
pvbatch with PV_PLUGIN_PATH, and in ParaView's window with "Auto Load" ticked in its settings. The
libraries must be those of the archive, and both pictures must be alike.

Arguments: scripts/plugin; the build folder; pvbatch; paraview.
"""
import os
import re
import shutil
import subprocess
import sys
import tarfile

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "ArchiveScene.py")
# Libraries of the archive that a process has loaded.
LOADED = ("/Meniscus.so", "/libvtkMeniscus", "/libOpenMesh")


def make_archive(script, build, folder):
    subprocess.run([script, "--build", build, "--output", folder], check=True)
    names = [name for name in os.listdir(folder) if name.endswith(".tar.gz")]
    assert len(names) == 1, names
    return os.path.join(folder, names[0])


def unpack(archive, home):
    with tarfile.open(archive) as file:
        names = file.getnames()
        file.extractall(home)
    assert all(name.split("/")[0] == "Meniscus" for name in names), names
    for name in ("LICENSE", "Meniscus.so", "README"):
        assert "Meniscus/" + name in names, names
    return os.path.join(home, "Meniscus")


def write_settings(paraview, home, version, library):
    """Settings as the window saves them after `Load New`, with "Auto Load" ticked, and without the
    greeting at the first start."""
    plugins = ('<?xml version=\\"1.0\\" ?>\\n<Plugins>\\n  <Plugin name=\\"Meniscus\\" filename='
               '\\"%s\\" auto_load=\\"1\\" />\\n</Plugins>\\n' % library)
    folder = os.path.join(home, ".config", "ParaView")
    os.makedirs(folder)
    # Up to 5.13 the name has the version.
    for name in "ParaView%s.ini" % version, "ParaView.ini":
        with open(os.path.join(folder, name), "w") as file:
            file.write('[General]\nGeneralSettings.ShowWelcomeDialog=0\n\n[PluginsList]\n'
                       'Local%%3A%s="%s"\n' % (paraview.replace("/", "\\"), plugins))


def draw(command, environment, folder, picture):
    """Runs the scene, checks the libraries that it loaded and returns the picture's bytes."""
    run = subprocess.run(command, env=dict(environment, MENISCUS_PICTURE=picture), text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=500)
    print(run.stdout, flush=True)
    assert run.returncode == 0, "%s: status %d" % (command[0], run.returncode)
    loaded = re.findall(r"^LIBRARY (.*)$", run.stdout, re.MULTILINE)
    loaded = [name for name in loaded if any(part in name for part in LOADED)]
    assert len(loaded) >= 2, loaded
    for name in loaded:
        assert os.path.dirname(name) == folder, "%s is not from the archive" % name
    with open(os.path.join(environment["MENISCUS_OUTPUT_DIR"], picture + ".png"), "rb") as file:
        return file.read()


def main():
    script, build, pvbatch, paraview = sys.argv[1:]
    output = os.path.join(os.environ["MENISCUS_OUTPUT_DIR"], "archive")
    shutil.rmtree(output, ignore_errors=True)
    os.makedirs(output)
    archive = make_archive(script, build, output)
    home = os.path.join(output, "new user")
    os.makedirs(home)
    folder = unpack(archive, home)
    kept = ("PATH", "DISPLAY", "XAUTHORITY", "PYTHONPATH", "GALLIVM_PERF", "LANG")
    environment = {name: os.environ[name] for name in kept if name in os.environ}
    environment.update(HOME=home, MENISCUS_OUTPUT_DIR=output, PYTHONDONTWRITEBYTECODE="1")
    batch = draw([pvbatch, SCENE], dict(environment, PV_PLUGIN_PATH=folder), folder, "batch")
    program = os.path.realpath(paraview)  # settings are saved under its name without links
    version = subprocess.run([program, "--version"], env=environment, text=True, check=True,
                             stdout=subprocess.PIPE).stdout.split()[-1]
    write_settings(program, home, version, os.path.join(folder, "Meniscus.so"))
    window = draw([program, "--script=" + SCENE], environment, folder, "window")
    assert batch == window, "the pictures of pvbatch and of the window differ"
    print("FINISHED")


if __name__ == "__main__":
    main()
