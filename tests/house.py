"""The project as text: its files, and its functions as the parser sees them."""

from __future__ import annotations

import ast
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
PACKAGE = PROJECT / "src" / "eyeline"
FOLDERS = ("src", "tests", "docs", "examples", "benchmarks")

Definition = ast.FunctionDef | ast.AsyncFunctionDef
COMPILED = {"kernel", "helper"}


@dataclass(frozen=True)
class Function:
    """A function or method where it is defined."""

    file: Path
    node: Definition

    @property
    def place(self) -> str:
        """What an editor opens."""
        return f"{self.file.relative_to(PROJECT)}:{self.node.lineno} {self.node.name}"

    @property
    def is_compiled(self) -> bool:
        """Whether it is a kernel, or a helper of kernels."""
        return any(isinstance(mark, ast.Name) and mark.id in COMPILED for mark in self.node.decorator_list)

    @property
    def length(self) -> int:
        """Lines of its body, docstring not counted."""
        told = ast.get_docstring(self.node) is not None
        begin = self.node.body[0].end_lineno if told else self.node.body[0].lineno - 1
        return (self.node.end_lineno or 0) - (begin or 0)

    @property
    def parameters(self) -> list[ast.arg]:
        """Its parameters; self and cls are none."""
        arguments = self.node.args
        rest = [one for one in (arguments.vararg, arguments.kwarg) if one is not None]
        named = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, *rest]
        return [one for one in named if one.arg not in ("self", "cls")]

    @property
    def required(self) -> int:
        """How many parameters a caller must give."""
        arguments = self.node.args
        positional = [
            one for one in (*arguments.posonlyargs, *arguments.args) if one.arg not in ("self", "cls")
        ]
        return len(positional) - len(arguments.defaults) + arguments.kw_defaults.count(None)


@cache
def sources() -> tuple[Path, ...]:
    """Every Python file of the package."""
    return tuple(sorted(PACKAGE.rglob("*.py")))


@cache
def parsed(file: Path) -> ast.Module:
    """A file as the parser sees it."""
    return ast.parse(file.read_text(), str(file))


def functions() -> Iterator[Function]:
    """Every function and method of the package."""
    for file in sources():
        for node in ast.walk(parsed(file)):
            if isinstance(node, Definition):
                yield Function(file, node)


def imported(file: Path) -> set[str]:
    """The names of modules outside the package that a file imports, first part only."""
    names = set()
    for node in ast.walk(parsed(file)):
        if isinstance(node, ast.Import):
            names |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names.add(node.module.partition(".")[0])
    return names


def tracked() -> list[Path]:
    """Every text file under version control; in a copy without it, every one of our folders."""
    if (PROJECT / ".git").exists():
        git = subprocess.run(
            ["git", "ls-files", "-z"], cwd=PROJECT, capture_output=True, check=True, text=True
        )
        files = [PROJECT / name for name in git.stdout.split("\0") if name]
    else:
        files = [file for folder in FOLDERS for file in PROJECT.joinpath(folder).rglob("*")]
    return [file for file in files if file.is_file() and b"\0" not in file.read_bytes()[:4096]]
