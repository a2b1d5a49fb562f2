"""Every deformer: exact slopes, upright normals, and the same bytes however the work is cut."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from eyeline.deform import run
from eyeline.deform.bend import Bend
from eyeline.deform.composite import Composite, Mixture
from eyeline.deform.deformer import Deformer
from eyeline.deform.inflate import Inflate
from eyeline.deform.lattice import Lattice
from eyeline.deform.rigid import Reflection, Rotation, Translation
from eyeline.deform.shear import Shear
from eyeline.deform.spherify import Spherify
from eyeline.deform.stretch import Stretch
from eyeline.deform.table import DEFORMERS
from eyeline.deform.taper import Taper
from eyeline.deform.twist import Twist
from eyeline.deform.wave import Wave
from eyeline.errors import GeometryError

RNG = np.random.default_rng(0)
POINTS = RNG.uniform(-1, 1, (700, 3))
ACROSS = RNG.normal(size=(700, 3))
NORMALS = np.cross(ACROSS, RNG.normal(size=(700, 3)))
NORMALS /= np.linalg.norm(NORMALS, axis=1, keepdims=True)
ALONG = np.cross(NORMALS, ACROSS)
TANGENTS = np.concatenate([ALONG / np.linalg.norm(ALONG, axis=1, keepdims=True), np.ones((700, 1))], axis=1)
PLACE = {"origin": (0.1, -0.2, 0.3), "axis": (1.0, 2.0, -0.5)}

AT_WORK: dict[str, Deformer] = {
    "translation": Translation((1.0, -2.0, 0.5), **PLACE),
    "rotation": Rotation(2.0, **PLACE),
    "reflection": Reflection(**PLACE),
    "shear": Shear(0.4, -0.8, **PLACE),
    "taper": Taper(0.6, lower=-0.5, upper=0.6, **PLACE),
    "twist": Twist(1.3, lower=-0.5, upper=0.6, **PLACE),
    "bend": Bend(1.1, towards=0.4, lower=-0.5, upper=0.6, **PLACE),
    "stretch": Stretch(0.6, waist=0.2, lower=-0.5, upper=0.6, **PLACE),
    "inflate": Inflate(0.5, 0.9, **PLACE),
    "spherify": Spherify(0.7, 0.8, **PLACE),
    "wave": Wave(0.2, 0.9, 1.0, towards=0.3, **PLACE),
    "lattice": Lattice(RNG.normal(size=(4, 3, 5, 3)) / 8, fade=0.4, **PLACE),
    "lattice of splines": Lattice(RNG.normal(size=(4, 2, 6, 3)) / 8, basis="bspline", fade=0.9, **PLACE),
    "reaching": Bend(1.1, reach=0.8, **PLACE),
    "composite": Composite((Twist(1.0), Bend(0.7, lower=-1.0, **PLACE)), weight=0.6),
    "mixture": Mixture((Twist(1.0), Bend(0.7, lower=-1.0, **PLACE))),
}
AT_REST: dict[str, Deformer] = {
    name: one(**PLACE) for name, one in DEFORMERS.items() if name != "reflection"
} | {"reflection": Composite((Reflection(name="there"), Reflection(name="back")))}

every_deformer = pytest.mark.parametrize("name", AT_WORK)


def test_every_deformer_is_tried() -> None:
    assert {one.kind for one in AT_WORK.values()} == set(DEFORMERS)


@pytest.mark.parametrize("name", AT_REST)
def test_at_rest_it_changes_nothing(name: str) -> None:
    points, normals, tangents = AT_REST[name](POINTS, NORMALS, TANGENTS)
    for found, given in ((points, POINTS), (normals, NORMALS), (tangents, TANGENTS)):
        assert np.abs(found - given).max() <= 1e-15


@every_deformer
def test_without_weight_it_gives_back_what_it_got(name: str) -> None:
    points, normals, tangents = replace(AT_WORK[name], weight=0.0)(POINTS, NORMALS, TANGENTS)
    assert points is POINTS and normals is NORMALS and tangents is TANGENTS


@every_deformer
def test_weight_leads_straight_from_one_to_the_other(name: str) -> None:
    deformer = AT_WORK[name]
    whole, _, _ = replace(deformer, weight=1.0)(POINTS)
    for weight in (0.25, 0.5, 1.2):
        part, _, _ = replace(deformer, weight=weight)(POINTS)
        assert np.abs(part - (POINTS + weight * (whole - POINTS))).max() <= 1e-14


@every_deformer
def test_a_mask_is_a_weight_for_each_vertex(name: str) -> None:
    weights = np.linspace(0, 1, len(POINTS))
    masked, _, _ = replace(AT_WORK[name], mask=weights)(POINTS)
    whole, _, _ = AT_WORK[name](POINTS)
    assert np.abs(masked - (POINTS + weights[:, None] * (whole - POINTS))).max() <= 1e-14


@every_deformer
def test_the_jacobian_is_what_differences_measure(name: str) -> None:
    deformer, step = AT_WORK[name], 1e-5
    measured = np.stack(
        [
            (deformer(POINTS + step * unit)[0] - deformer(POINTS - step * unit)[0]) / (2 * step)
            for unit in np.eye(3)
        ],
        axis=2,
    )
    wrong = np.abs(deformer.jacobians(POINTS) - measured).max(axis=(1, 2))
    # A difference across a limit tells the mean of two slopes: there, and only there, it differs
    assert (wrong > 1e-7).sum() <= 2


@every_deformer
def test_normals_stand_upright_on_what_was_moved(name: str) -> None:
    deformer = AT_WORK[name]
    _, normals, tangents = deformer(POINTS, NORMALS, TANGENTS)
    jacobians = deformer.jacobians(POINTS)
    one = np.einsum("vij,vj->vi", jacobians, TANGENTS[:, :3])
    other = np.einsum("vij,vj->vi", jacobians, np.cross(NORMALS, TANGENTS[:, :3]))
    upright = np.cross(one, other)
    upright /= np.linalg.norm(upright, axis=1, keepdims=True) * (-1 if deformer.mirrors else 1)
    assert np.abs(np.linalg.norm(normals, axis=1) - 1).max() <= 1e-14
    assert np.abs(normals - upright).max() <= 1e-12
    assert np.abs(tangents[:, :3] - one / np.linalg.norm(one, axis=1, keepdims=True)).max() <= 1e-12
    assert np.array_equal(tangents[:, 3], -TANGENTS[:, 3] if deformer.mirrors else TANGENTS[:, 3])


@every_deformer
def test_alone_a_vertex_goes_where_it_goes_among_others(name: str) -> None:
    deformer, together = AT_WORK[name], AT_WORK[name](POINTS, NORMALS, TANGENTS)
    for part in (slice(0, 1), slice(3, 260), slice(256, 700)):
        alone = deformer(POINTS[part], NORMALS[part], TANGENTS[part])
        assert [one.tobytes() for one in alone] == [one[part].tobytes() for one in together]


@every_deformer
def test_threads_do_not_change_a_byte(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    points, normals = (np.tile(one, (20, 1)).astype(np.float32) for one in (POINTS, NORMALS))
    answers = []
    for count in (1, 2, 3):
        monkeypatch.setattr(run, "threads", lambda count=count: count)
        answers.append([one.tobytes() for one in AT_WORK[name](points, normals)[:2]])
    assert answers[0] == answers[1] == answers[2]


@every_deformer
def test_floats_of_either_width_go_the_same_way(name: str) -> None:
    single, _, _ = AT_WORK[name](POINTS.astype(np.float32))
    double, _, _ = AT_WORK[name](POINTS.astype(np.float32).astype(float))
    assert single.dtype == np.float32
    assert np.array_equal(single, double.astype(np.float32))


@every_deformer
@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"weight": np.nan}, "weight is nan; every number must be finite"),
        ({"origin": (0.0, np.inf, 0.0)}, "origin is [0.0, inf, 0.0]"),
        ({"axis": (0.0, 0.0, 0.0)}, "which has no direction"),
        ({"mask": np.ones(3)}, "made for 3 vertices; there are 700"),
    ],
)
def test_what_makes_no_sense_is_refused(name: str, change: dict[str, object], sentence: str) -> None:
    with pytest.raises(GeometryError) as refusal:
        replace(AT_WORK[name], **change)(POINTS)  # type: ignore[arg-type]
    assert sentence in str(refusal.value)


@every_deformer
def test_every_parameter_can_be_changed(name: str) -> None:
    deformer = AT_WORK[name]
    same = deformer.changed(deformer.parameters)
    assert np.array_equal(same(POINTS)[0], deformer(POINTS)[0])
    with pytest.raises(GeometryError, match=r"has no 'wight'; it has .*weight"):
        deformer.changed({"wight": 1.0})
