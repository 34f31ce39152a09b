// What a helmsman needs, large: where the vehicle is beside its runline, how far that goes on, heading and speed.
import { useEffect, useState } from "preact/hooks";
import { newest, news } from "./series";
import { missions, state, wantMissions, wantValues } from "./store";

const pane = {};
const SCALES_M = [2, 5, 10, 20, 50, 100, 200, 500, 1000];

const topicsOf = (type: string) => (state.value?.topics ?? []).filter((topic) => topic.type === type).map((topic) => topic.name);

/** Whether there is anything for a helm display. */
export const hasHelm = () => topicsOf("mission_state/1").length + topicsOf("estimate/1").length > 0;

/** Picks one of several topics; nothing to choose where there is one. */
function Choice({ label, of, chosen, choose }: { label: string; of: string[]; chosen: string; choose(name: string): void }) {
  if (of.length < 2) return null;
  return (
    <select aria-label={label} value={chosen} onChange={(e) => choose((e.target as HTMLSelectElement).value)}>
      {of.map((name) => <option key={name} value={name}>{name}</option>)}
    </select>
  );
}

function Big({ label, value, unit, note, name }: { label: string; value: string; unit: string; note?: string; name: string }) {
  return (
    <div class="big">
      <div class="note">{label}</div>
      <div><span class="bigValue" data-helm={name}>{value}</span> {unit}</div>
      <div class="note">{note ?? ""}</div>
    </div>
  );
}

/** The line in the middle, the vehicle beside it. */
function CrossTrack({ metres }: { metres: number }) {
  const scale = SCALES_M.find((one) => one >= Math.abs(metres)) ?? SCALES_M[SCALES_M.length - 1];
  const x = 100 * Math.max(-1, Math.min(1, metres / scale));
  return (
    <svg class="crossTrack" viewBox="-110 -16 220 42" role="img" aria-label={`cross-track, ${scale} m to either side`}>
      <line x1="-100" y1="0" x2="100" y2="0" class="faintLine" />
      {[-100, -50, 50, 100].map((tick) => <line key={tick} x1={tick} y1="-5" x2={tick} y2="5" class="faintLine" />)}
      <line x1="0" y1="-12" x2="0" y2="12" class="runline" />
      <polygon points={`${x},-8 ${x - 6},8 ${x + 6},8`} class="vessel" data-x={x} />
      <text x="-106" y="22" text-anchor="start">{scale} m port</text>
      <text x="106" y="22" text-anchor="end">starboard {scale} m</text>
    </svg>
  );
}

const text = (number: { value: number } | null, digits: number) => (number ? number.value.toFixed(digits) : "-");

export function HelmPane() {
  const missionTopics = topicsOf("mission_state/1");
  const estimateTopics = topicsOf("estimate/1");
  const guidanceTopics = topicsOf("guidance/1");
  const [mission, setMission] = useState(missionTopics[0] ?? "");
  const [estimate, setEstimate] = useState(estimateTopics[0] ?? "");
  const guidance = guidanceTopics.find((topic) => topic.split("/")[0] === mission.split("/")[0]) ?? "";
  const heading = `${estimate}.heading_grid_rad`;
  const speed = `${estimate}.speed_mps`;
  const names = [...(estimate ? [heading, speed] : []), ...(guidance ? [`${guidance}.heading_grid_rad`, `${guidance}.speed_mps`] : [])];
  useEffect(() => wantValues(pane, names), [names.join(" ")]);
  useEffect(() => wantMissions(mission ? [mission] : []), [mission]);
  useEffect(() => () => {
    wantValues(pane, []);
    wantMissions([]);
  }, []);
  news.value; // draws again when numbers have come
  const m = missions.value[mission];
  const toSteer = newest(`${guidance}.heading_grid_rad`);
  const toReach = newest(`${guidance}.speed_mps`);
  const onRunline = m && m.line >= 0;
  return (
    <>
      <header>
        <h2>helm</h2> by the estimate; headings from grid north
        {m && ` · ${m.state}`}
        {onRunline && ` · line ${m.line + 1} of ${m.line_count}${m.line_name ? `, ${m.line_name}` : ""}`}
      </header>
      <div class="helm" tabIndex={0}>
        {mission && (
          <>
            <div class="big">
              <div class="note">cross-track</div>
              <div>
                <span class="bigValue" data-helm="cross-track">{m ? Math.abs(m.cross_track_m).toFixed(1) : "-"}</span> m {m && (m.cross_track_m < 0 ? "to port" : "to starboard")}
              </div>
              {m && <CrossTrack metres={m.cross_track_m} />}
            </div>
            <Big label="distance to go" name="to-go" value={m ? m.distance_to_go_m.toFixed(0) : "-"} unit="m" />
          </>
        )}
        {estimate && (
          <>
            <Big label="heading" name="heading" value={text(newest(heading), 1)} unit="°" note={toSteer ? `to steer ${text(toSteer, 1)}°` : ""} />
            <Big label="speed over ground" name="speed" value={text(newest(speed), 2)} unit="m/s" note={toReach ? `asked for, through the water: ${text(toReach, 2)} m/s` : ""} />
          </>
        )}
      </div>
      <footer>
        <Choice label="mission" of={missionTopics} chosen={mission} choose={setMission} />
        <Choice label="estimate" of={estimateTopics} chosen={estimate} choose={setEstimate} />
        {!mission && "No process says what a mission is doing."}
      </footer>
    </>
  );
}
