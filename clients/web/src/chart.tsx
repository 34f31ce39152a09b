// The chart: cells of all soundings, tracks, cursor, ruler. Plane coordinates of the world: east and north in metres.
import { useEffect, useRef, useState } from "preact/hooks";
import Feature from "ol/Feature";
import Map from "ol/Map";
import View from "ol/View";
import ScaleLine from "ol/control/ScaleLine";
import { defaults as controls } from "ol/control/defaults";
import LineString from "ol/geom/LineString";
import Point from "ol/geom/Point";
import Draw from "ol/interaction/Draw";
import { defaults as interactions } from "ol/interaction/defaults";
import ImageLayer from "ol/layer/Image";
import VectorLayer from "ol/layer/Vector";
import Projection from "ol/proj/Projection";
import ImageCanvas from "ol/source/ImageCanvas";
import VectorSource from "ol/source/Vector";
import Fill from "ol/style/Fill";
import RegularShape from "ol/style/RegularShape";
import Stroke from "ol/style/Stroke";
import Style from "ol/style/Style";
import Text from "ol/style/Text";
import { ConsoleCells, ConsolePlan, ConsoleTrack } from "./messages";
import { kept } from "./kept";
import { colours } from "./light";
import { depthColours, ESTIMATE, TRUTH } from "./palette";
import { Relief } from "./relief";
import { ChartNews, watchChart } from "./store";
import { ColourBar, Swatch } from "./swatch";

const PLANE = new Projection({ code: "ensonify:plane", units: "m", extent: [-1e7, -1e7, 1e7, 1e7], axisOrientation: "enu" });
const PLAN = "#e8e8e8"; // lines and marks
const PLANNED = new Style({ stroke: new Stroke({ color: PLAN, width: 1, lineDash: [8, 5] }) });
const RULER = new Style({ stroke: new Stroke({ color: "#ffffff", width: 1.5, lineDash: [6, 4] }) });

interface Cell {
  mean_m: number;
  shoalest_m: number;
  sd_m: number;
  count: number;
}

type Colours = "mean" | "shoalest" | "count" | "sd";
const WORDS: Record<Colours, string> = { mean: "mean depth, m", shoalest: "shoalest, m", count: "soundings", sd: "standard deviation, m" };

const colouredBy = kept<Colours>("chart", "mean", (value) => Object.keys(WORDS).includes(value as string));

const valueOf = (cell: Cell, by: Colours) => (by === "mean" ? cell.mean_m : by === "shoalest" ? cell.shoalest_m : by === "count" ? cell.count : cell.sd_m);
const keyOf = (column: number, row: number) => row * 67108864 + column;

/** All cells so far, drawn for any extent. */
class Cells {
  cell_m = 1;
  by: Colours = "mean";
  range: [number, number] = [0, 1];
  extent: [number, number, number, number] | null = null;
  soundings = 0;
  private generation = 0;
  private cells: globalThis.Map<number, Cell & { column: number; row: number }> = new globalThis.Map();

  /** True when there is another grid than before. */
  take(news: ConsoleCells): boolean {
    const other = news.generation !== this.generation;
    if (other) this.cells.clear();
    this.generation = news.generation;
    this.cell_m = news.cell_m;
    const { column, row, count, mean_depth_m, shoalest_depth_m, sd_m } = news;
    for (let i = 0; i < column.data.length; ++i) {
      this.cells.set(keyOf(column.data[i], row.data[i]), {
        column: column.data[i], row: row.data[i], count: count.data[i], mean_m: mean_depth_m.data[i], shoalest_m: shoalest_depth_m.data[i], sd_m: sd_m.data[i],
      });
    }
    this.judge();
    return other;
  }

  judge() {
    let low = Infinity;
    let high = -Infinity;
    let [west, south, east, north] = [Infinity, Infinity, -Infinity, -Infinity];
    this.soundings = 0;
    for (const cell of this.cells.values()) {
      this.soundings += cell.count;
      const value = valueOf(cell, this.by);
      if (Number.isFinite(value)) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
      west = Math.min(west, cell.column);
      south = Math.min(south, cell.row);
      east = Math.max(east, cell.column + 1);
      north = Math.max(north, cell.row + 1);
    }
    this.range = low <= high ? [low, high] : [0, 1];
    this.extent = west < east ? [west * this.cell_m, south * this.cell_m, east * this.cell_m, north * this.cell_m] : null;
  }

  at(east_m: number, north_m: number): Cell | undefined {
    return this.cells.get(keyOf(Math.floor(east_m / this.cell_m), Math.floor(north_m / this.cell_m)));
  }

  colour(value: number): number {
    const [low, high] = this.range;
    const part = (value - low) / Math.max(high - low, 1e-6);
    return depthColours()[Math.max(0, Math.min(255, Math.round(255 * (this.by === "count" || this.by === "sd" ? 1 - part : part))))];
  }

  /** A canvas of width x height pixels over an extent. */
  draw(canvas: HTMLCanvasElement, [west, south, east, north]: number[], width: number, height: number) {
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d")!;
    const across = width / (east - west);
    const up = height / (north - south);
    const side_x = this.cell_m * across;
    const side_y = this.cell_m * up;
    for (const cell of this.cells.values()) {
      const x = (cell.column * this.cell_m - west) * across;
      const y = (north - (cell.row + 1) * this.cell_m) * up;
      if (x + side_x < 0 || y + side_y < 0 || x > width || y > height) continue;
      const value = valueOf(cell, this.by);
      if (!Number.isFinite(value)) continue;
      const pixel = this.colour(value);
      context.fillStyle = `rgb(${pixel & 255},${(pixel >> 8) & 255},${(pixel >> 16) & 255})`;
      const left = Math.floor(x);
      const top = Math.floor(y);
      context.fillRect(left, top, Math.max(1, Math.floor(x + side_x) - left), Math.max(1, Math.floor(y + side_y) - top));
    }
  }
}

function lengthText([x0, y0]: number[], [x1, y1]: number[]): string {
  const bearing = (Math.atan2(x1 - x0, y1 - y0) * 180 / Math.PI + 360) % 360;
  return `${Math.hypot(x1 - x0, y1 - y0).toFixed(1)} m, grid bearing ${bearing.toFixed(1)}°`;
}

/** The map with its layers. */
class Chart {
  cells = new Cells();
  map: Map;
  private canvas = document.createElement("canvas");
  private cellSource = new ImageCanvas({
    projection: PLANE, ratio: 1, interpolate: false,
    canvasFunction: (extent, _resolution, _ratio, size) => {
      this.cells.draw(this.canvas, extent, Math.round(size[0]), Math.round(size[1]));
      return this.canvas;
    },
  });
  relief: Relief | null = null;
  private reliefCanvas = document.createElement("canvas");
  private reliefSource = new ImageCanvas({
    projection: PLANE, ratio: 1, interpolate: false,
    canvasFunction: (extent, _resolution, _ratio, size) => {
      const [width, height] = [Math.round(size[0]), Math.round(size[1])];
      if (this.relief) this.relief.draw(this.reliefCanvas, extent, width, height);
      else [this.reliefCanvas.width, this.reliefCanvas.height] = [width, height];
      return this.reliefCanvas;
    },
  });
  private tracks = new VectorSource();
  private plan = new VectorSource();
  private ruler = new VectorSource();
  private lines: globalThis.Map<string, { generation: number; line: LineString; place: Feature<Point> }> = new globalThis.Map();
  private fitted = false;

  constructor(private target: HTMLElement, moved: (at: number[] | null) => void, measured: (text: string) => void) {
    const ruler = new Draw({ source: this.ruler, type: "LineString", maxPoints: 2, condition: (event) => event.originalEvent.shiftKey, style: RULER });
    this.map = new Map({
      target, interactions: interactions({ onFocusOnly: false }), // the wheel and the mouse work wherever the keyboard is
      controls: controls({ attribution: false, rotate: false }).extend([new ScaleLine({ units: "metric" })]),
      layers: [
        new ImageLayer({ source: this.reliefSource }),
        new ImageLayer({ source: this.cellSource }),
        new VectorLayer({ source: this.plan }),
        new VectorLayer({ source: this.tracks }),
        new VectorLayer({ source: this.ruler, style: RULER }),
      ],
      view: new View({ projection: PLANE, center: [0, 0], resolution: 1, minResolution: 0.005, maxResolution: 200, constrainResolution: false }),
    });
    this.map.addInteraction(ruler);
    ruler.on("drawstart", () => this.ruler.clear());
    ruler.on("drawend", (event) => {
      const [from, to] = (event.feature.getGeometry() as LineString).getCoordinates();
      measured(lengthText(from, to));
    });
    this.map.on("pointermove", (event) => moved(event.coordinate));
    target.addEventListener("pointerleave", () => moved(null));
    // By keyboard the middle is the cursor.
    const middle = () => this.map.getView().getCenter()!;
    const by_keys = () => document.activeElement === target && target.matches(":focus-visible");
    this.map.on("moveend", () => by_keys() && moved(middle()));
    target.addEventListener("focus", () => by_keys() && moved(middle()));
    target.addEventListener("blur", () => moved(null));
    target.addEventListener("keydown", (event) => {
      if (event.key !== "m") return;
      if (this.measureFrom) measured(this.measure(this.measureFrom, middle()));
      else this.ruler.clear();
      this.measureFrom = this.measureFrom ? null : middle();
    });
  }

  private measureFrom: number[] | null = null;

  private measure([x0, y0]: number[], [x1, y1]: number[]): string {
    this.ruler.clear();
    this.ruler.addFeature(new Feature(new LineString([[x0, y0], [x1, y1]])));
    return lengthText([x0, y0], [x1, y1]);
  }

  /** Draws the cells in the colours that are wanted now. */
  recolour(by: Colours) {
    this.cells.by = by;
    this.cells.judge();
    this.cellSource.changed();
  }

  get metresPerPixel(): number {
    return this.map.getView().getResolution() ?? 1;
  }

  private takePlan(news: ConsolePlan) {
    this.plan.clear();
    const { data } = news.line_enu_m;
    for (let i = 0; i + 3 < data.length; i += 4) {
      const line = new Feature(new LineString([[data[i], data[i + 1]], [data[i + 2], data[i + 3]]]));
      line.setStyle(PLANNED);
      this.plan.addFeature(line);
    }
    for (const { text, position_enu_m } of news.marks) {
      const mark = new Feature(new Point(position_enu_m));
      mark.setStyle(new Style({
        image: new RegularShape({ points: 4, radius: 6, stroke: new Stroke({ color: PLAN, width: 2 }), angle: Math.PI / 4 }),
        text: new Text({ text, offsetX: 10, textAlign: "left", fill: new Fill({ color: PLAN }), stroke: new Stroke({ color: "#101418", width: 3 }) }),
      }));
      this.plan.addFeature(mark);
    }
    this.target.dataset.plan = `${data.length / 4} ${news.marks.length}`; // for tests
  }

  take(news: ChartNews) {
    if ("marks" in news) {
      this.takePlan(news);
    } else if ("shade" in news) {
      this.relief = new Relief(news);
      this.reliefSource.changed();
    } else if ("cell_m" in news) {
      if (this.cells.take(news)) this.fitted = false;
      this.cellSource.changed();
    } else {
      this.takeTrack(news);
    }
    if (!this.fitted) this.fit();
  }

  private takeTrack(news: ConsoleTrack) {
    let kept = this.lines.get(news.source);
    if (!kept || kept.generation !== news.generation || news.first === 0) {
      if (kept) for (const feature of this.tracks.getFeatures()) if (feature.get("source") === news.source) this.tracks.removeFeature(feature);
      const colour = news.truth ? TRUTH : ESTIMATE;
      const line = new LineString([]);
      const path = new Feature(line);
      path.setStyle(new Style({ stroke: new Stroke({ color: colour, width: news.truth ? 3 : 1.5 }) }));
      const place = new Feature(new Point([0, 0]));
      for (const feature of [path, place]) feature.set("source", news.source);
      this.tracks.addFeatures([path, place]);
      kept = { generation: news.generation, line, place };
      this.lines.set(news.source, kept);
    }
    const points = news.point_enu_m.data;
    const grown = kept.line.getCoordinates();
    for (let i = 0; i + 1 < points.length; i += 2) grown.push([points[i], points[i + 1]]);
    kept.line.setCoordinates(grown);
    kept.place.setGeometry(new Point(news.position_enu_m.slice(0, 2)));
    const fill = new Fill({ color: news.truth ? TRUTH : ESTIMATE });
    kept.place.setStyle(new Style({ image: new RegularShape({ points: 3, radius: news.truth ? 9 : 7, fill, rotation: news.heading_rad, rotateWithView: true, scale: [0.7, 1] }) }));
  }

  /** Shows all that there is, and follows until the user moves the chart. */
  fit() {
    const extent = this.cells.extent ?? (this.tracks.isEmpty() ? this.relief?.extent : this.tracks.getExtent());
    if (!extent || !Number.isFinite(extent[0])) return;
    const grown = extent.slice();
    const t = this.tracks.getExtent();
    if (t && Number.isFinite(t[0])) [grown[0], grown[1], grown[2], grown[3]] = [Math.min(grown[0], t[0]), Math.min(grown[1], t[1]), Math.max(grown[2], t[2]), Math.max(grown[3], t[3])];
    this.map.getView().fit(grown, { padding: [20, 20, 20, 20], minResolution: 0.02 });
  }

  keepView() {
    this.fitted = true;
  }
}

const fixed = (value: number, digits = 2) => (Number.isFinite(value) ? value.toFixed(digits) : "-");

export function ChartPane() {
  const place = useRef<HTMLDivElement>(null);
  const chart = useRef<Chart | null>(null);
  const [at, setAt] = useState<number[] | null>(null);
  const by = colouredBy.value;
  const [ruler, setRuler] = useState("");
  const [, setNews] = useState(0);
  useEffect(() => {
    const made = new Chart(place.current!, setAt, setRuler);
    chart.current = made;
    for (const kind of ["pointerdown", "wheel", "keydown"]) place.current!.addEventListener(kind, () => made.keepView());
    let news = 0;
    const close = watchChart((message) => {
      made.take(message);
      setNews(++news);
    });
    return () => {
      close();
      made.map.setTarget(undefined);
    };
  }, []);
  const cells = chart.current?.cells;
  const choose = (event: Event) => {
    const wanted = (event.target as HTMLSelectElement).value as Colours;
    colouredBy.value = wanted;
  };
  useEffect(() => chart.current?.recolour(by), [by, colours.value]);
  const cell = at && cells?.at(at[0], at[1]);
  const relief = chart.current?.relief;
  const contour = at && relief?.contourAt(at[0], at[1], 4 * chart.current!.metresPerPixel);
  return (
    <>
      <header>
        <h2>chart</h2> <Swatch colour={ESTIMATE} /> estimate <Swatch colour={TRUTH} /> truth <Swatch colour={PLAN} /> plan
        {relief && relief.contourStep_m > 0 && ` · contours of the chart every ${relief.contourStep_m} m `}
        {cells && cells.soundings > 0 && ` · ${cells.soundings} soundings in cells of ${cells.cell_m} m, as many as this console has received`}
      </header>
      <div ref={place} class="map" tabIndex={0} role="application" aria-label="chart: arrows move it, + and - zoom, m measures from and to its middle" />
      <footer>
        <select aria-label="colours by" value={by} onChange={choose}>
          {Object.entries(WORDS).map(([key, words]) => <option key={key} value={key}>{words}</option>)}
        </select>
        <ColourBar colours={depthColours()} label="colours from the least depth to the greatest" />
        {cells && cells.soundings === 0 && "no soundings yet"}
        {cells && cells.soundings > 0 && `${fixed(cells.range[0])} to ${fixed(cells.range[1])}${by === "mean" || by === "shoalest" ? ", shoal is warm" : ""}`}
        <button onClick={() => chart.current?.fit()}>all</button>
        <span class="cursor">
          {at
            ? `${relief ? `${relief.textOf(at[0], at[1])}; ` : ""}east ${fixed(at[0], 1)} m, north ${fixed(at[1], 1)} m${contour != null ? `; contour ${contour.toFixed(1)} m` : ""}${cell ? `; mean ${fixed(cell.mean_m)} m, shoalest ${fixed(cell.shoalest_m)} m, ${cell.count} soundings, sd ${fixed(cell.sd_m)} m` : ""}`
            : ruler || "drag to move, wheel to zoom, shift and click twice to measure"}
          {at && ruler && ` · ruler ${ruler}`}
        </span>
      </footer>
    </>
  );
}
