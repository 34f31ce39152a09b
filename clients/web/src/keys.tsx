// All by keyboard: what each key does, and the list of them.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

export interface Key {
  key: string; // as KeyboardEvent names it
  does: string;
  act(): void;
}

/** Keys that single panes know, for the list. */
const OF_PANES = [
  ["Tab, Shift Tab", "from one thing to the next"],
  ["arrows in a picture", "move its cursor; with Shift by 20 pixels"],
  ["arrows, + and - in the chart", "move it, zoom; its middle is the cursor"],
  ["arrows on an edge between panes", "move it; with Shift by more"],
  ["m in the chart", "measures from its middle; again: to its middle"],
];

const listed = signal(false);
export const listKeys = () => (listed.value = !listed.value);

const isText = (target: EventTarget | null) => target instanceof HTMLElement && ["INPUT", "SELECT", "TEXTAREA"].includes(target.tagName);
const ownsKey = (target: EventTarget | null, key: string) => isText(target) || (key === " " && target instanceof HTMLButtonElement);

/** Listens while it is shown, and lists the keys where that is asked for. */
export function Keys({ keys }: { keys: Key[] }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const known = useRef(keys);
  known.current = keys;
  useEffect(() => {
    const press = (event: KeyboardEvent) => {
      if (event.ctrlKey || event.metaKey || event.altKey || ownsKey(event.target, event.key)) return;
      const key = known.current.find((one) => one.key === event.key);
      if (!key) return;
      event.preventDefault();
      key.act();
    };
    document.addEventListener("keydown", press);
    return () => document.removeEventListener("keydown", press);
  }, []);
  const open = listed.value;
  useEffect(() => {
    if (open) dialog.current!.showModal();
    else dialog.current!.close();
  }, [open]);
  return (
    <dialog ref={dialog} aria-label="keys" onClose={() => (listed.value = false)}>
      <h2>Keys</h2>
      <table>
        <tbody>
          {keys.map(({ key, does }) => <tr key={key}><th scope="row"><kbd>{key === " " ? "Space" : key}</kbd></th><td>{does}</td></tr>)}
          {OF_PANES.map(([key, does]) => <tr key={key}><th scope="row"><kbd>{key}</kbd></th><td>{does}</td></tr>)}
        </tbody>
      </table>
      <button onClick={listKeys}>close</button>
    </dialog>
  );
}
