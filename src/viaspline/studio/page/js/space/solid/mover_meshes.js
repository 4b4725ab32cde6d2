/** What moves in the 3-D view, where it is at an instant. */

import * as THREE from "../../../vendor/three.min.js";
import { frameAt, outOf } from "../../geometry/motion.js";
import { shapeOf } from "../../shapes/registry.js";
import { materialOf } from "./meshes.js";

const HIDDEN = 0.35; // how opaque is what the robot hasn't seen

/**
 * A ball as it is, everything else as the upright cylinder that holds it.
 * @param {any} doc @param {number} time [s] @param {number[]} origin
 * @param {{colours: import("./colours.js").SolidColours, isSeen: (index: number) => boolean, size: number}} look
 */
export function moversOf(doc, time, origin, { colours, isSeen, size }) {
  const group = new THREE.Group();
  for (const list of ["known", "unseen"]) {
    (doc.world?.[list] ?? []).forEach((/** @type {any} */ item, /** @type {number} */ index) => {
      const shape = item?.motion ? shapeOf(item) : null;
      const frame = shape ? frameAt(item.motion, time) : null;
      if (!shape || !frame) return;
      const isUnseen = list === "unseen", isHidden = isUnseen && !isSeen(index);
      const look = { color: isUnseen ? colours.unseen : colours.moving, transparent: isHidden, opacity: isHidden ? HIDDEN : 1 };
      const mesh = new THREE.Mesh(bodyOf(item, shape.reach(item), size), materialOf("MeshLambertMaterial", look));
      const { x, y, z } = placeOf(item, frame);
      mesh.position.set(x - origin[0], y - origin[1], z - origin[2]);
      group.add(mesh);
    });
  }
  return group;
}

/** Where the middle of it is, a cylinder's without its height. @param {any} item @param {import("../../geometry/motion.js").Frame} frame */
function placeOf(item, frame) {
  if (!item.ball) return frame;
  const [x, y, z] = item.ball.center;
  const at = outOf(frame, [x, y]);
  return { x: at[0], y: at[1], z: frame.z + z };
}

/** @param {any} item @param {number} reach [m] @param {number} size of all that is seen [m] */
function bodyOf(item, reach, size) {
  if (item.ball) return new THREE.SphereGeometry(item.ball.radius, 20, 14);
  const [low, high] = heightsOf(item) ?? [-size, size];
  const body = new THREE.CylinderGeometry(reach, reach, high - low, 24);
  body.rotateX(Math.PI / 2);
  body.translate(0, 0, 0.5 * (low + high));
  return body;
}

/** From where to where something reaches in its frame [m]; null: it is at every height. @param {any} item @returns {number[]|null} */
function heightsOf({ height_m, box, capsule }) {
  if (height_m) return height_m;
  if (box) return [box.min[2], box.max[2]];
  if (capsule?.from.length !== 3) return null;
  const ends = [capsule.from[2], capsule.to[2]];
  return [Math.min(...ends) - capsule.radius, Math.max(...ends) + capsule.radius];
}
