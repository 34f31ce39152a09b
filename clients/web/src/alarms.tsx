// Alarms stay until somebody acknowledges them on this page, also when their cause has passed.
import { signal } from "@preact/signals";
import { ConsoleAlarm, ConsoleAlarms } from "./messages";

const WORDS: Record<string, string> = {
  no_bottom: "no bottom", off_line: "off the line", late: "late", late_pings: "late pings", slips: "slips", lost: "lost", disk: "disk", degraded: "degraded", failed: "failed",
};

const MOMENTS = ["late_pings", "slips", "lost"]; // they have no end

const alarms = signal<ConsoleAlarms>({ generation: 0, alarms: [] });
/** How often each had been raised when it was acknowledged. */
const acknowledged = signal<Record<string, number>>({});

const keyOf = (alarm: ConsoleAlarm) => `${alarm.kind} ${alarm.source}`;
const isNew = (alarm: ConsoleAlarm) => alarm.raised > (acknowledged.value[keyOf(alarm)] ?? 0);

export function takeAlarms(fresh: ConsoleAlarms) {
  if (fresh.generation !== alarms.value.generation) acknowledged.value = {};
  alarms.value = fresh;
}

/** Another run or record has been opened. */
export function clearAlarms() {
  alarms.value = { generation: 0, alarms: [] };
  acknowledged.value = {};
}

function acknowledge(these: ConsoleAlarm[]) {
  acknowledged.value = { ...acknowledged.value, ...Object.fromEntries(these.map((alarm) => [keyOf(alarm), alarm.raised])) };
}

export const acknowledgeAll = () => acknowledge(alarms.value.alarms.filter(isNew));

export function Alarms() {
  const shown = alarms.value.alarms.filter((alarm) => alarm.active || isNew(alarm));
  if (!shown.length) return null;
  const fresh = shown.filter(isNew);
  return (
    <section class="alarms" aria-label="alarms">
      <ul aria-live="assertive">
        {[...fresh, ...shown.filter((alarm) => !isNew(alarm))].map((alarm) => (
          <li key={keyOf(alarm)} class={isNew(alarm) ? "new" : "known"} data-alarm={keyOf(alarm)}>
            <b>{WORDS[alarm.kind] ?? alarm.kind}</b> {alarm.source}: {alarm.text}
            <span class="note"> since t = {(alarm.since_ns * 1e-9).toFixed(1)} s{alarm.raised > 1 && `, ${alarm.raised} times`}{!alarm.active && !MOMENTS.includes(alarm.kind) && ", over"}</span>
            {isNew(alarm) && <button aria-label={`acknowledge ${WORDS[alarm.kind] ?? alarm.kind} ${alarm.source}`} onClick={() => acknowledge([alarm])}>acknowledge</button>}
          </li>
        ))}
      </ul>
      {fresh.length > 1 && <button onClick={() => acknowledge(fresh)}>acknowledge all {fresh.length}</button>}
    </section>
  );
}
