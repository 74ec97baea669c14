# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writers of files of other programs: Exodus, CGNS, VTKHDF, netCDF (by netCDF4 and h5py), EnSight,
OpenFOAM, Gmsh, Abaqus and AVS. Each fills a folder or writes a file."""
import os
import struct

import h5py
import netCDF4
import numpy

from meshes import FACES, HEXAHEDRON, QUADRATIC_TETRA, TETRA, WEDGE

_EXODUS_NAMES = {TETRA: "TET4", HEXAHEDRON: "HEX8", WEDGE: "WEDGE6", QUADRATIC_TETRA: "TET10"}


def _text(size, names):
    """Names as rows of characters."""
    return numpy.array([list(name.ljust(size, "\0")) for name in names], "S1")


def exodus(name, blocks, points, node_arrays, cell_arrays, times):
    """An Exodus file.

    blocks: pairs of a cell type and lists of point indices. node_arrays: functions of a time by
    name, cell_arrays: functions of a time and a block's number.
    """
    with netCDF4.Dataset(name, "w", format="NETCDF3_CLASSIC") as file:
        file.setncatts({"api_version": numpy.float32(4.98), "version": numpy.float32(4.98),
                        "floating_point_word_size": numpy.int32(8), "file_size": numpy.int32(1),
                        "title": "box"})
        for dimension, size in (("len_string", 33), ("len_name", 33), ("time_step", None),
                                ("num_dim", 3), ("num_nodes", len(points)),
                                ("num_elem", sum(len(cells) for _, cells in blocks)),
                                ("num_el_blk", len(blocks)), ("num_nod_var", len(node_arrays)),
                                ("num_elem_var", len(cell_arrays))):
            file.createDimension(dimension, size)
        file.createVariable("time_whole", "f8", ("time_step",))[:] = times
        file.createVariable("eb_status", "i4", ("num_el_blk",))[:] = 1
        prop = file.createVariable("eb_prop1", "i4", ("num_el_blk",))
        prop.setncattr("name", "ID")
        prop[:] = numpy.arange(len(blocks)) + 1
        for axis, values in zip("xyz", points.T):
            file.createVariable("coord" + axis, "f8", ("num_nodes",))[:] = values
        for number, (kind, cells) in enumerate(blocks, 1):
            file.createDimension(f"num_el_in_blk{number}", len(cells))
            file.createDimension(f"num_nod_per_el{number}", len(cells[0]))
            connect = file.createVariable(f"connect{number}", "i4", (
                f"num_el_in_blk{number}", f"num_nod_per_el{number}"))
            connect.setncattr("elem_type", _EXODUS_NAMES[kind])
            connect[:] = numpy.array(cells) + 1
        file.createVariable("name_nod_var", "S1", ("num_nod_var", "len_name"))[:] = _text(
            33, node_arrays)
        file.createVariable("name_elem_var", "S1", ("num_elem_var", "len_name"))[:] = _text(
            33, cell_arrays)
        file.createVariable("elem_var_tab", "i4", ("num_el_blk", "num_elem_var"))[:] = 1
        for index, function in enumerate(node_arrays.values(), 1):
            file.createVariable(f"vals_nod_var{index}", "f8", ("time_step", "num_nodes"))[:] = [
                function(time) for time in times]
        for index, function in enumerate(cell_arrays.values(), 1):
            for number in range(1, len(blocks) + 1):
                file.createVariable(f"vals_elem_var{index}eb{number}", "f8", (
                    "time_step", f"num_el_in_blk{number}"))[:] = [
                        numpy.full(len(blocks[number - 1][1]), function(time, number))
                        for time in times]


def climate(name):
    """A netCDF file with CF conventions: a variable on a surface before those of the air."""
    with netCDF4.Dataset(name, "w", format="NETCDF3_CLASSIC") as file:
        file.setncattr("Conventions", "CF-1.6")
        for dimension, size in (("z", 2), ("y", 2), ("x", 3)):
            file.createDimension(dimension, size)
            axis = file.createVariable(dimension, "f8", (dimension,))
            axis.setncattr("units", "m")
            axis[:] = numpy.linspace(0, 2 if dimension == "x" else 1, size)
        file.createVariable("orography", "f8", ("y", "x"))[:] = 1.0
        z, y, x = numpy.meshgrid([0, 1], [0, 1], [0, 1, 2], indexing="ij")
        file.createVariable("T", "f8", ("z", "y", "x"))[:] = x + 2 * y + 3 * z
        file.createVariable("q", "f8", ("z", "y", "x"))[:] = x * 1.0


def _node(parent, name, label, kind="MT", data=None):
    """A node of CGNS in HDF5."""
    group = parent.create_group(name, track_order=True)
    for key, value, size in (("name", name, 33), ("label", label, 33), ("type", kind, 3)):
        group.attrs.create(key, numpy.bytes_(value.encode()), dtype=f"S{size}")
    group.attrs.create("flags", numpy.array([1], "i4"))
    if data is not None:
        group.create_dataset(" data", data=data)
    return group


def _characters(text):
    return numpy.frombuffer(text.encode(), "i1")


def _solution(zone, name, location, arrays):
    solution = _node(zone, name, "FlowSolution_t")
    _node(solution, "GridLocation", "GridLocation_t", "C1", _characters(location))
    for array, values in arrays.items():
        _node(solution, array, "DataArray_t", "R8", values)


def _zone(base, name, sizes, kind, points):
    zone = _node(base, name, "Zone_t", "I4", numpy.array(sizes, "i4"))
    _node(zone, "ZoneType", "ZoneType_t", "C1", _characters(kind))
    coordinates = _node(zone, "GridCoordinates", "GridCoordinates_t")
    for axis, values in zip("XYZ", points):
        _node(coordinates, "Coordinate" + axis, "DataArray_t", "R8", values)
    return zone


def cgns(name, bases):
    """A CGNS file; bases: functions by name that fill a base."""
    with h5py.File(name, "w", track_order=True) as file:
        for key, value, size in (("name", "HDF5 MotherNode", 33),
                                 ("label", "Root Node of HDF5 File", 33), ("type", "MT", 3)):
            file.attrs.create(key, numpy.bytes_(value.encode()), dtype=f"S{size}")
        file.create_dataset(" format", data=_characters("IEEE_LITTLE_32\0"))
        file.create_dataset(" hdf5version", data=_characters("HDF5 Version 1.10.0".ljust(33, "\0")))
        _node(file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4", numpy.array([3.4], "f4"))
        for base, fill in bases.items():
            fill(_node(file, base, "CGNSBase_t", "I4", numpy.array([3, 3], "i4")))


def cgns_hexahedra(mesh):
    """Fills a base with hexahedra that have three cell arrays."""
    def fill(base):
        count = len(mesh.cells)
        zone = _zone(base, "Zone", [[len(mesh.points)], [count], [0]], "Unstructured",
                     mesh.points.T)
        elements = _node(zone, "Elements", "Elements_t", "I4", numpy.array([17, 0], "i4"))
        _node(elements, "ElementRange", "IndexRange_t", "I4", numpy.array([1, count], "i4"))
        _node(elements, "ElementConnectivity", "DataArray_t", "I4",
              numpy.array(mesh.cells, "i4").ravel() + 1)
        _solution(zone, "CellSolution", "CellCenter", {
            "Pressure": numpy.arange(count) + 1.0, "Density": numpy.arange(count) + 2.0,
            "Temperature": numpy.arange(count) + 3.0})
    return fill


def cgns_structured(first):
    """Fills a base with a unit cube from x = first on, as a structured zone with a point array."""
    def fill(base):
        z, y, x = numpy.meshgrid([0.0, 1.0], [0.0, 1.0], [first, first + 1.0], indexing="ij")
        zone = _zone(base, "Zone", [[2, 2, 2], [1, 1, 1], [0, 0, 0]], "Structured", (x, y, z))
        _solution(zone, "Solution", "Vertex", {"Pressure": x + 2 * y + 3 * z})
    return fill


def _write_hdf_grid(group, meshes):
    """Pieces of an unstructured grid as VTKHDF keeps them."""
    for name, values in (("NumberOfPoints", [len(mesh.points) for mesh in meshes]),
                         ("NumberOfCells", [len(mesh.cells) for mesh in meshes]),
                         ("NumberOfConnectivityIds",
                          [sum(map(len, mesh.cells)) for mesh in meshes])):
        group.create_dataset(name, data=numpy.array(values, "i8"))
    group.create_dataset("Points", data=numpy.concatenate([mesh.points for mesh in meshes]))
    group.create_dataset("Connectivity", data=numpy.array(
        [point for mesh in meshes for cell in mesh.cells for point in cell], "i8"))
    group.create_dataset("Offsets", data=numpy.concatenate(
        [[0, *numpy.cumsum([len(cell) for cell in mesh.cells])] for mesh in meshes]).astype("i8"))
    group.create_dataset("Types", data=numpy.concatenate(
        [mesh.types for mesh in meshes]).astype("u1"))
    for kind, name in (("PointData", "point_data"), ("CellData", "cell_data")):
        arrays = group.create_group(kind)
        for array in getattr(meshes[0], name):
            arrays.create_dataset(array, data=numpy.concatenate(
                [getattr(mesh, name)[array] for mesh in meshes]))


def _hdf_root(file, kind, version):
    root = file.create_group("VTKHDF")
    root.attrs["Version"] = numpy.array(version, "i8")
    root.attrs.create("Type", numpy.bytes_(kind.encode()))
    return root


def vtkhdf(name, meshes, version=(1, 0)):
    """Pieces of an unstructured grid."""
    with h5py.File(name, "w") as file:
        _write_hdf_grid(_hdf_root(file, "UnstructuredGrid", version), meshes)


def vtkhdf_image(name):
    """Image data."""
    with h5py.File(name, "w") as file:
        root = _hdf_root(file, "ImageData", (1, 0))
        root.attrs["WholeExtent"] = numpy.array([0, 2, 0, 1, 0, 1], "i8")
        root.attrs["Origin"] = numpy.zeros(3)
        root.attrs["Spacing"] = numpy.ones(3)
        root.attrs["Direction"] = numpy.eye(3).ravel()
        z, y, x = numpy.meshgrid([0, 1], [0, 1], [0, 1, 2], indexing="ij")
        root.create_group("PointData").create_dataset("T", data=1.0 * x + 2 * y + 3 * z)
        root.create_group("CellData")


def vtkhdf_steps(name, mesh, times):
    """Version 2: one mesh whose point array T is multiplied by 1 + time in each step."""
    with h5py.File(name, "w") as file:
        root = _hdf_root(file, "UnstructuredGrid", (2, 0))
        _write_hdf_grid(root, [mesh])
        del root["PointData"]["T"], root["PointData"]["U"]
        root["PointData"].create_dataset("T", data=numpy.concatenate(
            [(1 + time) * mesh.point_data["T"] for time in times]))
        steps = root.create_group("Steps")
        steps.attrs["NSteps"] = len(times)
        steps.create_dataset("Values", data=numpy.array(times))
        zeros = numpy.zeros(len(times), "i8")
        for offset in ("PartOffsets", "PointOffsets"):
            steps.create_dataset(offset, data=zeros)
        steps.create_dataset("NumberOfParts", data=zeros + 1)
        for offset in ("CellOffsets", "ConnectivityIdOffsets"):
            steps.create_dataset(offset, data=zeros.reshape(-1, 1))
        steps.create_group("PointDataOffsets").create_dataset(
            "T", data=len(mesh.points) * numpy.arange(len(times)))
        steps.create_group("CellDataOffsets").create_dataset("p", data=zeros)


def _ensight_line(text, binary):
    return text.encode().ljust(80, b"\0") if binary else text.encode() + b"\n"


def _ensight_numbers(values, code, binary):
    if binary:
        return struct.pack("<" + code * len(values), *values)
    form = "%10d\n" if code == "i" else "%12.5e\n"
    return "".join(form % value for value in values).encode()


def ensight(folder, name, mesh, times, binary=False):
    """A case of EnSight Gold with a scalar per node, a vector per node and a scalar per element."""
    os.makedirs(folder, exist_ok=True)

    def line(text):
        return _ensight_line(text, binary)

    def numbers(values, code):
        return _ensight_numbers(values, code, binary)

    def write(file, *parts):
        with open(os.path.join(folder, file), "wb") as stream:
            stream.write(b"".join(parts))

    part = line("part") + numbers([1], "i")
    write(name + ".geo", line("C Binary") if binary else b"", line("box"), line("of hexahedra"),
          line("node id off"), line("element id off"), part, line("box"), line("coordinates"),
          numbers([len(mesh.points)], "i"), *(numbers(axis, "f") for axis in mesh.points.T),
          line("hexa8"), numbers([len(mesh.cells)], "i"),
          *((numbers([i + 1 for i in cell], "i") if binary
             else "".join("%10d" % (i + 1) for i in cell).encode() + b"\n") for cell in mesh.cells))
    for number, time in enumerate(times):
        write(f"{name}{number:03}.T", line("T"), part, line("coordinates"),
              numbers((1 + time) * mesh.point_data["T"], "f"))
        write(f"{name}{number:03}.U", line("U"), part, line("coordinates"),
              *(numbers(axis, "f") for axis in mesh.point_data["U"].T))
        write(f"{name}{number:03}.p", line("p"), part, line("hexa8"),
              numbers(mesh.cell_data["p"], "f"))
    write(name + ".case", (
        f"FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: {name}.geo\nVARIABLE\n"
        f"scalar per node: 1 T {name}***.T\nvector per node: 1 U {name}***.U\n"
        f"scalar per element: 1 p {name}***.p\nTIME\ntime set: 1\n"
        f"number of steps: {len(times)}\nfilename start number: 0\nfilename increment: 1\n"
        "time values: " + " ".join(map(str, times)) + "\n").encode())


def _foam(folder, kind, name, body):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", newline="\n") as file:
        file.write("FoamFile\n{\n    version 2.0;\n    format ascii;\n    class " + kind
                   + ";\n    object " + os.path.basename(name) + ";\n}\n" + body)


def openfoam(folder, mesh, times):
    """A case of OpenFOAM: hexahedra with the fields p and U of each time."""
    sides = {}
    for number, cell in enumerate(mesh.cells):
        for face in FACES:
            points = [cell[i] for i in face]
            sides.setdefault(frozenset(points), []).append((number, points))
    inner = [each for each in sides.values() if len(each) == 2]
    outer = [each for each in sides.values() if len(each) == 1]
    faces = inner + outer

    def listed(items):
        return f"{len(items)}\n(\n" + "\n".join(items) + "\n)\n"

    grid = "constant/polyMesh/"
    # OpenFOAM's normals point out of the owner, those of FACES into the cell or out of it alike:
    # VTK's reader turns them.
    _foam(folder, "vectorField", grid + "points", listed(
        ["(%g %g %g)" % tuple(point) for point in mesh.points]))
    _foam(folder, "faceList", grid + "faces", listed(
        ["4(%d %d %d %d)" % tuple(each[0][1]) for each in faces]))
    _foam(folder, "labelList", grid + "owner", listed([str(each[0][0]) for each in faces]))
    _foam(folder, "labelList", grid + "neighbour", listed([str(each[1][0]) for each in inner]))
    _foam(folder, "polyBoundaryMesh", grid + "boundary", (
        "1\n(\nwalls\n{\n    type wall;\n    nFaces %d;\n    startFace %d;\n}\n)\n"
        % (len(outer), len(inner))))
    _foam(folder, "dictionary", "system/controlDict", (
        "application none;\nstartFrom startTime;\nstartTime 0;\nstopAt endTime;\nendTime 1;\n"
        "deltaT 1;\nwriteControl timeStep;\nwriteInterval 1;\nwriteFormat ascii;\n"))
    for time in times:
        _foam(folder, "volScalarField", f"{time}/p", (
            "dimensions [0 2 -2 0 0 0 0];\ninternalField nonuniform List<scalar>\n"
            + listed(["%g" % (number + time) for number in range(len(mesh.cells))])
            + ";\nboundaryField { walls { type zeroGradient; } }\n"))
        _foam(folder, "volVectorField", f"{time}/U", (
            "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (1 0 0);\n"
            "boundaryField { walls { type fixedValue; value uniform (0 0 0); } }\n"))
    with open(os.path.join(folder, "case.foam"), "w"):
        pass


def gmsh(mesh):
    """Text of a file of Gmsh, version 2.2, with the boundary's quadrilaterals."""
    kinds = {TETRA: 4, HEXAHEDRON: 5, WEDGE: 6, 9: 3}
    text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n" % len(mesh.points)
    text += "".join("%d %g %g %g\n" % (i, *point) for i, point in enumerate(mesh.points, 1))
    text += "$EndNodes\n$Elements\n%d\n" % len(mesh.cells)
    text += "".join("%d %d 2 1 1 %s\n" % (i, kinds[kind], " ".join(str(p + 1) for p in cell))
                    for i, (kind, cell) in enumerate(zip(mesh.types, mesh.cells), 1))
    text += '$EndElements\n$NodeData\n1\n"T"\n1\n0.0\n3\n0\n1\n%d\n' % len(mesh.points)
    text += "".join("%d %g\n" % (i, value) for i, value in enumerate(mesh.point_data["T"], 1))
    return text + "$EndNodeData\n"


def _xdmf_item(values):
    kind = "Float" if values.dtype.kind == "f" else "Int"
    return (f'<DataItem DataType="{kind}" Precision="8" Format="XML" '
            f'Dimensions="{" ".join(map(str, values.shape))}">\n'
            + " ".join(map(str, values.ravel().tolist())) + "\n</DataItem>\n")


def _xdmf_grid(mesh):
    cells = numpy.array(mesh.cells, "i8")
    return (f'<Topology TopologyType="Tetrahedron" NumberOfElements="{len(cells)}">\n'
            f'{_xdmf_item(cells)}</Topology>\n<Geometry GeometryType="XYZ">\n'
            f'{_xdmf_item(mesh.points)}</Geometry>\n')


def _xdmf_attribute(name, values):
    return (f'<Attribute Name="{name}" AttributeType="Scalar" Center="Node">\n'
            f'{_xdmf_item(values)}</Attribute>\n')


def xdmf(mesh, times=()):
    """Text of an XDMF file of tetrahedra with the point array T, multiplied by 1 + time in a
    series."""
    body = f'<Grid Name="mesh" GridType="Uniform">\n{_xdmf_grid(mesh)}'
    if not times:
        body += _xdmf_attribute("T", mesh.point_data["T"])
    body += "</Grid>\n"
    if times:
        body += '<Grid Name="T" GridType="Collection" CollectionType="Temporal">\n' + "".join(
            f'<Grid Name="T" GridType="Uniform">\n<Time Value="{time}"/>\n'
            + _xdmf_attribute("T", (1 + time) * mesh.point_data["T"]) + "</Grid>\n"
            for time in times) + "</Grid>\n"
    return f'<?xml version="1.0"?>\n<Xdmf Version="3.0">\n<Domain>\n{body}</Domain>\n</Xdmf>\n'


def abaqus(mesh):
    """Text of an input file of Abaqus."""
    text = "*HEADING\nbox\n*NODE\n"
    text += "".join("%d, %g, %g, %g\n" % (i, *point) for i, point in enumerate(mesh.points, 1))
    text += "*ELEMENT, TYPE=C3D8, ELSET=BOX\n"
    text += "".join(", ".join(map(str, [i, *(p + 1 for p in cell)])) + "\n"
                    for i, cell in enumerate(mesh.cells, 1))
    return text


def avs(mesh):
    """Text of an AVS UCD file."""
    text = "%d %d 1 1 0\n" % (len(mesh.points), len(mesh.cells))
    text += "".join("%d %g %g %g\n" % (i, *point) for i, point in enumerate(mesh.points, 1))
    text += "".join("%d 1 hex %s\n" % (i, " ".join(str(cell[k] + 1) for k in (
        4, 5, 6, 7, 0, 1, 2, 3))) for i, cell in enumerate(mesh.cells, 1))
    text += "1 1\nT, K\n"
    text += "".join("%d %g\n" % (i, value) for i, value in enumerate(mesh.point_data["T"], 1))
    text += "1 1\np, Pa\n"
    return text + "".join("%d %g\n" % (i, value)
                          for i, value in enumerate(mesh.cell_data["p"], 1))
