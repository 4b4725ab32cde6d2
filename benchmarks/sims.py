"""viaspline in other people's simulators: BARN's worlds, unseen, in MuJoCo and in ir-sim.

    pip install 'viaspline[sim]'
    python benchmarks/sims.py mujoco|irsim [FOLDER] [--worlds N] [--only WORLD ...] [--alone]

The cart of ``mujoco_cart`` or ``irsim_cart`` is identified by ``viaspline identify`` from a test
drive in the simulator, and then driven from start to goal through worlds of which it knows nothing:
every fifth of BARN's in FOLDER (see ``barn_unseen``), or generated ones (see ``barn_worlds``) that
have a way for a disc of 0.3 m, as all of BARN's have. In each world pure pursuit of the shortest
way over a map of all scans drives the same cart afterwards.

A contact is one by the simulator's own detection. The clearance is measured by shapely on the true
places at every step of the simulator. Steps are timed by the thread's processor time and by the
clock on the wall, those in which the cart moves.
"""

from __future__ import annotations

import argparse
import math
import os
import tempfile
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Any

import barn_unseen
import barn_worlds
import numpy as np
from identified_cart import SPEED, YAW_RATE, identified
from scan_pursuit import Pursuit
from sim_bridge import Posts, SimulatedCart
from sim_drive import (
    AT_GOAL,
    CLEARANCE,
    LONGEST,
    Drive,
    drive,
    is_there,
    kept,
    mission,
)

import viaspline as vs

START, GOAL = barn_unseen.START, barn_unseen.GOAL
EMPTY = np.zeros((0, 3))
FIRST_SEED, ROOM = 90_000, 0.3
STUCK_S, STUCK_M = 15.0, 0.05
"""Who comes no farther than that in so long is stuck [s], [m]."""


def cart_in(simulator: str, posts: Posts, start: tuple[float, float, float], seed: int) -> Any:
    """The cart in one of the simulators, imported only then."""
    if simulator == "mujoco":
        from mujoco_cart import MujocoCart

        return MujocoCart(posts, start, seed)
    from irsim_cart import IrsimCart

    return IrsimCart(posts, start, seed)


def worlds(folder: Path | None) -> Iterator[tuple[int, Posts]]:
    """Numbers and posts."""
    if folder is not None:
        for number, posts, _ in list(barn_unseen.worlds(folder))[::5]:
            yield number, np.array(posts)
        return
    for seed in count(FIRST_SEED):
        middles = barn_worlds.posts(seed)
        if barn_worlds.is_there_a_way(middles, ROOM) == "open":
            yield seed, np.column_stack((middles, np.full(len(middles), barn_worlds.RADIUS_M)))


def drive_by_pursuit(world: int, cart: SimulatedCart, task: vs.Mission) -> Drive:
    """Drive a cart by pure pursuit, with the limits that were identified."""
    robot = task.robot
    limits = (min(SPEED, robot.max_speed_mps), YAW_RATE, robot.max_accel_mps2)
    pursuit, reason = Pursuit(cart.state.position, task.route.goal.at, limits), "its time is over"
    last = 0.0, np.array(cart.state.position)
    while cart.time < LONGEST and cart.contacts == 0:
        place = np.array(cart.state.position)
        if np.hypot(*(place - task.route.goal.at)) <= AT_GOAL:
            break
        if np.hypot(*(place - last[1])) > STUCK_M:
            last = cart.time, place
        elif cart.time - last[0] > STUCK_S:
            reason = "it is stuck"
            break
        cart.drive(*pursuit.told(cart, cart.ranges()))
    reason = "it touched something" if cart.contacts else reason
    return Drive(
        world, is_there(cart, task) and not cart.contacts, cart.contacts, kept(cart),
        cart.time, reason=reason,
    )  # fmt: skip


def shown(line: str) -> None:
    print("  ", line, flush=True)


def ignored(_: str) -> None:
    pass


def figures(times: list[float]) -> str:
    if not times:
        return ""
    return " / ".join(f"{1e3 * t:.1f}" for t in np.percentile(times, (50, 99, 100))) + " ms"


def row(name: str, drives: list[Drive]) -> str:
    reached = sum(d.reached for d in drives)
    near = min(d.kept for d in drives)
    below = sum(d.kept < CLEARANCE for d in drives)
    seconds = np.median([d.seconds for d in drives if d.reached] or [math.nan])
    cells = [name, f"{reached} of {len(drives)}", f"{sum(d.contacts > 0 for d in drives)}",
             f"{1e3 * near:.1f} mm", f"{below}", f"{seconds:.1f} s"]  # fmt: skip
    cells += [
        figures([t for d in drives for t in d.cpu]),
        figures([t for d in drives for t in d.wall]),
    ]
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("simulator", choices=("mujoco", "irsim"))
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--worlds", type=int, default=50)
    parser.add_argument("--only", type=int, nargs="*", help="these worlds")
    parser.add_argument("--events", action="store_true", help="tell what happens under way")
    parser.add_argument("--alone", action="store_true")
    options = parser.parse_args()
    name = options.simulator
    with tempfile.TemporaryDirectory() as folder:
        empty = cart_in(name, EMPTY, (0.0, 0.0, 0.0), 0)
        keys = identified(empty, Path(folder))
        print((Path(folder) / "drive.yaml").read_text(), flush=True)
    task, start = mission(keys, len(empty.angles), START, GOAL), (*START, 0.5 * math.pi)
    drives: dict[str, list[Drive]] = {"viaspline": []}
    print("load", os.getloadavg())
    try:
        for number, posts in worlds(options.folder):
            if options.only and number not in options.only:
                continue
            cart = cart_in(name, posts, start, number)
            told = shown if options.events else ignored
            drives["viaspline"].append(drive(number, cart, task, told))
            print(drives["viaspline"][-1].line("viaspline"), flush=True)
            if not options.alone:
                cart = cart_in(name, posts, start, number)
                drives.setdefault("pure pursuit", []).append(drive_by_pursuit(number, cart, task))
                print(drives["pure pursuit"][-1].line("pure pursuit"), flush=True)
            wanted = len(options.only) if options.only else options.worlds
            if len(drives["viaspline"]) == wanted:
                break
    except KeyboardInterrupt:
        print("interrupted: this is the table of the worlds up to there")
    print("load", os.getloadavg())
    print("| driver | reached | with contacts | nearest | below the clearance | time, median | "
          "steps by the processor, median / 99 % / most | by the clock on the wall |")  # fmt: skip
    print("|---|---|---|---|---|---|---|---|")
    for driver, found in drives.items():
        if found:
            print(row(f"{name}, {driver}", found))


if __name__ == "__main__":
    main()
