// The A-scan: the levels of one beam over slant range.
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { View } from "./messages";

const FAINT = "#93a1b0";
const GRID = "#2c3540";
const LINE = "#f9c932";

/** Range of the middle of each cell, and its level; null: nothing was received there. */
function levelsOf(view: View, beam: number): [number[], (number | null)[]] {
  const cells = view.level.shape[1];
  const ranges: number[] = [];
  const levels: (number | null)[] = [];
  for (let i = 0; i < cells; ++i) {
    const value = view.level.data[beam * cells + i];
    ranges.push(view.first_range_m + (i + 0.5) * view.cell_m);
    levels.push(value ? view.level_floor_db + (value - 1) * view.level_step_db : null);
  }
  return [ranges, levels];
}

/** `pointed_m`: slant range under the fan's cursor. */
export function AScan({ view, beam, pointed_m, gain }: { view: View; beam: number; pointed_m: number | null; gain: string }) {
  const place = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const mark = useRef<number | null>(null);
  mark.current = pointed_m;
  useEffect(() => {
    const element = place.current!;
    const size = () => ({ width: Math.max(80, element.clientWidth), height: Math.max(60, element.clientHeight) });
    const axis = { stroke: FAINT, grid: { stroke: GRID, width: 1 }, ticks: { stroke: GRID, width: 1, size: 4 }, gap: 3, font: "11px sans-serif" };
    const made = new uPlot(
      {
        ...size(), legend: { show: false }, scales: { x: { time: false } }, padding: [6, 8, 0, 0], cursor: { show: false },
        axes: [{ ...axis, size: 22, values: (_, ticks) => ticks.map((t) => `${t} m`) }, { ...axis, size: 56, values: (_, ticks) => ticks.map((t) => `${t} dB`) }],
        series: [{}, { stroke: LINE, width: 1, points: { show: false } }],
        hooks: {
          draw: [(u: uPlot) => {
            const { left, top, width, height } = u.bbox;
            element.dataset.box = [left, top, width, height].join(" ");
            element.dataset.range = `${u.scales.x.min} ${u.scales.x.max}`;
            element.dataset.level = `${u.scales.y.min} ${u.scales.y.max}`;
            if (mark.current == null) return;
            u.ctx.fillStyle = FAINT;
            u.ctx.fillRect(Math.round(u.valToPos(mark.current, "x", true)), top, 1, height);
          }],
        },
      },
      [[], []],
      element,
    );
    plot.current = made;
    const observer = new ResizeObserver(() => made.setSize(size()));
    observer.observe(element);
    return () => {
      observer.disconnect();
      made.destroy();
    };
  }, []);
  const [ranges, levels] = levelsOf(view, beam);
  useEffect(() => plot.current?.setData([ranges, levels]), [view, beam, pointed_m]);
  let best = -1;
  levels.forEach((level, i) => {
    if (level != null && (best < 0 || level > levels[best]!)) best = i;
  });
  const strongest = best < 0 ? "nothing was received" : `strongest ${levels[best]!.toFixed(1)} dB at ${ranges[best].toFixed(2)} m`;
  const angle = (view.beam_angle_rad.data[beam] * 180) / Math.PI;
  return (
    <div class="ascan">
      <div class="stripTitle">A-scan of beam {beam}, {angle.toFixed(1)}° · {strongest} · dB re 1 µPa{gain} over slant range</div>
      <div ref={place} class="stripPlot" data-ascan={beam} role="img" aria-label={`levels of beam ${beam} over slant range`} />
    </div>
  );
}
