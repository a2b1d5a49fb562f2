"""Docstrings are plain text; here they become reStructuredText, and comments on fields become a list.

A paragraph stays a paragraph, an indented one becomes code, `name` becomes code, [Shoemake85] a link to the
bibliography. Whatever else reStructuredText would take for markup is text.
"""

from __future__ import annotations

import ast
import inspect
import io
import re
import textwrap
import tokenize
from collections.abc import Iterator
from dataclasses import is_dataclass
from typing import Any

from sphinx.application import Sphinx

KEY = re.compile(r"[A-Z][A-Za-z]+\d\d")
CITATION = re.compile(rf"\[({KEY.pattern})([^\]]*)\]")


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("autodoc-process-docstring", plain)
    return {"parallel_read_safe": True}


def plain(app: Sphinx, kind: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Rewrite a docstring in place."""
    text = textwrap.dedent("\n".join(lines)).strip("\n")
    if text.startswith(f"{getattr(thing, '__name__', '')}(") and is_dataclass(thing):
        text = ""  # dataclasses write their signature where nobody wrote a docstring
    lines[:] = plain_text(text).splitlines()
    if kind == "class" and is_dataclass(thing):
        lines += ["", *listed(thing)]
    lines.append("")


def plain_text(text: str) -> str:
    """A docstring as reStructuredText."""
    return "\n\n".join(paragraph(part) for part in re.split(r"\n\s*\n", text))


def paragraph(text: str) -> str:
    """A paragraph of plain text as reStructuredText."""
    if all(line.startswith("    ") for line in text.splitlines()):
        return f"::\n\n{textwrap.indent(textwrap.dedent(text), '    ')}"
    return escaped(" ".join(line.strip() for line in text.splitlines()))


def escaped(text: str) -> str:
    """Text in which only code and citations are markup."""
    code_and_text = re.split(r"`+([^`]+)`+", text)
    for index, part in enumerate(code_and_text):
        if index % 2:
            code_and_text[index] = f"\\ ``{part}``\\ "
        else:
            quiet = re.sub(r"([\\*|_])", r"\\\1", part)
            code_and_text[index] = CITATION.sub(cited, quiet)
    return "".join(code_and_text)


def cited(match: re.Match[str]) -> str:
    """A citation, each of its keys a link."""
    return KEY.sub(lambda key: f"\\ :ref:`{key.group()} <{key.group().lower()}>`\\ ", match.group())


def listed(thing: type) -> Iterator[str]:
    """The fields of a dataclass with the comments that stand beside them."""
    for name, annotation, default, comment in fields(thing):
        value = f" = {default}" if default is not None else ""
        yield f"* ``{name}: {annotation}{value}`` {escaped(comment)}".rstrip()


def fields(thing: type) -> Iterator[tuple[str, str, str | None, str]]:
    """Name, annotation, default and comment of every field, as written."""
    source = textwrap.dedent(inspect.getsource(thing))
    comments = {
        token.start[0]: token.string.lstrip("# ")
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type == tokenize.COMMENT
    }
    body = ast.parse(source).body[0]
    assert isinstance(body, ast.ClassDef)
    for node in body.body:
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.target.id[0] != "_":
            default = ast.unparse(node.value) if node.value is not None else None
            comment = comments.get(node.end_lineno or 0, "")
            yield (
                node.target.id,
                ast.unparse(node.annotation),
                default,
                re.sub(r"type: ignore\S*\s*#?\s*", "", comment),
            )
