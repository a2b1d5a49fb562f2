"""How a command ends: its exit code, and the one sentence that goes with it.

0 done; 1 a defect of ours; 2 the input or the options are wrong; 130 interrupted; 143 told to stop.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from eyeline.errors import EyelineError

DONE, DEFECT, WRONG, INTERRUPTED, TERMINATED = 0, 1, 2, 130, 143


def run(arguments: Sequence[str] | None = None) -> int:
    """Run a command line and give its exit code; no exception leaves it."""
    given = sys.argv[1:] if arguments is None else list(arguments)
    try:
        code = call(given)
        sys.stdout.flush()
        return code
    except EyelineError as reason:
        return refuse(str(reason))
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        # Who reads our output has gone, as `head` does. Python would complain once more at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except MemoryError:
        return refuse("there is not enough memory; a smaller --size or fewer --samples take less")
    except Exception as reason:
        return stopped(reason) or confess(reason, "--debug" in given)


def call(arguments: list[str]) -> int:
    """Parse and do; usage errors become a refusal."""
    import typer

    from eyeline.cli.app import app

    usage_error: Any = typer.BadParameter.__bases__[0]  # the parent that typer does not export
    stop_at_terminate()
    command: Any = typer.main.get_command(app)
    try:
        return command.main(arguments, prog_name="eyeline", standalone_mode=False) or DONE
    except SystemExit as end:
        # Typer ends the process by itself where the reader of our output has gone
        raise end.__context__ if isinstance(end.__context__, BrokenPipeError) else end from None
    except typer.Abort:
        return INTERRUPTED
    except usage_error as reason:
        asked = reason.ctx.command_path if reason.ctx else "eyeline"
        return refuse(f"{usage_sentence(reason, arguments)}; `{asked} --help` tells what there is")


def usage_sentence(reason: Any, arguments: list[str]) -> str:
    """What is wrong with a command line; a number that is none is named by its value."""
    import typer

    sentence = str(reason.format_message()).rstrip(".")
    if isinstance(reason, typer.BadParameter) and reason.param and sentence.startswith("Invalid value"):
        wanted = "a whole number" if "integer" in sentence else "a number"
        for word, following in pairwise([*arguments, ""]):
            option, _, joined = word.partition("=")
            if option in reason.param.opts:
                return f"{option} is {joined or following!r}; {wanted} is needed"
    return f"{sentence[:1].lower()}{sentence[1:]}"


def stop_at_terminate() -> None:
    """Leave by an exception when told to stop, so that unfinished files are removed."""

    def leave(*_: object) -> None:
        sys.exit(TERMINATED)

    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, leave)


def stopped(reason: BaseException | None) -> int:
    """The exit code of a signal that an exception follows from, 0 if none.

    A signal may strike where a lock is taken; Python then complains about the lock, not about the signal.
    """
    while reason is not None:
        if isinstance(reason, KeyboardInterrupt):
            return INTERRUPTED
        if isinstance(reason, SystemExit):
            return TERMINATED
        reason = reason.__context__
    return 0


def refuse(sentence: str) -> int:
    """Say why the input or the options cannot be used."""
    print("eyeline:", " ".join(sentence.split()), file=sys.stderr, flush=True)
    return WRONG


def confess(reason: Exception, debug: bool) -> int:
    """Say that the fault is ours, and where the traceback is."""
    import tempfile
    import traceback

    told = "".join(traceback.format_exception(reason))
    where = "it stands above"
    if debug:
        print(told, file=sys.stderr)
    else:
        with tempfile.NamedTemporaryFile(
            "w", prefix="eyeline-", suffix=".txt", delete=False, encoding="utf-8"
        ) as kept:
            kept.write(told)
        where = f"the traceback is in {Path(kept.name)}"
    summary = " ".join(f"{type(reason).__name__}: {reason}".split())
    print(f"eyeline: a defect of ours, {summary}; {where}", file=sys.stderr, flush=True)
    return DEFECT
