"""The reference page: every public name, and what the public functions answer."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from typing import Any

from sphinx.util.inspect import stringify_signature

import eyeline
from extensions.docstrings import plain_text
from eyeline.render.frame import render
from eyeline.samples import SAMPLES

ANSWERS = ("eyeline.visibility.Visible", "eyeline.visibility.Area", "eyeline.shading.look.Look")


def public_names(_: str) -> str:
    """Markdown that describes everything in `eyeline.__all__`."""
    public = {name: getattr(eyeline, name) for name in eyeline.__all__} | {"render": render}
    functions = {name: thing for name, thing in public.items() if inspect.isfunction(thing)}
    classes = [f"eyeline.{name}" for name, thing in public.items() if inspect.isclass(thing)]
    return "\n\n".join(
        [
            "## Functions",
            *(described(f"eyeline.{name}", function) for name, function in functions.items()),
            "## Tables",
            "`el.METHODS`, `el.STYLES` and `el.EASINGS` are what `method=`, `style=` and `ease=` can name:"
            " see [methods](/methods/index.md), [styles](/guide/styles.md) and [easings](/guide/keys.md).",
            "## Classes",
            *(section(name, f"autoclass:: {name}") for name in classes),
            "## What functions take and answer",
            *(section(name, f"autoclass:: {name}") for name in ANSWERS),
            "## Samples",
            eyeline.samples.__doc__ or "",
            *(described(f"eyeline.samples.{name}", make) for name, make in SAMPLES.items()),
            "## Errors",
            embedded("automodule:: eyeline.errors", ":members:"),
        ]
    )


def described(name: str, function: Callable[..., Any]) -> str:
    """A function under the name by which it is called, wherever it is defined."""
    signature = stringify_signature(inspect.signature(function), unqualified_typehints=True)
    unquoted = re.sub(r"(: |-> )'([^']*)'", r"\1\2", signature)
    text = plain_text(inspect.getdoc(function) or "")
    return section(name, f"function:: {name}{unquoted}", "", *text.splitlines())


def section(name: str, directive: str, *body: str) -> str:
    """A heading and what stands under it."""
    return f"### {name.rpartition('.')[2]}\n\n{embedded(directive, *(body or [':members:']))}"


def embedded(directive: str, *body: str) -> str:
    """reStructuredText inside Markdown."""
    return "\n".join(["```{eval-rst}", f".. {directive}", *(f"   {line}".rstrip() for line in body), "```"])
