// The panes of heads: fans and waterfalls.
import { useEffect, useRef, useState } from "preact/hooks";
import { AScan } from "./ascan";
import { FanPicture, FINDS } from "./fan";
import { kept as keptChoice } from "./kept";
import { colours } from "./light";
import { levelColours, Limits, percentiles } from "./palette";
import { ColourBar, Swatch } from "./swatch";
import { View } from "./messages";
import { flow, watch, wish } from "./store";
import { Waterfall } from "./waterfall";

const fixed = (value: number | null | undefined, digits = 1) => (value == null || !Number.isFinite(value) ? "-" : value.toFixed(digits));
const degrees = (angle: number) => (angle * 180) / Math.PI;

/** How a topic reaches this page. */
function Flow({ topic }: { topic: string }) {
  const f = flow.value[topic];
  if (!f) return null;
  return (
    <span class="flow" data-sent={f.sent} data-lost={f.lost} data-age={f.age_s}>
      {fixed(f.rate_hz)} /s · {Math.round(f.age_s * 1000)} ms old · {f.lost} lost{f.halved > 0 && ` · width 1/${2 ** f.halved} for the link`}
    </span>
  );
}

/** Pictures that the head did not make. */
function LeftOut({ view }: { view: View }) {
  return view.left_out > 0 ? <span class="gaps">{view.left_out} pictures left out while the run waited for the head</span> : null;
}

/** Moves a cursor over a picture: by the pointer, and by the arrow keys where the picture has the focus. */
function cursorOf(pointer: Pointer | null, move: (to: Pointer | null) => void) {
  return {
    tabIndex: 0, role: "img" as const,
    onPointerMove: (event: PointerEvent) => move({ x: event.offsetX, y: event.offsetY }),
    onPointerLeave: () => move(null),
    onBlur: () => move(null),
    onKeyDown: (event: KeyboardEvent) => {
      const step = event.shiftKey ? 20 : 1;
      const by: Record<string, [number, number]> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
      const canvas = event.currentTarget as HTMLCanvasElement;
      if (!by[event.key]) return;
      event.preventDefault();
      const from = pointer ?? { x: canvas.width / 2, y: canvas.height / 2 };
      const inside = (value: number, size: number) => Math.max(0, Math.min(size - 1, value));
      move({ x: inside(from.x + by[event.key][0], canvas.width), y: inside(from.y + by[event.key][1], canvas.height) });
    },
  };
}

/** Keeps a canvas as large as its place. */
function useCanvas(resized: (canvas: HTMLCanvasElement) => void) {
  const ref = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const canvas = ref.current!;
    const fit = () => {
      const width = Math.max(1, Math.floor(canvas.clientWidth));
      const height = Math.max(1, Math.floor(canvas.clientHeight));
      if (canvas.width === width && canvas.height === height) return;
      canvas.width = width;
      canvas.height = height;
      resized(canvas);
    };
    fit();
    const observer = new ResizeObserver(fit);
    observer.observe(canvas);
    return () => observer.disconnect();
  }, []);
  return ref;
}

function settings(view: View): string {
  return `${fixed(view.frequency_hz / 1e3, 0)} kHz · ${fixed(view.pulse_length_s * 1e3, 3)} ms · ${fixed(view.source_level_db, 0)} dB · ${fixed(view.range_m, 0)} m`;
}

function gainText(view: View): string {
  return view.added_spreading_db ? ` + ${view.added_spreading_db} log R, R in m` : "";
}

/** The colour scale, its ends set by hand or by the picture. */
function Scale({ ramp, limits, view, set }: { ramp: string; limits: Limits | null; view: View; set(limits: Limits | null): void }) {
  const change = (key: keyof Limits) => (event: Event) => {
    const value = Number((event.target as HTMLInputElement).value);
    if (limits && Number.isFinite(value)) set({ ...limits, [key]: value });
  };
  return (
    <span class="scale">
      <input type="number" step="1" aria-label="level of the darkest colour, dB" value={fixed(limits?.low_db, 0)} onChange={change("low_db")} />
      <ColourBar colours={levelColours(ramp)} label="colours of levels" />
      <input type="number" step="1" aria-label="level of the brightest colour, dB" value={fixed(limits?.high_db, 0)} onChange={change("high_db")} />
      dB re 1 µPa{gainText(view)} <button onClick={() => set(null)}>auto</button>
    </span>
  );
}

const showFinds = keptChoice("detections", true, (value) => typeof value === "boolean");
const onGround = keptChoice("ground", false, (value) => typeof value === "boolean");
const wantsUpright = keptChoice("upright", false, (value) => typeof value === "boolean");
/** A head that looks down and knows how it hangs. */
const canStand = (view: View) => view.beam_axis === "down" && view.enu_from_head.some((part) => part !== 0);
const rectangular = keptChoice("rectangular", false, (value) => typeof value === "boolean");
const showScan = keptChoice("ascan", false, (value) => typeof value === "boolean");

const WATERFALL_DB = 30; // added to waterfalls: a seabed that a pulse cuts has even levels then

interface Pointer {
  x: number;
  y: number;
}

function Fan({ topic, first }: { topic: string; first: View }) {
  const [view, setView] = useState<View>(first);
  const [given, setGiven] = useState<Limits | null>(null);
  const [pointer, setPointer] = useState<Pointer | null>(null);
  const picture = useRef<FanPicture | null>(null);
  const finds = showFinds.value;
  const scan = showScan.value;
  const [beam, setBeam] = useState(0);
  const kept = useRef<{ view: View; given: Limits | null; auto: Limits | null; finds: boolean }>({ view: first, given: null, auto: null, finds: true });
  kept.current.given = given;
  kept.current.finds = finds;
  const redraw = () => {
    const { view: newest, given: by, auto } = kept.current;
    const limits = by ?? auto;
    if (!limits || !picture.current) return;
    picture.current.rectangular = rectangular.value;
    picture.current.upright = wantsUpright.value && canStand(newest);
    picture.current.draw(newest, limits);
    if (kept.current.finds) picture.current.drawFinds();
    wish(topic, { cells: picture.current.cells, spreading_db: 0, ground: false, upright: picture.current.upright });
  };
  const canvas = useCanvas((element) => {
    picture.current ??= new FanPicture(element);
    redraw();
  });
  const judge = (newest: View) => {
    const found = percentiles(newest.level.data, newest.level_floor_db, newest.level_step_db, 20, 99.9);
    const auto = kept.current.auto;
    if (found) kept.current.auto = auto ? { low_db: 0.9 * auto.low_db + 0.1 * found.low_db, high_db: 0.9 * auto.high_db + 0.1 * found.high_db } : found;
  };
  useEffect(
    () => watch(topic, { cells: 1024, spreading_db: 0, ground: false, upright: false }, {
      take(newest) {
        if (newest.added_spreading_db === 0) kept.current.view = newest; // else made before it was known that this is a fan
      },
      draw() {
        if (kept.current.view.added_spreading_db !== 0) return;
        judge(kept.current.view);
        redraw();
        setView(kept.current.view);
      },
    }),
    [],
  );
  useEffect(redraw, [given, finds, colours.value, rectangular.value, wantsUpright.value]);
  const place = pointer && picture.current?.placeOf(pointer.x, pointer.y);
  const chooseBeam = (wanted: number) => {
    if (Number.isInteger(wanted) && wanted >= 0 && wanted < view.level.shape[0]) setBeam(wanted);
  };
  const point = (at: Pointer | null) => {
    setPointer(at);
    if (at) chooseBeam(picture.current?.placeOf(at.x, at.y)?.beam ?? -1); // it stays when the cursor leaves the fan
  };
  return (
    <>
      <header>
        <h2>{topic}</h2> ping {view.ping} · {settings(view)} <Flow topic={topic} /> <LeftOut view={view} />
      </header>
      <canvas ref={canvas} class="picture" data-topic={topic} aria-label={`fan of ${topic}`} {...cursorOf(pointer, point)} />
      {scan && <AScan view={view} beam={Math.min(beam, view.level.shape[0] - 1)} pointed_m={place && place.beam >= 0 ? place.range_m : null} gain={gainText(view)} />}
      <footer>
        <label><input type="checkbox" checked={scan} onChange={() => (showScan.value = !scan)} /> A-scan</label>
        {canStand(view) && <label title="the head's roll, by its estimate, is taken out"><input type="checkbox" checked={wantsUpright.value} onChange={() => (wantsUpright.value = !wantsUpright.value)} /> upright</label>}
        <label title="beams from left to right, ranges from the head to the far edge; not to scale"><input type="checkbox" checked={rectangular.value} onChange={() => (rectangular.value = !rectangular.value)} /> rectangular</label>
        {scan && (
          <label>beam <input class="beam" type="number" min={0} max={view.level.shape[0] - 1} value={beam} onInput={(e) => chooseBeam(Number((e.target as HTMLInputElement).value))} /></label>
        )}
        <Scale ramp="inferno" limits={given ?? kept.current.auto} view={view} set={setGiven} />
        {view.find_range_m.data.length > 0 && (
          <label>
            <input type="checkbox" checked={finds} onChange={() => (showFinds.value = !finds)} /> detections: <Swatch colour={FINDS[1]} /> amplitude <Swatch colour={FINDS[2]} /> phase
          </label>
        )}
        <span class="cursor">
          {place
            ? `range ${fixed(place.range_m)} m, ${fixed(degrees(place.angle_rad))}°, beam ${place.beam < 0 ? "-" : place.beam}; across ${fixed(place.across_m)} m, ${view.beam_axis === "forward" ? "ahead" : "down"} ${fixed(place.along_m)} m; ${fixed(place.level_db)} dB`
            : `${picture.current?.upright ? "upright" : "as the head has it"}${rectangular.value ? ", not to scale" : ""}; straight rays at the head's sound speed`}
        </span>
      </footer>
    </>
  );
}

function Sidescan({ topic, early }: { topic: string; early: View[] }) {
  const first = early[0];
  const [view, setView] = useState<View>(first);
  const [given, setGiven] = useState<Limits | null>(null);
  const [pointer, setPointer] = useState<Pointer | null>(null);
  const fall = useRef<Waterfall | null>(null);
  const canvas = useCanvas((element) => {
    if (!fall.current) {
      fall.current = new Waterfall(element);
      for (const line of early.splice(0)) fall.current.add(line);
    }
    fall.current.draw();
  });
  useEffect(() => {
    let newest = first;
    for (const line of early.splice(0)) fall.current?.add(line);
    return watch(topic, { cells: 1024, spreading_db: WATERFALL_DB, ground: onGround.value, upright: false }, {
      take(line) {
        newest = line;
        fall.current?.add(line);
      },
      draw() {
        fall.current?.draw();
        setView(newest);
      },
    });
  }, []);
  useEffect(() => {
    fall.current?.setLimits(given);
    fall.current?.draw();
  }, [given]);
  useEffect(() => wish(topic, { cells: 1024, spreading_db: WATERFALL_DB, ground: onGround.value, upright: false }), [onGround.value]);
  useEffect(() => {
    fall.current?.repaint();
    fall.current?.draw();
  }, [colours.value]);
  const place = pointer && fall.current?.placeOf(pointer.x, pointer.y);
  const gaps = fall.current?.gaps ?? 0;
  const kind = view.ground_altitude_m > 0 ? "ground" : "slant";
  return (
    <>
      <header>
        <h2>{topic}</h2> ping {view.ping} · {settings(view)} <Flow topic={topic} /> <LeftOut view={view} /> {gaps > 0 && <span class="gaps">{gaps} pings did not come</span>}
      </header>
      <canvas ref={canvas} class="picture" data-topic={topic} aria-label={`waterfall of ${topic}`} {...cursorOf(pointer, setPointer)} />
      <footer>
        <label title="by the altitude of the head's own bottom track, above a level seabed"><input type="checkbox" checked={onGround.value} onChange={() => (onGround.value = !onGround.value)} /> ground range</label>
        <Scale ramp="copper" limits={fall.current?.limits ?? null} view={view} set={setGiven} />
        <span class="cursor">
          {place
            ? `${place.side}${place.kind} range ${fixed(place.range_m)} m, ping ${place.ping}, t = ${fixed(place.stamp_ns * 1e-9, 2)} s; ${fixed(place.level_db)} dB`
            : fall.current?.single
              ? `${kind} range from 0 to ${fixed(fall.current.reach_m)} m; newest on top`
              : `port · ${kind} range, ${fixed(fall.current?.reach_m)} m to either side · starboard; newest on top`}
        </span>
      </footer>
    </>
  );
}

/** Shows what a head sends: with three beams and more a fan, with fewer a waterfall. */
export function Head({ topic }: { topic: string }) {
  const early = useRef<View[]>([]); // until the pane is there that draws them
  const [first, setFirst] = useState<View | null>(null);
  useEffect(() => watch(topic, { cells: 1024, spreading_db: WATERFALL_DB, ground: false, upright: false }, {
    take(view) {
      early.current.push(view);
      setFirst((known) => known ?? view);
    },
    draw() {},
  }), []);
  if (!first) return <header><h2>{topic}</h2> waits for a ping</header>;
  return first.level.shape[0] > 2 ? <Fan topic={topic} first={first} /> : <Sidescan topic={topic} early={early.current} />;
}
