/** Which robot of a fleet lies under a pixel, other than the one that is chosen. */

import { isFleet, membersOf, missionOf, robotName } from "../core/fleet.js";
import { pointsOf } from "../core/mission.js";

/** @typedef {{kind: "robot", robot: number, id: string|null}} PickedRobot `id` of a point of its route */

/**
 * A point of another robot's route.
 * @param {import("../core/store.js").Store} store @param {import("../geometry/camera.js").Camera} camera
 * @param {number} px @param {number} py @param {number} reach [CSS pixel]
 * @returns {PickedRobot|null}
 */
export function pickOtherPoint(store, camera, px, py, reach) {
  if (!isFleet(store.file)) return null;
  /** @type {PickedRobot|null} */ let found = null;
  let best = reach;
  membersOf(store.file).forEach((_, robot) => {
    if (robot === store.robot) return;
    for (const { id, at } of pointsOf(missionOf(store.file, robot, store.missions))) {
      if (!at) continue;
      const [x, y] = camera.toScreen(at[0], at[1]);
      const away = Math.hypot(x - px, y - py);
      if (away < best) {
        best = away;
        found = { kind: "robot", robot, id };
      }
    }
  });
  return found;
}

/**
 * Another robot, by its disc at an instant or by its path.
 * @param {import("../core/store.js").Store} store @param {import("../geometry/camera.js").Camera} camera
 * @param {number} px @param {number} py @param {number} reach [CSS pixel] @param {number} time [s]
 * @returns {PickedRobot|null}
 */
export function pickOtherRobot(store, camera, px, py, reach, time) {
  const plan = store.fleetPlan;
  if (!isFleet(store.file) || !plan) return null;
  const [wx, wy] = camera.toWorld(px, py);
  /** @type {PickedRobot|null} */ let found = null;
  let best = reach;
  membersOf(store.file).forEach((_, robot) => {
    const own = plan.byName.get(robotName(store.file, robot));
    if (robot === store.robot || !own?.curve) return;
    const at = own.curve.at(own.curve.distanceAt(time));
    const onDisc = Math.hypot(at.x - wx, at.y - wy) <= own.radius;
    const away = onDisc ? 0 : own.curve.nearest(wx, wy).away * camera.scale;
    if (away < best) {
      best = away;
      found = { kind: "robot", robot, id: null };
    }
  });
  return found;
}
