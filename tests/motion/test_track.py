import numpy as np
import pytest

from eyeline.errors import SceneError
from eyeline.motion import Curve, Track


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
