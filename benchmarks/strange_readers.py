"""Readers of exported paths that know nothing of the package; see ``strange_exits.py``."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

ORIGIN = (47.3977, 8.5456)
AXIS_M, FLATTENING = 6378137.0, 1 / 298.257223563


def earth(latitude: np.ndarray, longitude: np.ndarray) -> np.ndarray:
    """Places on the WGS 84 ellipsoid, (n, 3) [m]."""
    squared = FLATTENING * (2 - FLATTENING)
    phi, lam = np.radians(latitude), np.radians(longitude)
    normal = AXIS_M / np.sqrt(1 - squared * np.sin(phi) ** 2)
    return np.column_stack([normal * np.cos(phi) * np.cos(lam), normal * np.cos(phi) * np.sin(lam),
                            normal * (1 - squared) * np.sin(phi)])  # fmt: skip


def metres(latitude: Any, longitude: Any) -> np.ndarray:
    """East and north of the origin on the ellipsoid, (n, 2) [m]."""
    origin = earth(np.array([ORIGIN[0]]), np.array([ORIGIN[1]]))
    off = earth(np.asarray(latitude, float), np.asarray(longitude, float)) - origin
    phi, lam = map(math.radians, ORIGIN)
    east = off @ [-math.sin(lam), math.cos(lam), 0]
    north = off @ [-math.sin(phi) * math.cos(lam), -math.sin(phi) * math.sin(lam), math.cos(phi)]
    return np.column_stack([east, north])


def read(file: Path, home: float) -> tuple[np.ndarray, float | None]:
    """The points of a file (n, 3) [m], z nan where it has none, and the sum of its dwells [s]."""
    reader: dict[str, Callable[[Path, float], tuple[np.ndarray, float | None]]] = {
        "plan": _plan, "waypoints": _waypoints, "path.yaml": _yaml, "mcap": _mcap,
        "geojson": _geojson, "kml": _kml, "gpx": _gpx, "csv": _csv, "json": _json,
    }  # fmt: skip
    return reader[file.name.split(".", 1)[1]](file, home)


def _items(rows: list[tuple[int, list[float]]], home: float) -> tuple[np.ndarray, float]:
    """Items of a mission: commands and seven parameters."""
    points: list[list[float]] = []
    held = 0.0
    for command, p in rows:
        if command in (16, 22, 21):
            x, y = metres([p[4]], [p[5]])[0].tolist() if p[4] or p[5] else points[-1][:2]
            points.append([x, y, p[6] + home])
            held += p[0] if command == 16 else 0.0
        elif command in (19, 93):
            held += p[0]
    return np.array(points), held


def _plan(file: Path, home: float) -> tuple[np.ndarray, float]:
    items = json.loads(file.read_text(encoding="utf-8"))["mission"]["items"]
    return _items([(one["command"], [math.nan if p is None else p for p in one["params"]])
                   for one in items], home)  # fmt: skip


def _waypoints(file: Path, home: float) -> tuple[np.ndarray, float]:
    lines = [line.split("\t") for line in file.read_text(encoding="utf-8").splitlines()[2:]]
    return _items([(int(line[3]), list(map(float, line[4:11]))) for line in lines], home)


def _yaml(file: Path, home: float) -> tuple[np.ndarray, None]:
    import yaml

    poses = yaml.load(file.read_text(encoding="utf-8"), yaml.CSafeLoader)["poses"]
    at = [one["pose"]["position"] for one in poses]
    return np.array([[one["x"], one["y"], one["z"]] for one in at]), None


def _mcap(file: Path, home: float) -> tuple[np.ndarray, None]:
    from mcap_ros2.reader import read_ros2_messages

    (message,) = read_ros2_messages(str(file))
    at = [pose.pose.position for pose in message.ros_msg.poses]
    return np.array([[one.x, one.y, one.z] for one in at]), None


def _geojson(file: Path, home: float) -> tuple[np.ndarray, float]:
    features = json.loads(file.read_text(encoding="utf-8"))["features"]
    line = next(one for one in features if one["geometry"]["type"].endswith("LineString"))
    at = line["geometry"]["coordinates"]
    if line["geometry"]["type"] == "MultiLineString":  # cut at 180 degrees, where parts join
        at = [*at[0], *(place for part in at[1:] for place in part[1:])]
    at = np.array(at)
    dwells = sum(one["properties"].get("dwell_s", 0.0) for one in features)
    return _degrees(at), dwells


def _degrees(at: np.ndarray) -> np.ndarray:
    z = at[:, 2] if at.shape[1] > 2 else np.full(len(at), np.nan)
    return np.column_stack([metres(at[:, 1], at[:, 0]), z])


def _kml(file: Path, home: float) -> tuple[np.ndarray, None]:
    space = "{http://www.opengis.net/kml/2.2}"
    tree = ElementTree.parse(file)
    (text,) = [one.text for one in tree.iter(f"{space}coordinates") if " " in one.text.strip()]
    return _degrees(np.array([row.split(",") for row in text.split()], float)), None


def _gpx(file: Path, home: float) -> tuple[np.ndarray, None]:
    space = "{http://www.topografix.com/GPX/1/1}"
    rows = [(float(one.get("lon")), float(one.get("lat")),
             float(one.findtext(f"{space}ele", "nan")))
            for one in ElementTree.parse(file).iter(f"{space}rtept")]  # fmt: skip
    return _degrees(np.array(rows)), None


def _csv(file: Path, home: float) -> tuple[np.ndarray, float]:
    with file.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    at = [[float(row[key]) if key in row else math.nan for key in ("x_m", "y_m", "z_m")]
          for row in rows]  # fmt: skip
    return np.array(at), sum(float(row["dwell_s"]) for row in rows)


def _json(file: Path, home: float) -> tuple[np.ndarray, float]:
    points = json.loads(file.read_text(encoding="utf-8"))["points"]
    at = np.array(points["at"], float)
    if at.shape[1] == 2:
        at = np.column_stack([at, np.full(len(at), np.nan)])
    return at, sum(points["dwell_s"])
