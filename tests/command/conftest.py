"""What the engine makes of one problem is made once for the tests of this room."""

from tests.support.shared import made_once

__all__ = ("made_once",)
