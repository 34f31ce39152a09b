// Day, dusk and night, and the choice of colours. At night the browser dims all that it shows, pictures included (console.css).
import { kept } from "./kept";

export const LIGHTS = ["day", "dusk", "night"];
export const light = kept<string>("light", "dusk", (value) => LIGHTS.includes(value as string));
light.subscribe((now) => (document.documentElement.dataset.light = now));

export const COLOURS = ["even", "rainbow"];
/** `even`: of even steps in lightness, for all eyes; `rainbow`: as surveyors know it. */
export const colours = kept<string>("colours", "even", (value) => COLOURS.includes(value as string));

export const nextLight = () => (light.value = LIGHTS[(LIGHTS.indexOf(light.value) + 1) % LIGHTS.length]);
