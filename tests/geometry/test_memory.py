"""Memory serves again, but never while somebody still looks at it."""

from __future__ import annotations

import gc
import threading

import numpy as np

from eyeline.geometry.memory import LEAST, MOST, recycled

SHAPE = (300, 1000)


def address(array: np.ndarray) -> int:
    return array.__array_interface__["data"][0]


def test_memory_of_a_dead_array_serves_again() -> None:
    first = recycled(SHAPE, np.int32)
    place = address(first)
    del first
    others = [recycled(SHAPE, np.float32) for _ in range(13)]
    assert place in [address(other) for other in others]


def test_a_view_keeps_its_memory() -> None:
    views = [recycled(SHAPE, np.int32)[10:20, ::3].reshape(-1) for _ in range(3)]
    views.append(memoryview(recycled(SHAPE, np.int32)))
    views.append(recycled(SHAPE, np.int32).view(np.uint8)[5:7])
    gc.collect()
    kept = [np.asarray(view).copy() for view in views]
    for _ in range(40):
        recycled(SHAPE, np.int32)[:] = 123456789
    for view, copy in zip(views, kept, strict=True):
        assert np.array_equal(np.asarray(view), copy)


def test_arrays_alive_share_nothing() -> None:
    arrays = [recycled(SHAPE, np.int32) for _ in range(30)]
    assert len({address(array) for array in arrays}) == 30


def test_any_size_is_given() -> None:
    for shape in ((0, 5), (3,), (LEAST,), (MOST + 1,)):
        assert recycled(shape, np.uint8).shape == shape
        assert recycled(shape, np.uint8).flags.writeable


def test_threads_never_get_the_same_memory() -> None:
    wrong = []

    def work(mark: int) -> None:
        for _ in range(200):
            array = recycled(SHAPE, np.int32)
            array[::50] = mark
            if not (array[::50] == mark).all():
                wrong.append(mark)

    workers = [threading.Thread(target=work, args=(mark,)) for mark in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert wrong == []
