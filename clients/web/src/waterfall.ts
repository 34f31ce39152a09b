// A waterfall: the newest ping at the top, port to the left and starboard to the right, slant range. Of a single beam (an
// echogram) the range grows from left to right.
import { View } from "./messages";
import { EMPTY, GAP, IN_MEMORY, Limits, percentiles, pixels } from "./palette";

const LINES = 1024; // kept
const SIDE = 1024; // pixels of a side in the kept picture

interface Line {
  view: View | null; // null: pings that did not come
  ping: number;
}

export class Waterfall {
  limits: Limits | null = null;
  gaps = 0; // pings that did not come, in all
  private lines: Line[] = []; // newest first
  private ring = document.createElement("canvas");
  private row = document.createElement("canvas");
  private head = 0; // row of the ring that comes next
  private fixed = false;

  constructor(private canvas: HTMLCanvasElement) {
    this.ring.width = 2 * SIDE;
    this.ring.height = LINES;
  }

  private beams(view: View) {
    const angles = view.beam_angle_rad.data;
    const port = angles[0] <= angles[angles.length - 1] ? 0 : angles.length - 1;
    return { port, starboard: angles.length - 1 - port };
  }

  add(view: View) {
    const last = this.lines.find((line) => line.view);
    if (last?.view && view.ping > last.ping + 1) {
      this.gaps += view.ping - last.ping - 1;
      this.put({ view: null, ping: view.ping - 1 });
    }
    if (last?.view && view.ping <= last.ping) this.clear(); // another run
    this.put({ view, ping: view.ping });
    if (!this.fixed && (this.lines.length < 40 || this.lines.length % 64 === 0)) this.judge();
  }

  clear() {
    this.lines = [];
    this.gaps = 0;
    this.head = 0;
    const context = this.ring.getContext("2d", IN_MEMORY)!;
    context.clearRect(0, 0, this.ring.width, this.ring.height);
  }

  setLimits(limits: Limits | null) {
    this.fixed = limits !== null;
    this.limits = limits;
    if (!limits) this.judge();
    else this.repaint();
  }

  /** By the newest lines. */
  private judge() {
    const found = this.lines.slice(0, 100).flatMap(({ view }) => {
      const limits = view && percentiles(view.level.data, view.level_floor_db, view.level_step_db, 25, 99.7);
      return limits ? [limits] : [];
    });
    if (!found.length) return;
    const middle = (values: number[]) => values.sort((a, b) => a - b)[values.length >> 1];
    const limits = { low_db: middle(found.map((l) => l.low_db)), high_db: middle(found.map((l) => l.high_db)) };
    const near = this.limits && Math.abs(limits.low_db - this.limits.low_db) < 2 && Math.abs(limits.high_db - this.limits.high_db) < 2;
    if (near) return;
    this.limits = limits;
    this.repaint();
  }

  repaint() {
    const lines = this.lines.slice().reverse();
    this.head = 0;
    for (const line of lines) this.paint(line);
  }

  private put(line: Line) {
    this.lines.unshift(line);
    if (this.lines.length > LINES) this.lines.pop();
    this.paint(line);
  }

  private paint({ view }: Line) {
    const context = this.ring.getContext("2d", IN_MEMORY)!;
    const y = this.head;
    this.head = (this.head + 1) % LINES;
    context.clearRect(0, y, 2 * SIDE, 1);
    if (!view) {
      context.fillStyle = `#${(GAP & 0xff).toString(16).padStart(2, "0")}${((GAP >> 8) & 0xff).toString(16).padStart(2, "0")}${((GAP >> 16) & 0xff).toString(16).padStart(2, "0")}`;
      context.fillRect(0, y, 2 * SIDE, 1);
      return;
    }
    const cells = view.level.shape[1];
    const { port, starboard } = this.beams(view);
    const table = pixels("copper", view.level_floor_db, view.level_step_db, this.limits ?? { low_db: 0, high_db: 1 });
    const single = port === starboard;
    const wide = single ? cells : 2 * cells;
    const image = new ImageData(wide, 1);
    const out = new Uint32Array(image.data.buffer).fill(EMPTY);
    const level = view.level.data;
    for (let i = 0; i < cells; ++i) {
      if (!single) out[cells - 1 - i] = table[level[port * cells + i]];
      out[(single ? 0 : cells) + i] = table[level[starboard * cells + i]];
    }
    this.row.width = wide;
    this.row.height = 1;
    this.row.getContext("2d", IN_MEMORY)!.putImageData(image, 0, 0);
    context.drawImage(this.row, 0, 0, wide, 1, 0, y, 2 * SIDE, 1);
  }

  get single(): boolean {
    return this.lines.find((line) => line.view)?.view?.level.shape[0] === 1;
  }

  /** Slant range at either edge: that of the newest line. */
  get reach_m(): number {
    const view = this.lines.find((line) => line.view)?.view;
    return view ? view.first_range_m + view.level.shape[1] * view.cell_m : 0;
  }

  draw() {
    const { width, height } = this.canvas;
    const context = this.canvas.getContext("2d", IN_MEMORY)!;
    context.fillStyle = "#101418";
    context.fillRect(0, 0, width, height);
    context.imageSmoothingEnabled = false;
    // Newest on top: the ring upside down, in up to two pieces, a line a pixel.
    const shown = Math.min(height, this.lines.length);
    context.save();
    context.scale(1, -1);
    let row = this.head - 1;
    for (let drawn = 0; drawn < shown;) {
      if (row < 0) row += LINES;
      const count = Math.min(shown - drawn, row + 1);
      context.drawImage(this.ring, 0, row + 1 - count, 2 * SIDE, count, 0, -(drawn + count), width, count);
      drawn += count;
      row -= count;
    }
    context.restore();
  }

  /** Side, slant range, ping and level at a pixel. */
  placeOf(x: number, y: number) {
    const line = this.lines[Math.floor(y)];
    if (!line?.view || x < 0 || x >= this.canvas.width) return null;
    const view = line.view;
    const cells = view.level.shape[1];
    const { port, starboard } = this.beams(view);
    const single = port === starboard;
    const part = single ? x / this.canvas.width : (2 * x) / this.canvas.width - 1;
    const cell = Math.min(cells - 1, Math.floor(Math.abs(part) * cells));
    const value = view.level.data[(part < 0 ? port : starboard) * cells + cell];
    return {
      side: single ? "" : part < 0 ? "port, " : "starboard, ", kind: view.ground_altitude_m > 0 ? "ground" : "slant",
      range_m: view.first_range_m + Math.abs(part) * cells * view.cell_m, ping: line.ping,
      stamp_ns: view.stamp_ns, level_db: value ? view.level_floor_db + (value - 1) * view.level_step_db : null,
    };
  }
}
