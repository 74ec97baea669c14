# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Data of single files, by VTK's readers or by meshio, with all of their arrays."""
import contextlib
import importlib
import io
import os
import re
import struct
import tempfile
import warnings

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from .appended import find_fault
from .guard import noting_file

_AMR = ("vtkIOXML", "vtkXMLUniformGridAMRReader")
_EXODUS = ("vtkIOExodus", "vtkExodusIIReader")
_BYU = ("vtkIOGeometry", "vtkBYUReader")
_ENSIGHT = ("vtkIOEnSight", "vtkGenericEnSightReader")
# Reader by the ending of the file's name, as VTK module and class. VTK's modules are loaded when
# they are used, because a build of VTK may lack some.
READERS = {
    ".vtu": ("vtkIOXML", "vtkXMLUnstructuredGridReader"),
    ".pvtu": ("vtkIOXML", "vtkXMLPUnstructuredGridReader"),
    ".vti": ("vtkIOXML", "vtkXMLImageDataReader"),
    ".pvti": ("vtkIOXML", "vtkXMLPImageDataReader"),
    ".vtr": ("vtkIOXML", "vtkXMLRectilinearGridReader"),
    ".pvtr": ("vtkIOXML", "vtkXMLPRectilinearGridReader"),
    ".vts": ("vtkIOXML", "vtkXMLStructuredGridReader"),
    ".pvts": ("vtkIOXML", "vtkXMLPStructuredGridReader"),
    ".vtp": ("vtkIOXML", "vtkXMLPolyDataReader"),
    ".vtm": ("vtkIOXML", "vtkXMLMultiBlockDataReader"),
    ".vtpd": ("vtkIOXML", "vtkXMLPartitionedDataSetReader"),
    ".vtpc": ("vtkIOXML", "vtkXMLPartitionedDataSetCollectionReader"),
    ".vth": _AMR,
    ".vthb": _AMR,
    ".vtk": ("vtkIOLegacy", "vtkGenericDataObjectReader"),
    ".vtkhdf": ("vtkIOHDF", "vtkHDFReader"),
    ".hdf": ("vtkIOHDF", "vtkHDFReader"),
    ".e": _EXODUS,
    ".ex2": _EXODUS,
    ".exo": _EXODUS,
    ".exii": _EXODUS,
    ".g": _EXODUS,
    ".case": _ENSIGHT,
    ".encas": _ENSIGHT,
    ".cgns": ("vtkIOCGNSReader", "vtkCGNSReader"),
    ".foam": ("vtkIOGeometry", "vtkOpenFOAMReader"),
    ".nc": ("vtkIONetCDF", "vtkNetCDFCFReader"),
    ".avs": ("vtkIOGeometry", "vtkAVSucdReader"),
    ".inp": ("vtkIOGeometry", "vtkAVSucdReader"),
    ".stl": ("vtkIOGeometry", "vtkSTLReader"),
    ".obj": ("vtkIOGeometry", "vtkOBJReader"),
    ".ply": ("vtkIOPLY", "vtkPLYReader"),
}
# Endings of files of XML with data of their own.
_WITH_APPENDED = (".vtu", ".vti", ".vtr", ".vts", ".vtp")
# First bytes of files of libraries whose messages do not say that a file is of another kind, or
# that end the process.
_HDF = b"\x89HDF\r\n\x1a\n"
# Files of ADF begin with "@(#)"; some have the highest bit set in these four bytes.
_ADF = tuple(start + b"ADF Database Version" for start in (b"@(#)", b"\xc0\xa8\xa3\xa9"))
_SIGNATURES = {".cgns": (_HDF, *_ADF), ".vtkhdf": (_HDF,), ".hdf": (_HDF,)}
# Endings that meshio reads, if it is installed.
MESHIO_ENDINGS = (".msh", ".med", ".xdmf", ".xmf", ".mesh", ".meshb", ".bdf", ".nas", ".fem",
                  ".su2", ".vol", ".mdpa")
# Methods by which readers select arrays and parts, most of which are off by default in some, and
# the one by which values that are missing in netCDF are not numbers instead of huge ones.
_ENABLING = ("EnableAllBases", "EnableAllFamilies", "EnableAllPointArrays", "EnableAllCellArrays",
             "ReadAllVariablesOn", "ReadAllScalarsOn", "ReadAllVectorsOn", "ReadAllNormalsOn",
             "ReadAllTensorsOn", "ReadAllTCoordsOn", "ReadAllColorScalarsOn", "ReadAllFieldsOn",
             "ReplaceFillValueWithNanOn")
_SELECTIONS = ("GetPointDataArraySelection", "GetCellDataArraySelection")


# One part of a decomposed Exodus file, such as mesh.e.4.0: name and number of parts.
DECOMPOSED = re.compile(r"(.*\.(?:e|ex2|exo|exii|g))\.(\d+)\.\d+$", re.IGNORECASE)


class ReadingError(Exception):
    """A file that cannot be used; the message names the file and the reason."""


def check_exists(name):
    if not os.path.exists(name):
        raise ReadingError(f"{name}: there is no such file")
    if os.path.isdir(name):
        raise ReadingError(f"{name}: this is a folder, not a file")
    if not os.path.isfile(name):  # a pipe would be waited for, a device may have no end
        raise ReadingError(f"{name}: this is a pipe or a device, not a file")
    if not os.access(name, os.R_OK):
        raise ReadingError(f"{name}: there is no permission to read this file")


def ending_of(name):
    """Ending of a file's name, or of the whole file if it is a part of a decomposed one."""
    part = DECOMPOSED.match(name)
    return os.path.splitext(part[1] if part else name)[1].lower()


def _check_signature(name):
    """Checks the first bytes, and that an HDF5 file is as long as they say: the library of CGNS
    ends the process if it cannot read a file."""
    with open(name, "rb") as file:
        start = file.read(52)
    signatures = _SIGNATURES.get(ending_of(name))
    if signatures and not start.startswith(signatures):
        raise ReadingError(f"{name}: this is not a file of the kind that ends in "
                           f"'{ending_of(name)}'")
    if start.startswith(_HDF) and len(start) > 8:
        # Place of the end-of-file address in the superblock, by its version, for 8-byte addresses.
        place = {0: 40, 1: 44, 2: 28, 3: 28}.get(start[8], len(start))
        end, size = start[place:place + 8], os.path.getsize(name)
        if len(end) == 8 and size < struct.unpack("<Q", end)[0]:
            raise ReadingError(f"{name}: the file is cut off: it has {size} of "
                               f"{struct.unpack('<Q', end)[0]} bytes")


@contextlib.contextmanager
def _without_standard_error():
    """Discards what C libraries such as HDF5 and netCDF write to the standard error stream."""
    kept = os.dup(2)
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(null)


def text_of(name):
    """Text of VTK, which is a str if it is UTF-8, and otherwise bytes, as parts of a damaged file
    or names that a program wrote in Latin-1."""
    return name.decode("latin-1") if isinstance(name, bytes) else name


def _messages_of(text, kind):
    """First lines of the errors or warnings in the text of an output window."""
    messages = []
    for report in text.split(kind + ": ")[1:]:
        message = report.split("\n", 1)[-1].split("): ", 1)[-1].strip()
        messages.append((message.splitlines() or ["unknown error"])[0])
    return messages


@contextlib.contextmanager
def collecting_reports():
    """Keeps VTK's errors and warnings from the console; yields a function that returns them so
    far, as two lists of messages."""
    shown, kept = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(kept)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        yield lambda: tuple(_messages_of(text_of(kept.GetOutput()), kind)
                            for kind in ("ERROR", "Warning"))
    finally:
        vtkOutputWindow.SetInstance(shown)
        vtkLogger.SetStderrVerbosity(vtkLogger.ConvertToVerbosity(verbosity))


@contextlib.contextmanager
def _reading(name):
    """Turns the first error that VTK reports into a ReadingError, and prints none."""
    with noting_file(name), collecting_reports() as reports, _without_standard_error():
        yield
        errors, _ = reports()
    # Said of a piece without points, which is read; if not, there is another error.
    errors = [error for error in errors if "Reading file may fail" not in error]
    if errors:
        # The pipeline only repeats that the reader failed.
        reasons = [error for error in errors if "returned failure for request" not in error]
        raise ReadingError(f"{name}: {(reasons or ['VTK cannot read this file'])[0]}")


def _is_byu(name):
    """Whether a file is a surface of Movie.BYU, text with the ending of Exodus's .g: its first line
    has four whole numbers."""
    if ending_of(name) != ".g":
        return False
    with open(name, "rb") as file:
        words = file.readline(200).split()
    return len(words) >= 4 and all(word.isdigit() for word in words)


def _make_reader(name):
    module, reader = _BYU if _is_byu(name) else READERS[ending_of(name)]
    try:
        return getattr(importlib.import_module("vtkmodules." + module), reader)()
    except (ImportError, AttributeError):
        raise ReadingError(f"{name}: this build of VTK has no {reader}") from None


def _select_all(reader):
    """Switches all arrays and parts on that a reader knows after UpdateInformation()."""
    for method in _ENABLING:
        if hasattr(reader, method):
            getattr(reader, method)()
    for selection in _SELECTIONS:
        if hasattr(reader, selection):
            getattr(reader, selection)().EnableAllArrays()
    if hasattr(reader, "SetAllArrayStatus"):  # Exodus
        for kind in (reader.NODAL, reader.ELEM_BLOCK):
            reader.SetAllArrayStatus(kind, 1)
    if hasattr(reader, "SetMaximumLevelsToReadByDefault"):  # AMR
        reader.SetMaximumLevelsToReadByDefault(0)  # all
    if hasattr(reader, "GetAllDimensions"):  # netCDF: variables of one set of dimensions
        dimensions = [reader.GetAllDimensions().GetValue(index)
                      for index in range(reader.GetAllDimensions().GetNumberOfValues())]
        if dimensions:
            reader.SetDimensions(max(dimensions, key=lambda names: names.count(",")))


class _VTKFile:
    """A file that a reader of VTK reads."""

    def __init__(self, name):
        self.name = name
        self.reader = _make_reader(name)
        fault = find_fault(name) if ending_of(name) in _WITH_APPENDED else None
        if fault:
            raise ReadingError(f"{name}: {fault}")
        for method in ("SetFileName", "SetCaseFileName", "SetGeometryFileName"):
            if hasattr(self.reader, method):
                getattr(self.reader, method)(name)
                break
        with _reading(name):
            self.reader.UpdateInformation()
            _select_all(self.reader)

    def get_times(self):
        """Time values of the file's steps; empty if it has none."""
        information = self.reader.GetOutputInformation(0)
        key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        return list(information.Get(key)) if information.Has(key) else []

    def read(self, time=None):
        with _reading(self.name):
            if time is None:
                self.reader.Update()
            else:
                self.reader.UpdateTimeStep(time)
        return self.reader.GetOutputDataObject(0)


class _MeshioFile:
    """A file that meshio reads; the way to VTK is a temporary file."""

    def __init__(self, name):
        self.name = name
        try:
            self.meshio = importlib.import_module("meshio")
        except ImportError:
            raise ReadingError(f"{name}: files that end in '{ending_of(name)}' are read by the "
                               "package meshio, which is not installed (pip install meshio)"
                               ) from None

    def get_times(self):
        """Time values of a series of XDMF; empty for other files."""
        if ending_of(self.name) not in (".xdmf", ".xmf"):
            return []
        try:
            series = self.meshio.xdmf.TimeSeriesReader(self.name)
            return [float(grid.find("Time").get("Value")) for grid in series.collection]
        except Exception:  # a single mesh, or a file that read() reports
            return []

    def _read_mesh(self, time):
        times = self.get_times()
        if not times:
            return self.meshio.read(self.name)
        step = max((i for i, t in enumerate(times) if time is not None and t <= time), default=0)
        with self.meshio.xdmf.TimeSeriesReader(self.name) as series:
            points, cells = series.read_points_cells()
            _, point_data, cell_data = series.read_data(step)
        return self.meshio.Mesh(points, cells, point_data, cell_data)

    def read(self, time=None):
        printed = io.StringIO()
        with tempfile.TemporaryDirectory() as folder:
            copy = os.path.join(folder, "mesh.vtu")
            try:
                with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
                    self.meshio.write(copy, self._read_mesh(time))
            # meshio has no common class of errors, and ends the program for some.
            except (Exception, SystemExit) as error:
                reason = str(error) if isinstance(error, Exception) else printed.getvalue()
                reason = (reason.strip().splitlines() or [type(error).__name__])[0]
                raise ReadingError(f"{self.name}: meshio cannot read it: {reason}") from None
            return _VTKFile(copy).read()


class _PyVistaFile:
    """A file of a kind that only PyVista reads."""

    def __init__(self, name, reader):
        """reader: of PyVista."""
        self.name = name
        self.reader = reader

    def get_times(self):
        """Time values of the file's steps; empty if it has none."""
        return list(getattr(self.reader, "time_values", None) or [])

    def read(self, time=None):
        try:
            with _reading(self.name):
                if time is not None:
                    self.reader.set_active_time_value(time)
                return self.reader.read()
        except ReadingError:
            raise
        except Exception as error:  # readers in Python have no common class of errors
            raise ReadingError(f"{self.name}: PyVista cannot read it: {error}") from None


def _open_by_packages(name):
    """A file whose ending is not among those that are named here, by PyVista or meshio if they are
    installed and know it."""
    found = [import_quietly(package) for package in ("pyvista", "meshio")]
    if found[0]:
        with contextlib.suppress(ValueError, OSError, ImportError):
            return _PyVistaFile(name, found[0].get_reader(name))
    if found[1] and ending_of(name) in found[1].extension_to_filetypes:
        return _MeshioFile(name)
    known = ", ".join([*READERS, ".pvd", ".series", *MESHIO_ENDINGS])
    absent = [package for package, module in zip(("pyvista", "meshio"), found) if not module]
    hint = f"; the packages {' and '.join(absent)} know more (pip install {' '.join(absent)})"
    raise ReadingError(f"{name}: files that end in '{ending_of(name)}' cannot be read; known "
                       f"endings are {known}" + (hint if absent else ""))


def import_quietly(package):
    """A package without its warnings about itself; None if it is not installed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return importlib.import_module(package)
        except ImportError:
            return None


def _first_line(name):
    """First line that is not empty. In an input file of Abaqus it starts with a *, in a file of
    AVS, which has the same ending, it does not."""
    with open(name, errors="replace") as file:
        return next((line.strip() for line in file if line.strip()), "")


def open_file(name):
    """A file with get_times() and read(time): of an ending in READERS or MESHIO_ENDINGS, or of
    another one that PyVista or meshio know; a folder may be a case of OpenFOAM."""
    if os.path.isfile(os.path.join(name, "system", "controlDict")):
        name = os.path.join(name, "case.foam")  # which need not exist
    else:
        check_exists(name)
        _check_signature(name)
    suffix = ending_of(name)
    if suffix in MESHIO_ENDINGS or (suffix == ".inp" and _first_line(name).startswith("*")):
        return _MeshioFile(name)
    return _VTKFile(name) if suffix in READERS else _open_by_packages(name)
