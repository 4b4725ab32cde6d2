/** Geometries made by hand: many as one, lines, tubes. */

import * as THREE from "../../../vendor/three.min.js";

const KINDS = {
  LineBasicMaterial: THREE.LineBasicMaterial, LineDashedMaterial: THREE.LineDashedMaterial, MeshBasicMaterial: THREE.MeshBasicMaterial,
  MeshLambertMaterial: THREE.MeshLambertMaterial, SpriteMaterial: THREE.SpriteMaterial,
};
const AROUND = 6; // corners of a tube's section

/** @type {Map<string, any>} */ const materials = new Map();

/**
 * A material, kept: one that is thrown away takes its program on the graphics card along, and the
 * next picture waits until that is compiled again.
 * @param {string} kind of three's materials @param {Record<string, any>} how @param {any} [map] its picture
 */
export function materialOf(kind, how, map = null) {
  const key = [kind, JSON.stringify(how), map?.uuid].join();
  const kept = materials.get(key);
  if (kept) return kept;
  const made = new (/** @type {any} */ (KINDS)[kind])(map ? { ...how, map } : how);
  if (materials.size > 600) materials.clear();
  materials.set(key, made);
  return made;
}

/** Many geometries as one, so that they are drawn in one go. @param {any[]} list @param {boolean} hasNormals */
export function merged(list, hasNormals) {
  const flat = list.map((one) => (one.index ? one.toNonIndexed() : one));
  const count = flat.reduce((sum, one) => sum + one.attributes.position.count, 0);
  const places = new Float32Array(3 * count), normals = new Float32Array(hasNormals ? 3 * count : 0);
  let at = 0;
  for (const one of flat) {
    places.set(one.attributes.position.array, at);
    if (hasNormals) normals.set(one.attributes.normal.array, at);
    at += 3 * one.attributes.position.count;
  }
  list.forEach((one) => one.dispose());
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  if (hasNormals) geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
  return geometry;
}

/** Lines as pieces for LineSegments. @param {number[][][]} lines @param {number[]} origin */
export function linesOf(lines, origin) {
  const places = [];
  for (const line of lines) {
    for (let i = 0; i + 1 < line.length; i += 1) {
      for (const place of [line[i], line[i + 1]]) places.push(place[0] - origin[0], place[1] - origin[1], place[2] - origin[2]);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  return geometry;
}

/**
 * A tube along places, each with a colour of its own.
 * @param {number[][]} line [m] @param {number[]} origin @param {number} radius [m] @param {(i: number) => number[]} colourOf red, green, blue from 0 to 1
 */
export function tubeOf(line, origin, radius, colourOf) {
  const n = line.length;
  const places = new Float32Array(3 * n * AROUND), normals = new Float32Array(3 * n * AROUND), colours = new Float32Array(3 * n * AROUND);
  let side = [1, 0, 0];
  for (let i = 0; i < n; i += 1) {
    const a = line[Math.max(i - 1, 0)], b = line[Math.min(i + 1, n - 1)];
    const way = unit([b[0] - a[0], b[1] - a[1], b[2] - a[2]]);
    const along = dot(side, way);
    side = unit([side[0] - along * way[0], side[1] - along * way[1], side[2] - along * way[2]], Math.abs(way[2]) < 0.9 ? [-way[1], way[0], 0] : [1, 0, 0]);
    const up = cross(way, side);
    const colour = colourOf(i);
    for (let k = 0; k < AROUND; k += 1) {
      const angle = (2 * Math.PI * k) / AROUND, c = Math.cos(angle), s = Math.sin(angle);
      const at = 3 * (i * AROUND + k);
      for (let axis = 0; axis < 3; axis += 1) {
        const out = c * side[axis] + s * up[axis];
        normals[at + axis] = out;
        places[at + axis] = line[i][axis] - origin[axis] + radius * out;
        colours[at + axis] = colour[axis];
      }
    }
  }
  const corners = [];
  for (let i = 0; i + 1 < n; i += 1) {
    for (let k = 0; k < AROUND; k += 1) {
      const a = i * AROUND + k, b = i * AROUND + ((k + 1) % AROUND);
      corners.push(a, b, a + AROUND, b, b + AROUND, a + AROUND);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  geometry.setIndex(corners);
  return geometry;
}

/** Empty a group, and give back what it held on the graphics card. @param {any} group */
export function cleared(group) {
  for (const child of [...group.children]) {
    child.traverse((/** @type {any} */ one) => {
      if (!one.isSprite) one.geometry?.dispose(); // sprites have one geometry together
      one.dispose?.();
    });
    group.remove(child);
  }
}

const dot = (/** @type {number[]} */ a, /** @type {number[]} */ b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (/** @type {number[]} */ a, /** @type {number[]} */ b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** @param {number[]} v @param {number[]} [instead] where it has no length */
function unit(v, instead = [1, 0, 0]) {
  const size = Math.hypot(...v);
  if (size > 1e-9) return v.map((one) => one / size);
  const other = Math.hypot(...instead) || 1;
  return instead.map((one) => one / other);
}
