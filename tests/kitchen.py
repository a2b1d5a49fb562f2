"""Programs made by others that run under node: installed by npm beside the project's build, once."""

from __future__ import annotations

import json
import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from data import PROJECT

LONGEST_WAIT = 120  # seconds


@cache
def kitchen(home: Path) -> Path:
    """The folder where the programs of `home` and what they need are ready to run; skips without."""
    if not (shutil.which("node") and shutil.which("npm")):
        pytest.skip("node and npm are not installed")
    folder = PROJECT / "build" / home.name
    folder.mkdir(parents=True, exist_ok=True)
    for file in home.iterdir():
        shutil.copyfile(file, folder / file.name)
    wanted = json.loads((home / "package.json").read_text())["dependencies"]
    if all(version == _installed(folder, name) for name, version in wanted.items()):
        return folder
    command = ["npm", "install", "--no-audit", "--no-fund", "--no-package-lock", "--ignore-scripts"]
    try:
        done = subprocess.run(
            command, cwd=folder, capture_output=True, text=True, timeout=LONGEST_WAIT, check=False
        )
    except subprocess.TimeoutExpired:
        pytest.skip(f"npm took more than {LONGEST_WAIT} s to install {', '.join(wanted)}")
    if done.returncode:
        pytest.skip(f"npm could not install {', '.join(wanted)}: {done.stderr.strip()[-200:]}")
    return folder


def _installed(folder: Path, name: str) -> str | None:
    package = folder / "node_modules" / name / "package.json"
    return json.loads(package.read_text())["version"] if package.exists() else None


def answer(home: Path, program: str, question: Any) -> Any:
    """What a program says to a question, both JSON."""
    done = subprocess.run(
        ["node", program],
        cwd=kitchen(home),
        input=json.dumps(question),
        capture_output=True,
        text=True,
        timeout=LONGEST_WAIT,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
