// The newest lines of the processes' logs. They are text, whatever is in them.
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { signal } from "@preact/signals";
import { ConsoleLog, ConsoleLogLine } from "./messages";
import { watchLog } from "./store";

const KEPT = 1000;
const SHOWN = 300; // of those that are chosen
const RANK: Record<string, number> = { info: 0, warning: 1, error: 2 };

interface Line extends ConsoleLogLine {
  index: number;
}

const lines = signal<Line[]>([]);
let generation = 0;

function take(log: ConsoleLog) {
  const last = lines.value[lines.value.length - 1];
  const anew = log.generation !== generation || (last && log.first <= last.index);
  generation = log.generation;
  lines.value = [...(anew ? [] : lines.value), ...log.lines.map((line, i) => ({ ...line, index: log.first + i }))].slice(-KEPT);
}

export function LogsPane() {
  const [process, setProcess] = useState("");
  const [level, setLevel] = useState("info");
  const [word, setWord] = useState("");
  const place = useRef<HTMLDivElement>(null);
  const atEnd = useRef(true);
  useEffect(() => {
    lines.value = [];
    return watchLog(take);
  }, []);
  const processes = [...new Set([...lines.value.map((line) => line.process), ...(process ? [process] : [])])].sort();
  const wanted = word.toLowerCase();
  const chosen = lines.value.filter((line) => (!process || line.process === process) && RANK[line.level] >= RANK[level] && (!wanted || line.text.toLowerCase().includes(wanted)));
  const shown = chosen.slice(-SHOWN);
  // Before the browser says that it has scrolled: else lines that came meanwhile would pass for the reader's wish.
  useLayoutEffect(() => {
    if (atEnd.current) place.current!.scrollTop = place.current!.scrollHeight;
  });
  const value = (event: Event) => (event.target as HTMLInputElement | HTMLSelectElement).value;
  return (
    <>
      <header><h2>logs</h2> newest below · {shown.length} of {lines.value.length} lines{atEnd.current ? "" : ", held where you read"}</header>
      <div
        ref={place} class="log" tabIndex={0} role="log" aria-label="log lines"
        onScroll={({ currentTarget: t }) => (atEnd.current = t.scrollHeight - t.scrollTop - t.clientHeight < 8)}
      >
        {shown.map((line) => <div key={line.index} class={line.level}><span class="note">{line.process}</span> {line.text}</div>)}
        {lines.value.length === 0 && <p class="note">No line yet.</p>}
      </div>
      <footer>
        <select aria-label="process" value={process} onChange={(e) => setProcess(value(e))}>
          <option value="">all processes</option>
          {processes.map((name) => <option key={name} value={name}>{name}</option>)}
        </select>
        <select aria-label="least level" value={level} onChange={(e) => setLevel(value(e))}>
          <option value="info">all levels</option>
          <option value="warning">warnings and errors</option>
          <option value="error">errors</option>
        </select>
        <input aria-label="text to find" placeholder="text to find" value={word} onInput={(e) => setWord(value(e))} />
      </footer>
    </>
  );
}
