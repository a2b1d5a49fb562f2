from __future__ import annotations

from pathlib import Path

import pytest

from eyeline.cli import main


@pytest.fixture
def broken(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(_: object) -> None:
        raise ZeroDivisionError("of\nours")

    monkeypatch.setattr("eyeline.cli.info.contents", fail)


@pytest.mark.usefixtures("broken")
def test_a_defect_of_ours_is_told_in_a_line_with_the_traceback_in_a_file(
    capfd: pytest.CaptureFixture[str],
) -> None:
    assert main(["info", "sample:cube"]) == 1
    out, error = capfd.readouterr()
    assert out == ""
    assert error.startswith("eyeline: a defect of ours, ZeroDivisionError: of ours; the traceback is in ")
    assert error.count("\n") == 1
    kept = Path(error.split(" is in ")[1].strip())
    assert "Traceback" in kept.read_text() and "in fail" in kept.read_text()
    kept.unlink()


@pytest.mark.usefixtures("broken")
def test_a_defect_of_ours_is_shown_to_who_asks(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["info", "sample:cube", "--debug"]) == 1
    _, error = capfd.readouterr()
    assert "Traceback" in error
    assert error.splitlines()[-1].startswith("eyeline: a defect of ours")


@pytest.mark.parametrize(("signal", "code"), [(KeyboardInterrupt, 130), (SystemExit, 143)])
def test_a_signal_that_struck_a_lock_is_still_a_signal(
    monkeypatch: pytest.MonkeyPatch, signal: type[BaseException], code: int
) -> None:
    def fail(_: object) -> None:
        try:
            raise signal
        finally:
            raise RuntimeError("cannot release un-acquired lock")

    monkeypatch.setattr("eyeline.cli.info.contents", fail)
    assert main(["info", "sample:cube"]) == code


@pytest.mark.parametrize(("error", "code"), [(KeyboardInterrupt, 130), (MemoryError, 2)])
def test_other_ends_have_their_own_codes(
    monkeypatch: pytest.MonkeyPatch, error: type[BaseException], code: int
) -> None:
    def fail(_: object) -> None:
        raise error

    monkeypatch.setattr("eyeline.cli.info.contents", fail)
    assert main(["info", "sample:cube"]) == code
