"""Several threads that ask at once get the answers that one alone gets."""

from __future__ import annotations

import random
import threading
from collections.abc import Callable
from hashlib import sha256

import eyeline as el

THREADS, ROUNDS = 4, 8
BALL = el.samples.sphere().surfaces[0].mesh


def three_balls() -> el.Scene:
    places = {"front": (-0.35, 0, 0.9), "middle": (0.4, 0, 0.1), "back": (-0.1, 0, -0.9)}
    return el.Scene.of(*(el.Node(name, translation=place, mesh=BALL) for name, place in places.items()))


def seen(width: int, height: int) -> Callable[[], str]:
    """What is seen of the balls in a picture large enough for its memory to be used again."""
    camera = el.Camera.look_at((0, 1.2, 6), (0, 0, 0), fov=0.42)

    def ask() -> str:
        scene = three_balls()
        answer = el.visible(scene, camera, size=(width, height))
        areas = [answer.area(name) for name in scene.paths]
        arrays = (answer.face, answer.node, answer.depth, answer.distance)
        return f"{areas} {sha256(b''.join(array.tobytes() for array in arrays)).hexdigest()}"

    return ask


def drawn(make: Callable[[], el.Scene], style: str) -> Callable[[], str]:
    """A small picture."""
    return lambda: sha256(
        el.render(make(), size=(160, 90), style=style, time=0.4).pixels.tobytes()
    ).hexdigest()


QUESTIONS = [
    seen(641, 361),
    seen(960, 540),
    drawn(el.samples.desk_lamp, "shaded"),
    drawn(three_balls, "shaded"),
    drawn(el.samples.bouncing_ball, "toon"),
]


def test_answers_do_not_depend_on_who_else_asks() -> None:
    alone = [ask() for ask in QUESTIONS]
    wrong: list[object] = []

    def work(seed: int) -> None:
        chance = random.Random(seed)
        for _ in range(ROUNDS):
            number = chance.randrange(len(QUESTIONS))
            answer = QUESTIONS[number]()
            if answer != alone[number]:
                wrong.append((seed, number, answer))

    workers = [threading.Thread(target=work, args=(seed,), daemon=True) for seed in range(THREADS)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join(timeout=60)
    assert [worker.is_alive() for worker in workers] == [False] * THREADS
    assert wrong == []


def test_areas_stay_the_same_when_asked_often() -> None:
    ask = seen(480, 270)
    assert {ask() for _ in range(60)} == {ask()}
