# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files that name other files as time steps and parts of a mesh: .pvd, .series, and the parts of a
decomposed Exodus file."""
import glob
import json
import math
import os
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

from ..data import leaves_of
from .files import DECOMPOSED, ReadingError, check_exists, ending_of, open_file


class _Entry:
    """One file of a collection.

    time: time of the step; None if the file is a part of every step.
    """

    def __init__(self, time, file):
        self.time = time
        self.file = file


def _time_of(name, text):
    try:
        time = float(text)
    except (TypeError, ValueError, OverflowError):
        time = math.nan
    if not math.isfinite(time):
        raise ReadingError(f"{name}: the time '{text}' is not a number")
    return time


def _read_pvd(name):
    """Entries of a ParaView data file: those without a time belong to every step."""
    try:
        sets = ElementTree.parse(name).getroot().findall("./Collection/DataSet")
    except (ElementTree.ParseError, LookupError, UnicodeError) as error:
        raise ReadingError(f"{name}: {error}") from None
    entries = []
    for item in sets:
        time = item.get("timestep")
        entries.append(_Entry(None if time is None else _time_of(name, time), item.get("file")))
    return entries


def _text_of(name):
    """The name of a file; None is one that is absent."""
    if not isinstance(name, (str, type(None))):
        raise TypeError(name)
    return name


def _read_series(name):
    """Entries of a file series (JSON): a file without a time has its number as time."""
    try:
        with open(name, encoding="utf-8-sig") as file:
            files = json.load(file)["files"]
        return [_Entry(_time_of(name, item.get("time", number)), _text_of(item.get("name")))
                for number, item in enumerate(files)]
    except RecursionError:
        raise ReadingError(f"{name}: its brackets are nested too deeply") from None
    except ValueError as error:
        raise ReadingError(f"{name}: {error}") from None
    except (AttributeError, KeyError, TypeError):
        raise ReadingError(f"{name}: the series has no list 'files' of names") from None


_COLLECTIONS = {".pvd": _read_pvd, ".series": _read_series}


def is_collection(name):
    return ending_of(name) in _COLLECTIONS


def _find_decomposed(name):
    """Names of all parts of a decomposed Exodus file, such as mesh.e.4.0 to mesh.e.4.3; empty for
    other files."""
    match = DECOMPOSED.match(name)
    if not match or not os.path.exists(name):
        return []
    stem, count = match.groups()
    parts = sorted(glob.glob(f"{glob.escape(stem)}.{count}.*"))
    parts = [part for part in parts if DECOMPOSED.match(part)]
    if len(parts) != int(count):
        raise ReadingError(f"{name}: there are {len(parts)} of {count} parts")
    return parts


def _join(parts):
    """The data sets of several data as one."""
    if len(parts) == 1:
        return parts[0]
    blocks = vtkMultiBlockDataSet()
    for leaf in [leaf for data in parts for leaf in leaves_of(data)]:
        blocks.SetBlock(blocks.GetNumberOfBlocks(), leaf)
    return blocks


class _Collection:
    """Several files: files of one time are the parts of one step."""

    def __init__(self, name, entries, open_part):
        """name: of the collection. open_part: function that opens a file."""
        self.name = name
        self.open_part = open_part
        folder = os.path.dirname(name)
        self.entries, known = [], set()
        for entry in entries:
            if not entry.file:
                raise ReadingError(f"{name}: an entry of the collection names no file")
            file = os.path.join(folder, entry.file)
            if not os.path.exists(file):  # names that were written on Windows
                file = os.path.join(folder, entry.file.replace("\\", "/"))
            if (entry.time, file) not in known:
                known.add((entry.time, file))
                self.entries.append(_Entry(entry.time, file))
        if not self.entries:
            raise ReadingError(f"{name}: the collection names no files")
        if len(self.entries) == 1:
            self._take_times_of(self.entries[0])

    def _take_times_of(self, entry):
        """The times of a single file are its own, if it has several."""
        if len(self._open(entry.file).get_times()) > 1:
            entry.time = None

    def _open(self, file):
        try:
            return self.open_part(file)
        except ReadingError as error:
            raise ReadingError(f"{error} (a part of {self.name})") from None

    def get_times(self):
        times = {entry.time for entry in self.entries if entry.time is not None}
        if not times:
            for entry in self.entries:
                times.update(self._open(entry.file).get_times())
        return sorted(times)

    def read(self, time=None):
        """The parts of the last step that is not later than a time; default: the first step."""
        times = self.get_times()
        if times:
            time = max((t for t in times if time is not None and t <= time), default=times[0])
        return _join([self._open(entry.file).read(time) for entry in self.entries
                      if entry.time is None or entry.time == time])


def open_source(name, parents=()):
    """A file, a collection or a decomposed file, with get_times() and read(time).

    parents: absolute names of the collections that this file is a part of.
    """
    parts = _find_decomposed(name)
    if parts:
        return _Collection(name, [_Entry(None, os.path.basename(part)) for part in parts],
                           open_file)
    if not is_collection(name):
        return open_file(name)
    check_exists(name)
    parents = (*parents, os.path.abspath(name))

    def open_part(part):
        if os.path.abspath(part) in parents:
            raise ReadingError(f"{part}: the collection is a part of itself")
        return open_source(part, parents)

    return _Collection(name, _COLLECTIONS[ending_of(name)](name), open_part)
