"""A shot only writes keys: what they say is where things are, whichever door they came through."""

from __future__ import annotations

import math

import numpy as np
import pytest

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.motion import EASINGS, Key
from eyeline.motion.act import in_turn, together
from eyeline.motion.path import Path
from eyeline.motion.shot import Shot
from eyeline.samples.solids import sphere
from eyeline.scene.camera import Camera
from eyeline.scene.light import Light
from eyeline.scene.material import Material
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

CLAY = Material("clay", (0.8, 0.2, 0.1, 1.0))
BALL = Node("ball", mesh=sphere().nodes[0].mesh, translation=(0, 1, 0))


def stage() -> Scene:
    mesh = BALL.mesh.with_material(CLAY) if BALL.mesh else None
    ball = BALL.changed(mesh=mesh)
    camera = Node("camera", camera=Camera(fov=0.6), translation=(0, 1, 6))
    lamp = Node("v1.2", light=Light("spot"), controls={"warmth": 0.5})
    return Scene((Node("group"), Node("arm", parent=0), ball, camera, lamp))


def shot() -> Shot:
    return Shot(stage())


def test_keys_are_where_a_thing_is() -> None:
    scene = shot().key("ball.translation", {0: (0, 1, 0), 2: (4, 1, 0)}).scene
    assert scene.at(1.0)["ball"].translation == (2, 1, 0)
    assert scene.duration == 2


def test_an_easing_is_the_curve_it_names() -> None:
    scene = shot().key("clay.roughness", {0: 0.0, 2: 1.0}, ease="ease_in_cubic").scene
    for time in (0.3, 1.1, 1.9):
        mesh = scene.at(time)["ball"].mesh
        assert mesh is not None
        assert mesh.materials[0].roughness == pytest.approx(EASINGS["ease_in_cubic"]([time / 2])[0])


def test_names_with_dots_and_ends_of_paths_are_found() -> None:
    scene = shot().key("v1.2.light.intensity", {0: 1.0, 1: 3.0}).key("arm.scale", {0: (2, 2, 2)}).scene
    posed = scene.at(0.5)
    assert posed["group/arm"].scale == (2, 2, 2)
    assert posed["v1.2"].light is not None
    assert posed["v1.2"].light.intensity == 2.0


def test_plays_follow_each_other_and_start_where_the_last_ended() -> None:
    one = shot()
    one.play(one["ball"].animate.move_to((1, 1, 0)), run_time=1, ease="linear").wait(1)
    one.play(one["ball"].animate.move_by((0, 2, 0)), run_time=2, ease="linear").wait(0.5)
    places = [one.scene.at(time)["ball"].translation for time in (0, 0.5, 1, 1.7, 2, 3, 4)]
    assert places == [(0, 1, 0), (0.5, 1, 0), (1, 1, 0), (1, 1, 0), (1, 1, 0), (1, 2, 0), (1, 3, 0)]
    assert one.scene.duration == 4.5


def test_a_turn_goes_as_often_around_as_it_is_told() -> None:
    one = shot()
    one.play(one["ball"].animate.rotate(5 * math.pi), run_time=2, ease="ease_in_out_sine")
    for part in (0.1, 0.35, 0.5, 0.9):
        angle = 5 * math.pi * EASINGS["ease_in_out_sine"]([part])[0]
        wanted = quaternion.from_axis_angle((0, 1, 0), angle)
        assert abs(np.dot(one.scene.at(2 * part)["ball"].rotation, wanted)) == pytest.approx(1, abs=1e-6)


def test_an_orbit_keeps_its_distance_and_its_eye_on_the_target() -> None:
    one = shot()
    one.play(one["camera"].animate.orbit((0, 1, 0), 1.5 * math.pi), run_time=3)
    for time in np.linspace(0, 3, 50):
        camera = one.scene.at(float(time)).cameras[0].world_from_eye
        assert np.linalg.norm(camera[:3, 3] - (0, 1, 0)) == pytest.approx(6, abs=1e-4)
        assert np.allclose(camera[:3, 3] - 6 * camera[:3, 2], (0, 1, 0), atol=1e-4)


def test_a_dolly_zoom_keeps_the_target_as_large() -> None:
    one = shot()
    one.play(one["camera"].animate.dolly_zoom((0, 1, 0), 120.0), run_time=2)
    sizes = []
    for time in np.linspace(0, 2, 9):
        camera = one.scene.at(float(time)).cameras[0]
        assert camera.focal_length is not None
        sizes.append(camera.focal_length / (camera.world_from_eye[2, 3] - 0))
    assert np.ptp(sizes) < 1e-12 * sizes[0] * 10
    assert one.scene.at(2).cameras[0].focal_length == pytest.approx(120)


@pytest.mark.parametrize(
    ("verb", "amount", "place"),
    [("dolly", 2.0, (0, 1, 4)), ("truck", 2.0, (2, 1, 6)), ("crane", 2.0, (0, 3, 6))],
)
def test_a_camera_goes_along_its_axes(verb: str, amount: float, place: tuple[float, ...]) -> None:
    one = shot()
    one.play(getattr(one["camera"].animate, verb)(amount))
    assert np.allclose(one.scene.at(1)["camera"].translation, place)


@pytest.mark.parametrize(("verb", "ahead"), [("pan", (-1, 0, 0)), ("tilt", (0, 1, 0)), ("roll", (0, 0, -1))])
def test_a_camera_turns_about_its_axes(verb: str, ahead: tuple[float, ...]) -> None:
    one = shot()
    one.play(getattr(one["camera"].animate, verb)(math.pi / 2))
    assert np.allclose(-one.scene.at(1).world[3, :3, 2], ahead)


def test_acts_in_turn_share_the_time() -> None:
    one = shot()
    up, side = one["ball"].animate.move_by((0, 1, 0)), one["ball"].animate.move_by((1, 0, 0))
    one.play(in_turn(up, side, lasting=(1, 3)), run_time=4, ease="linear")
    assert [one.scene.at(time)["ball"].translation for time in (0.5, 1, 2.5, 4)] == [
        (0, 1.5, 0), (0, 2, 0), (0.5, 2, 0), (1, 2, 0),
    ]  # fmt: skip


def test_a_lag_lets_each_begin_later() -> None:
    one = shot()
    acts = [one[name].animate.move_to((1, 0, 0)) for name in ("ball", "arm", "group")]
    one.play(*acts, run_time=1, lag_ratio=0.5, ease="linear")
    posed = one.scene.at(1.25)
    assert [posed[name].translation[0] for name in ("ball", "arm", "group")] == [1, 0.75, 0.25]
    assert one.time == 2


def test_an_eased_act_keeps_its_easing() -> None:
    one = shot()
    first = one["ball"].animate.move_to((1, 1, 0)).eased("ease_in_quad")
    one.play(together(first, one["arm"].animate.move_to((1, 0, 0))), ease="linear")
    posed = one.scene.at(0.5)
    assert (posed["ball"].translation[0], posed["arm"].translation[0]) == (0.25, 0.5)


def test_a_journey_has_its_speed() -> None:
    one = shot().wait(1)
    path = Path.through([(0, 0, 0), (3, 0, 1), (4, 0, 5)])
    one.travel("ball", path, speed=2.0)
    assert one.time == pytest.approx(1 + path.length / 2)
    assert one.scene.at(0.5)["ball"].translation == (0, 1, 0)
    assert np.allclose(one.scene.at(1.75)["ball"].translation, path.at([1.5])[0])


def test_a_shaking_camera_is_the_same_whenever_it_is_asked() -> None:
    one = shot().handheld("camera", seed=4, place=0.1)
    times = np.random.default_rng(0).uniform(0, 30, 40)
    batch = one.scene.sample(times)
    alone = [one.scene.at(float(time))["camera"].translation for time in times[::-1]]
    assert np.array_equal(batch.translation[::-1, 3], alone)
    spread = one.scene.sample(np.linspace(0, 300, 5000)).translation[:, 3] - (0, 1, 6)
    assert np.sqrt((spread**2).mean()) == pytest.approx(0.1, rel=0.1)


def test_a_watcher_looks_at_what_moves() -> None:
    one = shot().watch("camera", "ball")
    one.key("ball.translation", {0: (0, 1, 0), 1: (5, 4, 0)})
    camera = one.scene.at(1).cameras[0].world_from_eye
    assert np.allclose(np.cross(camera[:3, 2], camera[:3, 3] - (5, 4, 0)), 0, atol=1e-9)


def test_a_key_may_say_its_own_way() -> None:
    one = shot().key("ball.translation", {0: Key((0, 0, 0), ease="step"), 1: (1, 0, 0), 2: (2, 0, 0)})
    assert one.scene.at(0.9)["ball"].translation[0] == 0
    assert one.scene.at(1.5)["ball"].translation[0] == 1.5


@pytest.mark.parametrize(
    ("what", "keys", "sentence"),
    [
        (
            "bal.translation",
            {0: (0, 0, 0)},
            "nothing in the scene is called 'bal.translation'; there is 'ball",
        ),
        ("clay.rough", {0: 1}, "there is 'clay.roughness'"),
        ("camera.light.color", {0: (0, 0, 0)}, "nothing in the scene"),
        ("ball.translation", {0: (1, 2)}, "has shape"),
        ("ball.translation", {math.nan: (1, 2, 3)}, "a finite time is needed"),
        ("ball.translation", {0: (math.nan, 2, 3)}, "not finite"),
    ],
)
def test_keys_that_lead_nowhere_are_refused(what: str, keys: dict[float, object], sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        _ = shot().key(what, keys).clip  # type: ignore[arg-type]


def test_two_ways_at_once_are_refused() -> None:
    one = shot()
    with pytest.raises(SceneError, match="changed twice in one act"):
        one["ball"].animate.move_to((0, 0, 0)).move_by((1, 0, 0))
    one.key("ball.translation", {0.5: (0, 0, 0)})
    with pytest.raises(SceneError, match=r"has a key at 0\.5 s already"):
        one.play(one["ball"].animate.move_to((1, 1, 1)))


def test_times_that_are_none_are_refused() -> None:
    one = shot()
    act = one["ball"].animate.move_to((0, 0, 0))
    with pytest.raises(SceneError, match="run_time is 0"):
        one.play(act, run_time=0)
    with pytest.raises(SceneError, match="a wait of -1"):
        one.wait(-1)
    with pytest.raises(SceneError, match="either a run_time or a speed"):
        one.travel("ball", Path.circle((0, 0, 0), 1))
    with pytest.raises(SceneError, match="a positive number for each"):
        in_turn(act, act, lasting=(1,))
