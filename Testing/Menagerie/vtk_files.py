# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writers of VTK's XML and legacy files in all encodings, without VTK."""
import base64
import lzma
import struct
import zlib

import numpy

_XML_NAMES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8",
              "i2": "Int16"}
_LEGACY_NAMES = {"f4": "float", "f8": "double", "i4": "int", "i8": "vtktypeint64",
                 "u1": "unsigned_char", "i2": "short"}


def _kind(values):
    return values.dtype.kind + str(values.dtype.itemsize)


def _lz4_block(data):
    """An LZ4 block of literals only."""
    size = len(data)
    extra = b"" if size < 15 else b"\xff" * ((size - 15) // 255) + bytes([(size - 15) % 255])
    return bytes([min(size, 15) << 4]) + extra + data


COMPRESSORS = {
    "vtkZLibDataCompressor": zlib.compress,
    "vtkLZ4DataCompressor": _lz4_block,
    "vtkLZMADataCompressor": lzma.compress,
}


class XMLWriter:
    """Text of a VTK XML file.

    encoding: "ascii", "base64" (inline), "raw" or "appended base64". compressor: a name of
    COMPRESSORS. big: byte order. header: struct format of the sizes, I or Q.
    """

    def __init__(self, encoding="ascii", compressor=None, big=False, header="I", version="1.0",
                 block=64):
        self.encoding, self.compressor, self.version = encoding, compressor, version
        self.big, self.header, self.block = big, header, block
        self.appended = b""

    def _sizes(self, *values):
        return struct.pack((">" if self.big else "<") + self.header * len(values), *values)

    def _encode(self, values):
        """Bytes of an array with their header, each part as it stands before base64."""
        data = values.astype(values.dtype.newbyteorder(">" if self.big else "<")).tobytes()
        if not self.compressor:
            return [self._sizes(len(data)) + data]
        blocks = [data[i:i + self.block] for i in range(0, len(data), self.block)]
        packed = [COMPRESSORS[self.compressor](each) for each in blocks]
        last = len(blocks[-1]) % self.block if blocks else 0
        header = self._sizes(len(blocks), self.block, last, *map(len, packed))
        return [header, b"".join(packed)]

    def array(self, name, values, components=1):
        """A DataArray element."""
        values = numpy.asarray(values)
        tag = f'<DataArray type="{_XML_NAMES[_kind(values)]}" Name="{name}"'
        if components > 1:
            tag += f' NumberOfComponents="{components}"'
        if self.encoding == "ascii":
            text = " ".join(repr(value) for value in values.ravel().tolist())
            return f'{tag} format="ascii">\n{text}\n</DataArray>\n'
        parts = self._encode(values)
        if self.encoding == "base64":
            text = "".join(base64.b64encode(part).decode() for part in parts)
            return f'{tag} format="binary">\n{text}\n</DataArray>\n'
        tag += f' format="appended" offset="{len(self.appended)}"/>\n'
        self.appended += (b"".join(parts) if self.encoding == "raw"
                          else b"".join(base64.b64encode(part) for part in parts))
        return tag

    def arrays(self, tag, arrays):
        """PointData or CellData."""
        return f"<{tag}>\n" + "".join(
            self.array(name, values, values.shape[1] if values.ndim > 1 else 1)
            for name, values in arrays.items()) + f"</{tag}>\n"

    def file(self, kind, body, attributes=""):
        """The bytes of a file of a type, such as UnstructuredGrid."""
        compressor = f' compressor="{self.compressor}"' if self.compressor else ""
        order = "BigEndian" if self.big else "LittleEndian"
        header = {"I": "UInt32", "Q": "UInt64"}[self.header]
        text = (f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="{self.version}" '
                f'byte_order="{order}" header_type="{header}"{compressor}>\n'
                f"<{kind}{attributes}>\n{body}</{kind}>\n").encode()
        if self.appended:
            name = "raw" if self.encoding == "raw" else "base64"
            text += f'<AppendedData encoding="{name}">\n_'.encode() + self.appended
            text += b"\n</AppendedData>\n"
        return text + b"</VTKFile>\n"


def _face_stream(mesh):
    """Arrays faces and faceoffsets of polyhedra."""
    stream, ends = [], []
    for faces in mesh.faces:
        stream.append(len(faces))
        for face in faces:
            stream += [len(face), *face]
        ends.append(len(stream))
    return stream, ends


def vtu(mesh, ids="i8", points="f8", connectivity=None, offsets=None, field="", **options):
    """Bytes of a .vtu file; connectivity and offsets replace those of the mesh."""
    writer = XMLWriter(**options)
    sizes = [len(cell) for cell in mesh.cells]
    if connectivity is None:
        connectivity = [point for cell in mesh.cells for point in cell]
    if offsets is None:
        offsets = numpy.cumsum(sizes)
    body = field + (f'<Piece NumberOfPoints="{len(mesh.points)}" '
                    f'NumberOfCells="{len(mesh.types)}">\n')
    body += writer.arrays("PointData", mesh.point_data) + writer.arrays("CellData", mesh.cell_data)
    body += "<Points>\n" + writer.array("Points", mesh.points.astype(points), 3) + "</Points>\n"
    body += "<Cells>\n" + writer.array("connectivity", numpy.array(connectivity, ids))
    body += writer.array("offsets", numpy.array(offsets, ids))
    body += writer.array("types", numpy.array(mesh.types, "u1"))
    if mesh.faces:
        stream, ends = _face_stream(mesh)
        body += writer.array("faces", numpy.array(stream, ids))
        body += writer.array("faceoffsets", numpy.array(ends, ids))
    return writer.file("UnstructuredGrid", body + "</Cells>\n</Piece>\n")


def _names(arrays):
    return "".join(
        f'<PDataArray type="{_XML_NAMES[_kind(values)]}" Name="{name}" '
        f'NumberOfComponents="{values.shape[1] if values.ndim > 1 else 1}"/>\n'
        for name, values in arrays.items())


def pvtu(mesh, pieces):
    """Bytes of a .pvtu file; mesh: one of the pieces."""
    body = (f"<PPointData>\n{_names(mesh.point_data)}</PPointData>\n"
            f"<PCellData>\n{_names(mesh.cell_data)}</PCellData>\n"
            '<PPoints>\n<PDataArray type="Float64" Name="Points" NumberOfComponents="3"/>\n'
            "</PPoints>\n" + "".join(f'<Piece Source="{piece}"/>\n' for piece in pieces))
    return XMLWriter().file("PUnstructuredGrid", body, ' GhostLevel="0"')


def _grid_arrays(dimensions):
    x, y, z = (axis.ravel(order="F") for axis in numpy.meshgrid(
        *(numpy.linspace(0, 2 if i == 0 else 1, n) for i, n in enumerate(dimensions)),
        indexing="ij"))
    return numpy.stack([x, y, z], axis=1), {"T": x + 2 * y + 3 * z}


def structured(kind, dimensions=(3, 2, 2), ghosts=None, **options):
    """Bytes of a .vti, .vtr or .vts file of the box, by its type, such as ImageData."""
    writer = XMLWriter(**options)
    extent = " ".join(f"0 {n - 1}" for n in dimensions)
    points, arrays = _grid_arrays(dimensions)
    cells = {"p": numpy.arange(float(numpy.prod([max(1, n - 1) for n in dimensions])))}
    if ghosts is not None:
        cells["vtkGhostType"] = numpy.array(ghosts, "u1")
    body = f'<Piece Extent="{extent}">\n' + writer.arrays("PointData", arrays)
    body += writer.arrays("CellData", cells)
    if kind == "RectilinearGrid":
        body += "<Coordinates>\n" + "".join(
            writer.array(axis, numpy.linspace(0, 2 if axis == "x" else 1, n))
            for axis, n in zip("xyz", dimensions)) + "</Coordinates>\n"
    elif kind == "StructuredGrid":
        body += "<Points>\n" + writer.array("Points", points, 3) + "</Points>\n"
    attributes = f' WholeExtent="{extent}"'
    if kind == "ImageData":
        spacing = " ".join(str((2 if i == 0 else 1) / max(1, n - 1))
                           for i, n in enumerate(dimensions))
        attributes += f' Origin="0 0 0" Spacing="{spacing}"'
    return writer.file(kind, body + "</Piece>\n", attributes)


def blocks(files, kind="vtkMultiBlockDataSet", tag="DataSet"):
    """Bytes of a .vtm file; a file that is a list is a nested block."""
    def write(items):
        text = ""
        for index, item in enumerate(items):
            if isinstance(item, str):
                text += f'<{tag} index="{index}" file="{item}"/>\n'
            else:
                text += f'<Block index="{index}">\n{write(item)}</Block>\n'
        return text
    return XMLWriter().file(kind, write(files))


def collection(entries):
    """Bytes of a .pvd file; entries: attributes of the data sets as dictionaries."""
    return XMLWriter(version="0.1").file("Collection", "".join(
        "<DataSet " + " ".join(f'{name}="{value}"' for name, value in entry.items()) + "/>\n"
        for entry in entries))


class _LegacyWriter:
    def __init__(self, binary):
        self.binary = binary

    def values(self, values):
        values = numpy.asarray(values)
        if self.binary:
            return values.astype(values.dtype.newbyteorder(">")).tobytes() + b"\n"
        return " ".join(repr(value) for value in values.ravel().tolist()).encode() + b"\n"

    def field(self, arrays):
        text = f"FIELD FieldData {len(arrays)}\n".encode()
        for name, values in arrays.items():
            components = values.shape[1] if values.ndim > 1 else 1
            text += (f"{name} {components} {len(values)} {_LEGACY_NAMES[_kind(values)]}\n".encode()
                     + self.values(values))
        return text


def legacy(mesh, binary=False, version="4.2", scalars=None):
    """Bytes of a legacy .vtk file; scalars: name of a point array that is written as SCALARS."""
    writer = _LegacyWriter(binary)
    text = (f"# vtk DataFile Version {version}\nmesh\n{'BINARY' if binary else 'ASCII'}\n"
            f"DATASET UNSTRUCTURED_GRID\nPOINTS {len(mesh.points)} double\n").encode()
    text += writer.values(mesh.points)
    sizes = [len(cell) for cell in mesh.cells]
    if version >= "5":
        offsets = numpy.concatenate([[0], numpy.cumsum(sizes)]).astype("i8")
        ids = numpy.array([point for cell in mesh.cells for point in cell], "i8")
        text += f"CELLS {len(offsets)} {len(ids)}\nOFFSETS vtktypeint64\n".encode()
        text += writer.values(offsets) + b"CONNECTIVITY vtktypeint64\n" + writer.values(ids)
    else:
        stream = numpy.array([number for cell in mesh.cells for number in (len(cell), *cell)], "i4")
        text += f"CELLS {len(sizes)} {len(stream)}\n".encode() + writer.values(stream)
    text += f"CELL_TYPES {len(mesh.types)}\n".encode()
    text += writer.values(numpy.array(mesh.types, "i4"))
    points = dict(mesh.point_data)
    text += f"POINT_DATA {len(mesh.points)}\n".encode()
    if scalars:
        text += f"SCALARS {scalars} double 1\nLOOKUP_TABLE default\n".encode()
        text += writer.values(points.pop(scalars))
    text += writer.field(points) if points else b""
    if mesh.cell_data:
        text += f"CELL_DATA {len(mesh.cells)}\n".encode() + writer.field(mesh.cell_data)
    return text
