/** A colour for each robot of a fleet: as far apart as they get, and never the only thing that tells two apart. */

// Okabe and Ito's, darker where they have to stand on white; beyond them hues by the golden angle.
const LIGHT = ["#0072b2", "#c2540a", "#008f68", "#a0468c", "#8a6200", "#2a8fc9", "#7a4cc2"];
const DARK = ["#56b4e9", "#ff9a5c", "#2ed3a2", "#d98cc8", "#f0b429", "#8fd0ff", "#b79cf0"];
const GOLDEN_ANGLE_DEG = 137.508;

/** @param {number} index of the robot @param {boolean} isDark */
export function robotColour(index, isDark) {
  const few = isDark ? DARK : LIGHT;
  if (index < few.length) return few[index];
  const hue = (index * GOLDEN_ANGLE_DEG) % 360;
  const light = (isDark ? 66 : 36) + 6 * ((index % 3) - 1);
  return `hsl(${hue.toFixed(0)} 70% ${light}%)`;
}
