"""What the studio answers to a message that it can't or won't obey.

Tested through ``studio/test_document``.
"""

from __future__ import annotations

from viaspline.errors import ViasplineError


class RefusedError(ViasplineError):
    """A message that is refused, with the reason for the person at the page."""
