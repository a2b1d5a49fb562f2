import numpy as np
import pytest

from eyeline.deform.composite import Composite
from eyeline.deform.twist import Twist
from eyeline.errors import SceneError
from eyeline.motion import Clip, Curve, Track
from eyeline.samples.solids import cube
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene


@pytest.mark.parametrize(
    ("kind", "what", "width", "rotation", "sentence"),
    [
        ("node", "translaton", 3, False, "no property 'translaton' that moves; there is 'translation'"),
        ("node", "mesh", 3, False, "no property 'mesh'"),
        ("material", "translation", 3, False, "no property 'translation'"),
        ("material", "double_sided", 1, False, "no property 'double_sided'"),
        ("light", "color", 3, False, "a node, a material or a constraint, not a 'light'"),
        ("node", "translation", 4, False, "(4,); (3,) is needed"),
        ("node", "light.intensity", 1, False, "(1,); () is needed"),
        ("node", "rotation", 4, False, "made with rotation=True"),
        ("material", "base_color", 4, True, "made without rotation=True"),
    ],
)
def test_a_curve_that_does_not_fit_is_refused(
    kind: str, what: str, width: int, rotation: bool, sentence: str
) -> None:
    curve = Curve([0, 1], np.ones((2, width)), rotation=rotation)
    with pytest.raises(SceneError) as refusal:
        Track(kind, "arm", what, curve)
    assert sentence in str(refusal.value)


def test_weights_are_a_list() -> None:
    with pytest.raises(SceneError, match=r"\(targets,\) is needed"):
        Track("node", "face", "weights", Curve([0, 1], [0, 1]))


def test_a_deformer_moves_by_its_part_and_number() -> None:
    tower = Node(
        "tower", mesh=cube().nodes[0].mesh, deform=Composite.of(Twist(angle=0.0), Twist(name="other"))
    )
    turn = Track("node", "tower", "deform.twist.angle", Curve([0, 1], [0.0, 1.0]))
    scene = Scene((tower,), (Clip("turn", [turn]),))
    halfway = scene.at(0.5)
    wanted = Twist(angle=0.5)(scene.surfaces[0].mesh.points)[0]
    assert np.array_equal(halfway.surfaces[0].mesh.points, wanted)
    assert not np.array_equal(wanted, scene.surfaces[0].mesh.points)


def test_an_unknown_deformer_names_those_there_are() -> None:
    tower = Node("tower", mesh=cube().nodes[0].mesh, deform=Composite.of(Twist(angle=0.0)))
    turn = Track("node", "tower", "deform.twost.angle", Curve([0, 1], [0.0, 1.0]))
    with pytest.raises(SceneError, match=r"leads nowhere; there is 'twist.angle'"):
        Scene((tower,), (Clip("turn", [turn]),)).at(0.5)
