"""The cart in MuJoCo: two driven wheels and a swivelling caster on a floor with friction.

The wheels' motors are velocity servos with a torque that ends; what the cart does follows from the
friction of its wheels, the weight on them and the caster that has to swing round. The lidar is cast
by ``mj_multiRay``. A contact is one that MuJoCo's own collision detection finds between any part of
the cart and a post.

    pip install 'viaspline[sim]'
"""

from __future__ import annotations

import math

import mujoco
import numpy as np
import shapely
from numpy.typing import NDArray
from sim_bridge import NOISE, PERIOD, RADIUS, REACH, TRACK, Posts, beam_angles

import viaspline as vs

WHEEL, STEP = 0.08, 0.0025
"""Radius of a driven wheel [m]; of the simulation [s]."""

EYE, BEAMS = 0.28, 720
"""Height of the lidar [m], and how many beams it has."""

CART = f"""
<body name="cart" pos="{{x}} {{y}} {WHEEL}" euler="0 0 {{heading}}"><freejoint/>
  <geom name="hull" type="cylinder" pos="0 0 .07" size="{RADIUS} .05" mass="1"/>
  <geom type="box" pos="-.05 0 .02" size=".09 .07 .04" mass="9" contype="0" conaffinity="0"/>
  <body pos="0 {TRACK / 2} 0"><joint name="left" axis="0 1 0" armature=".01" damping=".02"/>
    <geom type="cylinder" size="{WHEEL} .015" zaxis="0 1 0" friction="1 .005 .0005" mass=".6"/>
  </body>
  <body pos="0 -{TRACK / 2} 0"><joint name="right" axis="0 1 0" armature=".01" damping=".02"/>
    <geom type="cylinder" size="{WHEEL} .015" zaxis="0 1 0" friction="1 .005 .0005" mass=".6"/>
  </body>
  <body pos="-.1 0 -.02"><joint name="swivel" axis="0 0 1" damping=".005"/>
    <geom type="sphere" size=".01" mass=".05" contype="0" conaffinity="0"/>
    <body pos="-.025 0 -.03"><joint name="roll" axis="0 1 0" damping=".0005"/>
      <geom type="ellipsoid" size=".03 .01 .03" friction=".8 .002 .0005" mass=".08"/></body>
  </body>
</body>"""

WORLD = f"""
<mujoco><compiler angle="radian"/><option timestep="{STEP}" integrator="implicitfast"/>
<worldbody><geom name="floor" type="plane" size="50 50 1" friction="1 .005 .0005"/>
{{posts}}{CART}</worldbody>
<actuator>
  <velocity joint="left" kv="4" forcerange="-1.2 1.2"/>
  <velocity joint="right" kv="4" forcerange="-1.2 1.2"/>
</actuator></mujoco>"""


class MujocoCart:
    """See ``SimulatedCart``.

    Args:
        posts: What stands there.
        start: x, y [m] and heading [rad].
        seed: Of the lidar's noise.
    """

    def __init__(self, posts: Posts, start: tuple[float, float, float], seed: int = 0) -> None:
        stand = "".join(
            f'<geom type="cylinder" pos="{x} {y} .25" size="{r} .25"/>' for x, y, r in posts
        )
        x, y, heading = start
        text = WORLD.format(posts=stand, x=x, y=y, heading=heading)
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)
        self._chance = np.random.default_rng(seed)
        self._cart, floor = self.model.body("cart").id, self.model.geom("floor").id
        root = self.model.body_rootid[self.model.geom_bodyid]
        self._own = root == self._cart
        self._post = ~self._own & (np.arange(self.model.ngeom) != floor)
        mujoco.mj_forward(self.model, self.data)
        self.angles = beam_angles(BEAMS)
        self.solids = [(shapely.Point(px, py), float(r)) for px, py, r in posts]
        self.contacts, self.track = 0, [(x, y)]

    @property
    def time(self) -> float:
        return float(self.data.time)

    @property
    def state(self) -> vs.RobotState:
        w, x, y, z = self.data.qpos[3:7]
        heading = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
        vx, vy = self.data.qvel[:2]
        speed = float(vx * math.cos(heading) + vy * math.sin(heading))
        at = float(self.data.qpos[0]), float(self.data.qpos[1])
        return vs.RobotState(at, heading, speed, stamp=self.time)

    def ranges(self) -> NDArray[np.float64]:
        state = self.state
        ways = state.heading + self.angles
        rays = np.column_stack((np.cos(ways), np.sin(ways), np.zeros(BEAMS))).ravel()
        hit, far = np.zeros(BEAMS, np.int32), np.zeros(BEAMS)
        eye = np.array([*state.position, EYE])
        groups = None
        mujoco.mj_multiRay(
            self.model, self.data, eye, rays, groups, 1, self._cart, hit, far, None, BEAMS, REACH
        )
        measured = far + self._chance.normal(0.0, NOISE, BEAMS)
        return np.where((hit < 0) | (measured > REACH), np.inf, measured)

    def drive(self, speed: float, yaw_rate: float) -> None:
        turn = 0.5 * TRACK * yaw_rate
        self.data.ctrl = (speed - turn) / WHEEL, (speed + turn) / WHEEL
        for _ in range(round(PERIOD / STEP)):
            mujoco.mj_step(self.model, self.data)
            self.track.append((float(self.data.qpos[0]), float(self.data.qpos[1])))
            pairs = self.data.contact.geom
            touched = self._own[pairs] & self._post[pairs[:, ::-1]]
            self.contacts += bool(touched.any())
