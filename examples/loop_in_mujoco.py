"""viaspline beside MuJoCo: a cart with two wheels and a caster, contact physics, 180 rays, no map.

pip install 'viaspline[sim]'
python examples/loop_in_mujoco.py
"""

import math

import mujoco
import numpy as np

import viaspline as vs

POSTS = [(5.0, 0.3, 0.6), (9.0, -1.4, 0.7), (10.0, 2.2, 0.8)]  # x, y, radius [m]
TRACK, WHEEL = 0.4, 0.1
XML = f"""<mujoco><option timestep="0.005" integrator="implicitfast"/><worldbody>
  <geom type="plane" size="30 30 1" friction="1"/>
  {"".join(f'<geom type="cylinder" pos="{x} {y} .5" size="{r} .5"/>' for x, y, r in POSTS)}
  <body name="cart" pos="0 0 {WHEEL}"><freejoint/>
    <geom type="box" size=".2 .13 .04" mass="8"/>
    <geom type="sphere" pos=".16 0 -.05" size=".05" friction="0.001" mass=".2"/>
    <body pos="0 {TRACK / 2} 0"><joint name="left" axis="0 1 0"/>
      <geom type="cylinder" size="{WHEEL} .02" zaxis="0 1 0" friction="1.5" mass=".5"/></body>
    <body pos="0 -{TRACK / 2} 0"><joint name="right" axis="0 1 0"/>
      <geom type="cylinder" size="{WHEEL} .02" zaxis="0 1 0" friction="1.5" mass=".5"/></body>
  </body></worldbody>
  <actuator><velocity joint="left" kv="3"/><velocity joint="right" kv="3"/></actuator></mujoco>"""
ANGLES, REACH = np.linspace(-2.3, 2.3, 180), 6.0
MISSION = vs.Mission.model_validate({
    "robot": {
        "radius_m": 0.3, "clearance_m": 0.25, "max_speed_mps": 0.8, "max_accel_mps2": 0.6,
        "tracking_error_m": 0.05,
        "drive": {"differential": {"track_m": TRACK}, "lag_s": 0.05},
        "sensor": {"lidar": {"range_m": REACH, "fov_deg": 264, "beams": len(ANGLES)}},
    },
    "route": {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [14, 0]},
})  # fmt: skip


def look(model: mujoco.MjModel, data: mujoco.MjData, pose: vs.RobotState) -> vs.Scan:
    ways = pose.heading + ANGLES
    rays = np.column_stack((np.cos(ways), np.sin(ways), np.zeros(len(ways)))).ravel()
    hit, far = np.zeros(len(ways), np.int32), np.zeros(len(ways))
    eye, cart = np.array([*pose.position, 0.3]), model.body("cart").id
    mujoco.mj_multiRay(model, data, eye, rays, None, 1, cart, hit, far, None, len(ways), REACH)
    ranges = np.where(hit < 0, np.inf, far)
    return vs.Scan.from_laserscan(ranges, ANGLES[0], ANGLES[1] - ANGLES[0], 0.05, REACH, pose)


def drive(nav: vs.Navigator) -> tuple[vs.Navigator, np.ndarray]:
    model = mujoco.MjModel.from_xml_string(XML)
    data, track = mujoco.MjData(model), []
    while not nav.finished and data.time < 120.0:
        w, _, _, z = data.qpos[3:7]
        heading = 2.0 * math.atan2(z, w)
        forward = data.qvel[0] * math.cos(heading) + data.qvel[1] * math.sin(heading)
        pose = vs.RobotState(tuple(data.qpos[:2].tolist()), heading, float(forward))
        command, nav = nav.step(pose, look(model, data, pose), data.time)
        for event in nav.events:
            print(f"{event.time:6.2f} s  {event.kind:<10} {event.message}")
        wheels = command.actuators
        data.ctrl = wheels["left_wheel_mps"] / WHEEL, wheels["right_wheel_mps"] / WHEEL
        mujoco.mj_step(model, data, 10)
        track.append(pose.position)
    return nav, np.array(track)


if __name__ == "__main__":
    done, _ = drive(vs.Navigator(MISSION))
    print("reached its goal" if done.reached else f"stands: {done.reason}")
