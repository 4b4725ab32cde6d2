"""Curves in space, sampled; see ``strange_flight_oracle.py``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

SAMPLES_M = 0.01


@dataclass(frozen=True)
class Sampled:
    """A curve every centimetre: places, unit tangents, curvature vectors, distances, spans."""

    places: np.ndarray
    ways: np.ndarray
    bends: np.ndarray
    along: np.ndarray
    of: np.ndarray

    @classmethod
    def of_spans(cls, spans: np.ndarray) -> Sampled:
        found: list[list[np.ndarray]] = [[], [], [], [], []]
        done = 0.0
        for number, (a, b, c, d) in enumerate(spans):
            length = np.linalg.norm(np.diff([a, b, c, d], axis=0), axis=1).sum()
            u = np.linspace(0, 1, max(48, math.ceil(length / SAMPLES_M)) + 1)[:, None]
            v = 1 - u
            places = v**3 * a + 3 * v**2 * u * b + 3 * v * u**2 * c + u**3 * d
            first = 3 * (v**2 * (b - a) + 2 * v * u * (c - b) + u**2 * (d - c))
            second = 6 * (v * (c - 2 * b + a) + u * (d - 2 * c + b))
            speed = np.linalg.norm(first, axis=1)[:, None]
            with np.errstate(all="ignore"):
                way = first / speed
                bend = (second - (second * way).sum(axis=1)[:, None] * way) / speed**2
            steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
            along = done + np.concatenate([[0.0], np.cumsum(steps)])
            done = along[-1]
            for to, part in zip(found, (places, way, bend, along, np.full(len(u), number)),
                                strict=True):  # fmt: skip
                to.append(part)
        return cls(*map(np.concatenate, found))


def users(plan: dict[str, Any]) -> list[dict[str, Any]]:
    """A path's via points of the route."""
    return [via for via in plan["path"]["vias"] if via["kind"] == "user"]
