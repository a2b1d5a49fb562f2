"""Cameras: perspective and orthographic lenses. [glTF 2.0, 3.10]"""

from __future__ import annotations

from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import Part
from eyeline.scene.camera import Camera


def camera_of(document: Document, index: int, place: str) -> Camera:
    """The lens that `place` names; the node it is at gives it its place."""
    part = document.one("cameras", index, place)
    kind = part.choice("type", ("perspective", "orthographic"))
    lens, name = part.part(kind), part.name()
    if kind == "perspective":
        fov = lens.number("yfov")
        if not 0 < fov < 3.14159:
            raise lens.refuse("yfov", "an angle between 0 and pi, in radians, is needed")
        near, far = _planes(lens, needs_far=False)
        return Camera(fov=fov, near=near, far=far, aspect=_aspect(lens), name=name)
    width, height = _size(lens, "xmag"), _size(lens, "ymag")
    near, far = _planes(lens, needs_far=True)
    return Camera(height=2 * height, near=near, far=far, aspect=width / height, name=name)


def _aspect(lens: Part) -> float | None:
    return _size(lens, "aspectRatio") if lens.has("aspectRatio") else None


def _size(lens: Part, key: str) -> float:
    value = lens.number(key)
    if not value > 0:
        raise lens.refuse(key, "more than 0 is needed")
    return value


def _planes(lens: Part, needs_far: bool) -> tuple[float, float | None]:
    """The near and far planes; a perspective lens may see to infinity."""
    near = lens.number("znear")
    if near < 0 or (near == 0 and not needs_far):
        raise lens.refuse("znear", "a distance in front of the eye is needed")
    far = lens.distance("zfar")
    if far is None and needs_far:
        raise lens.refuse("zfar", f"a distance of more than znear, {near:g}, is needed")
    if far is not None and not far > near:
        raise lens.refuse("zfar", f"more than znear, {near:g}, is needed")
    return near, far
