"""What a curve moves: one property of one node, material or constraint."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Literal, get_args

from eyeline.errors import SceneError, suggestion
from eyeline.motion.curve import Curve
from eyeline.scene.material import DEFAULT

Kind = Literal["node", "material", "constraint"]

NODE_SHAPES: dict[str, tuple[int, ...] | None] = {
    "translation": (3,),  # metres
    "rotation": (4,),  # x y z w
    "scale": (3,),
    "weights": None,  # as many as the mesh has morph targets
    "visible": (),  # above a half is shown
    "light.color": (3,),
    "light.intensity": (),
    "light.range": (),
    "light.inner_cone": (),
    "light.outer_cone": (),
    "camera.fov": (),
    "camera.focal_length": (),  # millimetres on a 24 mm high sensor
    "camera.focus": (),  # metres
    "camera.f_number": (),
    "camera.height": (),
    "camera.near": (),
    "camera.far": (),
}

# Their first names are fields that hold more by name; what is in them, and its shape, is the scene's to say
OPEN = ("controls", "deform")

SLOT_SHAPES: dict[str, tuple[int, ...]] = {"offset": (2,), "rotation": (), "scale": (2,)}


def _material_shapes() -> dict[str, tuple[int, ...] | None]:
    """Every number of a material, and how its texture slots lie."""
    shapes: dict[str, tuple[int, ...] | None] = {}
    for field in fields(DEFAULT):
        value = getattr(DEFAULT, field.name)
        if isinstance(value, float):
            shapes[field.name] = ()
        elif isinstance(value, tuple):
            shapes[field.name] = (len(value),)
        elif field.name.endswith("_texture"):
            shapes |= {f"{field.name}.{part}": shape for part, shape in SLOT_SHAPES.items()}
    return shapes


SHAPES: dict[str, dict[str, tuple[int, ...] | None]] = {"node": NODE_SHAPES, "material": _material_shapes()}


@dataclass(frozen=True, eq=False)
class Track:
    """A curve, and the property it moves. A node is named by its path, a material or constraint by its name.

    Properties: those of SHAPES; of a node also controls.NAME and deform.NAME.PARAMETER; of a constraint its
    numbers.
    """

    kind: Kind
    name: str
    property: str
    curve: Curve

    def __post_init__(self) -> None:
        """Refuse a property that cannot move, and a curve that does not fit it."""
        if self.kind not in get_args(Kind):
            raise SceneError(f"a track moves a node, a material or a constraint, not a {self.kind!r}")
        if self.is_open():
            self._refuse_turns(wanted=False)
            return
        shapes = SHAPES[self.kind]
        if self.property not in shapes:
            near = suggestion(self.property, shapes)
            raise SceneError(f"{self.kind} {self.name!r} has no property {self.property!r} that moves{near}")
        shape = shapes[self.property]
        if shape is None and len(self.curve.shape) != 1:
            raise SceneError(f"{self} has values of shape {self.curve.shape}; (targets,) is needed")
        if shape is not None and self.curve.shape != shape:
            raise SceneError(f"{self} has values of shape {self.curve.shape}; {shape} is needed")
        self._refuse_turns(wanted=self.kind == "node" and self.property == "rotation")

    def is_open(self) -> bool:
        """Whether only a scene can tell if the property is there, and its shape."""
        return self.kind == "constraint" or (self.kind == "node" and self.property.split(".")[0] in OPEN)

    def _refuse_turns(self, *, wanted: bool) -> None:
        if wanted != self.curve.rotation:
            raise SceneError(f"{self} needs a curve made {'with' if wanted else 'without'} rotation=True")

    def __str__(self) -> str:
        return f"the track of {self.kind} {self.name!r}, {self.property}"
