"""Writes what was measured into the README and the page on speed: `python -m benchmarks.table`."""

from __future__ import annotations

from pathlib import Path

from benchmarks import results

PROJECT = Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"
FRONT = ("zbuffer", "shading", "film", "first_png", "skinning")  # what the front page shows
ORDER = ("zbuffer", "methods", "octree", "raycast", "shading", "drawing", "film", "first_png", "skinning")
ELSEWHERE = {"growth"}  # stands with the methods' pages


def main() -> None:
    rows = results.load()
    every = [name for name in ORDER if name in rows]
    every += [name for name in rows if name not in (*ORDER, *ELSEWHERE)]
    write(PROJECT / "README.md", [name for name in FRONT if name in rows])
    write(PROJECT / "docs" / "guide" / "speed.md", every)


def write(page: Path, names: list[str]) -> None:
    """Put the rows of some programs between a page's markers."""
    head, rest = page.read_text().split(BEGIN)
    tail = rest.split(END)[1]
    page.write_text(f"{head}{BEGIN}\n{table(names)}\n{END}{tail}")


def table(names: list[str]) -> str:
    """The rows of programs as a Markdown table, and the machine in a sentence."""
    rows = results.load()
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
