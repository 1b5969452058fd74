"""What each lecture shows alike."""

import pytest

from derive.command import lecturing
from derive.lecture import document
from tests.support.shared import once


@pytest.fixture(autouse=True, scope="module")
def shown_alike():
    """Records are made, and figures drawn, once for the chapters and equations that are given."""
    figures = {x: once(y, on_disk=True) for x, y in document.FIGURES.items()}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(document, "FIGURES", figures)
        patch.setattr(lecturing, "records_of", once(lecturing.records_of, on_disk=True))
        yield
