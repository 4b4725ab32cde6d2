/** Lengths, times and speeds as people say them, as the command line does. */

/** @param {number|null|undefined} value @param {number} [digits] */
export function metres(value, digits = 2) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return "unlimited";
  if (Math.abs(value) >= 10000) return `${(value / 1000).toFixed(2)} km`;
  return `${value.toFixed(digits)} m`;
}

/** A proven clearance is rounded down: it promises no more than was proven. @param {number|null|undefined} value */
export function down(value) {
  if (value === null || value === undefined) return "unlimited";
  const digits = value < 10 ? 3 : 1;
  return metres(Math.floor(value * 10 ** digits + 1e-6) / 10 ** digits, digits);
}

/** @param {number|null|undefined} value */
export function seconds(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value < 100) return `${value.toFixed(1)} s`;
  const whole = Math.round(value);
  if (whole < 6000) return `${Math.floor(whole / 60)} min ${String(whole % 60).padStart(2, "0")} s`;
  return `${Math.floor(whole / 3600)} h ${String(Math.floor((whole % 3600) / 60)).padStart(2, "0")} min`;
}

/** A clock of the drive. @param {number} value */
export function clock(value) {
  const whole = Math.floor(value);
  return `${String(Math.floor(whole / 60)).padStart(2, "0")}:${String(whole % 60).padStart(2, "0")}.${Math.floor((value % 1) * 10)}`;
}

/** @param {number|null} value */
export function bend(value) {
  if (value === null || Math.abs(value) < 1e-9) return "straight";
  const radius = 1 / Math.abs(value);
  return radius > 10000 ? "nearly straight" : radius < 0.1 ? `r ${Number(radius.toPrecision(2))} m` : `r ${radius.toFixed(radius < 10 ? 2 : 1)} m`;
}

/** A length without the noise of sums [m]. @param {number} value */
export const tidy = (value) => Math.round(value * 1e4) / 1e4;

/** A number without needless zeros. @param {number} value @param {number} [digits] */
export const number = (value, digits = 3) => String(Number(value.toFixed(digits)));

/** @param {number[]} at */
export const place = (at) => `(${number(at[0], 2)}, ${number(at[1], 2)})`;
