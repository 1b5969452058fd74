"""What each lecture shows alike."""

import pytest

from derive.command import lecturing
from tests.support.shared import once


@pytest.fixture(autouse=True, scope="module")
def shown_alike():
    """Records are made once for the chapters that are given."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lecturing, "records_of", once(lecturing.records_of, on_disk=True))
        yield
