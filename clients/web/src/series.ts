// Numbers over sim time, as the gateway sends them: ten minutes of each that a pane shows.
import { signal } from "@preact/signals";
import { ConsoleValues } from "./messages";

const KEPT_S = 600;
const MOST_POINTS = 8000; // of a number

export interface Series {
  unit: string;
  time_s: number[];
  value: (number | null)[]; // null: a gap
}

const known = new Map<string, Series & { next: number }>();
let generation = 0;

/** Counts what has come, so that panes draw again. */
export const news = signal(0);

export const seriesOf = (name: string): Series | undefined => known.get(name);

/** The newest value, as long as no gap follows it. */
export function newest(name: string): { value: number; unit: string } | null {
  const series = known.get(name);
  const value = series?.value[series.value.length - 1];
  return series && value != null ? { value, unit: series.unit } : null;
}

/** Drops all others. */
export function keepSeries(names: string[]) {
  for (const name of known.keys()) if (!names.includes(name)) known.delete(name);
}

export function clearSeries() {
  known.clear();
}

/** Returns the newest sim time. */
export function takeValues(values: ConsoleValues): number {
  if (values.generation !== generation) known.clear();
  generation = values.generation;
  let latest_s = 0;
  for (const { name, unit, first, time_s, value } of values.series) {
    let series = known.get(name);
    if (!series || first < series.next) {
      series = { unit, time_s: [], value: [], next: first };
      known.set(name, series);
    }
    for (let i = 0; i < time_s.data.length; ++i) {
      series.time_s.push(time_s.data[i]);
      series.value.push(Number.isFinite(value.data[i]) ? value.data[i] : null);
    }
    series.next = first + time_s.data.length;
    const newest_s = series.time_s[series.time_s.length - 1];
    latest_s = Math.max(latest_s, newest_s);
    let old = Math.max(0, series.time_s.length - MOST_POINTS);
    while (series.time_s[old] < newest_s - KEPT_S) ++old;
    series.time_s.splice(0, old);
    series.value.splice(0, old);
  }
  ++news.value;
  return latest_s;
}
