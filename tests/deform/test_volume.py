"""What deformers do to volumes: the integral of their growth is the growth of a body."""

import numpy as np
import pytest

from eyeline.deform.bend import Bend
from eyeline.deform.composite import Composite
from eyeline.deform.deformer import Deformer
from eyeline.deform.inflate import Inflate
from eyeline.deform.shear import Shear
from eyeline.deform.spherify import Spherify
from eyeline.deform.stretch import Stretch
from eyeline.deform.taper import Taper
from eyeline.deform.twist import Twist
from eyeline.deform.wave import Wave
from eyeline.geometry.volume import volume

SIDE = 48  # cells along an edge of the box


def box() -> tuple[np.ndarray, np.ndarray]:
    """A closed box, x and z in -0.3 to 0.3, y in 0 to 1, its sides in cells; faces outward."""
    line = np.linspace(0, 1, SIDE + 1)
    u, v = (one.reshape(-1) for one in np.meshgrid(line, line, indexing="ij"))
    a = (np.arange(SIDE)[:, None] * (SIDE + 1) + np.arange(SIDE)).reshape(-1)
    cells = np.concatenate(
        [np.stack([a, a + SIDE + 1, a + 1], 1), np.stack([a + 1, a + SIDE + 1, a + SIDE + 2], 1)]
    )
    points, faces = [], []
    for axis in range(3):
        for end in (0.0, 1.0):
            side = np.empty((len(u), 3))
            side[:, axis], side[:, (axis + 1) % 3], side[:, (axis + 2) % 3] = end, u, v
            faces.append((cells if end else cells[:, ::-1]) + len(points) * len(u))
            points.append(side)
    return (np.concatenate(points) - (0.5, 0, 0.5)) * (0.6, 1, 0.6), np.concatenate(faces)


def inside() -> np.ndarray:
    """Points evenly in the box: middles of cells."""
    line = (np.arange(40) + 0.5) / 40
    grid = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    return (grid - (0.5, 0, 0.5)) * (0.6, 1, 0.6)


KEEPING: list[Deformer] = [
    Twist(1.5), Shear(0.3, 0.4), Wave(0.1, 0.7, axis=(1.0, 0.0, 0.0)), Stretch(0.8), Stretch(-0.6),
]  # fmt: skip
OTHERS: list[Deformer] = [
    Taper(-0.7), Bend(1.2), Stretch(0.4, volume=0.5, waist=0.3), Inflate(0.6, 1.2, origin=(0.0, 0.5, 0.0)),
    Spherify(0.5, 0.4, origin=(0.1, -0.3, 0.0)),
    Composite((Taper(0.4), Twist(1.0), Bend(0.8, weight=0.7), Inflate(0.3, reach=0.9))),
]  # fmt: skip


@pytest.mark.parametrize("deformer", KEEPING + OTHERS, ids=lambda one: one.kind)
def test_a_body_grows_by_the_integral_of_the_growth(deformer: Deformer) -> None:
    points, faces = box()
    grown = volume(deformer(points)[0], faces) / volume(points, faces)
    assert abs(grown - deformer.growth(inside()).mean()) <= 1e-3


@pytest.mark.parametrize("deformer", KEEPING, ids=lambda one: one.kind)
def test_what_keeps_volumes_keeps_them_everywhere(deformer: Deformer) -> None:
    assert np.allclose(deformer.growth(inside()), 1, rtol=0, atol=1e-12)


def test_growth_has_its_closed_form() -> None:
    points = inside()
    x, y, z = points.T
    assert np.allclose(Taper(-0.7).growth(points), (1 - 0.7 * y) ** 2, rtol=1e-12)
    assert np.allclose(Bend(1.2).growth(points), 1 - 1.2 * x, rtol=1e-12)
    g = 0.5 + 0.5 * 0.4 / np.sqrt(x * x + y * y + z * z)
    assert np.allclose(Spherify(0.5, 0.4).growth(points), g * g * 0.5, rtol=1e-12)


def test_a_bent_axis_keeps_its_length() -> None:
    axis = np.zeros((2001, 3))
    axis[:, 1] = np.linspace(-0.5, 1.5, 2001)
    arc, _, _ = Bend(2.0)(axis)
    lengths = np.linalg.norm(np.diff(arc, axis=0), axis=1)
    assert np.allclose(lengths, 0.001, rtol=1e-6)
    radius = np.linalg.norm(arc[500:1501] - (0.5, 0, 0), axis=1)
    assert np.allclose(radius, 0.5, rtol=1e-12)


def test_no_faces_enclose_nothing() -> None:
    assert volume(np.zeros((3, 3)), np.zeros((0, 3), int)) == 0
