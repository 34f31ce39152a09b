// Colours of levels and depths, dark to bright: points between which they are interpolated. All but the rainbow grow by even steps of
// lightness (CIE L*), and grow for colour-blind eyes as well (tests/console/light_test.py).
import { colours } from "./light";

type Colour = [number, number, number];

const POINTS: Record<string, Colour[]> = {
  inferno: [[0, 0, 4], [21, 11, 56], [44, 11, 87], [71, 11, 106], [99, 20, 110], [127, 30, 108], [155, 40, 101], [182, 52, 88], [206, 67, 71], [225, 87, 53], [239, 109, 34], [248, 134, 14], [252, 160, 8], [251, 186, 32], [247, 212, 65], [242, 236, 111], [252, 255, 164]], // matplotlib's
  copper: [[0, 0, 0], [31, 16, 4], [51, 25, 7], [70, 36, 9], [89, 47, 12], [109, 58, 14], [130, 70, 17], [148, 84, 22], [165, 100, 28], [182, 116, 35], [200, 132, 41], [214, 149, 57], [225, 169, 78], [236, 188, 99], [245, 207, 129], [250, 227, 175], [255, 246, 220]], // as `ensonify plot waterfall`
  depth: [[16, 16, 64], [20, 28, 82], [23, 40, 100], [27, 53, 119], [30, 68, 129], [32, 84, 139], [36, 99, 148], [43, 116, 149], [50, 133, 150], [65, 149, 148], [89, 164, 140], [115, 179, 133], [156, 191, 120], [194, 201, 111], [230, 210, 117], [249, 224, 149], [255, 240, 200]],
  rainbow: [[48, 18, 59], [63, 62, 156], [70, 105, 224], [67, 145, 254], [42, 185, 238], [24, 219, 197], [47, 241, 155], [105, 253, 102], [161, 253, 61], [203, 237, 52], [236, 209, 58], [253, 174, 53], [251, 129, 34], [236, 83, 15], [210, 49, 5], [172, 23, 1], [122, 4, 3]], // Google's turbo
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

const RAMPS: Record<string, Uint32Array> = Object.fromEntries(Object.keys(POINTS).map((name) => [name, ramp(name)]));
/** Shoal (the first) is warm, deep is cold. */
const DEPTHS = RAMPS.depth.slice().reverse();
const RAINBOW_DEPTHS = RAMPS.rainbow.slice().reverse();

/** 256 colours of levels, in the colours that were chosen. */
export const levelColours = (name: string): Uint32Array => RAMPS[colours.value === "rainbow" ? "rainbow" : name];
/** 256 colours of depths, from shoal to deep. */
export const depthColours = (): Uint32Array => (colours.value === "rainbow" ? RAINBOW_DEPTHS : DEPTHS);
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
  const steps = levelColours(name);
  table[0] = EMPTY;
  for (let n = 1; n < 256; ++n) {
    const level_db = floor_db + (n - 1) * step_db;
    const part = (level_db - limits.low_db) / Math.max(limits.high_db - limits.low_db, 1);
    table[n] = steps[Math.max(0, Math.min(255, Math.round(255 * part)))];
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
