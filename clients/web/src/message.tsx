// The newest message of any topic as text (`ensonify topic echo` prints the same fields).
import { signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { Numbers } from "./messages";
import { state, watchText } from "./store";
import { Frame } from "./wire";

const EVERY_MS = 250; // what changes faster nobody reads
const SHOWN = 8; // elements of an array
const MOST_LINES = 400;

const isArray = (value: object): value is Numbers<ArrayLike<unknown>> => "shape" in value && "data" in value && ArrayBuffer.isView((value as Numbers<unknown>).data);
const numberText = (value: unknown) => (typeof value === "number" && !Number.isInteger(value) ? String(Number(value.toPrecision(9))) : String(value));

function arrayText({ shape, data }: Numbers<ArrayLike<unknown>>): string {
  const first = Array.from({ length: Math.min(SHOWN, data.length) }, (_, i) => numberText(data[i]));
  return `[${shape.join(" x ")}] ${first.join(", ")}${data.length > SHOWN ? ", ..." : ""}`;
}

/** A field a line, members farther right. */
function linesOf(value: unknown, name: string, indent: string): string[] {
  if (typeof value === "string") return [`${indent}${name}: ${JSON.stringify(value)}`];
  if (value === null || typeof value !== "object") return [`${indent}${name}: ${numberText(value)}`];
  if (isArray(value)) return [`${indent}${name}: ${arrayText(value)}`];
  const members = Object.entries(value);
  if (Array.isArray(value) && value.every((one) => typeof one !== "object")) return [`${indent}${name}: [${value.map(numberText).join(", ")}]`];
  return [`${indent}${name}:`, ...members.flatMap(([key, member]) => linesOf(member, key, `${indent}  `))];
}

function textOf(frame: Frame): string {
  const lines = Object.entries(frame.content as object).flatMap(([name, value]) => linesOf(value, name, ""));
  return [...lines.slice(0, MOST_LINES), ...(lines.length > MOST_LINES ? [`... ${lines.length - MOST_LINES} lines more`] : [])].join("\n");
}

const chosen = signal("");

export function MessagePane() {
  const topics = state.value!.topics.filter(({ name }) => name.includes("/")); // as published: others are made here
  const topic = topics.some(({ name }) => name === chosen.value) ? chosen.value : topics[0]?.name ?? "";
  const [shown, show] = useState<Frame | null>(null);
  const [held, hold] = useState(false);
  const holds = useRef(held);
  holds.current = held;
  useEffect(() => {
    let newest: Frame | null = null;
    show(null);
    const close = watchText(topic, (frame) => (newest = frame));
    const timer = setInterval(() => !holds.current && show(newest), EVERY_MS);
    return () => {
      clearInterval(timer);
      close();
    };
  }, [topic]);
  return (
    <>
      <header>
        <h2>message</h2> {topics.find(({ name }) => name === topic)?.type}
        {shown && ` · number ${shown.seq}, t = ${(shown.tSim_ns * 1e-9).toFixed(3)} s, ${shown.bytes} bytes`}
      </header>
      <pre class="log" tabIndex={0} aria-label="newest message">{shown ? textOf(shown) : `No message of ${topic} yet.`}</pre>
      <footer>
        <select aria-label="topic of the message" value={topic} onChange={(e) => (chosen.value = (e.target as HTMLSelectElement).value)}>
          {topics.map(({ name, type }) => <option key={name} value={name}>{name}, {type}</option>)}
        </select>
        <label><input type="checkbox" checked={held} onChange={() => hold(!held)} /> hold</label>
      </footer>
    </>
  );
}
