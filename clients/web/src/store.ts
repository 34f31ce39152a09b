// What the page knows: signals that the panes show.
import { signal } from "@preact/signals";
import { ClockHealth, ConsoleAlarms, ConsoleAnswer, ConsoleCells, ConsoleFlow, ConsoleLog, ConsolePlan, ConsoleRelief, ConsoleTrack, ConsoleFlowTopic, ConsoleState, ConsoleTopic, ConsoleValues, Health, MissionState, View } from "./messages";
import { clearAlarms, takeAlarms } from "./alarms";
import { clearSeries, keepSeries, takeValues } from "./series";
import { Frame, takeToken, Wire } from "./wire";

export const connected = signal(false);
export const trouble = signal("");
export const state = signal<ConsoleState | null>(null);
export const flow = signal<Record<string, ConsoleFlowTopic>>({});
export const link = signal<ConsoleFlow | null>(null);
export const answer = signal("");
export const simTime_s = signal(0);
export const health = signal<Record<string, Health>>({});
/** What missions are doing, by topic. */
export const missions = signal<Record<string, MissionState>>({});
export const clock = signal<ClockHealth | null>(null);

/** What a pane of a head draws. Returns once it is on the canvas. */
export interface Drawer {
  take(view: View): void; // every message, in order
  draw(): void; // once a frame at most
}

interface Wished {
  cells: number;
  spreading_db: number;
  ground: boolean; // ranges on the ground
  upright: boolean; // the head's roll taken out
}

const UPRIGHT = ":upright";
const headOf = (topic: string) => (topic.endsWith(UPRIGHT) ? topic.slice(0, -UPRIGHT.length) : topic);
/** Who draws pictures of this topic. Not the head's own in the place of upright ones: somebody may read them as text. */
const drawerOf = (topic: string) => (wishes.get(headOf(topic))?.upright === topic.endsWith(UPRIGHT) ? drawers.get(headOf(topic)) : undefined);

const drawers = new Map<string, Drawer>();
const wishes = new Map<string, Wished>();
const due = new Map<string, number>(); // seq of the newest message of each topic that waits to be drawn
let wire: Wire | null = null;
let frameAsked = false;

/** Whether soundings or positions are published. */
export const hasChart = () => (state.value?.topics ?? []).some((topic) => CHART.includes(topic.name));
export type ChartNews = ConsoleCells | ConsolePlan | ConsoleRelief | ConsoleTrack;
const CHART = ["cells", "track", "relief", "plan"];
let chart: ((news: ChartNews) => void) | null = null;

/** Opens the chart's topics for a pane; the result closes them. */
export function watchChart(take: (news: ChartNews) => void): () => void {
  chart = take;
  watchAll();
  return () => {
    if (chart !== take) return;
    chart = null;
    watchAll();
  };
}

const numbers = new Map<object, string[]>(); // that a pane asks for
/** Whether there are numbers to be drawn over time. */
export const hasValues = () => (state.value?.topics ?? []).some((topic) => topic.name === VALUES);
const VALUES = "values";
const ALARMS = "alarms";
const LOG = "log";
let log: ((news: ConsoleLog) => void) | null = null;
/** Whether logs of the run's processes can be read. */
export const hasLog = () => (state.value?.topics ?? []).some((topic) => topic.name === LOG);

/** Opens the logs for a pane; the result closes them. */
export function watchLog(take: (news: ConsoleLog) => void): () => void {
  log = take;
  watchAll();
  return () => {
    log = null;
    watchAll();
  };
}

let text: { topic: string; take(frame: Frame): void } | null = null;

/** Opens a topic whose messages are read as text, whatever they are; the result closes it. */
export function watchText(topic: string, take: (frame: Frame) => void): () => void {
  const mine = { topic, take };
  text = mine;
  watchAll();
  return () => {
    if (text !== mine) return; // another has taken its place
    text = null;
    watchAll();
  };
}

const MOST_VALUES = 32;

/** All numbers (TOPIC.field) that a pane shows from now on. */
export function wantValues(pane: object, names: string[]) {
  if (names.length) numbers.set(pane, names);
  else numbers.delete(pane);
  watchAll();
}

let missionTopics: string[] = [];
/** Topics of mission_state/1 that are shown from now on. */
export function wantMissions(topics: string[]) {
  missionTopics = topics;
  watchAll();
}

const wantedValues = () => [...new Set([...numbers.values()].flat())].slice(0, MOST_VALUES);

export function viewTopics(): ConsoleTopic[] {
  return (state.value?.topics ?? []).filter((topic) => topic.type === "view/1");
}

const plain = (topic: string) => ({ topic, cells: 16, peak: false, spreading_db: 0, absorption_dbpm: 0 });

function watchAll() {
  const heads = [...wishes].map(([topic, { cells, spreading_db, upright }]) => ({ topic: upright ? topic + UPRIGHT : topic, cells, spreading_db, peak: false, absorption_dbpm: 0 }));
  const ground = [...wishes].filter(([, wished]) => wished.ground).map(([topic]) => topic);
  const small = (state.value?.topics ?? []).filter((topic) => topic.type === "health/1" || topic.type === "clock_health/1");
  const states = small.slice(0, 57 - heads.length).map(({ name }) => plain(name));
  const values = wantedValues();
  const shown = new Set([...heads, ...states.map(({ topic }) => ({ topic }))].map(({ topic }) => topic));
  const read = text?.topic && !shown.has(text.topic) && !missionTopics.includes(text.topic) ? [plain(text.topic)] : [];
  keepSeries(values);
  const made = [...(chart ? CHART : []), ...(values.length ? [VALUES] : []), ...missionTopics, ALARMS, ...(log ? [LOG] : [])].map(plain);
  wire?.send("console_watch/1", { hidden: document.hidden, topics: [...heads, ...made, ...states, ...read], values, ground });
}

/** Opens a topic for a pane; the result closes it. */
export function watch(topic: string, wished: Wished, drawer: Drawer): () => void {
  drawers.set(topic, drawer);
  wishes.set(topic, wished);
  watchAll();
  return () => {
    if (drawers.get(topic) !== drawer) return; // another pane has taken it over
    drawers.delete(topic);
    wishes.delete(topic);
    watchAll();
  };
}

/** Another size or gain for a pane that is watching. */
export function wish(topic: string, wished: Wished) {
  const now = wishes.get(topic);
  if (!now || (now.cells === wished.cells && now.spreading_db === wished.spreading_db && now.ground === wished.ground && now.upright === wished.upright)) return;
  wishes.set(topic, wished);
  watchAll();
}

function drawDue() {
  frameAsked = false;
  for (const [topic, seq] of due) {
    drawerOf(topic)?.draw();
    wire?.send("console_drawn/1", { topic, seq });
  }
  due.clear();
}

/** Topics of which this page has received something: messages and bytes so far, and in the second before. */
export const received = signal<Record<string, { messages: number; bytes: number; bytesPerS: number }>>({});
let counted: Record<string, { messages: number; bytes: number }> = {};

function count({ topic, bytes }: Frame) {
  const known = (counted[headOf(topic)] ??= { messages: 0, bytes: 0 });
  ++known.messages;
  known.bytes += bytes;
}

/** Once a second of wall time, with the gateway's report. */
function sayReceived() {
  received.value = Object.fromEntries(Object.entries(counted).map(([topic, now]) => [topic, { ...now, bytesPerS: now.bytes - (received.value[topic]?.bytes ?? 0) }]));
}

function take(frame: Frame) {
  count(frame);
  if (text?.topic === frame.topic) text.take(frame);
  if (frame.type === "view/1") {
    simTime_s.value = (frame.content as View).stamp_ns * 1e-9;
    drawerOf(frame.topic)?.take(frame.content as View);
    due.set(frame.topic, frame.seq);
    if (!frameAsked) requestAnimationFrame(drawDue);
    frameAsked = true;
  } else if (frame.type === "console_cells/1" || frame.type === "console_relief/1" || frame.type === "console_plan/1" || frame.type === "console_track/1") {
    chart?.(frame.content as ChartNews);
    if (frame.type === "console_track/1") simTime_s.value = Math.max(simTime_s.value, (frame.content as ConsoleTrack).stamp_ns * 1e-9);
    wire?.send("console_drawn/1", { topic: frame.topic, seq: frame.seq });
  } else if (frame.type === "console_values/1") {
    simTime_s.value = Math.max(simTime_s.value, takeValues(frame.content as ConsoleValues));
    wire?.send("console_drawn/1", { topic: frame.topic, seq: frame.seq });
  } else if (frame.type === "health/1") {
    health.value = { ...health.value, [frame.topic.split("/")[0]]: frame.content as Health };
  } else if (frame.type === "console_log/1") {
    log?.(frame.content as ConsoleLog);
    wire?.send("console_drawn/1", { topic: frame.topic, seq: frame.seq });
  } else if (frame.type === "console_alarms/1") {
    takeAlarms(frame.content as ConsoleAlarms);
  } else if (frame.type === "mission_state/1") {
    missions.value = { ...missions.value, [frame.topic]: frame.content as MissionState };
  } else if (frame.type === "clock_health/1") {
    clock.value = frame.content as ClockHealth;
    simTime_s.value = clock.value.stamp_ns * 1e-9;
  } else if (frame.type === "console_state/1") {
    const fresh = frame.content as ConsoleState;
    const other = fresh.name !== state.value?.name;
    if (other) {
      health.value = {};
      clock.value = null;
      missions.value = {};
      clearAlarms();
      clearSeries();
      counted = {};
      received.value = {};
      simTime_s.value = 0;
    }
    state.value = fresh;
    watchAll();
  } else if (frame.type === "console_flow/1") {
    link.value = frame.content as ConsoleFlow;
    flow.value = Object.fromEntries(link.value.topics.map((topic) => [headOf(topic.topic), topic]));
    wire?.send("console_drawn/1", { topic: frame.topic, seq: frame.seq });
    sayReceived();
  } else if (frame.type === "console_answer/1") {
    answer.value = (frame.content as ConsoleAnswer).error;
  } else {
    wire?.send("console_drawn/1", { topic: frame.topic, seq: frame.seq });
  }
}

export const send = (type: string, content: object) => {
  answer.value = "";
  wire?.send(type, content);
};

export function begin() {
  const token = takeToken();
  if (!token) {
    trouble.value = "Open the whole URL that the console printed: what follows # in it is the key.";
    return;
  }
  wire = new Wire(token, {
    frame: take,
    up() {
      connected.value = true;
      trouble.value = "";
    },
    down(why) {
      connected.value = false;
      trouble.value = why;
    },
  });
  document.addEventListener("visibilitychange", watchAll);
}
