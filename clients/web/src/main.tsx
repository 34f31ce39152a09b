// The console's page.
import { render } from "preact";
import { acknowledgeAll, Alarms } from "./alarms";
import { ChartPane } from "./chart";
import { areSizesChanged, Grid, resetSizes } from "./grid";
import { HelmPane } from "./helm";
import { Key, Keys, listKeys } from "./keys";
import { CHART, choose, HEALTH, HELM, layout, LAYOUT_NAMES, LOGS, MESSAGE, names, nextLayout, NUMBERS, panes, toggle } from "./layouts";
import { COLOURS, colours, light, LIGHTS, nextLight } from "./light";
import { LogsPane } from "./logs";
import { NumbersPane } from "./numbers";
import { MessagePane } from "./message";
import { Head } from "./panes";
import { HealthPane } from "./processes";
import { answer, begin, connected, send, simTime_s, state, trouble } from "./store";

const command = (name: string, rate = 1) => send("console_command/1", { command: name, rate });

function Controls() {
  const s = state.value!;
  if (!s.may_control || s.state === "ended" || s.state === "waiting") return null;
  const rate = (event: Event) => {
    const value = Number((event.target as HTMLInputElement).value);
    if (Number.isFinite(value) && value >= 0) command("rate", value);
  };
  return (
    <span class="controls">
      {s.state === "paused" ? <button onClick={() => command("resume")}>resume</button> : <button onClick={() => command("pause")}>pause</button>}
      <label>rate <input type="number" min="0" step="0.5" value={s.speed} onChange={rate} title="sim seconds per wall second; 0: as fast as possible" /></label>
      <button onClick={() => confirm("Stop the run?") && command("stop")}>stop</button>
    </span>
  );
}

function Select({ label, of, chosen, choose: take }: { label: string; of: string[]; chosen: string; choose(name: string): void }) {
  return (
    <select aria-label={label} title={label} value={chosen} onChange={(e) => take((e.target as HTMLSelectElement).value)}>
      {of.map((name) => <option key={name} value={name}>{name}</option>)}
    </select>
  );
}

function Bar() {
  const s = state.value!;
  return (
    <nav>
      <h1>Ensonify</h1>
      <span title={s.launch || s.name}>{s.kind} {s.name.split("/").pop()}</span>
      {s.items.length > 0 && (
        <select aria-label="open another run or record" value="" onChange={(e) => send("console_open/1", { id: (e.target as HTMLSelectElement).value })}>
          <option value="">open ...</option>
          {s.items.map((item) => <option key={item.id} value={item.id}>{item.text}</option>)}
        </select>
      )}
      <span class={`state ${s.state}`}>{s.state}</span>
      <span>t = {simTime_s.value.toFixed(1)} s</span>
      <Controls />
      <button disabled={!areSizesChanged(shown().length)} onClick={() => resetSizes(shown().length)} title="panes as large as at first">reset sizes</button>
      <button aria-label="keys" title="keys" onClick={listKeys}>?</button>
      {s.message && <span class="note">{s.message}</span>}
      {answer.value && <span class="error" role="alert">{answer.value}</span>}
      {!connected.value && <span class="error" role="alert">no connection: {trouble.value}</span>}
      <span class="right">
        {names().map((name) => (
          <label key={name}><input type="checkbox" checked={panes().includes(name)} onChange={() => toggle(name)} /> {name}</label>
        ))}
        <Select label="layout" of={LAYOUT_NAMES} chosen={layout.value} choose={choose} />
        <Select label="light" of={LIGHTS} chosen={light.value} choose={(name) => (light.value = name)} />
        <Select label="colours" of={COLOURS} chosen={colours.value} choose={(name) => (colours.value = name)} />
      </span>
    </nav>
  );
}

const shown = () => [...panes(), HEALTH];

function pane(name: string) {
  if (name === CHART) return <ChartPane />;
  if (name === NUMBERS) return <NumbersPane />;
  if (name === LOGS) return <LogsPane />;
  if (name === MESSAGE) return <MessagePane />;
  if (name === HELM) return <HelmPane />;
  if (name === HEALTH) return <HealthPane />;
  return <Head topic={name} />;
}

const pauseOrResume = () => state.value!.may_control && command(state.value!.state === "paused" ? "resume" : "pause");

const keys = (): Key[] => [
  { key: "?", does: "lists these keys", act: listKeys },
  ...names().slice(0, 9).map((name, i) => ({ key: String(i + 1), does: `shows or hides ${name}`, act: () => toggle(name) })),
  { key: "v", does: "next layout", act: nextLayout },
  { key: "l", does: "day, dusk, night", act: nextLight },
  ...(state.value!.may_control ? [{ key: " ", does: "pauses the run, resumes it", act: pauseOrResume }] : []),
  { key: "a", does: "acknowledges all alarms", act: acknowledgeAll },
];

function Start() {
  const s = state.value!;
  return (
    <section class="start">
      <h1>Open a run or a record</h1>
      {s.items.length === 0 && <p>No run is live, and there are no records in the console's folder (--folder).</p>}
      <ul>{s.items.map((item) => <li key={item.id}><button onClick={() => send("console_open/1", { id: item.id })}>{item.kind}: {item.text}</button></li>)}</ul>
      <h2>Start one from a shell</h2>
      <ul>{s.launches.map((file) => <li key={file}><code>ensonify console {file}</code></li>)}</ul>
      {answer.value && <p class="error" role="alert">{answer.value}</p>}
    </section>
  );
}

function Page() {
  const s = state.value;
  if (!s) return <p class={trouble.value ? "error" : "note"} role="alert">{trouble.value || "Connecting ..."}</p>;
  if (!s.kind) return <Start />;
  return (
    <>
      <Bar />
      <Alarms />
      <Keys keys={keys()} />
      <Grid panes={shown().map((name) => ({ name: `${s.name} ${name}`, pane: pane(name) }))} />
    </>
  );
}

const root = document.getElementById("page")!;
root.textContent = "";
render(<Page />, root);
begin();
