"""Animation against three.js: another reader, mixer, skinner and morpher, made by others."""

import json
import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from data import PROJECT, data, every
from eyeline.files import load
from eyeline.geometry import transform
from eyeline.scene.scene import Scene

HERE = Path(__file__).parent / "threejs"
KITCHEN = PROJECT / "build" / "threejs"  # where npm puts three.js
REACH = 1e-5  # of the greatest number of a pose

FILES = [path.name for path in every("gltf/*.gl*")] or ["none"]


def times_of(duration: float, seed: int) -> list[float]:
    """Before, within, after and at both ends, shuffled."""
    rng = np.random.default_rng(seed)
    times = np.concatenate([[-0.5, 0, duration, duration + 1], rng.uniform(0, duration, 6)])
    return rng.permutation(times).tolist()


@cache
def install() -> str:
    """Why three.js cannot be had; empty if it is there."""
    if not (shutil.which("node") and shutil.which("npm")):
        return "node and npm are not installed"
    KITCHEN.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "mixer.mjs"):
        shutil.copyfile(HERE / name, KITCHEN / name)
    wanted = json.loads((HERE / "package.json").read_text())["dependencies"]["three"]
    there = KITCHEN / "node_modules" / "three" / "package.json"
    if there.exists() and json.loads(there.read_text())["version"] == wanted:
        return ""
    command = ["npm", "install", "--no-audit", "--no-fund", "--no-package-lock", "--ignore-scripts"]
    try:
        done = subprocess.run(command, cwd=KITCHEN, capture_output=True, text=True, timeout=120, check=False)
    except subprocess.TimeoutExpired:
        return "npm took more than 120 s to install three.js"
    return "" if done.returncode == 0 else f"npm could not install three.js: {done.stderr.strip()[-200:]}"


@cache
def answers() -> dict[str, Any]:
    """What three.js says of every file, asked at once."""
    if reason := install():
        pytest.skip(reason)
    requests = []
    for name in FILES:
        clips = load(data(f"gltf/{name}")).clips
        times = [times_of(clip.duration, seed) for seed, clip in enumerate(clips)]
        requests.append({"file": str(data(f"gltf/{name}")), "times": times})
    done = subprocess.run(
        ["node", "mixer.mjs"],
        cwd=KITCHEN,
        input=json.dumps(requests),
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return dict(zip(FILES, json.loads(done.stdout), strict=True))


def distance(found: np.ndarray, expected: np.ndarray) -> float:
    """The greatest difference, as a part of the greatest number expected."""
    assert found.shape == expected.shape
    return float(np.abs(found - expected).max(initial=0) / (np.abs(expected).max(initial=0) or 1))


def compare(scene: Scene, pose: Any) -> None:
    world = np.reshape(pose["world"], (-1, 4, 4)).swapaxes(1, 2)
    assert distance(scene.world, world) <= REACH
    for surface in scene.surfaces:
        points = transform.apply(surface.world_from_mesh, surface.mesh.points)
        assert distance(points, np.reshape(pose["points"][surface.node], (-1, 3))) <= REACH


@pytest.mark.parametrize("name", FILES)
def test_nodes_and_vertices_are_where_three_js_has_them(name: str) -> None:
    scene = load(data(f"gltf/{name}"))
    expected = answers()[name]
    compare(scene, expected["rest"])
    assert len(scene.clips) == len(expected["clips"])
    for index, (clip, poses) in enumerate(zip(scene.clips, expected["clips"], strict=True)):
        for time, pose in zip(times_of(clip.duration, index), poses, strict=True):
            compare(scene.at(time, index), pose)


@pytest.mark.parametrize("name", FILES)
def test_batches_are_where_three_js_has_them(name: str) -> None:
    scene = load(data(f"gltf/{name}"))
    for index, (clip, poses) in enumerate(zip(scene.clips, answers()[name]["clips"], strict=True)):
        expected = np.reshape([pose["world"] for pose in poses], (len(poses), -1, 4, 4)).swapaxes(2, 3)
        assert distance(scene.sample(times_of(clip.duration, index), index).world, expected) <= REACH
