// Frames of the gateway, and the connection to it (docs/manual/console-wire.md).
import { decode } from "@msgpack/msgpack";
import { Numbers, TYPES } from "./messages";

export interface Frame {
  type: string; // "view/1"; "" for a type that this page does not know
  topic: string;
  epoch: number;
  seq: number;
  tSim_ns: number;
  bytes: number; // of the whole frame
  content: unknown;
}

const ENVELOPE = 64;
const MAGIC = 0x31534e45;
const KINDS = {
  u1: Uint8Array, i2: Int16Array, u2: Uint16Array, i4: Int32Array, u4: Uint32Array, i8: BigInt64Array, f4: Float32Array,
  f8: Float64Array,
};

const padded = (size: number) => Math.ceil(size / 8) * 8;

/** Views of the frame's bytes where arrays are described. */
function withArrays(value: any, take: (dtype: keyof typeof KINDS, count: number) => ArrayLike<unknown>): unknown {
  if (Array.isArray(value)) return value.map((element) => withArrays(element, take));
  if (value === null || typeof value !== "object") return value;
  if ("dtype" in value && "shape" in value && "frame" in value) {
    const count = value.shape.length ? value.shape.reduce((a: number, b: number) => a * b, 1) : 0;
    return { shape: value.shape, data: take(value.dtype, count) } as Numbers<unknown>;
  }
  return Object.fromEntries(Object.entries(value).map(([key, member]) => [key, withArrays(member, take)]));
}

export function decodeFrame(bytes: ArrayBuffer): Frame {
  const head = new DataView(bytes);
  if (bytes.byteLength < ENVELOPE + 8 || head.getUint32(0, true) !== MAGIC) throw new Error("not a frame of a console");
  const topicBytes = head.getUint32(ENVELOPE, true);
  const mapBytes = head.getUint32(ENVELOPE + 4, true);
  const topicAt = ENVELOPE + 8;
  const mapAt = topicAt + padded(topicBytes);
  let at = mapAt + padded(mapBytes);
  const take = (dtype: keyof typeof KINDS, count: number) => {
    const kind = KINDS[dtype];
    const array = new kind(bytes, at, count);
    at += padded(count * kind.BYTES_PER_ELEMENT);
    return array;
  };
  return {
    type: TYPES[head.getBigUint64(24, true).toString(16).padStart(16, "0")] ?? "",
    topic: new TextDecoder().decode(new Uint8Array(bytes, topicAt, topicBytes)),
    epoch: head.getUint32(8, true),
    seq: Number(head.getBigUint64(32, true)),
    tSim_ns: Number(head.getBigInt64(40, true)),
    bytes: bytes.byteLength,
    content: withArrays(decode(new Uint8Array(bytes, mapAt, mapBytes)), take),
  };
}

/** The token of the URL that was opened, kept for this tab and taken out of the address bar. */
export function takeToken(): string {
  const given = location.hash.slice(1);
  if (given) {
    sessionStorage.setItem("token", given);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem("token") ?? "";
}

/** A connection that comes back by itself; `down` says why it went. */
export class Wire {
  private socket: WebSocket | null = null;

  constructor(private token: string, private on: { frame(frame: Frame): void; up(): void; down(why: string): void }) {
    this.open();
  }

  private open() {
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.socket = socket;
      this.send("console_enter/1", { token: this.token });
      this.on.up();
    };
    socket.onmessage = (event) => this.on.frame(decodeFrame(event.data));
    socket.onclose = (event) => {
      this.socket = null;
      this.on.down(event.reason || "the console does not answer");
      if (event.code !== 1008) setTimeout(() => this.open(), 1000);
    };
  }

  send(type: string, content: object) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ type, ...content }));
  }
}
