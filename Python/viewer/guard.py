# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Messages about files that crash the library that reads them.

A reader that takes a count from a damaged file may ask for more memory than there is, or leave its
arrays; some libraries end the process instead of returning. The command therefore runs in a child
process, and its parent tells how it ended.
"""
import contextlib
import os
import signal
import sys

_ENDED = b"\0"  # Python has come to an end by itself
_pipe = None  # to the parent


def _tell(text):
    if _pipe is not None:
        os.write(_pipe, text)


@contextlib.contextmanager
def noting_file(name):
    """Lets the parent know that a file is being read."""
    _tell(os.fsencode(name).replace(b"\n", b" ") + b"\n")
    try:
        yield
    finally:
        _tell(b"\n")


def _run_child(function):
    try:
        return function()
    finally:
        sys.stdout.flush()
        _tell(_ENDED)


def _describe_end(status):
    if os.WIFSIGNALED(status):
        return f"crashed ({signal.Signals(os.WTERMSIG(status)).name})"
    return f"ended the program (status {os.WEXITSTATUS(status)})"


def _wait(child, pipe):
    """Exit status of the child; a message if Python did not end it."""
    told = b""
    while True:
        part = os.read(pipe, 1 << 16)
        if not part:
            break
        told = (told + part)[-(1 << 16):]
    _, status = os.waitpid(child, 0)
    if status == 0:  # argcomplete ends the process by itself
        return 0
    if told.endswith(_ENDED) or (os.WIFSIGNALED(status)
                                 and os.WTERMSIG(status) in (signal.SIGTERM, signal.SIGKILL)):
        return 128 + os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
    name = os.fsdecode(told.rsplit(b"\n", 2)[-2]) if told.count(b"\n") else ""
    end = _describe_end(status)
    if name:
        print(f"meniscus: {name}: the library that reads this file has {end}; the file is damaged, "
              "or larger than the memory", file=sys.stderr)
    else:
        print(f"meniscus: a library has {end}", file=sys.stderr)
    return 1


def run_guarded(function):
    """Runs a function that returns an exit status, and returns that; 1 after a message if a library
    ended the process."""
    global _pipe
    if not hasattr(os, "fork"):
        return function()
    pipe, child_pipe = os.pipe()
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        os.close(pipe)
        _pipe = child_pipe
        return _run_child(function)
    os.close(child_pipe)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the terminal sends it to both
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda which, _frame: os.kill(child, which))
    return _wait(child, pipe)
