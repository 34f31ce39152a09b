// The place of the panes: two columns of rows, and edges between them that can be moved.
import { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";
import { kept } from "./kept";
import { layout } from "./layouts";

/** Shares of the width and of the height. */
interface Sizes {
  columns: number[];
  rows: number[];
}

const LEAST = 0.1; // of what two neighbours have together
const STEP = 0.02; // by an arrow key
const FIRST_COLUMNS = [0.6, 0.4];

const isShares = (value: unknown) => Array.isArray(value) && value.length > 0 && value.every((share) => typeof share === "number" && share > 0 && share < 1);
const isSizes = (value: unknown) => value !== null && typeof value === "object" && isShares((value as Sizes).columns) && isShares((value as Sizes).rows);

/** Sizes that were changed, by layout and number of rows. */
const changed = kept<Record<string, Sizes>>("sizes", {}, (value) => value !== null && typeof value === "object" && !Array.isArray(value) && Object.values(value).every(isSizes));

/** The last of an odd number of panes has the whole width; beside few panes it is low. */
const rowsOf = (count: number) => Math.max(1, Math.ceil(count / 2));
const isWide = (count: number) => count % 2 === 1;
const keyOf = (count: number) => `${layout.value} ${count}`;

function firstSizes(count: number): Sizes {
  const rows = rowsOf(count);
  const parts = Array.from({ length: rows }, (_, row) => (isWide(count) && rows > 1 && row === rows - 1 ? 0.5 : 1));
  const all = parts.reduce<number>((sum, part) => sum + part, 0);
  return { columns: FIRST_COLUMNS, rows: parts.map((part) => part / all) };
}

function sizesOf(count: number): Sizes {
  const first = firstSizes(count);
  const found = changed.value[keyOf(count)];
  return found && found.columns.length === first.columns.length && found.rows.length === first.rows.length ? found : first;
}

export const areSizesChanged = (count: number) => keyOf(count) in changed.value;
export function resetSizes(count: number) {
  changed.value = Object.fromEntries(Object.entries(changed.value).filter(([key]) => key !== keyOf(count)));
}

/** Moves an edge so that the pane before it has this share of what both neighbours have. */
function move(count: number, way: keyof Sizes, edge: number, share: number) {
  const sizes = sizesOf(count);
  const shares = sizes[way].slice();
  const both = shares[edge] + shares[edge + 1];
  shares[edge] = both * Math.max(LEAST, Math.min(1 - LEAST, share));
  shares[edge + 1] = both - shares[edge];
  changed.value = { ...changed.value, [keyOf(count)]: { ...sizes, [way]: shares } };
}

/** The edge behind a column or a row. */
function Edge({ count, way, edge, place }: { count: number; way: keyof Sizes; edge: number; place: string }) {
  const shares = sizesOf(count)[way];
  const share = shares[edge] / (shares[edge] + shares[edge + 1]);
  const held = useRef<{ from: number; share: number; both_px: number } | null>(null);
  const upright = way === "columns";
  const at = (event: PointerEvent) => (upright ? event.clientX : event.clientY);
  const press = (event: PointerEvent) => {
    const element = event.currentTarget as HTMLElement;
    const all_px = upright ? element.parentElement!.clientWidth : element.parentElement!.clientHeight;
    held.current = { from: at(event), share, both_px: all_px * (shares[edge] + shares[edge + 1]) };
    element.setPointerCapture(event.pointerId);
    event.preventDefault();
    element.focus({ preventScroll: true });
  };
  const drag = (event: PointerEvent) => {
    const by = held.current;
    if (by) move(count, way, edge, by.share + (at(event) - by.from) / by.both_px);
  };
  const step = (event: KeyboardEvent) => {
    const [back, forth] = upright ? ["ArrowLeft", "ArrowRight"] : ["ArrowUp", "ArrowDown"];
    if (event.key !== back && event.key !== forth) return;
    event.preventDefault();
    move(count, way, edge, share + (event.key === back ? -1 : 1) * (event.shiftKey ? 5 : 1) * STEP);
  };
  const let_go = () => (held.current = null);
  return (
    <div
      class={`edge ${way}`} style={place} role="separator" tabIndex={0} aria-orientation={upright ? "vertical" : "horizontal"}
      aria-label={upright ? "width of the left column" : `height of row ${edge + 1}`} title="drag, or arrow keys: other sizes"
      aria-valuenow={Math.round(100 * share)} aria-valuemin={100 * LEAST} aria-valuemax={100 * (1 - LEAST)}
      onPointerDown={press} onPointerMove={drag} onPointerUp={let_go} onPointerCancel={let_go} onKeyDown={step}
    />
  );
}

const tracks = (shares: number[]) => shares.map((share) => `minmax(0, ${share.toFixed(4)}fr)`).join(" var(--edge) ");

/** Panes from left to right and down. */
export function Grid({ panes }: { panes: { name: string; pane: ComponentChildren }[] }) {
  const count = panes.length;
  const sizes = sizesOf(count);
  const pairs = Math.floor(count / 2); // rows with two panes
  const place = (i: number) => {
    const row = 2 * Math.floor(i / 2) + 1;
    return i === count - 1 && isWide(count) ? `grid-area: ${row} / 1 / auto / -1` : `grid-area: ${row} / ${(i % 2) * 2 + 1}`;
  };
  return (
    <div class="panes" style={`grid-template: ${tracks(sizes.rows)} / ${tracks(sizes.columns)}`}>
      {panes.map(({ name, pane }, i) => <section key={name} class="pane" style={place(i)}>{pane}</section>)}
      {pairs > 0 && <Edge key="columns" count={count} way="columns" edge={0} place={`grid-area: 1 / 2 / ${2 * pairs} / 3`} />}
      {sizes.rows.slice(1).map((_, edge) => <Edge key={edge} count={count} way="rows" edge={edge} place={`grid-area: ${2 * edge + 2} / 1 / auto / -1`} />)}
    </div>
  );
}
