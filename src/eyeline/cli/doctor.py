"""`eyeline doctor`: whether everything is there, and compiling ahead."""

from __future__ import annotations

import json as encoding
import platform
import sys
import time
from pathlib import Path
from typing import Annotated, Any

import typer

from eyeline.cli.progress import progress_bar, say
from eyeline.cli.values import Debug, Json, Quiet

LIBRARIES = ("numpy", "numba", "scipy", "pillow", "av", "trimesh", "DracoPy", "typer", "rich")

Warm = Annotated[
    bool, typer.Option("--warm", help="Compile every kernel now, so that no picture waits for it.")
]


def doctor(warm: Warm = False, json: Json = False, quiet: Quiet = False, debug: Debug = False) -> None:
    """Tell versions, threads, the kernel cache, and which films can be written."""
    if warm:
        compile_all(quiet)
    found = findings()
    if json:
        print(encoding.dumps(found))
        return
    width = max(map(len, found))
    for name, value in found.items():
        shown = ", ".join(f"{k} {v}" for k, v in value.items()) if isinstance(value, dict) else value
        print(f"{name:{width}}  {shown}")


def findings() -> dict[str, Any]:
    """Everything `doctor` tells, as plain data."""
    import eyeline
    from eyeline.jit import cache_root, threads

    files = [path for path in cache_root().rglob("*") if path.is_file()]
    megabytes = sum(path.stat().st_size for path in files) / 1e6
    return {
        "eyeline": eyeline.__version__,
        "python": f"{platform.python_version()} ({sys.executable})",
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "processor": processor(),
        "threads": threads(),
        "cache": str(cache_root()),
        "cache_megabytes": round(megabytes, 1),
        "libraries": {name: installed(name) for name in LIBRARIES},
        "films": films(),
        "samples": ", ".join(samples()),
    }


def processor() -> str:
    """What the processor calls itself."""
    told = Path("/proc/cpuinfo")
    if told.exists():
        for line in told.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def installed(name: str) -> str:
    """The version of a library, or that it is not there."""
    from importlib import metadata

    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return "missing"


def films() -> dict[str, str]:
    """Suffix -> whether its codec is in the video library."""
    import av

    from eyeline.render.encoders import ENCODERS

    told = {}
    for suffix, encoder in ENCODERS.items():
        codec = getattr(encoder, "codec", None)
        told[suffix or "folder"] = "yes" if codec is None or codec in av.codecs_available else f"no {codec}"
    return told


def samples() -> list[str]:
    """The names of the built-in models."""
    from eyeline.samples import SAMPLES

    return [f"sample:{name}" for name in SAMPLES]


def compile_all(quiet: bool) -> None:
    """Run every kernel once, on a small picture."""
    from eyeline.render.warming import errands

    begun = time.perf_counter()
    work = errands()
    with progress_bar("compiling", quiet) as progress:
        for count, errand in enumerate(work, 1):
            errand()
            if progress:
                progress(count, len(work))
    say(f"every kernel is compiled ({time.perf_counter() - begun:.1f} s)", quiet)
