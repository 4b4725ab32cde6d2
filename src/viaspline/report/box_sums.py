"""How much of something lies within boxes of a picture, for many boxes at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats


@dataclass(frozen=True)
class BoxSums:
    """Sums of an image over boxes, each in the time of four look-ups.

    Attributes:
        table: Sums from the lower left corner to each corner of a cell, (rows + 1, columns + 1).
        corner: The lower left corner [pixels], shape (2,).
        cell: Side of a cell [pixels].
    """

    table: Floats
    corner: Floats
    cell: float

    @classmethod
    def of_image(cls, image: Floats, corner: Floats, cell: float) -> BoxSums:
        """Sums of an image, its lowest row first, shape (rows, columns).

        Example:
            >>> sums = BoxSums.of_image(np.eye(3), np.zeros(2), 10.0)
            >>> sums.within(np.array([[0.0, 0, 10, 10], [0, 0, 30, 30], [10, 0, 20, 10]]))
            array([1., 3., 0.])
        """
        table = np.zeros((image.shape[0] + 1, image.shape[1] + 1))
        np.cumsum(np.cumsum(image, axis=0, dtype=float), axis=1, out=table[1:, 1:])
        return cls(table, np.asarray(corner, float), cell)

    @classmethod
    def of_points(cls, points: Floats, area: Floats, cell: float) -> BoxSums:
        """Counts of the cells with points [pixels], (n, 2), within an area (4,)."""
        columns, rows = np.maximum(np.ceil((area[2:] - area[:2]) / cell), 1).astype(int)
        image = np.zeros((rows, columns))
        with np.errstate(invalid="ignore"):
            index = np.floor((points - area[:2]) / cell)
            seen = ((index >= 0) & (index < (columns, rows))).all(axis=1)
        column, row = index[seen].astype(int).T
        image[row, column] = 1.0
        return cls.of_image(image, area[:2], cell)

    def within(self, boxes: Floats) -> Floats:
        """The sums over the cells that boxes touch, shape (k,).

        Args:
            boxes: x_min, y_min, x_max, y_max [pixels], shape (k, 4).
        """
        rows, columns = self.table.shape
        most = np.array([columns - 1, rows - 1])
        low = np.clip(np.floor((boxes[:, :2] - self.corner) / self.cell), 0, most).astype(int)
        high = np.clip(np.ceil((boxes[:, 2:] - self.corner) / self.cell), 0, most).astype(int)
        (x0, y0), (x1, y1) = low.T, high.T
        table = self.table
        sums: Floats = table[y1, x1] - table[y0, x1] - table[y1, x0] + table[y0, x0]
        return sums
