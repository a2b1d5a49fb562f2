"""Scenes whose answer is known: which node is seen at (x, y), without asking any method.

The orthographic ones are drawn in pixels: x right, y down, z towards the eye; pictures are WIDTH by HEIGHT.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

WIDTH, HEIGHT = 48, 32
TOUCH = 1 / 64  # pixels: a sample so near to a border may fall on either side

Pixels = npt.NDArray[np.float64]
Answer = Callable[[Pixels, Pixels], npt.NDArray[np.int_]]


@dataclass(frozen=True, eq=False)
class Known:
    """A scene, where it is seen from, and the node seen at pixel coordinates (x, y); -1 is background."""

    name: str
    scene: Scene
    camera: Camera
    answer: Answer

    @property
    def node(self) -> npt.NDArray[np.int_]:
        """(H, W) the node at every pixel's centre."""
        return self.answer(*centres())

    @property
    def certain(self) -> npt.NDArray[np.bool_]:
        """(H, W) whether the answer stays when the sample moves by TOUCH."""
        x, y = centres()
        return np.logical_and.reduce(
            [self.answer(x + dx, y + dy) == self.node for dx in (-TOUCH, TOUCH) for dy in (-TOUCH, TOUCH)]
        )


def centres() -> tuple[Pixels, Pixels]:
    """x and y (H, W) of the pixels' centres."""
    y, x = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    return x, y


# --- what scenes are made of ------------------------------------------------------------------------------


def page_camera(near: float = 1.0, far: float = 201.0) -> Camera:
    """Looks at the page: a point (x, y, z) is seen at pixel x, y whatever its z; the eye is at z = 100."""
    eye = np.eye(4)
    eye[:3, 3] = WIDTH / 2, HEIGHT / 2, 100
    return Camera(height=HEIGHT, near=near, far=far, world_from_eye=eye)


def page(*corners: tuple[float, float, float], single_sided: bool = False) -> Mesh:
    """A convex polygon on the page, front towards the eye where its corners go clockwise on the page."""
    points = np.array(corners, dtype=float)
    points[:, 1] = HEIGHT - points[:, 1]
    faces = [(0, k + 1, k) for k in range(1, len(corners) - 1)]
    return Mesh(points, faces, material=Material(double_sided=not single_sided))


def rectangle(
    x0: float, y0: float, x1: float, y1: float, z: float | tuple[float, float] = 0.0, **more: bool
) -> Mesh:
    """A rectangle on the page; z may go from one number at x0 to another at x1."""
    z0, z1 = z if isinstance(z, tuple) else (z, z)
    return page((x0, y0, z0), (x1, y0, z1), (x1, y1, z1), (x0, y1, z0), **more)


def within(x: Pixels, y: Pixels, x0: float, y0: float, x1: float, y1: float) -> npt.NDArray[np.bool_]:
    """Whether samples lie in a rectangle."""
    return (x0 < x) & (x < x1) & (y0 < y) & (y < y1)


def layered(*layers: tuple[int, npt.NDArray[np.bool_]]) -> npt.NDArray[np.int_]:
    """The node of the first layer that covers, nearest layer first."""
    node = np.full(layers[0][1].shape, -1)
    for number, covered in reversed(layers):
        node = np.where(covered, number, node)
    return node


# --- scenes on the page -----------------------------------------------------------------------------------


def nearer_hides_farther() -> Known:
    scene = Scene.of(rectangle(4, 4, 30, 20, 0), rectangle(20, 10, 44, 28, 5))
    return Known(
        "nearer hides farther",
        scene,
        page_camera(),
        lambda x, y: layered((1, within(x, y, 20, 10, 44, 28)), (0, within(x, y, 4, 4, 30, 20))),
    )


def equal_depths() -> Known:
    """A tie goes to the lower face number."""
    scene = Scene.of(rectangle(4, 4, 30, 20), rectangle(20, 10, 44, 28))
    return Known(
        "equal depths",
        scene,
        page_camera(),
        lambda x, y: layered((0, within(x, y, 4, 4, 30, 20)), (1, within(x, y, 20, 10, 44, 28))),
    )


def piercing() -> Known:
    """Two slopes cross along the line x = 24."""
    scene = Scene.of(rectangle(4, 4, 44, 20, (-10, 10)), rectangle(4, 10, 44, 28, (10, -10)))

    def answer(x: Pixels, y: Pixels) -> npt.NDArray[np.int_]:
        first, second = within(x, y, 4, 4, 44, 20), within(x, y, 4, 10, 44, 28)
        return layered((0, first & (~second | (x > 24))), (1, second))

    return Known("piercing", scene, page_camera(), answer)


def cyclic() -> Known:
    """Four planks on a square, each over the next at one end and under the one before at the other."""
    boxes = [(4, 4, 34, 10), (28, 2, 34, 24), (8, 20, 38, 26), (10, 0, 16, 30)]
    planks = [
        rectangle(*boxes[0], (0, 10)),
        page((28, 2, 0), (34, 2, 0), (34, 24, 10), (28, 24, 10)),
        rectangle(*boxes[2], (10, 0)),
        page((10, 0, 10), (16, 0, 10), (16, 30, 0), (10, 30, 0)),
    ]

    def height(k: int, x: Pixels, y: Pixels) -> Pixels:
        x0, y0, x1, y1 = boxes[k]
        rise = [(x - x0) / (x1 - x0), (y - y0) / (y1 - y0), (x1 - x) / (x1 - x0), (y1 - y) / (y1 - y0)][k]
        return np.where(within(x, y, x0, y0, x1, y1), 10 * rise, -1)

    def answer(x: Pixels, y: Pixels) -> npt.NDArray[np.int_]:
        heights = np.stack([height(k, x, y) for k in range(4)])
        return np.where(heights.max(axis=0) < 0, -1, heights.argmax(axis=0))

    return Known("cyclic", Scene.of(*planks), page_camera(), answer)


def t_junction() -> Known:
    """Two rectangles meet the long side of a third, with no corner of its own there; nothing behind shows."""
    scene = Scene.of(
        rectangle(4, 4, 24, 28),
        rectangle(24, 4, 44, 15.3),
        rectangle(24, 15.3, 44, 28),
        rectangle(0, 0, 48, 32, -5),
    )
    return Known(
        "t-junction",
        scene,
        page_camera(),
        lambda x, y: layered(
            (0, within(x, y, 4, 4, 24, 28)),
            (1, within(x, y, 24, 4, 44, 15.3)),
            (2, within(x, y, 24, 15, 44, 28)),
            (3, within(x, y, 0, 0, 48, 32)),
        ),
    )


def backs_are_dropped() -> Known:
    """The back of a single-sided rectangle shows what is behind it; its mirror image shows."""
    turned = rectangle(26, 4, 44, 28, 5, single_sided=True)
    turned = Mesh(turned.points, turned.faces[:, ::-1], material=turned.materials[0])
    mirror = np.diag([-1.0, 1, 1, 1])
    mirror[0, 3] = 24
    scene = Scene.of(
        Node("behind", mesh=rectangle(2, 2, 46, 30, 0)),
        Node("turned", mesh=turned),
        Node("mirrored", mesh=rectangle(4, 4, 20, 28, 5, single_sided=True), matrix=mirror),
    )
    return Known(
        "backs are dropped",
        scene,
        page_camera(),
        lambda x, y: layered((2, within(x, y, 4, 4, 20, 28)), (0, within(x, y, 2, 2, 46, 30))),
    )


def hidden_node() -> Known:
    scene = Scene.of(
        Node("hidden", mesh=rectangle(0, 0, 48, 32, 9), visible=False),
        Node("shown", mesh=rectangle(4, 4, 30, 20)),
    )
    return Known("hidden node", scene, page_camera(), lambda x, y: layered((1, within(x, y, 4, 4, 30, 20))))


def between_near_and_far() -> Known:
    """A slope that begins before the near plane and ends behind the far one: only its middle shows."""
    scene = Scene.of(rectangle(0, 4, 48, 28, (-24, 24)))
    return Known(
        "between near and far",
        scene,
        page_camera(near=88, far=112),
        lambda x, y: layered((0, within(x, y, 12, 4, 36, 28))),
    )


def staircase() -> Known:
    """Instances of one step, each nearer than the one before."""
    places = np.stack([np.eye(4)] * 5)
    places[:, :3, 3] = [(6 * k, -4 * k, 2 * k) for k in range(5)]
    scene = Scene.of(
        Node("steps", mesh=rectangle(2, 2, 14, 10), instances=places), rectangle(0, 0, 48, 32, -9)
    )

    def answer(x: Pixels, y: Pixels) -> npt.NDArray[np.int_]:
        steps = np.logical_or.reduce(
            [within(x, y, 2 + 6 * k, 2 + 4 * k, 14 + 6 * k, 10 + 4 * k) for k in range(5)]
        )
        return layered((0, steps), (1, within(x, y, 0, 0, 48, 32)))

    return Known("staircase", scene, page_camera(), answer)


def nothing() -> Known:
    return Known("nothing", Scene(), page_camera(), lambda x, y: np.full(x.shape, -1))


# --- scenes in space --------------------------------------------------------------------------------------


def rays(x: Pixels, y: Pixels, camera: Camera) -> npt.NDArray[np.float64]:
    """Directions (H, W, 3) in the world through pixel coordinates, 1 long along the view."""
    assert camera.fov is not None
    t = math.tan(camera.fov / 2)
    across, up = (2 * x / WIDTH - 1) * t * WIDTH / HEIGHT, (1 - 2 * y / HEIGHT) * t
    eye = np.stack([across, up, np.full_like(x, -1.0)], axis=-1)
    return eye @ camera.world_from_eye[:3, :3].T


def plain() -> Known:
    """A plain of 100 km around the eye, from below it to the horizon; it crosses the near plane."""
    far = 5e4
    ground = Mesh([(-far, 0, far), (far, 0, far), (far, 0, -far), (-far, 0, -far)], [(0, 1, 2), (0, 2, 3)])
    camera = Camera.look_at((0, 1.7, 0), (0.3, 1.2, -4), fov=math.radians(50), near=0.1)

    def answer(x: Pixels, y: Pixels) -> npt.NDArray[np.int_]:
        d = rays(x, y, camera)
        reach = 1.7 / np.maximum(-d[..., 1], 1e-12)
        hit = (np.abs(d[..., 0] * reach) < far) & (np.abs(d[..., 2] * reach) < far) & (d[..., 1] < 0)
        return np.where(hit, 0, -1)

    return Known("plain", Scene.of(ground), camera, answer)


def room() -> Known:
    """A closed box from inside: the six walls are six nodes, and no background is seen."""
    half = np.array([2.0, 1.25, 3.0])
    walls = []
    for axis in range(3):
        for side in (-1, 1):
            corners = np.zeros((4, 3))
            corners[:, axis] = side
            corners[:, (axis + 1) % 3], corners[:, (axis + 2) % 3] = (-1, 1, 1, -1), (-1, -1, 1, 1)
            walls.append(Mesh(corners * half, [(0, 1, 2), (0, 2, 3)]))
    eye = np.array([0.31, -0.22, 0.4])
    camera = Camera.look_at(eye, (1.0, 0.3, -1.0), fov=math.radians(110), near=0.05)

    def answer(x: Pixels, y: Pixels) -> npt.NDArray[np.int_]:
        d = rays(x, y, camera)
        with np.errstate(divide="ignore"):
            reach = np.stack(
                [
                    np.where(d[..., a] * s > 0, (s * half[a] - eye[a]) / d[..., a], np.inf)
                    for a in range(3)
                    for s in (-1, 1)
                ]
            )
        return reach.argmin(axis=0)

    return Known("room", Scene.of(*walls), camera, answer)


def room_far_away() -> Known:
    """The room and its eye, both moved far from the origin."""
    known = room()
    place = np.eye(4)
    place[:3, 3] = 1024.0, -512.0, 2048.0
    nodes = tuple(replace(node, matrix=place) for node in known.scene.nodes)
    camera = known.camera.moved(place @ known.camera.world_from_eye)
    return Known("room far from the origin", Scene(nodes), camera, known.answer)


KNOWN: tuple[Known, ...] = tuple(
    make()
    for make in (
        nearer_hides_farther, equal_depths, piercing, cyclic, t_junction, backs_are_dropped, hidden_node,
        between_near_and_far, staircase, nothing, plain, room, room_far_away,
    )
)  # fmt: skip
