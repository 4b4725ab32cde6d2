/** Latitudes and longitudes as people write them. */

const READ_DIGITS = 6; // about 0.1 m
const EDITED_DIGITS = 8; // about a millimetre

/** For a readout. @param {number[]} pair latitude, longitude */
export const shortWords = (pair) => pair.map((value) => value.toFixed(READ_DIGITS)).join(", ");

/** For a field: typed again, it is the place it was. @param {number[]} pair */
export const exactWords = (pair) => pair.map((value) => String(Number(value.toFixed(EDITED_DIGITS)))).join(", ");

const BEFORE = /([NSEW])\s*/iy;
const AFTER = /\s*([NSEW])/iy;
const ANGLE = /([-+−]?\d+(?:\.\d+)?)(?:\s*[°º]\s*(?:(\d+(?:\.\d+)?)\s*['′’]\s*(?:(\d+(?:\.\d+)?)\s*(?:["″”]|''|′′))?)?)?/y;

/**
 * A pair out of a text: "47.1, 8.2", "47.1 8.2", "N 47.1 E 8.2", "47°06'N 8°12'E", in brackets or not.
 * @param {string} text @returns {[number, number]|null} latitude and longitude; null if it is none
 */
export function pairFrom(text) {
  const rest = text.trim().replace(/^[[(]|[\])]$/g, "").trim();
  const first = angleAt(rest, 0);
  if (!first) return null;
  const gap = /\s*[,;/]\s*|\s+|/y;
  gap.lastIndex = first.end;
  gap.exec(rest);
  if (gap.lastIndex === first.end && !first.side) return null; // nothing stands between them
  const second = angleAt(rest, gap.lastIndex);
  if (!second || second.end !== rest.length) return null;
  const isEast = (/** @type {string} */ side) => side === "E" || side === "W";
  if (!!first.side !== !!second.side || (first.side && isEast(first.side) === isEast(second.side))) return null;
  const [lat, lon] = isEast(first.side) ? [second.value, first.value] : [first.value, second.value];
  return Math.abs(lat) <= 90 && Math.abs(lon) <= 180 ? [lat, lon] : null;
}

/** @param {string} text @param {number} start */
function angleAt(text, start) {
  const before = matched(BEFORE, text, start);
  const found = matched(ANGLE, text, start + (before?.[0].length ?? 0));
  if (!found) return null;
  const [whole, degrees, minutes = "0", seconds = "0"] = found;
  const end = found.index + whole.length;
  const after = before ? null : matched(AFTER, text, end);
  if (Number(minutes) >= 60 || Number(seconds) >= 60) return null;
  const side = (before ?? after)?.[1].toUpperCase() ?? "";
  const isMinus = /^[-−]/.test(degrees);
  if (side && isMinus) return null; // south of south
  const size = Math.abs(Number(degrees.replace("−", "-"))) + Number(minutes) / 60 + Number(seconds) / 3600;
  return { value: isMinus || side === "S" || side === "W" ? -size : size, side, end: end + (after?.[0].length ?? 0) };
}

/** What stands at a place of a text. @param {RegExp} pattern @param {string} text @param {number} start */
function matched(pattern, text, start) {
  pattern.lastIndex = start;
  return pattern.exec(text);
}

/** Two numbers out of a text: "12.5, 30" or "12.5 30". @param {string} text @returns {[number, number]|null} */
export function numbersFrom(text) {
  const found = text.trim().match(/^\(?\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*[,;\s]\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*\)?$/i);
  const pair = found ? [Number(found[1]), Number(found[2])] : [NaN];
  return pair.every(Number.isFinite) ? /** @type {[number, number]} */ (pair) : null;
}
