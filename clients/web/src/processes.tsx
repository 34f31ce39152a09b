// What the processes and the clock say of themselves, and what they publish.
import { ConsoleTopic, Health, Pace } from "./messages";
import { clock, flow, health, received, state } from "./store";

const seconds = (value: number) => `${value.toFixed(value < 1 ? 3 : 1)}\u00a0s`;
const processOf = (topic: string) => topic.split("/")[0];

function Process({ name, report, pace, wall_s }: { name: string; report?: Health; pace?: Pace; wall_s: number }) {
  const component = state.value!.topics.find((topic) => topic.publisher === name && topic.component)?.component;
  return (
    <tr class={report?.state}>
      <th scope="row">{name}</th><td>{component}</td><td>{report?.state}</td>
      <td>{pace?.grants}</td><td>{pace && seconds(pace.cost_s)}</td><td>{pace && wall_s > 0 && `${((100 * pace.cost_s) / wall_s).toFixed(1)}\u00a0%`}</td>
      <td>{pace?.late_events}</td><td>{pace && seconds(pace.worst_lateness_s)}</td>
      <td>{report?.message} {report?.counters.filter((k) => k.count).map((k) => `${k.name} ${k.count}`).join(", ")}</td>
    </tr>
  );
}

function Processes() {
  const c = clock.value;
  const paces = new Map((c?.participants ?? []).map((pace) => [pace.name, pace]));
  const names = [...new Set([...paces.keys(), ...Object.keys(health.value)])].sort();
  return (
    <table>
      <thead>
        <tr>
          <th>process</th><th>component</th><th>state</th><th title="times that the clock let it go on">grants</th><th title="wall time inside its events">cost</th>
          <th title="cost as a share of wall time">share</th><th title="grants that it finished last, the run being late">late</th><th title="largest lateness charged to it">worst</th><th>why, counts</th>
        </tr>
      </thead>
      <tbody>{names.map((name) => <Process key={name} name={name} report={health.value[name]} pace={paces.get(name)} wall_s={c?.wall_s ?? 0} />)}</tbody>
    </table>
  );
}

/** All topics, by process; numbers of those that this page receives. */
function Topics() {
  const owner = ({ name, publisher }: ConsoleTopic) => publisher || (name.includes("/") ? processOf(name) : "");
  const topics = state.value!.topics.map((topic) => ({ ...topic, process: owner(topic) }));
  // Those that the console makes itself come last.
  topics.sort((a, b) => Number(!a.process) - Number(!b.process) || a.process.localeCompare(b.process) || a.name.localeCompare(b.name));
  return (
    <table>
      <thead><tr><th>process</th><th>publishes</th><th>type</th><th>messages</th><th>bytes</th><th>not sent</th><th>age</th></tr></thead>
      <tbody>
        {topics.map(({ name, type, process }) => {
          const f = flow.value[name];
          const got = received.value[name];
          return (
            <tr key={name}>
              <td>{process || "console"}</td><td>{name}</td><td>{type}</td>
              {f ? <><td>{f.rate_hz.toFixed(1)}&nbsp;/s</td><td>{((got?.bytesPerS ?? 0) / 1000).toFixed(1)}&nbsp;kB/s</td><td>{f.lost}</td><td>{Math.round(1000 * f.age_s)}&nbsp;ms</td></> : <td colSpan={4} class="note">not watched here</td>}
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

export function HealthPane() {
  const c = clock.value;
  return (
    <>
      <header><h2>health</h2> as the processes and the clock say</header>
      <div class="scroll" tabIndex={0}>
        {c && (
          <p>
            clock: {c.state}; {c.rate ? `${c.rate} x real time asked for, ` : "as fast as possible, "}
            {c.rate_factor.toFixed(2)} reached; {c.lateness_s.toFixed(3)} s late, {c.slips} slips ({seconds(c.slip_s)})
          </p>
        )}
        {c || Object.keys(health.value).length > 0 ? <Processes /> : <p class="note">No process has reported since this page was opened: they report when something changes.</p>}
        <Topics />
      </div>
    </>
  );
}
