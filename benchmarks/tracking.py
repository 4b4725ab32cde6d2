"""How near machines stay to their paths: every example, every drive, with delay and noise.

2 m/s at most, 0.1 s from a command to its effect, a lag of 0.1 s, errors of the localisation and
of the drive; the 99th percentile of the error across the path is to be 0.15 m at most, nothing is
to be touched, and the driven body is to keep its clearance, proven.

    python benchmarks/tracking.py [NAME ...]
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import viaspline as vs
from viaspline.errors import ViasplineError

EXAMPLES = Path(__file__).parent.parent / "examples"
NOISE = {"delay_s": 0.1, "lag_s": 0.1, "speed_noise_mps": 0.05, "yaw_rate_noise_degps": 2.0}
PLACE = {"position_noise_m": 0.02, "heading_noise_deg": 0.5}
LIMIT = 0.15  # of the 99th percentile [m]

SMALL = ("barn-unseen", "depot-round")
"""Where a machine of half a metre would not fit."""


def drives(name: str) -> dict[str, dict]:
    """The machines, as large as they are in such places; an example's own if it has one."""
    own = vs.load(EXAMPLES / f"{name}.yaml").robot.drive
    if own is not None:
        kinds = own.model_dump(exclude_defaults=True)
        return {"its own": {key: value for key, value in kinds.items() if key not in NOISE}}
    size = 0.25 if name in SMALL else 0.6
    return {
        "point": {},
        "differential": {"differential": {"track_m": size, "max_wheel_speed_mps": 2.5}},
        "skid-steer": {"skid_steer": {"track_m": size, "slip": 0.3, "max_wheel_speed_mps": 2.5}},
        "ackermann": {
            "ackermann": {"wheelbase_m": size, "max_steer_deg": 40, "max_steer_rate_degps": 180}
        },
    }


def mission_of(name: str, drive: dict) -> vs.Mission:
    mission = vs.load(EXAMPLES / f"{name}.yaml")
    robot = mission.robot.model_dump(exclude_defaults=True)
    robot |= {"max_speed_mps": 2.0, "localization": PLACE}
    robot.setdefault("max_lateral_accel_mps2", 1.0)
    if drive:
        robot["drive"] = {**drive, **NOISE}
    data = mission.model_dump(exclude_defaults=True)
    return vs.Mission.model_validate({**data, "robot": robot})


def drive(name: str, machine: str, spec: dict) -> str:
    begin = time.perf_counter()
    try:
        mission = mission_of(name, spec)
        plan = vs.plan(mission)
        run = vs.simulate(mission, plan=plan, seed=1)
    except ViasplineError as error:
        return f"| {name} | {machine} | {str(error)[:90]} |"
    cross = run.tracking.cross
    touched = any(event.kind == "contact" for event in run.events)
    kept = run.certificate
    ok = cross.p99 <= LIMIT and not touched and kept.holds and run.reached
    return (
        f"| {name} | {machine} | {cross.p50:.3f} | {cross.p99:.3f} | {cross.max:.3f} | "
        f"{plan.tracking_error:.3f} | {kept.clearance:.3f} of {kept.required:g} | "
        f"{'TOUCHED' if touched else 'none'} | {len(run.replans)} | {run.duration:.0f} s | "
        f"{time.perf_counter() - begin:.1f} s | {'yes' if ok else 'NO: ' + str(run.reason)[:60]} |"
    )


def main() -> None:
    names = sys.argv[1:] or sorted(path.stem for path in EXAMPLES.glob("*.yaml"))
    print("| example | machine | p50 [m] | p99 [m] | largest [m] | allowed [m] | proven clearance "
          "[m] | contact | new paths | driven in | computed in | kept |")  # fmt: skip
    print("|" + "---|" * 12)
    for name in names:
        for machine, spec in drives(name).items():
            print(drive(name, machine, spec), flush=True)


if __name__ == "__main__":
    main()
