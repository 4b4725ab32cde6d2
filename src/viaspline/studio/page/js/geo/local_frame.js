/**
 * East and north of an origin in the plane that touches the WGS 84 ellipsoid there, as
 * `viaspline.formats.local_frame` has them: latitudes and longitudes in degrees, lengths in metres.
 */

const A_M = 6378137;
const FLATTENING = 1 / 298.257223563;
const E2 = FLATTENING * (2 - FLATTENING);
const ROUNDS = 6;

/** How far from the origin a place may be; farther off, a flat frame is no map any more [m]. */
export const MAX_REACH_M = 500e3;

const rad = (/** @type {number} */ deg) => (deg * Math.PI) / 180;
const deg = (/** @type {number} */ angle) => (angle * 180) / Math.PI;

/** Of a place on the ground, about the earth's middle [m]. @param {number} lat @param {number} lon */
function ecef(lat, lon) {
  const [s, c] = [Math.sin(rad(lat)), Math.cos(rad(lat))];
  const n = A_M / Math.sqrt(1 - E2 * s * s);
  return [n * c * Math.cos(rad(lon)), n * c * Math.sin(rad(lon)), n * (1 - E2) * s];
}

/** Latitude, longitude and height of a place about the earth's middle. @param {number[]} p */
function geodetic([x, y, z]) {
  const p = Math.hypot(x, y);
  let lat = Math.atan2(z, p * (1 - E2));
  let height = 0;
  for (let i = 0; i < ROUNDS; i += 1) {
    const s = Math.sin(lat);
    const n = A_M / Math.sqrt(1 - E2 * s * s);
    height = p * Math.cos(lat) + z * s - A_M * Math.sqrt(1 - E2 * s * s);
    lat = Math.atan2(z, p * (1 - (E2 * n) / (n + height)));
  }
  return [deg(lat), deg(Math.atan2(y, x)), height];
}

export class LocalFrame {
  /** @param {number} lat of the origin @param {number} lon */
  constructor(lat, lon) {
    this.lat = lat;
    this.lon = lon;
    const [sp, cp, sl, cl] = [Math.sin(rad(lat)), Math.cos(rad(lat)), Math.sin(rad(lon)), Math.cos(rad(lon))];
    this.middle = ecef(lat, lon);
    this.east = [-sl, cl, 0];
    this.north = [-sp * cl, -sp * sl, cp];
    this.up = [cp * cl, cp * sl, sp];
  }

  /** Metres east and north of the origin. @param {number} lat @param {number} lon @returns {[number, number]} */
  toLocal(lat, lon) {
    const d = ecef(lat, lon).map((v, i) => v - this.middle[i]);
    const along = (/** @type {number[]} */ axis) => axis.reduce((sum, v, i) => sum + v * d[i], 0);
    return [along(this.east), along(this.north)];
  }

  /** Latitude and longitude of a place on the ground. @param {number[]} at x, y [m] @returns {[number, number]} */
  toGeodetic([x, y]) {
    let up = 0; // the ground lies below the plane
    let [lat, lon] = [this.lat, this.lon];
    for (let i = 0; i < ROUNDS; i += 1) {
      const place = this.middle.map((v, k) => v + x * this.east[k] + y * this.north[k] + up * this.up[k]);
      let height = 0;
      [lat, lon, height] = geodetic(place);
      up -= height;
    }
    return [lat, lon];
  }

  /** How far a place is from the origin over a globe [m], good to a percent. @param {number} lat @param {number} lon */
  arc(lat, lon) {
    const half = Math.sin(rad(lat - this.lat) / 2) ** 2 + Math.cos(rad(this.lat)) * Math.cos(rad(lat)) * Math.sin(rad(lon - this.lon) / 2) ** 2;
    return 2 * 6.371e6 * Math.asin(Math.sqrt(Math.min(half, 1)));
  }
}
