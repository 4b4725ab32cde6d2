"""Values that say what they are in a few lines, in a console and in a notebook.

Tested through ``report/notebook/test_notebook_page``.
"""

from __future__ import annotations

from viaspline.presentable.upper_doors import opened


class ToldValue:
    """A value with ``summary()``, which a notebook shows as a table."""

    __slots__ = ()

    def summary(self) -> str:
        """What it is, on some lines: the name of each fact, and the fact."""
        words: str = opened("summary")(self)
        return words

    def _repr_html_(self) -> str:
        page: str = opened("page")(self)
        return page
