"""Visible lines of 25 tori, 1920x1080, against Blender's Line Art and OpenCascade's HLRBRep_PolyAlgo.

Neither peer is in the extra `bench`, for they are large: `pip install --no-deps bpy cadquery-ocp-novtk`.
Where one is absent, ours is measured alone. Line Art draws what we draw by default, of the same faces;
PolyAlgo draws outlines only, of its own mesh of the same bodies, which is then ours too. Both have their
geometry ready.
`python -m benchmarks.drawing`
"""

from __future__ import annotations

import importlib.util
import math
import statistics
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks import peers, results
from eyeline.drawing.kinds import USUAL
from eyeline.drawing.lines import Lines, lines_of
from eyeline.geometry import quaternion, transform
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

SIZE = (1920, 1080)
ROW = 5  # tori in a row, and rows
LENS = 50.0  # mm on a sensor 36 mm wide
DEFLECTION = 0.0015  # metres: OpenCascade then makes about 250,000 faces
CREASE = math.radians(40)


def eye() -> tuple[float, float, float]:
    return ROW * 0.7, ROW * 0.7, ROW * 3 + 2.0


def camera() -> Camera:
    fov = 2 * math.atan(18 / LENS * SIZE[1] / SIZE[0])
    place = transform.identity()
    place[:3, 3] = eye()
    return Camera(fov=fov, near=0.1, world_from_eye=place)


def places() -> list[np.ndarray]:
    """Where the tori stand: leaning, and through each other."""
    found = []
    for i in range(ROW):
        for j in range(ROW):
            lean = quaternion.from_axis_angle((0, 1, 0), 0.3 * i)
            turn = quaternion.multiply(lean, quaternion.from_axis_angle((1, 0, 0), 0.2))
            found.append(transform.compose((i * 1.5, j * 1.5, i * j % 3 * 0.7), turn, (1, 1, 1)))
    return found


def torus(around: int = 96, across: int = 48) -> Mesh:
    """A ring of radii 1 and 0.3 about z."""
    u, v = np.meshgrid(
        np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij"
    )
    rim = 1 + 0.3 * np.cos(v)
    points = np.stack([rim * np.cos(u), rim * np.sin(u), 0.3 * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b = (i * across + j).reshape(-1), ((i + 1) % around * across + j).reshape(-1)
    c, d = (
        ((i + 1) % around * across + (j + 1) % across).reshape(-1),
        (i * across + (j + 1) % across).reshape(-1),
    )
    return Mesh(points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


def scene() -> Scene:
    """The tori, each with a mesh of its own whose edges nobody has looked up yet."""
    ring = torus()
    nodes = [Node(f"torus {k}", mesh=ring.changed(), matrix=place) for k, place in enumerate(places())]
    return Scene.of(*nodes)


def drawn(shown: Scene, kinds: tuple[str, ...] = USUAL) -> Lines:
    return lines_of(shown, camera(), SIZE, kinds, CREASE)


# --- peers ------------------------------------------------------------------------------------------------


def line_art(shown: Scene) -> tuple[Callable[[], Any], str]:
    """Blender's Line Art over the meshes of a scene."""
    import bpy
    from mathutils import Matrix

    bpy.ops.wm.read_factory_settings(use_empty=True)
    stage = bpy.context.scene
    stage.render.resolution_x, stage.render.resolution_y = SIZE
    for surface in shown.surfaces:
        mesh = bpy.data.meshes.new("torus")
        mesh.from_pydata(surface.mesh.points.tolist(), [], surface.mesh.faces.tolist())
        thing = bpy.data.objects.new("torus", mesh)
        thing.matrix_world = Matrix(surface.world_from_mesh.tolist())
        stage.collection.objects.link(thing)
    lens = bpy.data.cameras.new("camera")
    lens.lens, lens.clip_start = LENS, 0.1
    stage.camera = bpy.data.objects.new("camera", lens)
    stage.camera.matrix_world = Matrix.Translation(eye())
    stage.collection.objects.link(stage.camera)
    bpy.ops.object.grease_pencil_add(type="LINEART_SCENE")
    ink = bpy.context.object

    def run() -> None:
        ink.update_tag()
        bpy.context.view_layer.update()

    return run, f"Line Art, Blender {bpy.app.version_string}"


def poly_algo() -> tuple[Callable[[], Any], str, Scene]:
    """OpenCascade's hidden lines of meshes, and the scene of its faces."""
    import OCP
    from OCP.BRep import BRep_Builder
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeTorus
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf
    from OCP.HLRAlgo import HLRAlgo_Projector
    from OCP.HLRBRep import HLRBRep_PolyAlgo, HLRBRep_PolyHLRToShape
    from OCP.TopoDS import TopoDS_Compound

    builder, bodies = BRep_Builder(), TopoDS_Compound()
    builder.MakeCompound(bodies)
    for place in places():
        move = gp_Trsf()
        move.SetValues(*place[:3].reshape(-1).tolist())
        builder.Add(bodies, BRepBuilderAPI_Transform(BRepPrimAPI_MakeTorus(1.0, 0.3).Shape(), move).Shape())
    BRepMesh_IncrementalMesh(bodies, DEFLECTION, False, 0.5, False)
    x, y, z = eye()
    projector = HLRAlgo_Projector(gp_Ax2(gp_Pnt(x, y, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)), z)

    def run() -> object:
        algorithm = HLRBRep_PolyAlgo()
        algorithm.Load(bodies)
        algorithm.Projector(projector)
        algorithm.Update()
        lines = HLRBRep_PolyHLRToShape()
        lines.Update(algorithm)
        return lines.OutLineVCompound()

    return run, f"PolyAlgo, OpenCascade {OCP.__version__}", Scene.of(*triangulated(bodies))


def triangulated(bodies: Any) -> list[Mesh]:
    """The mesh of each face of OpenCascade's bodies."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    meshes, faces = [], TopExp_Explorer(bodies, TopAbs_FACE)
    while faces.More():
        location = TopLoc_Location()
        found = BRep_Tool.Triangulation_s(TopoDS.Face_s(faces.Current()), location)
        move = location.Transformation()
        nodes = (found.Node(k).Transformed(move) for k in range(1, found.NbNodes() + 1))
        points = np.array([(node.X(), node.Y(), node.Z()) for node in nodes])
        corners = np.array([found.Triangle(k).Get() for k in range(1, found.NbTriangles() + 1)]) - 1
        meshes.append(Mesh(points, corners))
        faces.Next()
    return meshes


# --- measuring --------------------------------------------------------------------------------------------


def main() -> None:
    shown = scene()
    thousands = f"{shown.face_count / 1000:.0f}k faces"
    drawn(shown)
    alone = statistics.median(peers.seconds(lambda: drawn(scene())) for _ in range(15))
    what = f"visible lines, 1920x1080, {thousands}"
    rows = [results.Row(f"{what}, with looking up edges", alone * 1e3, bar="")]
    if importlib.util.find_spec("bpy") is not None:
        theirs, name = line_art(shown)
        duel = peers.alternate(lambda: drawn(shown), theirs)
        rows.append(results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, name, bar="<= 1/4"))
    if importlib.util.find_spec("OCP") is not None:
        theirs, name, meshed = poly_algo()
        duel = peers.alternate(lambda: drawn(meshed, ("outline",)), theirs)
        what = f"visible outlines, 1920x1080, {meshed.face_count / 1000:.0f}k faces"
        rows.append(results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, name, bar="<= 1/4"))
    results.record("drawing", rows)


if __name__ == "__main__":
    main()
