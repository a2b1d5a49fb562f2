import gc
import math
import pickle
import weakref

import numpy as np
import pytest

from eyeline.errors import SceneError
from eyeline.geometry import quaternion, transform
from eyeline.motion import Clip, Curve, Track
from eyeline.scene.camera import Camera
from eyeline.scene.light import Light
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh, MorphTarget
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.scene.texture import Texture, TextureSlot

SLOT = TextureSlot(Texture(np.zeros((1, 1, 4), np.uint8)))
POINTS, FACES = np.eye(3), [[0, 1, 2]]


def triangle(name: str = "steel", **values: object) -> Mesh:
    return Mesh(POINTS, FACES, material=Material(name, base_color_texture=SLOT), **values)


def stage(*tracks: Track) -> Scene:
    """An arm of two nodes, a lamp, two lenses, and a shape that blends."""
    nodes = (
        Node("arm", mesh=triangle()),
        Node("hand", parent=0, translation=(1, 0, 0), mesh=triangle("glass")),
        Node("lamp", light=Light("spot")),
        Node("eye", camera=Camera(fov=1.0, near=0.1)),
        Node("map", camera=Camera(height=1.0)),
        Node("face", mesh=triangle("skin", targets=[MorphTarget(POINTS), MorphTarget(POINTS)])),
        Node("placed", matrix=transform.compose([1, 2, 3], [0, 0, 0, 1], [2, 2, 2])),
    )
    return Scene(nodes, (Clip("act", tracks),))


def ramp(low: object, high: object, **options: object) -> Curve:
    return Curve([0, 1], [low, high], **options)


def node(path: str, what: str, low: object, high: object) -> Track:
    return Track("node", path, what, ramp(low, high, rotation=what == "rotation"))


def test_a_parent_takes_its_children_along() -> None:
    scene = stage(node("arm", "translation", (0, 0, 0), (0, 2, 0)))
    assert scene.at(0.5).world[1, :3, 3].tolist() == [1, 1, 0]


def test_a_turn_swings_the_hand_round() -> None:
    quarter = quaternion.from_axis_angle((0, 0, 1), math.pi / 2)
    scene = stage(node("arm", "rotation", (0, 0, 0, 1), tuple(quarter)))
    half = math.sqrt(0.5)
    assert np.allclose(scene.at(0.5).world[1, :3, 3], [half, half, 0], rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("track", "read", "expected"),
    [
        (node("arm", "scale", (1, 1, 1), (3, 1, 1)), lambda s: s["arm"].scale, (2, 1, 1)),
        (node("arm", "visible", 1, 0), lambda s: s["arm"].visible, False),
        (node("face", "weights", (0, 1), (1, 0)), lambda s: s["face"].weights, (0.5, 0.5)),
        (
            node("lamp", "light.color", (0, 0, 0), (1, 0.5, 1)),
            lambda s: s["lamp"].light.color,
            (0.5, 0.25, 0.5),
        ),
        (node("lamp", "light.intensity", 0, 8), lambda s: s["lamp"].light.intensity, 4),
        (node("lamp", "light.range", 1, 3), lambda s: s["lamp"].light.range, 2),
        (node("lamp", "light.inner_cone", 0, 0.5), lambda s: s["lamp"].light.inner_cone, 0.25),
        (node("lamp", "light.outer_cone", 1, 1.5), lambda s: s["lamp"].light.outer_cone, 1.25),
        (node("eye", "camera.fov", 1, 2), lambda s: s["eye"].camera.fov, 1.5),
        (node("map", "camera.height", 1, 2), lambda s: s["map"].camera.height, 1.5),
        (node("eye", "camera.near", 1, 2), lambda s: s["eye"].camera.near, 1.5),
        (node("eye", "camera.far", 8, 9), lambda s: s["eye"].camera.far, 8.5),
    ],
)
def test_every_property_of_a_node_moves(track: Track, read: object, expected: object) -> None:
    assert read(stage(track).at(0.5)) == expected


@pytest.mark.parametrize(
    ("what", "low", "high", "expected"),
    [
        ("base_color", (0, 0, 0, 1), (1, 1, 1, 0), (0.5, 0.5, 0.5, 0.5)),
        ("metallic", 0, 1, 0.5),
        ("roughness", 1, 0, 0.5),
        ("emissive", (0, 0, 0), (4, 2, 0), (2, 1, 0)),
        ("normal_scale", 0, 2, 1),
        ("occlusion_strength", 0, 1, 0.5),
        ("alpha_cutoff", 0, 1, 0.5),
    ],
)
def test_every_number_of_a_material_moves(what: str, low: object, high: object, expected: object) -> None:
    posed = stage(Track("material", "steel", what, ramp(low, high))).at(0.5)
    assert getattr(posed["arm"].mesh.materials[0], what) == expected


def test_a_texture_slides_turns_and_grows() -> None:
    slot = "base_color_texture"
    posed = stage(
        Track("material", "steel", f"{slot}.offset", ramp((0, 0), (1, 2))),
        Track("material", "steel", f"{slot}.rotation", ramp(0, 2)),
        Track("material", "steel", f"{slot}.scale", ramp((1, 1), (3, 5))),
    ).at(0.5)
    moved = posed["arm"].mesh.materials[0].base_color_texture
    assert (moved.offset, moved.rotation, moved.scale) == ((0.5, 1), 1, (2, 3))
    assert moved.texture is SLOT.texture


def test_a_mesh_that_stands_twice_is_painted_once() -> None:
    mesh = triangle()
    clip = Clip("fade", [Track("material", "steel", "metallic", ramp(0, 1))])
    posed = Scene.of(Node("one", mesh=mesh), Node("two", mesh=mesh), clips=[clip]).at(1)
    assert posed["one"].mesh is posed["two"].mesh
    assert posed["one"].mesh.points is mesh.points


def test_what_no_track_moves_stays_the_same_object() -> None:
    scene = stage(node("arm", "translation", (0, 0, 0), (0, 2, 0)))
    posed = scene.at(0.5)
    assert posed["arm"] is not scene["arm"]
    assert all(mine is theirs for mine, theirs in zip(posed.nodes[1:], scene.nodes[1:], strict=True))
    assert posed["arm"].mesh is scene["arm"].mesh


def test_the_scene_itself_does_not_move() -> None:
    scene = stage(node("arm", "translation", (0, 0, 0), (0, 2, 0)))
    before = scene.world.copy()
    scene.at(1.0)
    assert scene["arm"].translation == (0, 0, 0)
    assert np.array_equal(scene.world, before)


def test_a_posed_scene_stands_still() -> None:
    posed = stage(node("arm", "translation", (0, 0, 0), (0, 2, 0))).at(0.5)
    assert posed.at(1.0) is posed
    assert posed.duration == 0


def test_one_clip_can_be_laid_over_another() -> None:
    arm = Clip("arm", [node("arm", "translation", (0, 0, 0), (0, 2, 0))])
    lamp = Clip("lamp", [node("lamp", "light.intensity", 0, 8)])
    posed = lamp.pose(arm.pose(stage(), 0.5), 0.25)
    assert posed["arm"].translation == (0, 1, 0)
    assert posed["lamp"].light.intensity == 2


def test_a_node_given_as_a_matrix_keeps_what_no_track_moves() -> None:
    posed = stage(node("placed", "translation", (0, 0, 0), (8, 0, 0))).at(0.5)
    expected = transform.compose([4, 0, 0], [0, 0, 0, 1], [2, 2, 2])
    assert np.allclose(posed["placed"].parent_from_node, expected, rtol=0, atol=1e-15)


def test_a_matrix_that_shears_stays_where_nothing_moves_it() -> None:
    shear = np.eye(4)
    shear[0, 1] = 0.5
    scene = Scene.of(
        Node("lean", matrix=shear),
        Node("arm"),
        clips=[Clip("act", [node("arm", "translation", (0, 0, 0), (1, 0, 0))])],
    )
    assert np.array_equal(scene.sample([0, 1]).world[:, 0], [shear, shear])
    assert np.array_equal(scene.sample([0, 1]).local[:, 0], [shear, shear])


def test_a_batch_equals_one_pose_after_the_other() -> None:
    rng = np.random.default_rng(5)
    scene = stage(
        node("arm", "translation", (0, 0, 0), (0, 2, 0)),
        node("arm", "rotation", (0, 0, 0, 1), (0, 1, 0, 1)),
        node("hand", "scale", (1, 1, 1), (2, 1, 3)),
        node("face", "weights", (0, 0), (1, 2)),
    )
    times = rng.uniform(-0.5, 1.5, 40)
    samples = scene.sample(times)
    for index, time in enumerate(times):
        posed = scene.at(time)
        assert np.array_equal(samples.world[index], posed.world)
        assert tuple(samples.weights[5][index]) == posed["face"].weights
    assert np.allclose(
        samples.local[:, 1], np.linalg.solve(samples.world[:, 0], samples.world[:, 1]), atol=1e-12
    )


def test_the_order_of_times_never_matters() -> None:
    scene = stage(node("arm", "rotation", (0, 0, 0, 1), (0, 1, 0, 1)))
    times = np.random.default_rng(6).uniform(-0.5, 1.5, 25)
    forward = {time: scene.at(time).world.tobytes() for time in times}
    assert {time: scene.at(time).world.tobytes() for time in times[::-1]} == forward


def test_a_clip_lasts_to_its_last_key() -> None:
    late = Track("node", "arm", "translation", Curve([0.5, 3.25], np.zeros((2, 3))))
    assert stage(node("arm", "scale", (1, 1, 1), (2, 2, 2)), late).duration == 3.25


def test_an_empty_clip_changes_nothing() -> None:
    scene = stage()
    assert scene.duration == 0
    assert scene.at(5).nodes == scene.nodes
    assert scene.sample([1, 2]).world.shape == (2, 7, 4, 4)


def test_a_scene_without_nodes_can_be_posed() -> None:
    scene = Scene(clips=(Clip("nothing"),))
    assert scene.at(1).nodes == ()
    assert scene.sample([1]).world.shape == (1, 0, 4, 4)


def test_a_spline_that_overshoots_stays_a_material() -> None:
    wild = Curve([0, 1], [[0, 1, 9], [9, 1, 0]], "cubic")
    posed = stage(Track("material", "steel", "metallic", wild)).at(0.3)
    assert posed["arm"].mesh.materials[0].metallic == 1


@pytest.mark.parametrize(
    ("track", "sentence"),
    [
        (node("arms", "scale", (1, 1, 1), (1, 1, 1)), "there is no node 'arms'; there is 'arm'"),
        (
            Track("material", "steal", "metallic", ramp(0, 1)),
            "there is no material 'steal'; there is 'steel'",
        ),
        (node("arm", "light.color", (0, 0, 0), (1, 1, 1)), "there is no light to move"),
        (node("map", "camera.fov", 1, 2), "the camera is orthographic"),
        (node("eye", "camera.height", 1, 2), "the camera is perspective"),
        (node("face", "weights", (1, 2, 3), (1, 2, 3)), "3 weights for 2 morph targets"),
        (node("lamp", "weights", (1, 2), (1, 2)), "2 weights for 0 morph targets"),
        (Track("material", "steel", "normal_texture.rotation", ramp(0, 1)), "there is no normal_texture"),
    ],
)
def test_a_track_of_nothing_is_refused(track: Track, sentence: str) -> None:
    with pytest.raises(SceneError) as refusal:
        stage(track).at(0)
    assert sentence in str(refusal.value)


def test_two_tracks_of_one_property_are_refused() -> None:
    track = node("hand", "scale", (1, 1, 1), (1, 1, 1))
    with pytest.raises(SceneError, match="twice"):
        Clip("act", [track, track])
    with pytest.raises(SceneError, match="twice"):
        stage(track, node("arm/hand", "scale", (1, 1, 1), (1, 1, 1))).at(0)


def test_a_time_that_is_no_number_is_refused() -> None:
    with pytest.raises(SceneError, match="finite"):
        stage().at(math.nan)


def test_what_was_looked_up_dies_with_the_scene() -> None:
    clip = Clip("act", [node("arm", "scale", (1, 1, 1), (2, 2, 2))])
    scene = Scene.of(Node("arm"), clips=[clip])
    scene.at(0.5)
    scene, gone = None, weakref.ref(scene)
    gc.collect()
    assert gone() is None


def test_a_clip_can_be_sent_to_another_process() -> None:
    scene = stage(node("arm", "translation", (0, 0, 0), (0, 2, 0)))
    scene.at(0.5)
    copy = pickle.loads(pickle.dumps(scene))
    assert np.array_equal(copy.at(0.7).world, scene.at(0.7).world)
