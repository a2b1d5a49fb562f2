"""What stands in the table of a comparison, as text."""

from __future__ import annotations

from dataclasses import dataclass

from eyeline.comparison.comparison import Comparison
from eyeline.comparison.trial import Trial

HEADINGS = ("method", "time", "first run", "peak memory", "agreement", "work")
BASE = "zbuffer"  # whose time the others' are told in


@dataclass(frozen=True)
class Row:
    """One method, told for people; a line each."""

    method: str
    space: str
    time: tuple[str, ...]
    first: str
    memory: str
    agreement: tuple[str, ...]
    work: tuple[str, ...]
    agrees: bool | None  # None where nothing is compared


def rows_of(comparison: Comparison) -> list[Row]:
    """A row for each method, in the order given."""
    base = next((trial.again for trial in comparison.trials if trial.name == BASE), 0.0)
    return [row_of(trial, comparison, base) for trial in comparison.trials]


def row_of(trial: Trial, comparison: Comparison, base: float) -> Row:
    """A method's row."""
    space = f"{trial.method.space} space"
    if trial.refusal:
        return Row(trial.name, space, ("does not answer",), "", "", (trial.refusal,), (), None)
    time = [milliseconds(trial.again)]
    if base and trial.name != BASE:
        time.append(f"{trial.again / base:,.2g} times {BASE}")
    memory = "" if trial.memory is None else f"{trial.memory / 1e6:,.1f} MB"
    work = tuple(f"{count:,} {name}" for name, count in trial.work.items())
    agreement, agrees = judged(trial, comparison)
    return Row(trial.name, space, tuple(time), milliseconds(trial.first), memory, agreement, work, agrees)


def judged(trial: Trial, comparison: Comparison) -> tuple[tuple[str, ...], bool | None]:
    """What the judge says of a method, and whether that is good."""
    found = comparison.agreements.get(trial.name)
    if found is None:
        return ("answers lines, not pixels",), None
    wrong, different = int(found.wrong.sum()), int(found.different.sum())
    lines = ["agrees"] if not wrong else [f"{wrong:,} pixel{'s' * (wrong != 1)} wrong"]
    if found.unjudged:
        lines.append(f"{different:,} differ, {found.unjudged:,} of them not looked at")
    elif different > wrong:
        lines.append(f"{different - wrong:,} differ where rounding decides")
    return tuple(lines), wrong == 0


def judge_line(comparison: Comparison) -> str:
    """What is known of the scene, and who judges, in sentences."""
    notes = "".join(f"{note[:1].upper()}{note[1:]}. " for note in comparison.scene.notes)
    share = comparison.judge.share
    if share is None:
        return f"{notes}Judged by the depth buffer; pixels that differ are looked at in exact geometry."
    return f"{notes}Judged by brute force; {share:.2%} of the pixels are beyond doubt."


def milliseconds(seconds: float) -> str:
    """A time as people read it."""
    return f"{seconds * 1e3:,.3g} ms" if seconds < 1 else f"{seconds:,.3g} s"
