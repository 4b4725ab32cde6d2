/** The tools of the map in the order of their buttons: their names, what they are called, their keys. */

import { DRAWN } from "../shapes/registry.js";

/** @typedef {{name: string, label: string, key: string}} Tool */

/** @type {readonly Tool[]} */
export const TOOLS = [
  { name: "select", label: "Select and drag", key: "V" },
  { name: "via", label: "Add via points", key: "A" },
  ...DRAWN.map(({ shape, tool }) => ({ name: shape.key, label: tool.label, key: tool.key })),
  { name: "zone", label: "Draw a speed zone", key: "Z" },
  { name: "fence", label: "Draw a fence to stay inside of", key: "B" },
  { name: "several", label: "Select several by a box", key: "Q" },
  { name: "measure", label: "Measure", key: "M" },
  { name: "pan", label: "Move the map", key: "H" },
];

/** How the kind of obstacle is drawn that a tool makes; undefined if it makes another thing. @param {string} name */
export const shapeToolOf = (name) => DRAWN.find(({ shape }) => shape.key === name)?.tool;

/** Whether a tool puts corner after corner. @param {string} name */
export const goesByCorners = (name) => name === "zone" || name === "fence" || !!shapeToolOf(name)?.close;

/** Whether a tool sets something where the map is pressed. @param {string} name */
export const makes = (name) => name !== "select" && name !== "pan" && name !== "several";
