// A fan: every pixel shows the nearest beam at its range. Drawn as the head has it, along its own axis: to scale (polar), or with
// beams from left to right and ranges from one edge to the other (rectangular).
import { View } from "./messages";
import { EMPTY, IN_MEMORY, Limits, pixels } from "./palette";

/** Colours of detections by their kind: neither, by amplitude, by phase. */
export const FINDS = ["#ffffff", "#6fe3ff", "#7fd6a4"];

export interface Place {
  across_m: number; // positive to starboard
  along_m: number; // down or forward, as the head's beam angles count
  range_m: number;
  angle_rad: number;
  beam: number;
  level_db: number | null; // null: nothing was received there
}

interface Polar {
  range: number;
  angle: number;
}

/** Between pixels of the canvas and ranges and angles of the head. */
interface Frame {
  polarOf(x: number, y: number): Polar;
  pixelOf(polar: Polar): [number, number];
}

/** To scale: a part of the plane, from its upper left corner. */
function toScale(left_m: number, top_m: number, metre_px: number, upward: boolean): Frame {
  const down = upward ? -1 : 1;
  return {
    polarOf(x, y) {
      const across = left_m + x / metre_px;
      const along = top_m + (down * y) / metre_px;
      return { range: Math.hypot(across, along), angle: Math.atan2(across, along) };
    },
    pixelOf: ({ range, angle }) => [(range * Math.sin(angle) - left_m) * metre_px, down * (range * Math.cos(angle) - top_m) * metre_px],
  };
}

function rectangle(width: number, height: number, first: number, last: number, far_m: number, upward: boolean): Frame {
  const turned = (y: number) => (upward ? height - y : y);
  return {
    polarOf: (x, y) => ({ range: (turned(y) / height) * far_m, angle: first + (x / width) * (last - first) }),
    pixelOf: ({ range, angle }) => [((angle - first) / (last - first)) * width, turned((range / far_m) * height)],
  };
}

export class FanPicture {
  rectangular = false;
  upright = false; // angles swing with the head's roll: the picture keeps its frame
  private frame: Frame = toScale(0, 0, 1, false);
  private view: View | null = null;
  private cellOfPixel = new Int32Array(0);
  private mapped = "";
  private swung = { key: "", first: 0, last: 0 }; // farthest angles so far

  /** Cells for this canvas: somewhat finer than its pixels, so that the source averages and no pixel skips a cell. */
  get cells(): number {
    return Math.max(64, Math.min(1024, Math.ceil(1.5 * this.radius_px)));
  }
  private radius_px = 1024;

  constructor(private canvas: HTMLCanvasElement) {}

  /** Which cell every pixel shows; made anew when the geometry changes. */
  private map(view: View) {
    const { width, height } = this.canvas;
    const [beams, cells] = view.level.shape;
    const angles = view.beam_angle_rad.data;
    const key = [width, height, beams, cells, view.first_range_m, view.cell_m, view.beam_axis, this.rectangular, this.upright, angles.join()].join(";");
    if (key === this.mapped) return;
    this.mapped = key;
    const order = Array.from(angles.keys()).sort((a, b) => angles[a] - angles[b]);
    const sorted = order.map((beam) => angles[beam]);
    const first = sorted[0] - (sorted[1] - sorted[0]) / 2;
    const last = sorted[beams - 1] + (sorted[beams - 1] - sorted[beams - 2]) / 2;
    const far_m = view.first_range_m + cells * view.cell_m;
    const [least, most] = this.upright ? this.reach(first, last, `${beams} ${far_m} ${this.rectangular}`) : [first, last];
    const inside = (angle: number) => first <= angle && angle <= last;
    const shown = (angle: number) => least <= angle && angle <= most;
    const left = shown(-Math.PI / 2) ? -far_m : Math.min(0, far_m * Math.sin(least));
    const right = shown(Math.PI / 2) ? far_m : Math.max(0, far_m * Math.sin(most));
    const near = Math.min(0, far_m * Math.cos(Math.max(Math.abs(least), Math.abs(most))));
    const far = shown(0) ? far_m : far_m * Math.max(Math.cos(least), Math.cos(most));
    const upward = view.beam_axis === "forward";
    if (this.rectangular) {
      this.radius_px = height;
      this.frame = rectangle(width, height, least, most, far_m, upward);
    } else {
      const metre_px = Math.min(width / (right - left), height / (far - near));
      this.radius_px = metre_px * far_m;
      this.frame = toScale((left + right) / 2 - width / metre_px / 2, upward ? far : near, metre_px, upward);
    }
    this.cellOfPixel = new Int32Array(width * height).fill(-1);
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const { range, angle } = this.frame.polarOf(x + 0.5, y + 0.5);
        const cell = Math.floor((range - view.first_range_m) / view.cell_m);
        if (cell < 0 || cell >= cells || !inside(angle)) continue;
        let low = 0;
        let high = beams - 1;
        while (low < high) {
          const middle = (low + high) >> 1;
          if ((sorted[middle] + sorted[middle + 1]) / 2 < angle) low = middle + 1;
          else high = middle;
        }
        this.cellOfPixel[y * width + x] = order[low] * cells + cell;
      }
    }
  }

  private reach(first: number, last: number, key: string): [number, number] {
    const known = this.swung.key === key ? this.swung : { first, last };
    this.swung = { key, first: Math.min(known.first, first), last: Math.max(known.last, last) };
    return [this.swung.first, this.swung.last];
  }

  draw(view: View, limits: Limits) {
    this.view = view;
    const context = this.canvas.getContext("2d", IN_MEMORY)!;
    const { width, height } = this.canvas;
    const beams = view.level.shape[0];
    if (beams < 2 || !width || !height) return;
    this.map(view);
    const image = context.createImageData(width, height);
    const out = new Uint32Array(image.data.buffer);
    const table = pixels("inferno", view.level_floor_db, view.level_step_db, limits);
    const level = view.level.data;
    const cell = this.cellOfPixel;
    for (let i = 0; i < out.length; ++i) out[i] = cell[i] < 0 ? EMPTY : table[level[cell[i]]];
    context.putImageData(image, 0, 0);
  }

  /** A dot at every detection. */
  drawFinds() {
    const view = this.view;
    if (!view) return;
    const context = this.canvas.getContext("2d", IN_MEMORY)!;
    for (let i = 0; i < view.find_range_m.data.length; ++i) {
      const [x, y] = this.frame.pixelOf({ range: view.find_range_m.data[i], angle: view.find_angle_rad.data[i] });
      context.fillStyle = FINDS[view.find_kind.data[i]] ?? FINDS[0];
      context.fillRect(Math.round(x) - 1, Math.round(y) - 1, 3, 3);
    }
  }

  /** Where a pixel of the canvas is, and its level. */
  placeOf(x: number, y: number): Place | null {
    const view = this.view;
    if (!view || x < 0 || y < 0 || x >= this.canvas.width || y >= this.canvas.height) return null;
    const { range, angle } = this.frame.polarOf(x, y);
    const cell = this.cellOfPixel[Math.floor(y) * this.canvas.width + Math.floor(x)];
    const cells = view.level.shape[1];
    const value = cell < 0 ? 0 : view.level.data[cell];
    return {
      across_m: range * Math.sin(angle), along_m: range * Math.cos(angle), range_m: range, angle_rad: angle,
      beam: cell < 0 ? -1 : Math.floor(cell / cells),
      level_db: value ? view.level_floor_db + (value - 1) * view.level_step_db : null,
    };
  }
}
