"""Scan line: row by row, active edges sorted by column, and between them spans in which one face is nearest.

[Wylie67, Bouknight70, Watkins70], compared with all others of their time in [Survey74].
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.memory import recycled
from eyeline.projection.projected import Projected
from eyeline.visibility.method import Step, counted
from eyeline.visibility.scanline.edge_table import edge_table
from eyeline.visibility.scanline.row_spans import Stretch, spans_of_row
from eyeline.visibility.scanline.segments import Edge, Segment, edges_of, segments_of
from eyeline.visibility.scanline.spans import Scanned
from eyeline.visibility.scanline.sweep import scan

WORK = (
    "faces",
    "faces turned away",
    "faces beside pixels",
    "edges",
    "most edges active",
    "spans",
    "depth comparisons",
)  # what is counted; edges are those that cross the centres of a row


@dataclass(frozen=True)
class ScanLine:
    """Scan line: answers every scene, a row at a time, and compares faces where they begin, not at pixels."""

    name: str = "scanline"
    space: str = "image"
    answers: bool = True
    exact: bool = True

    def __call__(self, projected: Projected) -> Scanned:
        """The nearest face at every pixel, found span by span."""
        face = recycled((projected.height, projected.width), np.int32)
        depth = recycled((projected.height, projected.width), np.float32)
        table = edge_table(projected)
        counts = scan(projected, table, face, depth)
        numbers = (len(projected.faces), table.turned, table.beside, table.edges, *counts.tolist())
        return Scanned(face, depth, projected, self, dict(zip(WORK, numbers, strict=True)))

    def steps(self, projected: Projected) -> Iterator[Step]:
        """Row by row: edges come and go, spans form; the last step holds the picture."""
        face = np.full((projected.height, projected.width), -1, dtype=np.int32)
        depth = np.zeros(face.shape, dtype=np.float32)
        work = dict.fromkeys(WORK, 0)
        table: defaultdict[int, list[Edge]] = defaultdict(list)
        for step, edges in tabled(projected, work):
            for edge in edges:
                table[edge.top].append(edge)
            yield step
        active: list[Edge] = []
        for y in range(projected.height):
            gone, come = [edge for edge in active if edge.end == y], table[y]
            active = sorted([edge for edge in active if edge.end > y] + come, key=lambda edge: edge.place(y))
            work["most edges active"] = max(work["most edges active"], len(active))
            if gone or come:
                yield changed(y, active, come, gone, work)
            for span in spans_of_row(segments_of(active, projected, y), projected.width):
                work["depth comparisons"] += span.comparisons
                for x in range(span.first, span.last + 1):
                    # Depth 0 is as far as the back, which is nothing
                    if span.front and span.front.depth(x) > 0:
                        face[y, x], depth[y, x] = span.front.source, span.front.depth(x)
                if span.front:
                    yield formed(y, span, span.front, work)
            work["spans"] += 1 + int((face[y, 1:] != face[y, :-1]).sum())
        yield Step("done", "every row was scanned", {"face": face, "depth": depth}, dict(work))


def tabled(projected: Projected, work: dict[str, int]) -> Iterator[tuple[Step, list[Edge]]]:
    """Every face's edges that cross rows of the picture; none of a face that is dropped."""
    for number, source in enumerate(projected.source.tolist()):
        work["faces"] += 1
        edges = edges_of(projected, number)
        if edges is None:
            work["faces turned away"] += 1
            yield Step("dropped", f"face {source} turns away", {"face": source}, dict(work)), []
        elif not edges:
            work["faces beside pixels"] += 1
            yield Step("dropped", f"face {source} lies beside every pixel", {"face": source}, dict(work)), []
        else:
            work["edges"] += len(edges)
            rows = " and ".join(map(str, sorted({edge.top for edge in edges})))
            sentence = f"face {source} has {counted(len(edges), 'edge')} in the table, from row {rows} on"
            data = {"face": source, "segments": np.array([edge.ends for edge in edges])}
            yield Step("tabled", sentence, data, dict(work)), edges


def changed(y: int, active: list[Edge], come: list[Edge], gone: list[Edge], work: dict[str, int]) -> Step:
    """Edges have come into the active edge table at a row, or left it."""
    sentence = f"row {y}: {counted(len(come), 'edge')} in, {len(gone)} out; {len(active)} active"
    data = {
        "segments": np.array([edge.ends for edge in active]).reshape(-1, 2, 2),
        "faces": sorted({edge.source for edge in come}),
        "columns": [edge.column(y) for edge in active],
    }
    return Step("edges", sentence, data, dict(work))


def formed(y: int, span: Stretch, front: Segment, work: dict[str, int]) -> Step:
    """A face is in front over a span, however many others are there."""
    rivals = sorted({rival.source for rival in span.rivals})
    others = f"face{'s' if len(rivals) > 1 else ''} {', '.join(map(str, rivals))}"
    columns = f"columns {span.first} to {span.last}" if span.last > span.first else f"column {span.first}"
    sentence = f"row {y}, {columns}: face {front.source} is in front"
    if span.overtakes is not None:
        sentence += f"; here it comes through face {span.overtakes.source}"
    elif span.coherent:
        sentence += f" still, of {others} too" if rivals else " still"
    elif rivals:
        sentence += f" of {others}"
    data = {
        "face": front.source,
        "faces": rivals,
        "rectangle": (span.first, y, span.last + 1, y + 1),
        "pixels": [(x, y) for x in range(span.first, span.last + 1) if front.depth(x) > 0],
        "verdict": "split" if span.overtakes is not None else "kept",
    }
    return Step("pierced" if span.overtakes is not None else "span", sentence, data, dict(work))
