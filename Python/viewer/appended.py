# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Appended data of VTK's files of XML: whether arrays are where the file says.

VTK's readers do not check it: an array whose data are outside of the file has the contents of
memory, or is left out.
"""
import base64
import math
import mmap
import os
import re
import struct

# Elements of arrays, and the elements that contain them.
_TAG = re.compile(rb"""<(DataArray|Array|Piece|PointData|CellData|Points|Cells|Verts|Lines|"""
                  rb"""Strips|Polys|Coordinates|FieldData)\b(?:[^>"']|"[^"]*"|'[^']*')*>""")
_ATTRIBUTE = re.compile(rb"""(\w+)\s*=\s*(?:"([^"]*)"|'([^']*)')""")


def _attributes_of(tag):
    return {name.decode(): (first or second).decode("utf-8", "replace")
            for name, first, second in _ATTRIBUTE.findall(tag)}


class _Appended:
    """The appended data of a file.

    data: bytes of the file. head: attributes of the file. start, end: place of the data in it.
    """

    def __init__(self, data, head, tag, start, end):
        self._data = data
        self._start, self.size = start, end - start
        self._is_compressed = bool(head.get("compressor"))
        self._is_raw = tag.get("encoding") == "raw"
        self._kind = (">" if head.get("byte_order") == "BigEndian" else "<") + (
            "Q" if head.get("header_type") == "UInt64" else "I")
        self._word = struct.calcsize(self._kind)

    def _read_words(self, offset, count):
        """The first numbers of a block; None if they are not all in the data."""
        length = self._word * count
        if offset < 0 or count < 0 or offset + self._length_of(length) > self.size:
            return None
        block = self._data[self._start + offset:self._start + offset + self._length_of(length)]
        if not self._is_raw:
            try:
                block = base64.b64decode(block)
            except ValueError:
                return None
        if len(block) < length:
            return None
        return [number for number, in struct.iter_unpack(self._kind, block[:length])]

    def _length_of(self, size):
        """Length of so many bytes in the file."""
        return size if self._is_raw else -(-size // 3) * 4

    def find_block(self, offset):
        """Offset of the end of an array's data, and size of its values in bytes; None if they are
        not in the data."""
        words = self._read_words(offset, 1)
        if words is None:
            return None
        if not self._is_compressed:
            size = words[0]
            end = offset + self._length_of(self._word + size)
        elif words[0] == 0:  # an empty array
            size = 0
            end = offset + self._length_of(self._word)
        else:
            # The number of blocks, their size, that of the last one if it is smaller, and the
            # compressed size of each.
            count = 3 + words[0]
            words = self._read_words(offset, count)
            if words is None:
                return None
            size = words[0] * words[1] - (words[1] - words[2] if words[2] else 0)
            end = offset + self._length_of(self._word * count) + self._length_of(sum(words[3:]))
        return (end, size) if end <= self.size else None


def _open(data):
    """The appended data, and the head of the file with its arrays; None if there are none."""
    place = data.find(b"<AppendedData")
    begin = data.find(b"_", data.find(b">", place)) + 1 if place >= 0 else 0
    if begin == 0:
        return None
    head = data[:place]
    file = re.search(rb"<VTKFile\b[^>]*>", head)
    end = data.rfind(b"</AppendedData")
    return head, _Appended(data, _attributes_of(file.group() if file else b""),
                           _attributes_of(data[place:data.find(b">", place)]), begin,
                           end if end >= begin else len(data))


def _count_tuples(piece):
    """Numbers of points and cells of a piece."""
    if "Extent" in piece:
        extent = list(map(int, piece["Extent"].split()))
        sizes = [max(0, extent[i + 1] - extent[i]) for i in (0, 2, 4)]
        return {"PointData": math.prod(size + 1 for size in sizes),
                "CellData": math.prod(max(1, size) for size in sizes)}
    points = int(piece.get("NumberOfPoints", 0))
    counts = {"PointData": points, "Points": points}
    if "NumberOfCells" in piece:
        counts["CellData"] = int(piece["NumberOfCells"])
    return counts


def _list_arrays(head):
    """The attributes of each array with appended data, and the size of its values in bytes; None if
    that is not known."""
    counts, owner = {}, ""
    for match in _TAG.finditer(head):
        kind, attributes = match[1].decode(), _attributes_of(match[0])
        if kind == "Piece":
            counts = _count_tuples(attributes)
        elif not kind.endswith("Array"):
            owner = kind
        elif attributes.get("format") == "appended" and "offset" in attributes:
            bits = re.fullmatch("U?(?:Int|Float)([0-9]+)", attributes.get("type", ""))
            # One offset and one type belong to each cell; the number of indices is not known.
            known = attributes.get("Name") in ("offsets", "types") and owner == "Cells"
            tuples = counts.get("CellData" if known else owner)
            size = None if tuples is None or not bits else tuples * int(bits[1]) // 8 * int(
                attributes.get("NumberOfComponents", 1))
            yield attributes, size


def _find_fault(head, appended):
    blocks = {}
    for array, size in _list_arrays(head):
        name, offset = array.get("Name", ""), array["offset"].strip()
        number = int(offset) if re.fullmatch("-?[0-9]+", offset) else -1
        block = appended.find_block(number)
        if block is None:
            return (f"the array '{name}' is not in the appended data, which have {appended.size} "
                    f"bytes: its offset, {offset}, is wrong, or the file is cut off")
        if size not in (None, block[1]):
            return (f"the array '{name}' needs {size} bytes, but has {block[1]} in the appended "
                    f"data: its offset, {offset}, or the number of its values is wrong")
        blocks[number] = (name, block[0])
    places = sorted(blocks)
    for first, second in zip(places, places[1:]):
        if blocks[first][1] > second:
            return (f"the arrays '{blocks[first][0]}' and '{blocks[second][0]}' overlap in the "
                    f"appended data: one of their offsets, {first} and {second}, is wrong")
    return None


def find_fault(name):
    """What is wrong with the appended data of a file; None if nothing is found."""
    if os.path.getsize(name) == 0:
        return None
    with open(name, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        found = _open(data)
        try:
            return _find_fault(*found) if found else None
        except ValueError:  # numbers that are none, which the reader reports
            return None
