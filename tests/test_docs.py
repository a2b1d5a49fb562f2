"""What the pages say is so: their Python runs, what they cite is listed, and nothing public lacks a page."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

import eyeline as el
import house

DOCS = house.PROJECT / "docs"
PAGES = [
    house.PROJECT / "README.md",
    house.PROJECT / "CONVENTIONS.md",
    *sorted((DOCS / "guide").glob("*.md")),
    *sorted((DOCS / "methods").glob("*.md")),
]
FENCED_PYTHON = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
CITED = re.compile(r"\[([A-Z][A-Za-z]+\d\d(?:, [A-Z][A-Za-z]+\d\d)*)(?:, [^\]]*)?\]")


def programs() -> list[tuple[Path, str]]:
    """Every page with Python in it, and all its blocks as one program with the page's line numbers."""
    found = []
    for page in PAGES:
        text = page.read_text()
        lines = [""] * text.count("\n")
        for block in FENCED_PYTHON.finditer(text):
            first = text.count("\n", 0, block.start(1))
            code = block.group(1).splitlines()
            lines[first : first + len(code)] = code
        if any(lines):
            found.append((page, "\n".join(lines)))
    return found


PROGRAMS = programs()


@pytest.mark.parametrize(("page", "program"), PROGRAMS, ids=[page.stem for page, _ in PROGRAMS])
def test_python_on_a_page_runs(
    page: Path, program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(program, str(page), "exec"), {"__name__": "__main__"})


def test_every_citation_is_in_the_bibliography() -> None:
    listed = set(re.findall(r"^\*\*\[(\w+)\]\*\*", (DOCS / "bibliography.md").read_text(), re.MULTILINE))
    cited = {}
    for file in [
        *house.sources(),
        *sorted((DOCS / "methods").glob("*.md")),
        *sorted((DOCS / "decisions").glob("*.md")),
    ]:
        for keys in CITED.findall(file.read_text()):
            cited |= dict.fromkeys(keys.split(", "), file.name)
    assert {key: place for key, place in cited.items() if key not in listed} == {}


def test_the_bibliography_can_be_linked_to() -> None:
    text = (DOCS / "bibliography.md").read_text()
    keys = re.findall(r"^\*\*\[(\w+)\]\*\*", text, re.MULTILINE)
    assert keys == sorted(keys, key=str.lower)
    assert re.findall(r"^\((\w+)\)=$", text, re.MULTILINE) == [key.lower() for key in keys]


@pytest.mark.parametrize("name", el.METHODS)
def test_the_page_of_a_method_shows_it_at_work(name: str) -> None:
    assert f"](steps/{name}.svg)" in (DOCS / "methods" / f"{name}.md").read_text()


@pytest.mark.parametrize("name", el.METHODS)
def test_every_method_has_a_page_of_its_name(name: str) -> None:
    assert (DOCS / "methods" / f"{name}.md").read_text().startswith(f"# {name}: ")


@pytest.mark.parametrize("name", el.STYLES)
def test_every_style_has_a_section(name: str) -> None:
    assert re.search(rf"^## {name}$", (DOCS / "guide" / "styles.md").read_text(), re.MULTILINE)


def test_decisions_are_numbered_once() -> None:
    files = sorted((DOCS / "decisions").glob("0*.md"))
    numbers = [int(file.name[:4]) for file in files]
    assert numbers == list(range(1, len(files) + 1))
    for number, file in zip(numbers, files, strict=True):
        assert file.read_text().startswith(f"# {number}. ")


def test_every_public_name_is_described() -> None:
    silent = [
        name
        for name in el.__all__
        if name != "__version__" and not name.isupper() and not getattr(getattr(el, name), "__doc__", None)
    ]
    assert silent == []


def test_the_architecture_names_every_room() -> None:
    text = (house.PROJECT / "ARCHITECTURE.md").read_text()
    rooms = {file.parent.name for file in house.PACKAGE.glob("*/__init__.py")}
    assert {room for room in rooms if f"`{room}`" not in text} == set()


def test_the_architecture_lists_the_layers_that_are_checked() -> None:
    rows = re.findall(r"^\| (`[\w.`, ]+`) \|", (house.PROJECT / "ARCHITECTURE.md").read_text(), re.MULTILINE)
    listed = [set(re.findall(r"`(\w+)(?:\.py)?`", row)) for row in rows]
    settings = tomllib.loads((house.PROJECT / "pyproject.toml").read_text())["tool"]["importlinter"]
    layers = settings["contracts"][0]["layers"]
    assert listed == [set(re.findall(r"eyeline\.(\w+)", layer)) for layer in layers]
