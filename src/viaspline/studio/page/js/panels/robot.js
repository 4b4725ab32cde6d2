/** The robot's parts in fields: its body, its drive, its limits, its sensor. */

import { bodyOf, innerRadius } from "../core/mission.js";
import { choice, h, numberField, textField } from "./dom.js";

/** @typedef {(path: (string|number)[], value: unknown) => void} Set */

/**
 * A kind of drive, as the studio tells it: what it begins with, and its fields.
 * @typedef {{key: string, label: string, example: any, cannot: string, fields: {key: string, label: string, unit: string, step: number, min?: number, max?: number, placeholder?: string}[]}} DriveForm
 */

/** @param {any} doc @param {DriveForm[]} drives @param {Set} set @param {Node} preferred the slider below the clearance */
export function robotFields(doc, drives, set, preferred) {
  const robot = doc.robot ?? {};
  const field = (/** @type {string} */ label, /** @type {string} */ key, /** @type {string} */ unit, /** @type {any} */ more = {}) =>
    numberField({ label, unit, value: typeof robot[key] === "number" ? robot[key] : null, set: (value) => set(["robot", key], value), ...more });
  return [
    ...body(doc, set),
    h("div", { class: "pair" },
      field("Clearance", "clearance_m", "m", { min: 0, placeholder: "0.5", step: 0.05 }),
      field("Turning radius", "min_turn_radius_m", "m", { min: 0.001, placeholder: "no limit" })),
    preferred,
    h("div", { class: "pair" },
      field("Top speed", "max_speed_mps", "m/s", { min: 0.001, placeholder: "2" }),
      field("Acceleration", "max_accel_mps2", "m/s²", { min: 0.001, placeholder: "1" })),
    h("div", { class: "pair" },
      field("Across the path", "max_lateral_accel_mps2", "m/s²", { min: 0.001, placeholder: robot.max_lateral_accel_mps2 ?? "as along it" }),
      sensor(robot, set)),
    ...drive(robot, drives, set),
  ];
}

/** A disc with its radius, or a polygon with its corners. @param {any} doc @param {Set} set */
function body(doc, set) {
  const { robot = {} } = doc;
  const isPolygon = robot.footprint !== undefined && robot.footprint !== null;
  const { radius_m: _, footprint: __, ...rest } = robot;
  const change = (/** @type {string} */ kind) => {
    const now = bodyOf(doc);
    const r = Math.round((innerRadius(now) || 0.5) * 1e3) / 1e3;
    set(["robot"], kind === "disc" ? { radius_m: r, ...rest } : { footprint: [[-r, -r], [r, -r], [r, r], [-r, r]], ...rest });
  };
  return [
    h("div", { class: "pair" },
      choice({ label: "Body", value: isPolygon ? "polygon" : "disc", options: [["disc", "disc"], ["polygon", "polygon"]], set: change }),
      isPolygon ? null : numberField({ label: "Radius", unit: "m", value: typeof robot.radius_m === "number" ? robot.radius_m : null, min: 0, step: 0.05, placeholder: "0.5", set: (value) => set(["robot", "radius_m"], value) })),
    isPolygon ? textField({
      label: "Corners [m], x forward, y left", value: cornersText(robot.footprint), most: 4000,
      set: (text) => {
        const corners = cornersFrom(text);
        if (corners) set(["robot", "footprint"], corners);
        return corners !== null;
      },
    }) : null,
  ];
}

/** @param {any} robot @param {Set} set */
function sensor(robot, set) {
  const lidar = robot.sensor?.lidar;
  if (lidar) return numberField({ label: "Lidar range", unit: "m", value: lidar.range_m ?? null, min: 0.1, step: 1, set: (value) => value && set(["robot", "sensor", "lidar", "range_m"], value) });
  return numberField({ label: "Sensor range", unit: "m", value: robot.sensor?.range_m ?? null, min: 0.1, step: 1, placeholder: "none", set: (value) => set(["robot", "sensor"], value === null ? undefined : { ...robot.sensor, range_m: value }) });
}

/** What moves it. @param {any} robot @param {DriveForm[]} drives @param {Set} set */
function drive(robot, drives, set) {
  const form = drives.find(({ key }) => robot.drive?.[key]);
  const kind = form?.key ?? "";
  const manner = Object.fromEntries(Object.entries(robot.drive ?? {}).filter(([key]) => drives.every((other) => other.key !== key)));
  const fields = (form?.fields ?? []).map(({ key, ...field }) => numberField({
    ...field, value: robot.drive[kind][key] ?? null,
    set: (/** @type {number|null} */ value) => (value !== null || field.placeholder) && set(["robot", "drive", kind, key], value),
  }));
  const timing = (/** @type {string} */ label, /** @type {string} */ key) =>
    numberField({ label, unit: "s", value: robot.drive[key] ?? null, min: 0, max: 60, step: 0.05, placeholder: "0", set: (value) => set(["robot", "drive", key], value) });
  return [
    h("div", { class: "pair" },
      choice({
        label: "Drive", value: kind, options: [["", "follows exactly"], ...drives.map(({ key, label }) => /** @type {[string, string]} */ ([key, label]))],
        set: (value) => set(["robot", "drive"], value ? { [value]: drives.find(({ key }) => key === value)?.example, ...manner } : undefined),
      }),
      choice({
        label: "Turns on the spot", value: robot.turn_on_spot ?? "", options: [["", "as the drive"], ["never", "never"], ["stations", "at stations"], ["vias", "at via points"]],
        set: (value) => set(["robot", "turn_on_spot"], value || undefined),
      })),
    form ? h("div", { class: "pair", title: form.cannot }, ...fields, timing("Delay", "delay_s"), timing("Lag", "lag_s")) : null,
  ];
}

/** Corners as text. @param {unknown} corners */
function cornersText(corners) {
  if (!Array.isArray(corners)) return "";
  return corners.map((p) => (Array.isArray(p) ? p.join(" ") : String(p))).join(", ");
}

/** Corners from text, whatever stands between the numbers; null unless there are three pairs at least. @param {string} text */
function cornersFrom(text) {
  const numbers = text.split(/[\s,;()[\]]+/).filter(Boolean).map(Number);
  if (numbers.length < 6 || numbers.length % 2 || !numbers.every(Number.isFinite)) return null;
  return Array.from({ length: numbers.length / 2 }, (_, i) => [numbers[2 * i], numbers[2 * i + 1]]);
}
