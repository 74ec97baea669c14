# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A client connected to a server of 1, 2 and 4 ranks: its pictures equal those of a client alone.
The server draws; or the client draws with the data that a server of two ranks sends, except for
volumes, which ParaView always draws on the server. Arguments: mpirun, pvserver, the client's
Python."""
import os
import socket
import subprocess
import sys
import time

import RunRanks

FOLDER = os.environ["MENISCUS_OUTPUT_DIR"]
HERE = os.path.dirname(os.path.abspath(__file__))
START_SECONDS = 60
CLIENT_SECONDS = 240
# Prefix of the files, number of ranks, drawing side.
SERVERS = [("ServerDraws1", 1, "server"), ("ServerDraws2", 2, "server"),
           ("ServerDraws4", 4, "server"), ("ServerSends2", 2, "client")]
# Largest difference, of 255, by number of ranks, from Documentation/parallel.md; one rank
# composites nothing.
MOST = {1: 0, 2: 2, 4: 6}
# Share of the pixels that may differ by more than two.
SHARE = {1: 0, 2: 0, 4: 1e-4}


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def environment():
    return dict(os.environ, LD_PRELOAD=os.environ.get("MENISCUS_EXPAT_TOKENS", ""))


def start_server(mpirun, pvserver, ranks, port, log):
    """Waits until the server accepts a client; a test connection would be taken for one."""
    server = subprocess.Popen(
        [mpirun, "--allow-run-as-root", "--oversubscribe", "-np", str(ranks), pvserver,
         "--server-port=%d" % port],
        stdout=log, stderr=subprocess.STDOUT, env=environment())
    end = time.time() + START_SECONDS
    while time.time() < end and server.poll() is None:
        with open(log.name) as file:
            if "Accepting connection" in file.read():
                return server
        time.sleep(0.2)
    server.terminate()
    sys.exit("The server does not start")


def run_client(python, prefix, port, draws):
    command = [python, os.path.join(HERE, "ServerScene.py"), prefix, str(port), draws]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=environment(), timeout=CLIENT_SECONDS)
    if "FINISHED" not in done.stdout or " ERR|" in done.stdout:
        print(done.stdout)
        return False
    return True


def connected(mpirun, pvserver, python, prefix, ranks, draws):
    port = free_port()
    with open(os.path.join(FOLDER, prefix + ".log"), "w") as log:
        server = start_server(mpirun, pvserver, ranks, port, log)
        try:
            finished = run_client(python, prefix, port, draws)
            if finished:
                server.wait(START_SECONDS)
        finally:
            server.terminate()
    with open(log.name) as file:
        said = file.read()
    if not finished or " ERR|" in said:
        print(said)
        sys.exit("The client or the server of %d ranks failed, drawn by the %s" % (ranks, draws))


def main():
    mpirun, pvserver, python = sys.argv[1:]
    for old in os.listdir(FOLDER):
        if old.startswith("Server"):
            os.remove(os.path.join(FOLDER, old))
    if not run_client(python, "ServerNone", 0, "client"):
        sys.exit("The client alone failed")
    for prefix, ranks, draws in SERVERS:
        connected(mpirun, pvserver, python, prefix, ranks, draws)
    passed = True
    made = sorted(name for name in os.listdir(FOLDER)
                  if name.startswith("ServerNone") and name.endswith(".rgb"))
    assert made, "nothing was written"
    for name in made:
        for prefix, ranks, _ in SERVERS:
            passed &= RunRanks.compare_pictures(name, name.replace("ServerNone", prefix),
                                                MOST[ranks], SHARE[ranks])
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main()
