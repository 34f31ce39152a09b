// A strip chart: numbers of one field and unit over sim time, each in a colour of its own.
import uPlot from "uplot";
import { Series } from "./series";

export interface Line {
  name: string;
  colour: string;
}

const FAINT = "#93a1b0";
const GRID = "#2c3540";
const GAP_REACHES_NEIGHBOURS = 2; // uPlot's NULL_EXPAND: a gap covers the times of other lines as well
const HALF_TURN_DEG = 180;

/** Values of a heading that passes north: a gap instead of a line across the strip. */
function withoutJumps({ unit, time_s, value }: Series): [number[], (number | null)[]] {
  if (unit !== "deg") return [time_s, value];
  const times: number[] = [];
  const values: (number | null)[] = [];
  value.forEach((now, i) => {
    const before = value[i - 1];
    if (now != null && before != null && Math.abs(now - before) > HALF_TURN_DEG) {
      times.push((time_s[i - 1] + time_s[i]) / 2);
      values.push(null);
    }
    times.push(time_s[i]);
    values.push(now);
  });
  return [times, values];
}

const LEAST_S = 1; // of time
const LEAST = 1e-6; // of values
const LEAST_PART = 1e-4; // of a value

/** As wide at least: uPlot counts ticks without end where they are not numbers apart. */
function wide(low: number, high: number, least: number): [number, number] {
  const lack = (least - (high - low)) / 2;
  return lack > 0 ? [low - lack, high + lack] : [low, high];
}

/** The scale of values, with a tenth of room. */
function range(_: uPlot, low: number | null, high: number | null): uPlot.Range.MinMax {
  if (low == null || high == null) return [null, null];
  return uPlot.rangeNum(...wide(low, high, LEAST + LEAST_PART * Math.max(Math.abs(low), Math.abs(high))), 0.1, true);
}

export class Strip {
  private plot: uPlot;

  /** `pointed` is given the sim time under the cursor, of this strip or another; null: none. */
  constructor(private place: HTMLElement, lines: Line[], pointed: (time_s: number | null) => void) {
    const axis = { stroke: FAINT, grid: { stroke: GRID, width: 1 }, ticks: { stroke: GRID, width: 1, size: 4 }, gap: 3, font: "11px sans-serif" };
    this.plot = new uPlot(
      {
        width: Math.max(80, place.clientWidth), height: Math.max(60, place.clientHeight),
        legend: { show: false }, scales: { x: { time: false, range: (_, first, last) => (first == null ? [null, null] : wide(first, last, LEAST_S)) }, y: { range } }, padding: [6, 8, 0, 0],
        cursor: { sync: { key: "numbers" }, drag: { x: false, y: false }, points: { show: false } },
        axes: [{ ...axis, size: 22, values: (_, ticks) => ticks.map((t) => `${t} s`) }, { ...axis, size: 56 }],
        series: [{}, ...lines.map(({ colour }) => ({ stroke: colour, width: 1.5, points: { show: false } }))],
        hooks: {
          setCursor: [(u: uPlot) => pointed(u.cursor.left != null && u.cursor.left >= 0 ? u.posToVal(u.cursor.left, "x") : null)],
          draw: [() => this.say()],
        },
      },
      [[], ...lines.map(() => [])] as unknown as uPlot.AlignedData,
      place,
    );
  }

  draw(series: (Series | undefined)[]) {
    const tables = series.map((one) => (one ? withoutJumps(one) : [[], []])) as uPlot.AlignedData[];
    this.plot.setData(tables.length === 1 ? tables[0] : uPlot.join(tables, tables.map(() => [0, GAP_REACHES_NEIGHBOURS])));
  }

  resize() {
    this.plot.setSize({ width: Math.max(80, this.place.clientWidth), height: Math.max(60, this.place.clientHeight) });
  }

  /** What the strip covers, in numbers: for who cannot see it, and for tests. */
  private say() {
    const { left, top, width, height } = this.plot.bbox;
    const { x, y } = this.plot.scales;
    this.place.dataset.box = [left, top, width, height].join(" ");
    this.place.dataset.time = `${x.min} ${x.max}`;
    this.place.dataset.value = `${y.min} ${y.max}`;
  }

  destroy() {
    this.plot.destroy();
  }
}

/** The newest value at or before a time; null: a gap, or nothing. */
export function valueAt(series: Series | undefined, time_s: number): number | null {
  if (!series) return null;
  let low = 0;
  let high = series.time_s.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (series.time_s[middle] <= time_s) low = middle + 1;
    else high = middle;
  }
  return low ? series.value[low - 1] : null;
}
