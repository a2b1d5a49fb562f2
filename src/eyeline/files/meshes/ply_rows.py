"""The rows of a PLY file's elements, text or binary, as columns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.errors import FileError
from eyeline.files.meshes.ply_header import Element, Header
from eyeline.files.meshes.text import shortened
from eyeline.geometry.arrays import FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class Lists:
    """Lists of different lengths, one after the other."""

    values: IntArray | FloatArray  # (C,)
    counts: IntArray  # (N,)


Columns = dict[str, "IntArray | FloatArray | Lists"]  # by property: (N,) or Lists


def elements_of(data: bytes, header: Header) -> dict[str, Columns]:
    """The columns of every element, by its name."""
    found: dict[str, Columns] = {}
    if header.order:
        at = header.size
        for element in header.elements:
            found[element.name], at = binary_rows(data, element, at)
        return found
    try:
        numbers = np.fromiter(map(float, data[header.size :].split()), dtype=np.float64)
    except ValueError as error:
        raise FileError(f"has text among its numbers ({shortened(str(error))}); export it again") from error
    at = 0
    for element in header.elements:
        found[element.name], at = text_rows(numbers, element, at)
    return found


def binary_rows(data: bytes, element: Element, at: int) -> tuple[Columns, int]:
    """An element's columns, and the byte after it. Rows of one length are read at once, others in turn."""
    if not any(one.count_dtype for one in element.properties):
        return even_rows(data, element, at, {})
    lengths = first_lengths(data, element, at)
    columns, end = even_rows(data, element, at, lengths) if fits(data, element, at, lengths) else ({}, 0)
    if columns and all(
        (np.asarray(columns[f"{name} count"]) == length).all() for name, length in lengths.items()
    ):
        for name, length in lengths.items():
            values = np.asarray(columns[name]).reshape(-1)
            columns[name] = Lists(values, np.full(element.count, length, dtype=np.int64))
        return columns, end
    return uneven_rows(data, element, at)


def row_dtype(element: Element, lengths: dict[str, int]) -> np.dtype[np.void]:
    """A row's layout, its lists being of these lengths."""
    fields: list[tuple[str, str] | tuple[str, str, tuple[int]]] = []
    for one in element.properties:
        if one.count_dtype:
            fields += [(f"{one.name} count", one.count_dtype), (one.name, one.dtype, (lengths[one.name],))]
        else:
            fields.append((one.name, one.dtype))
    try:
        return np.dtype(fields)
    except ValueError as error:
        raise FileError(f"element {element.name!r} has a property twice; export it again") from error


def even_rows(data: bytes, element: Element, at: int, lengths: dict[str, int]) -> tuple[Columns, int]:
    """Rows that all have the same layout."""
    layout = row_dtype(element, lengths)
    end = at + element.count * layout.itemsize
    if end > len(data):
        raise cut_short(element)
    rows = np.frombuffer(data, layout, element.count, at)
    return {name: rows[name] for name in layout.names or ()}, end


def fits(data: bytes, element: Element, at: int, lengths: dict[str, int]) -> bool:
    """Whether rows with lists of these lengths fit the bytes there are."""
    size = element.least_size
    for one in element.properties:
        if one.count_dtype:
            size += lengths[one.name] * np.dtype(one.dtype).itemsize
    return at + element.count * size <= len(data)


def first_lengths(data: bytes, element: Element, at: int) -> dict[str, int]:
    """How long the lists of the first row are."""
    lengths = {}
    for one in element.properties:
        if one.count_dtype:
            lengths[one.name] = list_length(data, one.count_dtype, at, element) if element.count else 0
            at += np.dtype(one.count_dtype).itemsize + lengths[one.name] * np.dtype(one.dtype).itemsize
        else:
            at += np.dtype(one.dtype).itemsize
    return lengths


def list_length(data: bytes, dtype: str, at: int, element: Element) -> int:
    """The length of the list that begins at a byte."""
    if at + np.dtype(dtype).itemsize > len(data):
        raise cut_short(element)
    length = np.frombuffer(data, dtype, 1, at)[0]
    if not 0 <= length <= len(data):
        raise FileError(f"element {element.name!r} has a list of {length} numbers; it is damaged")
    return int(length)


def uneven_rows(data: bytes, element: Element, at: int) -> tuple[Columns, int]:
    """Rows whose lists differ in length: walked one by one."""
    pieces: dict[str, list[bytes]] = {one.name: [] for one in element.properties}
    counts: dict[str, list[int]] = {one.name: [] for one in element.properties}
    sizes = [(one, np.dtype(one.dtype).itemsize) for one in element.properties]
    for _ in range(element.count):
        for one, size in sizes:
            length = 1
            if one.count_dtype:
                length = list_length(data, one.count_dtype, at, element)
                at += np.dtype(one.count_dtype).itemsize
            if at + length * size > len(data):
                raise cut_short(element)
            pieces[one.name].append(data[at : at + length * size])
            counts[one.name].append(length)
            at += length * size
    columns: Columns = {}
    for one, _ in sizes:
        values = np.frombuffer(b"".join(pieces[one.name]), one.dtype)
        columns[one.name] = Lists(values, np.array(counts[one.name])) if one.count_dtype else values
    return columns, at


def text_rows(numbers: FloatArray, element: Element, at: int) -> tuple[Columns, int]:
    """An element's columns from all numbers of a text file, and the place after it."""
    properties = element.properties
    if not any(one.count_dtype for one in properties):
        end = at + element.count * len(properties)
        if end > len(numbers):
            raise cut_short(element)
        table = numbers[at:end].reshape(element.count, len(properties))
        return {one.name: table[:, k] for k, one in enumerate(properties)}, end
    if len(properties) == 1 and (even := even_lists(numbers, element.count, at)) is not None:
        return {properties[0].name: even}, at + even.values.size + element.count
    places: dict[str, list[int]] = {one.name: [] for one in properties}
    counts: dict[str, list[int]] = {one.name: [] for one in properties}
    for _ in range(element.count):
        for one in properties:
            length = 1
            if one.count_dtype:
                length = int(numbers[at]) if at < len(numbers) and 0 <= numbers[at] <= len(numbers) else -1
                at += 1
            if length < 0 or at + length > len(numbers):
                raise cut_short(element)
            places[one.name].append(at)
            counts[one.name].append(length)
            at += length
    columns: Columns = {}
    for one in properties:
        many = np.array(counts[one.name], dtype=np.int64)
        within = np.arange(many.sum()) - np.repeat(np.cumsum(many) - many, many)
        values = numbers[np.repeat(np.array(places[one.name], dtype=np.int64), many) + within]
        columns[one.name] = Lists(values, many) if one.count_dtype else values
    return columns, at


def even_lists(numbers: FloatArray, count: int, at: int) -> Lists | None:
    """The lists that begin at a place, if all are as long as the first."""
    length = numbers[at] if at < len(numbers) else -1
    if not 0 <= length <= len(numbers) or at + count * (int(length) + 1) > len(numbers):
        return None
    table = numbers[at : at + count * (int(length) + 1)].reshape(count, int(length) + 1)
    if not (table[:, 0] == length).all():
        return None
    return Lists(table[:, 1:].reshape(-1), np.full(count, int(length), dtype=np.int64))


def cut_short(element: Element) -> FileError:
    """The refusal of a file that ends inside an element."""
    return FileError(
        f"ends before all {element.count:,} of {element.name!r} are there; it is cut short or damaged"
    )
