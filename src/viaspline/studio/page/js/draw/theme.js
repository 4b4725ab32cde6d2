/**
 * Colours of what is drawn, for light and dark screens: Okabe and Ito's, which stay apart for every
 * common kind of colour blindness. What matters differs in shape, dash or words as well.
 */

const LIGHT = {
  paper: "#fbfcfd", outside: "#eceff3", grid: "rgba(40,60,90,0.07)", gridBold: "rgba(40,60,90,0.14)",
  ink: "#1b1f24", muted: "#5b6570", label: "#1b1f24", halo: "#f0f2f5", haloEdge: "#b3bcc7",
  obstacle: "#aeb5bf", obstacleEdge: "#4d5661", unknown: "#dfe3e8", bounds: "#6f7985",
  path: "#0072b2", casing: "#ffffff", stale: "#8a939e", detour: "#e69f00", loser: "#a0468c",
  tightest: "#d55e00", unseen: "#c24e00", unseenFill: "#fbe3d3", start: "#008f68", goal: "#1b1f24",
  station: "#f0e442", sensor: "#56b4e9", sensorFill: "rgba(86,180,233,0.18)", robot: "#d55e00",
  select: "#0b63ce", selectSoft: "rgba(11,99,206,0.16)", plate: "rgba(255,255,255,0.86)", comb: "#7d6590",
  problem: "#b3261e", driven: "#0072b2", zone: "#8a6200", zoneFill: "rgba(230,159,0,0.13)",
  corridor: "#00795a", corridorFill: "rgba(0,158,115,0.06)", swept: "rgba(0,114,178,0.13)",
  moving: "#c2410c", movingFill: "#f6c7a8", movingTube: "#fbe6d8",
  contour: "rgba(138,115,80,0.5)", contourText: "#7a6540", ground: "rgba(205,185,143,0.5)",
};

const DARK = {
  paper: "#12161b", outside: "#0b0e12", grid: "rgba(190,210,240,0.055)", gridBold: "rgba(190,210,240,0.12)",
  ink: "#e8ecf1", muted: "#9aa5b1", label: "#e8ecf1", halo: "#1b2129", haloEdge: "#475362",
  obstacle: "#4b5563", obstacleEdge: "#a3aebb", unknown: "#262d36", bounds: "#8793a0",
  path: "#56b4e9", casing: "#12161b", stale: "#77828e", detour: "#f0b429", loser: "#d98cc8",
  tightest: "#ff8d4d", unseen: "#ff9d66", unseenFill: "#46301f", start: "#2ed3a2", goal: "#e8ecf1",
  station: "#f0e442", sensor: "#56b4e9", sensorFill: "rgba(86,180,233,0.15)", robot: "#ff8d4d",
  select: "#7ab8ff", selectSoft: "rgba(122,184,255,0.2)", plate: "rgba(18,22,27,0.82)", comb: "#b69cd0",
  problem: "#ff8a80", driven: "#56b4e9", zone: "#f0b429", zoneFill: "rgba(240,180,41,0.12)",
  corridor: "#2ed3a2", corridorFill: "rgba(46,211,162,0.06)", swept: "rgba(86,180,233,0.15)",
  moving: "#ff9a5c", movingFill: "#7a3f1d", movingTube: "#3a2a20",
  contour: "rgba(200,175,130,0.38)", contourText: "#c9b083", ground: "rgba(140,118,80,0.4)",
};

/** @typedef {typeof LIGHT} Theme */

const query = matchMedia("(prefers-color-scheme: dark)");

/** @returns {Theme} */
export const theme = () => (query.matches ? DARK : LIGHT);

/** Whether the screen is dark. */
export const isDark = () => query.matches;

/** @param {() => void} listener */
export const onTheme = (listener) => query.addEventListener("change", listener);

const VIRIDIS = [
  [68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121],
  [110, 206, 88], [181, 222, 43], [253, 231, 37],
];

/** A colour of viridis. @param {number} part from 0 to 1 */
export function viridis(part) {
  const at = Math.min(Math.max(part, 0), 1) * (VIRIDIS.length - 1);
  const i = Math.min(Math.floor(at), VIRIDIS.length - 2), t = at - i;
  const [r, g, b] = VIRIDIS[i].map((c, k) => Math.round(c + t * (VIRIDIS[i + 1][k] - c)));
  return `rgb(${r},${g},${b})`;
}
