/** Colours of the 3-D view, for light and dark screens. */

import { isDark, theme } from "../../draw/theme.js";

const LIGHT = { sky: "#eef2f6", ground: "#d8ccb0", flat: "#e6e9ed", prism: "#b6bdc7", edge: "#5d6772", cable: "#6b4f9a", voxelLow: "#c9ced6", voxelHigh: "#5b6470", band: "#b58900", unseen: "#e58a4e" };
const DARK = { sky: "#0f1318", ground: "#4c4433", flat: "#1a2027", prism: "#566070", edge: "#a3aebb", cable: "#bfa3ea", voxelLow: "#3a434f", voxelHigh: "#aab4c0", band: "#d9a520", unseen: "#b5622f" };

/** What the theme has, and what only stands in space. */
export const solidColours = () => ({ ...theme(), ...(isDark() ? DARK : LIGHT) });

/** @typedef {ReturnType<typeof solidColours>} SolidColours */
