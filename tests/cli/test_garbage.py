from __future__ import annotations

import gc

import pytest

from eyeline.cli.garbage import uncollected


@pytest.mark.parametrize("before", [True, False])
def test_the_collector_rests_in_the_block_and_is_as_before_after_it(before: bool) -> None:
    was_enabled = gc.isenabled()
    try:
        (gc.enable if before else gc.disable)()
        with pytest.raises(KeyError), uncollected():
            assert not gc.isenabled()
            raise KeyError
        assert gc.isenabled() is before
    finally:
        gc.enable() if was_enabled else gc.disable()
