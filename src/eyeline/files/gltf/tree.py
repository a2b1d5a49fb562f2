"""The tree of nodes: who stands under whom, parents before children, depth first. [glTF 2.0, 3.5.3]"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from eyeline.errors import FileError
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import Part, spoken
from eyeline.files.limits import PATH_CHARACTERS


@dataclass(frozen=True)
class Tree:
    """The file's nodes in the scene's order, and each one's parent there."""

    order: tuple[int, ...]  # (N,) numbers in the file
    parents: tuple[int, ...]  # (N,) places in `order`; -1 is the world

    @property
    def node_of(self) -> dict[int, int]:
        """The scene's node for each of the file's."""
        return {number: node for node, number in enumerate(self.order)}


def tree_of(document: Document, scene: Part | None) -> Tree:
    """The nodes of a scene, or of all the file where no scene is given."""
    nodes = document.all("nodes")
    children = [node.wholes("children") for node in nodes]
    above = _parents(nodes, children)
    root_of = _roots(above)
    if scene is None:
        return _walk(document, [node for node in range(len(nodes)) if above[node] < 0], children)
    roots = scene.wholes("nodes")
    for root in roots:
        document.one("nodes", root, scene.at("nodes"))
        if above[root] >= 0:
            raise FileError(
                f"{scene.at('nodes')} names node {root}, which is a child of node {above[root]}; name a root"
            )
    if len(set(roots)) < len(roots):
        raise scene.refuse("nodes", "each root once is needed")
    return _walk(document, _with_joints(document, roots, root_of), children)


def _with_joints(document: Document, roots: Sequence[int], root_of: Sequence[int]) -> list[int]:
    """The roots, and those of all joints that skins under them name, which is reported."""
    members: dict[int, list[int]] = {}
    for node, root in enumerate(root_of):
        members.setdefault(root, []).append(node)
    wanted = list(roots)
    known = set(roots)
    # The list grows while it is walked: an added tree may wear skins too
    for root in wanted:
        for joint in _joints(document, members[root]):
            if root_of[joint] not in known:
                document.notes.add(
                    f"node {joint}, a joint of a skin, stands outside the scene; its tree is added"
                )
                known.add(root_of[joint])
                wanted.append(root_of[joint])
    return wanted


def _parents(nodes: Sequence[Part], children: Sequence[list[int]]) -> list[int]:
    """The parent of every node, -1 for none; two parents are refused."""
    above = [-1] * len(nodes)
    for parent, below in enumerate(children):
        for child in below:
            if child >= len(nodes):
                raise FileError(
                    f"{nodes[parent].at('children')} names nodes[{child}]; the file has {len(nodes)} of them"
                )
            if above[child] >= 0:
                raise FileError(
                    f"node {child} has two parents, nodes {above[child]} and {parent}; one is needed"
                )
            above[child] = parent
    return above


def _roots(above: Sequence[int]) -> list[int]:
    """The root above every node; a node under itself is refused."""
    roots = [-1] * len(above)
    for start in range(len(above)):
        trail: dict[int, None] = {}
        node = start
        while roots[node] < 0 and above[node] >= 0:
            if node in trail:
                raise FileError(f"node {node} is among its own children; a tree of nodes is needed")
            trail[node] = None
            node = above[node]
        root = node if roots[node] < 0 else roots[node]
        for passed in (*trail, node):
            roots[passed] = root
    return roots


def _joints(document: Document, nodes: Sequence[int]) -> list[int]:
    """The joints of every skin that these nodes use."""
    every = document.all("nodes")
    used = dict.fromkeys(every[node].whole("skin") for node in nodes if every[node].has("skin"))
    joints: dict[int, None] = {}
    for index in used:
        skin = document.one("skins", index, "a node's skin")
        for joint in skin.wholes("joints"):
            document.one("nodes", joint, skin.at("joints"))
            joints[joint] = None
    return list(joints)


def _walk(document: Document, roots: Sequence[int], children: Sequence[list[int]]) -> Tree:
    """Depth first from the roots; refused if names and depth make paths that no memory holds."""
    nodes = document.all("nodes")
    order: list[int] = []
    parents: list[int] = []
    characters = 0
    waiting = [(root, -1, 0) for root in reversed(roots)]
    while waiting:
        number, parent, length = waiting.pop()
        place = len(order)
        order.append(number)
        parents.append(parent)
        length += 1 + len(nodes[number].name(f"node {number}"))
        characters += length
        if characters > PATH_CHARACTERS:
            raise FileError(
                f"the names of nodes down to {spoken(nodes[number].name())} make paths of more than"
                f" {PATH_CHARACTERS:,} characters; use shorter names or a flatter tree"
            )
        waiting.extend((child, place, length) for child in reversed(children[number]))
    return Tree(tuple(order), tuple(parents))
