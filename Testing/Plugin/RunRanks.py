# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs RanksScene.py on 1, 2 and 4 ranks and compares: pictures of composited volumes must be those
of one rank up to the rounding of the compositing, refracted points those of one rank.
Arguments: mpirun, pvbatch, names of meshes.

Documentation/parallel.md derives how far apart they can be: less than 3 steps of 8 bits, so at most
2, for two ranks; for four it is what is demanded here."""
import os
import subprocess
import sys

FOLDER = os.environ["MENISCUS_OUTPUT_DIR"]
HERE = os.path.dirname(os.path.abspath(__file__))
# Of 255.
WORST = 2
# The point arrays are single precision, the scene is 16 wide.
POINT_TOLERANCE = 1e-5
SKIP = 125


def pixels(name):
    with open(os.path.join(FOLDER, name), "rb") as file:
        return file.read()


def compare_pictures(name, other):
    one, several = pixels(name), pixels(other)
    assert len(one) == len(several), other
    differences = [abs(a - b) for a, b in zip(one, several)]
    worst = max(differences)
    above = sum(max(differences[i:i + 3]) > WORST for i in range(0, len(differences), 3))
    lit = sum(max(one[i:i + 3]) > 2 for i in range(0, len(one), 3))
    print("%-36s worst %d, above %d: %d of %d pixels" % (other, worst, WORST, above, lit))
    return lit > 500 and worst <= WORST


def points(name):
    with open(os.path.join(FOLDER, name)) as file:
        return [tuple(float(word) for word in line.split()) for line in file]


def farthest(some, others):
    """How far the worst point of some is from the nearest of others."""
    size = 0.05
    grid = {}
    for point in others:
        grid.setdefault(tuple(int(x // size) for x in point[:3]), []).append(point)
    worst = 0
    for point in some:
        place = [int(x // size) for x in point[:3]]
        near = [other for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)
                for other in grid.get((place[0] + i, place[1] + j, place[2] + k), [])]
        distance = min((max(abs(a - b) for a, b in zip(point, other)) for other in near),
                       default=size)
        worst = max(worst, distance)
    return worst


def compare_points(name, other):
    one, several = points(name), points(other)
    worst = max(farthest(one, several), farthest(several, one))
    print("%-36s worst %.1e, %d and %d points" % (other, worst, len(one), len(several)))
    return len(one) > 300 and worst < POINT_TOLERANCE


def run(mpirun, pvbatch, ranks, names):
    command = [mpirun, "--allow-run-as-root", "--oversubscribe", "-np", str(ranks), pvbatch,
               os.path.join(HERE, "RanksScene.py"), "Ranks%d" % ranks] + names
    environment = dict(os.environ, LD_PRELOAD=os.environ.get("MENISCUS_EXPAT_TOKENS", ""))
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=environment)
    if "invalid token" in done.stdout:
        print("SKIPPED: this ParaView cannot send cells between ranks with the installed libexpat "
              "(newer than 2.5.0-1+deb12u1)")
        sys.exit(SKIP)
    if "FINISHED" not in done.stdout or " ERR|" in done.stdout:
        print(done.stdout)
        sys.exit("ParaView failed on %d ranks" % ranks)
    if not names and ranks > 1 and "There is no array 'RTData' on rank 1" not in done.stdout:
        sys.exit("A rank without the array is not told of")


def main():
    mpirun, pvbatch, names = sys.argv[1], sys.argv[2], sys.argv[3:]
    data = os.environ.get("MENISCUS_DATA_DIR", "")
    for name in names:
        if not os.path.exists(os.path.join(data, name + ".vtu")):
            print("SKIPPED: %s.vtu not found in MENISCUS_DATA_DIR" % name)
            sys.exit(SKIP)
    for old in os.listdir(FOLDER):
        if old.startswith("Ranks") and any(name in old for name in names or [old]):
            os.remove(os.path.join(FOLDER, old))
    passed = True
    for ranks in (1, 2, 4):
        run(mpirun, pvbatch, ranks, names)
    made = sorted(name for name in os.listdir(FOLDER) if name.startswith("Ranks1")
                  and not name.endswith(".png")
                  and any(mesh in name for mesh in names or [name]))
    assert made, "nothing was written"
    for name in made:
        compare = compare_pictures if name.endswith(".rgb") else compare_points
        for ranks in (2, 4):
            passed &= compare(name, name.replace("Ranks1", "Ranks%d" % ranks))
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main()
