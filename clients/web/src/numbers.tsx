// Numbers of any message over sim time. Those of one field and unit share a strip, so that an estimate stands beside the truth.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { kept } from "./kept";
import { ConsoleScalar, ConsoleTopic } from "./messages";
import { ESTIMATE, TRUTH } from "./palette";
import { news, seriesOf } from "./series";
import { state, wantValues } from "./store";
import { Line, Strip, valueAt } from "./strip";
import { Swatch } from "./swatch";

const OTHERS = ["#7fd6a4", "#f08fc0", "#c3b1ff", "#f2e06a", "#ff8a70", "#9fd0ff"];
const MOST = 24; // numbers at once
const pane = {};

/** Numbers that are shown, TOPIC.field; null: those of the layout. */
const chosen = kept<string[] | null>("numbers", null, (value) => Array.isArray(value) && value.every((name) => typeof name === "string"));
const pointed_s = signal<number | null>(null);

interface Choice {
  name: string;
  topic: ConsoleTopic;
  scalar: ConsoleScalar;
}

function choices(): Choice[] {
  const s = state.value!;
  const types = new Map(s.types.map(({ type, scalars }) => [type, scalars]));
  return s.topics.flatMap((topic) => (types.get(topic.type) ?? []).map((scalar) => ({ name: `${topic.name}.${scalar.field}`, topic, scalar })));
}

/** What a surveyor watches, as far as it is published. */
const WANTED: [string, string[]][] = [
  ["depth_m", ["soundings/1"]],
  ["altitude_m", ["bottom_track/1", "velocity_log/1"]],
  ["range_m", ["altitude/1"]],
  ["depth_m", ["pose/1", "estimate/1", "depth/1"]],
  ["heading_grid_rad", ["pose/1", "estimate/1"]],
  ["speed_mps", ["pose/1", "estimate/1"]],
  ["roll_rad", ["pose/1", "estimate/1"]],
  ["pitch_rad", ["pose/1", "estimate/1"]],
  ["heave_m", ["attitude/1"]],
  ["pings_per_s", ["soundings/1", "bottom_track/1"]],
  ["lateness_s", ["clock_health/1"]],
];

function layout(all: Choice[]): string[] {
  const names = WANTED.flatMap(([field, types]) => all.filter(({ topic, scalar }) => scalar.field === field && types.includes(topic.type)).map(({ name }) => name));
  return [...new Set(names)].slice(0, MOST);
}

/** Of a vehicle and of water below a head: one field, and yet not one strip. */
const keyOf = ({ topic, scalar }: Choice) => `${scalar.field} ${scalar.unit}${topic.type === "soundings/1" ? " sounded" : ""}`;

function strips(names: string[], all: Choice[]): { title: string; unit: string; lines: Line[] }[] {
  const found = new Map<string, { title: string; unit: string; lines: Line[] }>();
  for (const name of names) {
    const choice = all.find((one) => one.name === name);
    const key = choice ? keyOf(choice) : name;
    const strip = found.get(key) ?? { title: choice?.scalar.about ?? name, unit: choice?.scalar.unit ?? "", lines: [] };
    const type = choice?.topic.type;
    const free = OTHERS.filter((colour) => !strip.lines.some((line) => line.colour === colour));
    const own = type === "pose/1" ? TRUTH : type === "estimate/1" ? ESTIMATE : "";
    const taken = strip.lines.some((line) => line.colour === own);
    strip.lines.push({ name, colour: own && !taken ? own : (free[0] ?? OTHERS[0]) });
    found.set(key, strip);
  }
  return [...found.values()];
}

const shown = (value: number | null, unit: string) => (value == null ? "-" : `${value.toFixed(Math.abs(value) < 100 ? 2 : 1)} ${unit}`);

function StripView({ title, unit, lines, remove }: { title: string; unit: string; lines: Line[]; remove(name: string): void }) {
  const place = useRef<HTMLDivElement>(null);
  const strip = useRef<Strip | null>(null);
  useEffect(() => {
    const made = new Strip(place.current!, lines, (time_s) => (pointed_s.value = time_s));
    strip.current = made;
    const observer = new ResizeObserver(() => made.resize());
    observer.observe(place.current!);
    return () => {
      observer.disconnect();
      made.destroy();
    };
  }, [lines.map((line) => line.name).join(" ")]);
  const count = news.value;
  useEffect(() => strip.current?.draw(lines.map(({ name }) => seriesOf(name))), [count, lines.map((line) => line.name).join(" ")]);
  const at = pointed_s.value ?? Infinity;
  return (
    <div class="strip">
      <div class="stripTitle" title={title}>
        {lines.map(({ name, colour }) => (
          <span key={name}>
            <Swatch colour={colour} /> {name} <b data-number={name}>{shown(valueAt(seriesOf(name), at), unit)}</b>
            <button aria-label={`remove ${name}`} onClick={() => remove(name)}>×</button>
          </span>
        ))}
      </div>
      <div ref={place} class="stripPlot" data-strip={lines[0].name} role="img" aria-label={title} />
    </div>
  );
}

export function NumbersPane() {
  const all = choices();
  const names = chosen.value ?? layout(all);
  const asked = names.join(" ");
  useEffect(() => wantValues(pane, names), [asked]);
  useEffect(() => () => wantValues(pane, []), []);
  const add = (event: Event) => {
    const select = event.target as HTMLSelectElement;
    if (select.value && !names.includes(select.value)) chosen.value = [...names, select.value].slice(-MOST);
    select.value = "";
  };
  const remove = (name: string) => (chosen.value = names.filter((other) => other !== name));
  const topics = [...new Set(all.map(({ topic }) => topic.name))];
  return (
    <>
      <header>
        <h2>numbers</h2> over sim time, up to ten minutes{pointed_s.value != null && `, at ${pointed_s.value.toFixed(2)} s`}
      </header>
      <div class="strips" tabIndex={0}>
        {strips(names, all).map((strip) => <StripView key={strip.lines[0].name} {...strip} remove={remove} />)}
        {names.length === 0 && <p class="note">No number is chosen.</p>}
      </div>
      <footer>
        <select aria-label="add a number" value="" onChange={add}>
          <option value="">add a number ...</option>
          {topics.map((topic) => (
            <optgroup key={topic} label={topic}>
              {all.filter((choice) => choice.topic.name === topic).map(({ name, scalar }) => (
                <option key={name} value={name} title={scalar.about}>{scalar.field}{scalar.unit && `, ${scalar.unit}`}</option>
              ))}
            </optgroup>
          ))}
        </select>
        {chosen.value && <button onClick={() => (chosen.value = null)}>as at first</button>}
      </footer>
    </>
  );
}
