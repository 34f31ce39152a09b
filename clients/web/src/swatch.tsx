// What colours mean.
import { useEffect, useRef } from "preact/hooks";

/** A patch of colour beside the word for it: words keep the page's own colours, which are easy to read. */
export const Swatch = ({ colour }: { colour: string }) => <span class="swatch" style={{ background: colour }} />;

/** All colours of a scale, a pixel each. */
export function ColourBar({ colours, label }: { colours: Uint32Array; label: string }) {
  const ref = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const context = ref.current!.getContext("2d")!;
    const image = context.createImageData(colours.length, 1);
    new Uint32Array(image.data.buffer).set(colours);
    context.putImageData(image, 0, 0);
  }, [colours]);
  return <canvas ref={ref} class="bar" width={colours.length} height={1} role="img" aria-label={label} />;
}
