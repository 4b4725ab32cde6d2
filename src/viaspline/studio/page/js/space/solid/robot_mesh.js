/** The robot in the 3-D view, and where it has flown. */

import * as THREE from "../../../vendor/three.min.js";
import { viridis } from "../../draw/theme.js";
import { materialOf, tubeOf } from "./meshes.js";

const LEAST_SHARE = 0.008; // of what is seen: a smaller body is drawn so large
const MOST_TRAIL = 900;

/**
 * The body as large as it is, or large enough to be seen, and where it looks.
 * @param {any} state @param {any} robot of the document @param {number[]} origin
 * @param {{colours: import("./colours.js").SolidColours, isFlying: boolean, size: number}} look
 */
export function robotOf(state, robot, origin, { colours, isFlying, size }) {
  const group = new THREE.Group();
  const real = Number(robot.radius_m ?? 0.5) || 0.5;
  const radius = Math.max(real, LEAST_SHARE * size);
  const half = robot.half_height_m === undefined ? null : Math.max(Number(robot.half_height_m), 0.25 * radius);
  const body = half === null ? new THREE.SphereGeometry(radius, 20, 14) : new THREE.CylinderGeometry(radius, radius, 2 * half, 24);
  if (half !== null) body.rotateX(Math.PI / 2);
  const nose = new THREE.ConeGeometry(0.5 * radius, 1.5 * radius, 14);
  nose.rotateZ(-Math.PI / 2);
  nose.translate(1.5 * radius, 0, 0);
  const material = materialOf("MeshLambertMaterial", { color: isFlying ? colours.robot : colours.path });
  group.add(new THREE.Mesh(body, material), new THREE.Mesh(nose, material));
  group.position.set(state.x - origin[0], state.y - origin[1], state.z - origin[2]);
  group.rotation.z = state.yaw ?? state.heading;
  return group;
}

/** What was flown up to now, coloured by speed. @param {any} drive @param {number[]} origin @param {import("./colours.js").SolidColours} colours @param {number} radius [m] */
export function trailOf(drive, origin, colours, radius) {
  const { x, y, z, speed } = drive.run.samples;
  const last = drive.index();
  const step = Math.max(1, Math.ceil(last / MOST_TRAIL));
  const line = [], speeds = [];
  for (let i = 0; i <= last; i += step) {
    const before = line.at(-1);
    if (before && Math.hypot(x[i] - before[0], y[i] - before[1], z[i] - before[2]) < 1e-3) continue;
    line.push([x[i], y[i], z[i]]);
    speeds.push(speed[i]);
  }
  const top = Math.max(...speeds, 0.1);
  const shade = new THREE.Color();
  if (line.length < 2) return new THREE.Group();
  return new THREE.Mesh(tubeOf(line, origin, 1.6 * radius, (i) => shade.setStyle(viridis(Math.round((speeds[i] / top) * 40) / 40)).toArray()), materialOf("MeshLambertMaterial", { vertexColors: true, emissive: colours.robot, emissiveIntensity: 0.25 }));
}
