"""Values that can be drawn, on anybody's axes and in a notebook.

Tested through ``report/notebook/test_plain_axes``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from viaspline.presentable.told_value import ToldValue
from viaspline.presentable.upper_doors import opened

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class ShownValue(ToldValue):
    """A value with ``plot()``, which a notebook shows as a picture beside its facts."""

    __slots__ = ()

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw it with matplotlib; ``ax.legend()`` then names what is drawn.

        Args:
            ax: Where to. On empty axes the view is chosen, at equal scales; on others it grows.
                Without any a new figure of pyplot is made; with some, pyplot isn't touched.

        Returns:
            The axes.

        Raises:
            GeometryError: When ``ax`` is no axes of matplotlib.
        """
        axes: Axes = opened("plot")(self, ax)
        return axes

    def _repr_png_(self) -> bytes:
        data: bytes = opened("picture")(self)
        return data
