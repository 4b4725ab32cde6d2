/** What variants of a mission differ in: what the user picks of it, and the edit that makes each. */

import { forceSide, replaced, withSpline } from "../core/edits.js";
import { isSpatial } from "../core/heights.js";
import { number } from "../units.js";

/** @typedef {{name: string, make: (doc: any) => any}} Variant */
/**
 * @typedef {object} VariantKind
 * @property {string} key
 * @property {string} label
 * @property {string|null} usual values to begin with; null where there is nothing to type
 * @property {(values: number[]) => Variant[]} variants
 * @property {(value: number) => string|null} fault what is wrong with a value
 */

const LOOSEST = -199;

/** The kinds of variants that a mission has. @param {any} doc @param {any[]} ledger @returns {VariantKind[]} */
export function kindsOf(doc, ledger) {
  const clearance = Number(doc.robot?.clearance_m ?? 0.5);
  /** @type {VariantKind[]} */ const kinds = [
    {
      key: "clearance", label: "Clearance [m]", usual: `${number(clearance / 2)}, ${number(clearance * 2)}`,
      variants: (values) => values.map((value) => ({ name: `clearance ${number(value)} m`, make: (/** @type {any} */ d) => replaced(d, ["robot", "clearance_m"], value) })),
      fault: (value) => (value >= 0 ? null : "a clearance is 0 or more"),
    },
    {
      key: "tension", label: "Tension", usual: "-0.5, 0, 0.5",
      variants: (values) => values.map((value) => ({ name: `tension ${number(value)}`, make: (/** @type {any} */ d) => withSpline(d, value) })),
      fault: (value) => (value <= 1 && value >= LOOSEST ? null : `a tension lies between ${LOOSEST} and 1`),
    },
  ];
  for (const entry of ledger.filter((one) => one.forceable)) {
    const name = entry.members.length > 2 ? `${entry.members[0]} and ${entry.members.length - 1} more` : entry.members.join(" and ");
    const sides = isSpatial(doc) ? entry.candidates.map((/** @type {any} */ c) => c.side).filter((/** @type {string} */ side) => side !== "straight") : ["left", "right"];
    const key = `side:${entry.items.join()}`;
    if (kinds.some((kind) => kind.key === key)) continue;
    kinds.push({
      key, label: `Sides of ${name}`, usual: null,
      variants: () => sides.map((/** @type {string} */ side) => ({ name: `${name}: ${side}`, make: (/** @type {any} */ d) => forceSide(d, entry.items, side) })),
      fault: () => null,
    });
  }
  return kinds;
}

/** Numbers as they are typed, with commas or spaces between them; null if one of them is none. @param {string} text @returns {number[]|null} */
export function numbersIn(text) {
  const parts = text.replaceAll("−", "-").split(/[\s,;]+/).filter(Boolean);
  const values = parts.map(Number);
  return values.length && values.every(Number.isFinite) ? values : null;
}
