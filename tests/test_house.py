"""The laws of the house that a test can hold."""

from __future__ import annotations

import ast
import re
import sys
import tomllib

import pytest

import house

LONGEST_FILE = 300  # lines
LONGEST_FUNCTION = 40  # lines of its body
# A kernel cannot be cut wherever it is long: calling a function that takes arrays costs reference counts.
LONGEST_KERNEL = 150
# Longer by measurement: with its two loops over small faces in kernels of their own, LLVM computes their
# lanes one by one, and 80,000 faces take 35 ms in place of 21.
MEASURED_KERNELS = {"trace_tiles"}
# What can be left out is not counted: the faces of the package offer much and ask for little.
MOST_PARAMETERS = 6

# What a distribution is called when it is imported.
IMPORT_NAMES = {"pillow": "PIL", "fpdf2": "fpdf", "PyYAML": "yaml"}
# Not imported by us, but needed by trimesh to read 3MF.
NEEDED_BY_OTHERS = {"networkx"}


def test_every_function_says_what_it_takes_and_gives() -> None:
    """Kernels are typed by use; all others by annotation."""
    silent = [
        function.place
        for function in house.functions()
        if not function.is_compiled
        and (function.node.returns is None or any(one.annotation is None for one in function.parameters))
    ]
    assert silent == []


def test_kernels_are_not_annotated() -> None:
    annotated = [
        function.place
        for function in house.functions()
        if function.is_compiled
        and (function.node.returns is not None or any(one.annotation for one in function.parameters))
    ]
    assert annotated == []


def test_files_are_short() -> None:
    lengths = {file: len(file.read_text().splitlines()) for file in house.sources()}
    assert {str(file): length for file, length in lengths.items() if length > LONGEST_FILE} == {}


def test_functions_are_short() -> None:
    long = {
        function.place: function.length
        for function in house.functions()
        if function.length > (LONGEST_KERNEL if function.is_compiled else LONGEST_FUNCTION)
        and function.node.name not in MEASURED_KERNELS
    }
    assert long == {}


def test_functions_ask_for_few_things() -> None:
    greedy = {
        function.place: function.required
        for function in house.functions()
        if not function.is_compiled and function.required > MOST_PARAMETERS
    }
    assert greedy == {}


def test_docstrings_open_with_a_sentence() -> None:
    unfinished = []
    for file in house.sources():
        for node in ast.walk(house.parsed(file)):
            if isinstance(node, ast.Module | ast.ClassDef | house.Definition):
                first = (ast.get_docstring(node) or "").partition("\n")[0]
                if first and not re.search(r"[.:?\])]$", first):
                    unfinished.append(
                        f"{file.relative_to(house.PROJECT)} {getattr(node, 'name', '')}: {first}"
                    )
    assert unfinished == []


def test_only_jit_imports_numba() -> None:
    importers = {file.parent for file in house.sources() if house.imported(file) & {"numba", "llvmlite"}}
    assert importers == {house.PACKAGE / "jit"}


def test_dependencies_are_what_is_imported() -> None:
    project = tomllib.loads((house.PROJECT / "pyproject.toml").read_text())["project"]
    wanted = [*project["dependencies"], *project["optional-dependencies"]["draw"]]
    declared = {re.match(r"[\w-]+", one).group() for one in wanted}  # type: ignore[union-attr]
    names = {IMPORT_NAMES.get(name, name) for name in declared - NEEDED_BY_OTHERS}
    used = {name for file in house.sources() for name in house.imported(file)}
    assert used - sys.stdlib_module_names - {"eyeline"} == names


def test_every_pin_is_a_name_and_a_version() -> None:
    lines = (house.PROJECT / "constraints.txt").read_text().splitlines()
    pins = [line for line in lines if not line.startswith("#")]
    assert [pin for pin in pins if not re.fullmatch(r"[\w.-]+==[\w.]+", pin)] == []
    pinned = {pin.partition("==")[0].lower() for pin in pins}
    project = tomllib.loads((house.PROJECT / "pyproject.toml").read_text())["project"]
    wanted = [
        *project["dependencies"],
        *(one for extra in project["optional-dependencies"].values() for one in extra),
    ]
    assert {re.match(r"[\w-]+", one).group().lower() for one in wanted} <= pinned  # type: ignore[union-attr]


def test_public_names_exist() -> None:
    import eyeline

    assert len(eyeline.__all__) == len(set(eyeline.__all__))
    assert [name for name in eyeline.__all__ if not hasattr(eyeline, name)] == []


@pytest.mark.parametrize("name", ["utils", "util", "helpers", "manager", "misc", "common"])
def test_no_file_is_named_after_nothing(name: str) -> None:
    assert [file for file in house.sources() if file.stem == name or file.parent.name == name] == []


def test_nothing_is_unfinished() -> None:
    marks = re.compile(r"\b(TO" r"DO|FIX" r"ME|X" r"XX)\b|raise NotImplemented")
    assert [str(file) for file in house.sources() if marks.search(file.read_text())] == []


def test_no_machine_and_no_registry_is_named() -> None:
    """What works only here does not belong in the project."""
    hosts = re.compile(
        r"python" r"hosted|registry\.npm" r"js|deb\.debian" r"\.org|(^|[^.\w])/(wo" r"rk|far" r"m)/"
    )
    found = {}
    for file in house.tracked():
        for number, line in enumerate(file.read_text(errors="replace").splitlines(), 1):
            if hosts.search(line):
                found[f"{file.relative_to(house.PROJECT)}:{number}"] = line[:120]
    assert found == {}


def test_the_changelog_tells_what_is_not_released() -> None:
    assert "\n## [Unreleased]\n" in (house.PROJECT / "CHANGELOG.md").read_text()
