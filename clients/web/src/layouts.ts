// Which panes are shown: ready layouts, and what was changed by hand.
import { kept } from "./kept";
import { hasHelm } from "./helm";
import { hasChart, hasLog, hasValues, viewTopics } from "./store";

export const CHART = "chart";
export const NUMBERS = "numbers";
export const HELM = "helm";
export const LOGS = "logs";
export const MESSAGE = "message";
export const HEALTH = "health";

/** Heads of these components; of a record, or another component's, those that are named after it. */
function heads(...components: string[]): string[] {
  return viewTopics().filter(({ component }) => components.includes(component)).map(({ name }) => name);
}
const all = () => viewTopics().map(({ name }) => name);

const LAYOUTS: Record<string, () => string[]> = {
  survey: () => [...all().slice(0, 2), CHART],
  sidescan: () => [...heads("sidescan").slice(0, 3), CHART],
  imaging: () => [...heads("forward_looking", "scanning").slice(0, 3), CHART],
  navigation: () => [CHART, NUMBERS, LOGS],
  helm: () => [HELM, CHART],
};
export const LAYOUT_NAMES = Object.keys(LAYOUTS);

export const layout = kept<string>("layout", "survey", (value) => LAYOUT_NAMES.includes(value as string));
/** Panes that were chosen by hand; null: those of the layout. */
export const byHand = kept<string[] | null>("panes", null, (value) => Array.isArray(value) && value.every((name) => typeof name === "string"));

/** Names of all panes that there can be. */
export const names = () => [...all(), ...(hasChart() ? [CHART] : []), ...(hasValues() ? [NUMBERS] : []), ...(hasHelm() ? [HELM] : []), ...(hasLog() ? [LOGS] : []), MESSAGE];

export function panes(): string[] {
  const there = names();
  const own = byHand.value?.filter((name) => there.includes(name));
  if (own && (own.length || !byHand.value!.length)) return own;
  return LAYOUTS[layout.value]().filter((name) => there.includes(name));
}

export function choose(name: string) {
  layout.value = name;
  byHand.value = null;
}
export const nextLayout = () => choose(LAYOUT_NAMES[(LAYOUT_NAMES.indexOf(layout.value) + 1) % LAYOUT_NAMES.length]);

export function toggle(name: string) {
  const now = panes();
  byHand.value = now.includes(name) ? now.filter((other) => other !== name) : [...now, name];
}
