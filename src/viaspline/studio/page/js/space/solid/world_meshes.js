/** What stands in the world as meshes: the ground, prisms, balls and cables, voxels. */

import * as THREE from "../../../vendor/three.min.js";
import { boxOf } from "../plan_layer.js";
import { linesOf, materialOf, merged } from "./meshes.js";

/** @typedef {import("./colours.js").SolidColours} SolidColours */
/** @typedef {{origin: number[], colours: SolidColours, floor: number, roof: number, path: number[][]}} Setting */

const GHOST_M = 25; // from the path in plan; what stands farther away is drawn as a ghost
const GHOST_OPACITY = 0.22;

/** All of it, in one group. @param {any} scene @param {Setting} setting */
export function worldOf(scene, setting) {
  const group = new THREE.Group();
  if (scene.terrain) group.add(terrainOf(scene.terrain, setting));
  else if (scene.flat !== null) group.add(flatOf(scene, setting));
  if (scene.contours.length) group.add(contoursOf(scene.contours, setting));
  /** @type {Record<string, any[]>} */ const bodies = {}, edges = {};
  for (const solid of scene.solids) {
    if (solid.kind === "voxels") {
      group.add(voxelsOf(solid, setting));
      continue;
    }
    const kind = `${solid.list === "unseen" ? "unseen" : solid.kind === "prism" ? "prism" : "cable"}:${isFar(solid, setting.path) ? "ghost" : "near"}`;
    const found = solid.kind === "prism" ? prismsOf(solid, setting) : [segmentOf(solid, setting)];
    (bodies[kind] ??= []).push(...found);
    if (solid.kind === "prism") (edges[kind] ??= []).push(...found.map((geometry) => new THREE.EdgesGeometry(geometry, 20)));
    else (edges[kind] ??= []).push(linesOf([[solid.first, solid.last]], setting.origin));
  }
  for (const [kind, list] of Object.entries(bodies)) group.add(bodyOf(kind, list, setting.colours));
  for (const [kind, list] of Object.entries(edges)) group.add(edgeOf(kind, list, setting.colours));
  return group;
}

/** @param {string} kind @param {any[]} list @param {SolidColours} colours */
function bodyOf(kind, list, colours) {
  const [what, how] = kind.split(":");
  const isGhost = how === "ghost", isUnseen = what === "unseen";
  const material = materialOf("MeshLambertMaterial", {
    color: colours[/** @type {"prism"|"cable"|"unseen"} */ (what)], side: THREE.DoubleSide,
    transparent: isGhost || isUnseen, opacity: isGhost ? GHOST_OPACITY : isUnseen ? 0.5 : 1, depthWrite: !isGhost && !isUnseen,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
  return new THREE.Mesh(merged(list, true), material);
}

/** @param {string} kind @param {any[]} list @param {SolidColours} colours */
function edgeOf(kind, list, colours) {
  const [what, how] = kind.split(":");
  const color = what === "unseen" ? colours.unseen : what === "cable" ? colours.cable : colours.edge;
  const material = materialOf("LineBasicMaterial", { color, transparent: true, opacity: how === "ghost" ? 0.35 : 0.9 });
  return new THREE.LineSegments(merged(list, false), material);
}

/** Whether a solid stands far from the path in plan. @param {any} solid @param {number[][]} path */
function isFar(solid, path) {
  const box = boxOf(solid);
  if (!box || !path.length) return false;
  return path.every(([x, y]) => Math.hypot(Math.max(box[0] - x, 0, x - box[2]), Math.max(box[1] - y, 0, y - box[3])) > GHOST_M);
}

/** @param {any} solid @param {Setting} setting */
function prismsOf({ parts, low, high }, { origin, floor, roof }) {
  const from = low ?? floor, to = high ?? Math.max(roof, from + 1);
  return parts.map((/** @type {number[][]} */ rings) => {
    const [outer, ...holes] = rings.map((ring) => {
      const places = [];
      for (let i = 0; i < ring.length; i += 2) places.push(new THREE.Vector2(ring[i] - origin[0], ring[i + 1] - origin[1]));
      return places;
    });
    const shape = new THREE.Shape(outer);
    shape.holes = holes.map((hole) => new THREE.Path(hole));
    const geometry = new THREE.ExtrudeGeometry(shape, { depth: to - from, bevelEnabled: false });
    geometry.translate(0, 0, from - origin[2]);
    return geometry;
  });
}

/** @param {any} solid @param {Setting} setting */
function segmentOf({ first, last, radius }, { origin }) {
  const a = new THREE.Vector3(...first.map((/** @type {number} */ v, /** @type {number} */ k) => v - origin[k]));
  const b = new THREE.Vector3(...last.map((/** @type {number} */ v, /** @type {number} */ k) => v - origin[k]));
  const length = a.distanceTo(b);
  const geometry = length < 1e-9 ? new THREE.SphereGeometry(radius, 20, 14) : new THREE.CapsuleGeometry(radius, length, 4, 10);
  const turned = new THREE.Quaternion();
  if (length >= 1e-9) turned.setFromUnitVectors(new THREE.Vector3(0, 1, 0), b.clone().sub(a).normalize());
  geometry.applyMatrix4(new THREE.Matrix4().compose(a.clone().add(b).multiplyScalar(0.5), turned, new THREE.Vector3(1, 1, 1)));
  return geometry;
}

/** @param {any} terrain @param {Setting} setting */
function terrainOf({ origin: from, cell, nx, ny, heights }, { origin, colours }) {
  const places = new Float32Array(3 * nx * ny);
  heights.forEach((/** @type {number|null} */ z, /** @type {number} */ i) => {
    places[3 * i] = from[0] + (i % nx) * cell - origin[0];
    places[3 * i + 1] = from[1] + Math.floor(i / nx) * cell - origin[1];
    places[3 * i + 2] = (z ?? origin[2]) - origin[2];
  });
  const corners = [];
  for (let j = 0; j + 1 < ny; j += 1) {
    for (let i = 0; i + 1 < nx; i += 1) {
      const four = [j * nx + i, j * nx + i + 1, (j + 1) * nx + i, (j + 1) * nx + i + 1];
      if (four.some((k) => heights[k] === null)) continue; // nobody knows how high it is there
      corners.push(four[0], four[1], four[3], four[0], four[3], four[2]);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setIndex(corners);
  geometry.computeVertexNormals();
  const material = materialOf("MeshLambertMaterial", { color: colours.ground, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 });
  return new THREE.Mesh(geometry, material);
}

/** Even ground, where the world is or the path runs. @param {any} scene @param {Setting} setting */
function flatOf({ flat, bounds }, { origin, colours, path }) {
  const x = path.map((p) => p[0]), y = path.map((p) => p[1]);
  const box = bounds ?? [Math.min(...x) - 20, Math.min(...y) - 20, Math.max(...x) + 20, Math.max(...y) + 20];
  const geometry = new THREE.PlaneGeometry(box[2] - box[0], box[3] - box[1]);
  geometry.translate((box[0] + box[2]) / 2 - origin[0], (box[1] + box[3]) / 2 - origin[1], flat - origin[2]);
  const material = materialOf("MeshLambertMaterial", { color: colours.flat, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 });
  return new THREE.Mesh(geometry, material);
}

/** @param {any[]} contours @param {Setting} setting */
function contoursOf(contours, { origin, colours }) {
  const lines = contours.map(({ height, line }) => {
    const places = [];
    for (let i = 0; i < line.length; i += 2) places.push([line[i], line[i + 1], height + 0.05]);
    return places;
  });
  return new THREE.LineSegments(linesOf(lines, origin), materialOf("LineBasicMaterial", { color: colours.contourText, transparent: true, opacity: 0.7 }));
}

/** @param {any} solid @param {Setting} setting */
function voxelsOf({ origin: from, cell, cubes, list }, { origin, colours }) {
  const bytes = Uint8Array.from(atob(cubes), (letter) => letter.charCodeAt(0));
  const indices = new Int16Array(bytes.buffer);
  const count = indices.length / 3;
  const isUnseen = list === "unseen";
  const material = materialOf("MeshLambertMaterial", { color: "#ffffff", transparent: isUnseen, opacity: isUnseen ? 0.5 : 1 });
  const mesh = new THREE.InstancedMesh(new THREE.BoxGeometry(cell, cell, cell), material, count);
  let most = 1;
  for (let i = 2; i < indices.length; i += 3) most = Math.max(most, indices[i]);
  const matrix = new THREE.Matrix4(), low = new THREE.Color(colours.voxelLow), high = new THREE.Color(colours.voxelHigh), colour = new THREE.Color();
  for (let k = 0; k < count; k += 1) {
    const [x, y, z] = [0, 1, 2].map((axis) => from[axis] + (indices[3 * k + axis] + 0.5) * cell - origin[axis]);
    mesh.setMatrixAt(k, matrix.makeTranslation(x, y, z));
    mesh.setColorAt(k, colour.copy(low).lerp(high, indices[3 * k + 2] / most));
  }
  mesh.frustumCulled = false;
  return mesh;
}
