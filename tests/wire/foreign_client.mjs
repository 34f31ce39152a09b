// A participant written from docs/manual/wire.md alone, with the npm packages zeromq and @msgpack/msgpack and nothing of ours: it
// sees every pose once, in order and in time, steers east at 1.5 m/s and publishes an array. Exit code 1 if what arrives is not
// what the page promises.
import { decode, encode } from "@msgpack/msgpack";
import { readFileSync } from "node:fs";
import path from "node:path";
import process from "node:process";
import { Dealer, Subscriber, XPublisher } from "zeromq";

const NEVER = 2n ** 63n - 1n;
const PERIOD_NS = 100_000_000n;
const MAGIC = 0x31534e45;
const { ENSONIFY_NAME: name, ENSONIFY_CLOCK: clock } = process.env;

function must(truth, what) {
  if (truth) return;
  console.error(`foreign client: ${what}`);
  process.exit(1);
}

function typeHash(text) {
  let value = 0xcbf29ce484222325n;
  for (const byte of Buffer.from(text)) value = BigInt.asUintN(64, (value ^ BigInt(byte)) * 0x100000001b3n);
  return value;
}

const file = process.env.ENSONIFY_KEYS;
const keys = file && JSON.parse(readFileSync(file, "utf8"));
const bound = keys ? { curveServer: true, curveSecretKey: keys.bound_secret } : {};
const connected = keys
  ? { curveServerKey: keys.bound_public, curvePublicKey: keys.connected_public, curveSecretKey: keys.connected_secret } : {};
const control = new Dealer({ routingId: name, reconnectInterval: 5, ...connected });
const sync = new XPublisher({ noDrop: true, ...bound });
const live = new XPublisher(bound);
const data = new Subscriber({ receiveHighWaterMark: 0, ...connected });
for (const [plane, socket] of Object.entries({ sync, live })) {
  await socket.bind(clock.startsWith("ipc:") ? `${path.dirname(clock)}/${name}.${plane}` : "tcp://127.0.0.1:*");
}
control.connect(clock);

const say = (what) => control.send(JSON.stringify(what));
await say({
  kind: "hello", name, component: "foreign_js", pid: process.pid, sync: sync.lastEndpoint, live: live.lastEndpoint,
  out: [{ port: "command", type: "guidance/1", rate: [10, 1] }, { port: "image", type: "my_image/1", rate: [10, 1] }],
  in: [{ port: "pose", type: "pose/1" }],
});
const welcome = JSON.parse((await control.receive())[0]);
if (welcome.kind === "refused") {
  console.error(welcome.problems.join("\n"));
  process.exit(2);
}
const pose = welcome.in[0];
data.connect(pose.endpoint);
data.subscribe(pose.topic + "\0");
data.subscribe("~" + pose.token);

const unproven = new Set(welcome.out.flatMap((out) => out.tokens));
while (unproven.size > 0) {
  const [subscription] = await sync.receive();
  const token = subscription.subarray(2).toString();
  if (subscription[0] === 1 && subscription[1] === 0x7e && unproven.delete(token)) await say({ kind: "proven", tokens: [token] });
}

const published = welcome.out.map(() => 0n);
async function publish(out, type, t_ns, map, ...arrays) {
  const { topic, topic_id } = welcome.out[out];
  const envelope = Buffer.alloc(64);
  envelope.writeUInt32LE(MAGIC, 0);
  envelope.writeUInt16LE(1, 4);
  envelope.writeUInt32LE(welcome.epoch, 8);
  envelope.writeUInt32LE(welcome.rank, 12);
  envelope.writeUInt32LE(topic_id, 16);
  envelope.writeUInt32LE(3 + arrays.length, 20);
  envelope.writeBigUInt64LE(typeHash(type), 24);
  envelope.writeBigUInt64LE(published[out]++, 32);
  envelope.writeBigInt64LE(t_ns, 40);
  const frames = [topic + "\0", envelope, encode(map, { useBigInt64: true }), ...arrays];
  await sync.send(frames);
  await live.send(frames);
}

const waiting = []; // [t_sim, message], arrived and not yet due
let arrived = 0n, seen = 0n, next_ns = 0n;
for (;;) {
  const [frame] = await control.receive();
  if (frame[0] === "{".charCodeAt(0)) {
    must(JSON.parse(frame).kind === "end", `unexpected ${frame}`);
    break;
  }
  must(frame[0] === "G".charCodeAt(0), `unexpected ${frame}`);
  const horizon_ns = frame.readBigInt64LE(5);
  for (let i = 0, at = 17; i < frame.readUInt32LE(13); ++i, at += 12) {
    must(frame.readUInt32LE(at) === pose.topic_id, "a grant names a topic that is not ours");
    while (arrived < frame.readBigUInt64LE(at + 4)) {
      const [topic, envelope, head, ...arrays] = await data.receive();
      must(topic.toString() === pose.topic + "\0" && envelope.length === 64, "the frames are not as described");
      must(envelope.readUInt32LE(0) === MAGIC && envelope.readUInt16LE(4) === 1, "the envelope is not as described");
      must(envelope.readUInt32LE(8) === welcome.epoch && envelope.readUInt32LE(16) === pose.topic_id, "another epoch or topic");
      must(envelope.readUInt32LE(12) === pose.rank && envelope.readUInt32LE(20) === 3 + arrays.length, "another publisher");
      must(envelope.readBigUInt64LE(24) === typeHash("pose/1"), "another type");
      must(envelope.readBigUInt64LE(32) === arrived++, "a message is missing");
      waiting.push([envelope.readBigInt64LE(40), decode(head, { useBigInt64: true })]);
    }
  }
  while (next_ns <= horizon_ns) {
    while (waiting.length > 0 && waiting[0][0] + BigInt(pose.delay_ns) <= next_ns) {
      const stamp_ns = waiting.shift()[1].stamp_ns;
      must(BigInt(stamp_ns) === seen++ * 10_000_000n, `pose of ${stamp_ns} ns is not number ${seen - 1n}`);
    }
    must(seen === next_ns / 10_000_000n + 1n, `at ${next_ns} ns ${seen} poses were due`);
    await publish(0, "guidance/1", next_ns, { stamp_ns: next_ns, heading_grid_rad: Math.PI / 2, speed_mps: 1.5 });
    const rows = Number(next_ns / PERIOD_NS % 3n); // each third image is empty
    const pixels = rows > 0 ? { dtype: "f4", shape: [rows, 2], frame: 3 } : { dtype: "f4", shape: [], frame: 3 };
    await publish(1, "my_image/1", next_ns, { stamp_ns: next_ns, pixels }, Buffer.from(new Float32Array(2 * rows).buffer));
    next_ns += PERIOD_NS;
  }
  const done = Buffer.alloc(26 + 12 * welcome.out.length);
  done.write("D");
  done.writeUInt32LE(welcome.epoch, 1);
  done.writeBigInt64LE(next_ns, 5);
  done.writeUInt32LE(welcome.out.length, 22);
  welcome.out.forEach((out, i) => {
    done.writeUInt32LE(out.topic_id, 26 + 12 * i);
    done.writeBigUInt64LE(published[i], 30 + 12 * i);
  });
  await control.send(done);
}
must(seen > 0n && next_ns < NEVER, "no pose came");
await say({ kind: "bye" });
