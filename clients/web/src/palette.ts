// Colours of levels, dark to bright: points between which they are interpolated.

type Colour = [number, number, number];

const POINTS: Record<string, Colour[]> = {
  // matplotlib's inferno at every eighth, of monotonic lightness.
  inferno: [[0, 0, 4], [31, 12, 72], [85, 15, 109], [136, 34, 106], [186, 54, 85], [227, 89, 51], [249, 140, 10], [249, 201, 50], [252, 255, 164]],
  depth: [[16, 16, 64], [27, 54, 120], [35, 98, 148], [54, 142, 151], [110, 178, 134], [190, 200, 110], [246, 214, 120], [255, 240, 200]],
  // As `ensonify plot waterfall`.
  copper: [[0, 0, 0], [58, 29, 8], [138, 75, 18], [207, 138, 44], [243, 200, 112], [255, 246, 220]],
};

/** Pixels (ABGR, as canvases store them on little-endian machines) of 256 steps. */
function ramp(name: string): Uint32Array {
  const points = POINTS[name];
  return Uint32Array.from({ length: 256 }, (_, i) => {
    const at = (i / 255) * (points.length - 1);
    const k = Math.min(Math.floor(at), points.length - 2);
    const [r, g, b] = [0, 1, 2].map((c) => Math.round(points[k][c] + (at - k) * (points[k + 1][c] - points[k][c])));
    return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
  });
}

export const RAMPS: Record<string, Uint32Array> = { inferno: ramp("inferno"), copper: ramp("copper") };
/** Depths from shoal (warm and light) to deep (cold and dark), of monotonic lightness. */
export const DEPTHS: Uint32Array = ramp("depth").reverse();
/** Pixels are made here and written by the processor: a canvas on a graphics card, or on one that is emulated, would be slower. */
export const IN_MEMORY: CanvasRenderingContext2DSettings = { willReadFrequently: true };
/** Colours of what is estimated and of what is true. */
export const ESTIMATE = "#6fe3ff";
export const TRUTH = "#ffb454";
export const EMPTY = 0xff2a2a2a; // where nothing was received, or no beam pointed
export const GAP = 0xff705030; // where lines are missing

export interface Limits {
  low_db: number;
  high_db: number;
}

/** A pixel for each value of view/1. */
export function pixels(name: string, floor_db: number, step_db: number, limits: Limits): Uint32Array {
  const table = new Uint32Array(256);
  table[0] = EMPTY;
  for (let n = 1; n < 256; ++n) {
    const level_db = floor_db + (n - 1) * step_db;
    const part = (level_db - limits.low_db) / Math.max(limits.high_db - limits.low_db, 1);
    table[n] = RAMPS[name][Math.max(0, Math.min(255, Math.round(255 * part)))];
  }
  return table;
}

/** Levels that so many percent of the received cells lie below. */
export function percentiles(level: Uint8Array, floor_db: number, step_db: number, low: number, high: number): Limits | null {
  const counts = new Uint32Array(256);
  for (let i = 0; i < level.length; ++i) ++counts[level[i]];
  let received = 0;
  for (let n = 1; n < 256; ++n) received += counts[n];
  if (!received) return null;
  const at = (percent: number) => {
    let left = (received * percent) / 100;
    for (let n = 1; n < 256; ++n) if ((left -= counts[n]) <= 0) return floor_db + (n - 1) * step_db;
    return floor_db + 254 * step_db;
  };
  const low_db = at(low);
  return { low_db, high_db: Math.max(at(high), low_db + 6) };
}
