// What was chosen on this page, kept by the browser for this address.
import { Signal, signal } from "@preact/signals";

/** A choice that is there again after a reload. What a browser has kept and `fits` refuses is forgotten. */
export function kept<T>(name: string, first: T, fits: (value: unknown) => boolean): Signal<T> {
  let value = first;
  try {
    const found: unknown = JSON.parse(localStorage.getItem(name) ?? "null");
    if (found !== null && fits(found)) value = found as T;
  } catch {
    // Not ours, or no storage: as at first.
  }
  const choice = signal(value);
  let written = JSON.stringify(value);
  choice.subscribe((now) => {
    const text = JSON.stringify(now);
    if (text === written) return;
    written = text;
    try {
      localStorage.setItem(name, text);
    } catch {
      // No storage: the choice holds until the page goes.
    }
  });
  return choice;
}
