"""A robot gets no farther beside a path that was laid under way than is kept for that."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely

from viaspline.curve.bending import curvature_bound
from viaspline.curve.certificate import certify
from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.navigator import Navigator
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate
from viaspline.robot.state import RobotState

Make = Callable[..., Mission]
WHEELS = {"differential": {"track_m": 0.3}, "delay_s": 0.1, "lag_s": 0.1}
PLACE = {"position_noise_m": 0.01, "heading_noise_deg": 0.3}


def among_posts(seed: int) -> Mission:
    """A robot with a lidar among random posts that are not on its map."""
    random = np.random.default_rng(seed)
    posts = random.uniform((1.5, -3.0), (7.0, 3.0), (14, 2)).tolist()
    lidar = {"range_m": 4, "fov_deg": 270, "beams": 240, "noise_m": 0.01}
    return Mission.model_validate(
        {
            "world": {"unseen": [{"circle": {"center": at, "radius": 0.1}} for at in posts]},
            "robot": {
                "radius_m": 0.12, "clearance_m": 0.01, "max_speed_mps": 1.2, "drive": WHEELS,
                "localization": PLACE, "sensor": {"lidar": lidar},
            },
            "route": {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [8.5, 0]},
        }
    )  # fmt: skip


def nearest_post(run: Run) -> float:
    """How near the driven body came to a post, by shapely [m]."""
    line = shapely.LineString(np.asarray(run.path.evaluate(np.linspace(*run.path.domain, 20000))))
    posts = shapely.points([thing.circle.center for thing in run.plan.mission.world.unseen])
    return float(shapely.distance(line, posts).min()) - 0.1 - 0.12


@pytest.mark.parametrize("seed", range(3))
def test_a_driven_robot_among_posts_stays_as_near_to_its_paths_as_is_kept(seed: int) -> None:
    run = simulate(among_posts(seed), seed=seed)
    assert run.replans
    assert nearest_post(run) > 0.0
    beyond = sum(excess.until - excess.since for excess in run.excesses)
    assert beyond <= 1e-3 * run.duration


def slow_parts(mission: Mission) -> float:
    """How much of its path a robot has been made slower on at the most [m]."""
    most = 0.0

    def step(nav: Navigator, *state: Any) -> Any:
        nonlocal most
        command, after = real(nav, *state)
        slow = after._state.schedule.slow
        most = max(most, sum(part.end - part.start for part in slow))
        return command, after

    real = Navigator.step
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Navigator, "step", step)
        simulate(mission, seed=1)
    return most


def test_a_robot_that_keeps_little_is_slower_on_the_same_bends_than_one_that_keeps_much(
    mission_of: Make, disc_at: Callable[..., dict[str, Any]]
) -> None:
    made = [
        mission_of(
            [0, 0], [12, 0], unseen=[disc_at(6, 0.1, 1.5)], radius_m=0.3, clearance_m=0.1,
            sensor={"range_m": 3}, max_speed_mps=2, drive=WHEELS, tracking_error_m=kept,
        )
        for kept in (0.005, 0.3)
    ]  # fmt: skip
    little, much = (slow_parts(mission) for mission in made)
    assert much == 0.0 < little


def test_a_robot_that_can_not_stay_so_near_stops_and_says_so(
    mission_of: Make, disc_at: Callable[..., dict[str, Any]]
) -> None:
    noisy = {"position_noise_m": 0.05}
    mission = mission_of(
        [0, 0], [12, 0], unseen=[disc_at(6, 0.1, 0.5)], radius_m=0.3, clearance_m=0.1,
        sensor={"range_m": 3}, drive=WHEELS, localization=noisy, tracking_error_m=1e-4,
    )  # fmt: skip
    run = simulate(mission, plan=plan(mission))
    assert not run.reached
    assert run.reason is not None
    assert "farther beside its path than the 0.000 m" in run.reason
    assert run.certificate.clearance > 0.0


def test_a_steered_robot_that_could_not_follow_takes_wider_turns() -> None:
    """Where its wheels are turned as far as they go it has no steering left, however slow it is."""
    block = [[24.204, 20.097], [23.234, 20.628], [22.703, 19.658], [23.672, 19.127]]
    mission = Mission.model_validate(
        {
            "world": {
                "bounds": [-3, -3, 39, 39],
                "known": [{"polygon": block}],
                "unseen": [{"circle": {"center": [16.122, 10.541], "radius": 2.644}}],
            },
            "robot": {
                "radius_m": 0.5, "clearance_m": 0.3, "max_speed_mps": 1.298,
                "max_lateral_accel_mps2": 0.8, "sensor": {"range_m": 2.886},
                "drive": {
                    "ackermann": {"wheelbase_m": 1, "max_steer_deg": 32}, "delay_s": 0.1,
                    "lag_s": 0.1,
                },
            },
            "route": {
                "start": [19.984, 12.555], "via": [[8.193, 19.836], [26.396, 18.049]],
                "closed": True, "laps": 2,
            },
        }
    )  # fmt: skip
    nav, time = Navigator(mission), 0.0
    stands = RobotState((19.984, 12.555), nav.reference(0.0).heading, 0.0)
    while not nav.replans and not nav.finished:
        _, nav = nav.step(stands, mission.world.unseen, time)
        time += 0.1
    assert nav.replans, nav.reason
    (replan,) = nav.replans
    assert replan.mode == "from_rest"
    sharpest = 1.0 / (1.05 * mission.robot.turn_radius)
    assert curvature_bound(replan.path)[0] <= sharpest + 1e-9
    certificate = certify(replan.path, nav.world, 0.3 + nav.allowance, radius=0.5)
    assert certificate.holds
