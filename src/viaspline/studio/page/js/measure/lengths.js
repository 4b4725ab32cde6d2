/** Lengths and directions between places in the plane. */

/** @param {number[]} a @param {number[]} b [m] */
export const lengthOf = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);

/** Clockwise from north, as a compass has it, from 0 to 360 [deg]. @param {number[]} a @param {number[]} b */
export const bearingOf = (a, b) => ((Math.atan2(b[0] - a[0], b[1] - a[1]) * 180) / Math.PI + 360) % 360;

/** Anticlockwise from x, as `heading_deg` has it, from -180 to 180 [deg]. @param {number[]} a @param {number[]} b */
export const headingOf = (a, b) => (Math.atan2(b[1] - a[1], b[0] - a[0]) * 180) / Math.PI;

/** @param {number[][]} line @returns {number} [m] */
export const sumOf = (line) => line.slice(1).reduce((sum, b, k) => sum + lengthOf(line[k], b), 0);
