"""What a curve moves: one property of one node or material."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Literal

from eyeline.errors import SceneError
from eyeline.motion.curve import Curve
from eyeline.scene.material import DEFAULT
from eyeline.scene.scene import suggestion

Kind = Literal["node", "material"]

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
    "camera.height": (),
    "camera.near": (),
    "camera.far": (),
}

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
    """A curve, and the property it moves. A node is named by its path, a material by its name."""

    kind: Kind
    name: str
    property: str
    curve: Curve

    def __post_init__(self) -> None:
        """Refuse a property that cannot move, and a curve that does not fit it."""
        if self.kind not in SHAPES:
            raise SceneError(f"a track moves a node or a material, not a {self.kind!r}")
        shapes = SHAPES[self.kind]
        if self.property not in shapes:
            near = suggestion(self.property, shapes)
            raise SceneError(f"{self.kind} {self.name!r} has no property {self.property!r} that moves{near}")
        shape = shapes[self.property]
        if shape is None and len(self.curve.shape) != 1:
            raise SceneError(f"{self} has values of shape {self.curve.shape}; (targets,) is needed")
        if shape is not None and self.curve.shape != shape:
            raise SceneError(f"{self} has values of shape {self.curve.shape}; {shape} is needed")
        turns = self.kind == "node" and self.property == "rotation"
        if turns != self.curve.rotation:
            wanted = "with" if turns else "without"
            raise SceneError(f"{self} needs a curve made {wanted} rotation=True")

    def __str__(self) -> str:
        return f"the track of {self.kind} {self.name!r}, {self.property}"
