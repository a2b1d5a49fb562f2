"""A comparison as one web page that needs nothing beside it."""

from __future__ import annotations

import base64
import html
import io
from collections.abc import Iterator

import PIL.Image

from eyeline.comparison.cells import HEADINGS, Row, judge_line, rows_of
from eyeline.comparison.comparison import Comparison
from eyeline.comparison.plot import plot
from eyeline.comparison.thumbnails import answer_picture, colours_of, map_of

STYLE = """
.eyeline { font: 15px/1.45 system-ui, sans-serif; color: #22252b; background: #f7f5f0; padding: 1.4rem; }
.eyeline h1 { font-size: 1.3rem; margin: 0; }
.eyeline p { color: #6c717b; margin: .2rem 0 1rem; }
.eyeline table { border-collapse: separate; border-spacing: 0 .6rem; width: 100%; }
.eyeline th { text-align: left; font-weight: 400; color: #6c717b; padding: 0 .7rem; }
.eyeline td { background: #fff; padding: .5rem .7rem; vertical-align: top; }
.eyeline td { font-variant-numeric: tabular-nums; }
.eyeline td div { white-space: nowrap; }
.eyeline td div + div, .eyeline td.work { color: #6c717b; font-size: .88em; }
.eyeline td.said div { white-space: normal; min-width: 12em; max-width: 22em; }
.eyeline td.work { columns: 2; column-gap: 1.2em; }
.eyeline td.work div { font-size: 1em; break-inside: avoid; }
.eyeline .good { color: #1f8a4c; } .eyeline .bad { color: #c2342b; }
.eyeline img { display: block; max-width: 100%; }
.eyeline td img { width: 150px; max-width: none; }
.eyeline .plots { display: flex; flex-wrap: wrap; gap: 1rem; }
"""


def page(comparison: Comparison) -> str:
    """The whole page."""
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta http-equiv="Content-Security-Policy"'
        " content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\">"
        f"<title>{html.escape(comparison.title)}</title><style>body {{ margin: 0; }}</style></head>"
        f"<body>{body(comparison)}</body></html>\n"
    )


def body(comparison: Comparison) -> str:
    """What stands on the page, for notebooks too."""
    colours = colours_of(comparison)
    headings = "".join(f"<th>{name}</th>" for name in ("what it sees", "where it differs", *HEADINGS))
    lines = []
    for row, trial in zip(rows_of(comparison), comparison.trials, strict=True):
        pictures = (answer_picture(comparison, trial, colours), map_of(comparison, trial))
        lines.append(f"<tr>{''.join(cells(row, pictures))}</tr>")
    plots = "".join(picture(plot(ladder), f"time over {ladder.unit}") for ladder in comparison.ladders)
    return (
        f'<style>{STYLE}</style><div class="eyeline"><h1>{html.escape(comparison.title)}</h1>'
        f"<p>{html.escape(judge_line(comparison))}</p>"
        f"<table><thead><tr>{headings}</tr></thead><tbody>{''.join(lines)}</tbody></table>"
        f'<div class="plots">{plots}</div></div>'
    )


def cells(row: Row, pictures: tuple[PIL.Image.Image | None, PIL.Image.Image | None]) -> Iterator[str]:
    """The cells of one method."""
    for shown, told in zip(pictures, (f"what {row.method} sees", f"where {row.method} differs"), strict=True):
        yield f"<td>{picture(shown, told) if shown is not None else ''}</td>"
    verdict = {None: "said", True: "said good", False: "said bad"}[row.agrees]
    groups = (
        ((row.method, row.space), ""), (row.time, ""), ((row.first,), ""), ((row.memory,), ""),
        (row.agreement, verdict), (row.work, "work"),
    )  # fmt: skip
    for words, look in groups:
        inside = "".join(f"<div>{html.escape(line)}</div>" for line in words)
        yield f'<td class="{look}">{inside}</td>' if look else f"<td>{inside}</td>"


def picture(image: PIL.Image.Image, told: str) -> str:
    """A picture inside the page."""
    memory = io.BytesIO()
    image.save(memory, "PNG", optimize=True)
    source = base64.b64encode(memory.getvalue()).decode()
    return f'<img alt="{html.escape(told)}" src="data:image/png;base64,{source}">'
