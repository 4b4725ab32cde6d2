/** What a mission in space says of its robot, its altitude and where it looks, in fields. */

import { isSpatial } from "../core/heights.js";
import { choice, h, numberField } from "../panels/dom.js";

/** @typedef {(path: (string|number)[], value: unknown) => void} Set */

/** @param {any} doc @param {Set} set @returns {any[]} */
export function spaceFields(doc, set) {
  if (!isSpatial(doc)) return [];
  return [h("h3", {}, "In space"), ...robot(doc.robot ?? {}, set), ...altitude(doc.world?.altitude, set), ...yaw(doc.route?.yaw, set)];
}

/** @param {any} given @param {Set} set */
function robot(given, set) {
  const field = (/** @type {string} */ label, /** @type {string} */ key, /** @type {string} */ unit, /** @type {any} */ more) => numberField({
    label, unit, value: typeof given[key] === "number" ? given[key] : null, min: 0.001, ...more, set: (value) => set(["robot", key], value),
  });
  return [
    h("div", { class: "pair" }, field("Half height", "half_height_m", "m", { step: 0.05, placeholder: "a ball" }), field("Turns by at most", given.max_yaw_rate_degps === undefined ? "max_yaw_rate_dps" : "max_yaw_rate_degps", "°/s", { step: 5, placeholder: "no limit" })),
    h("div", { class: "pair" }, field("Climbs at", "max_climb_mps", "m/s", { placeholder: "as level" }), field("Descends at", "max_descent_mps", "m/s", { placeholder: "as it climbs" })),
    field("Acceleration up and down", "max_vertical_accel_mps2", "m/s²", { placeholder: "as level" }),
  ];
}

/** @param {any} band @param {Set} set */
function altitude(band, set) {
  const put = (/** @type {string} */ key) => (/** @type {unknown} */ value) => {
    const { [key]: _, ...rest } = band ?? {};
    const next = value === null || value === "" ? rest : { ...rest, [key]: value };
    set(["world", "altitude"], Object.keys(next).length ? next : undefined);
  };
  const one = (/** @type {string} */ label, /** @type {string} */ key) => numberField({
    label, unit: "m", step: 1, value: typeof band?.[key] === "number" ? band[key] : null, placeholder: "none", set: put(key),
  });
  return [
    h("div", { class: "pair" }, one("Altitude from", "min_m"), one("Altitude to", "max_m")),
    choice({ label: "Altitude counts from", value: band?.above ?? "home", options: [["home", "the ground at the start"], ["ground", "the ground below"], ["amsl", "zero of the heights"]], set: (value) => put("above")(value === "home" ? null : value) }),
  ];
}

/** @param {any} given @param {Set} set */
function yaw(given, set) {
  const kind = given?.to ? "to" : given?.fixed_deg !== undefined ? "fixed" : "along";
  const begin = { along: undefined, fixed: { fixed_deg: 0 }, to: { to: [0, 0, 0] } };
  return [
    choice({ label: "It looks", value: kind, options: [["along", "along its path"], ["to", "at a place"], ["fixed", "in one direction"]], set: (value) => set(["route", "yaw"], /** @type {any} */ (begin)[value]) }),
    kind === "fixed" ? numberField({ label: "Looks to", unit: "°", step: 5, value: given.fixed_deg, set: (value) => value !== null && set(["route", "yaw", "fixed_deg"], value) }) : null,
    kind === "to" ? h("div", { class: "triple" }, ...["x", "y", "z"].map((axis, k) => numberField({ label: `Looks at ${axis}`, unit: "m", value: given.to[k], step: 1, set: (value) => value !== null && set(["route", "yaw", "to", k], value) }))) : null,
  ];
}
