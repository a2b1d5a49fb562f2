"""What `import eyeline` gives, and what it costs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import eyeline as el

HEAVY = {"numba", "scipy", "PIL", "av", "trimesh", "rich", "typer"}


def fresh(program: str) -> str:
    """What a program prints in a new interpreter."""
    source = str(Path(el.__file__).parent.parent)
    run = [sys.executable, "-c", f"import sys; sys.path.insert(0, {source!r}); {program}"]
    return subprocess.run(run, check=True, capture_output=True, text=True, timeout=60).stdout


def test_public_names_are_those_that_exist() -> None:
    for name in el.__all__:
        assert getattr(el, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'shiny'"):
        el.shiny  # noqa: B018


def test_import_loads_nothing_heavy() -> None:
    loaded = fresh("import eyeline; print(*{name.partition('.')[0] for name in sys.modules})")
    assert set(loaded.split()) & HEAVY == set()


@pytest.mark.parametrize("first", ["eyeline.render.film", "eyeline.render.frame", "eyeline"])
def test_render_is_a_function_whatever_is_imported_first(first: str) -> None:
    assert (
        fresh(f"import {first}, eyeline; print(callable(eyeline.render), eyeline.film.__name__)")
        == "True film\n"
    )


def test_names_are_found_by_completion() -> None:
    assert set(el.__all__) <= set(dir(el))


def test_every_deformer_has_its_name() -> None:
    assert {one.__name__ for one in el.deform.DEFORMERS.values()} <= set(el.deform.__all__)
    for name in el.deform.__all__:
        assert getattr(el.deform, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'Shiny'"):
        el.deform.Shiny  # noqa: B018
