"""Writes what was measured into the README, between its markers: `python -m benchmarks.table`."""

from __future__ import annotations

from pathlib import Path

from benchmarks import results

README = Path(__file__).resolve().parent.parent / "README.md"
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"
ORDER = (
    "zbuffer", "methods", "octree", "raycast", "shading", "drawing", "film", "first_png", "skinning",
)  # fmt: skip
ELSEWHERE = {"growth"}  # stands with the methods' pages


def main() -> None:
    text = README.read_text()
    head, rest = text.split(BEGIN)
    tail = rest.split(END)[1]
    README.write_text(f"{head}{BEGIN}\n{table()}\n{END}{tail}")


def table() -> str:
    """The rows of every program as a Markdown table, and the machine in a sentence."""
    rows = results.load()
    names = [name for name in ORDER if name in rows] + [
        name for name in rows if name not in (*ORDER, *ELSEWHERE)
    ]
    lines = ["| what | eyeline | peer | eyeline / peer | bar |", "|---|--:|--:|--:|--:|"]
    for row in (row for name in names for row in rows[name]):
        peer = "" if row.theirs is None else f"{figure(row.theirs)} {row.unit}, {row.against}"
        lines.append(
            f"| {row.what} | {figure(row.ours)} {row.unit} | {peer} | {results.ratio(row)} | {row.bar} |"
        )
    machine = results.machine()
    lines += [
        "",
        f"Measured by `make bench`, rivals in turn in one run, medians: {machine['processor']},"
        f" {machine['cores']} cores, of which two spinning threads got {machine['free_cores']};"
        f" Python {machine['python']}, numpy {machine['numpy']}, numba {machine['numba']}.",
    ]
    return "\n".join(lines)


def figure(number: float) -> str:
    """Three digits of it, or all before the point."""
    return f"{number:,.0f}" if number >= 100 else f"{number:.3g}"


if __name__ == "__main__":
    main()
