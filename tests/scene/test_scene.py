"""A scene as a whole."""

from __future__ import annotations

import eyeline as el


def test_a_scene_is_shown_in_a_line() -> None:
    assert repr(el.samples.teapot()) == "Scene('teapot', nodes=2, meshes=2, clips=0)"
    assert len(repr(el.film(el.samples.desk_lamp(), size=(32, 18)))) < 1000
