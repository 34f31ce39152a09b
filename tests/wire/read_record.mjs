// read_record.mjs FILE: opens the sample record with @mcap/core and checks counts, times, schemas, attachments.
import assert from "node:assert/strict";
import { open } from "node:fs/promises";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

const START_NS = 1748736000n * 1000000000n;
const file = await open(process.argv[2]);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    await file.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  },
};

// By its indices.
const reader = await McapIndexedReader.Initialize({ readable });
assert.equal(reader.header.profile, "x-ensonify/1");
assert.equal(reader.statistics.messageCount, 53n);
assert.equal(reader.chunkIndexes.length, 3);
assert.equal(reader.attachmentIndexes.length, 2);
const topics = Object.fromEntries(
  [...reader.channelsById.values()].map((c) => [c.topic, reader.statistics.channelMessageCounts.get(c.id)]));
assert.deepEqual(topics, { "bow/ping": 3n, "bow/soundings": 25n, "agent/thought": 25n, "bow/health": 0n });
for (const schema of reader.schemasById.values()) {
  assert.equal(schema.encoding, "jsonschema");
  assert.equal(JSON.parse(new TextDecoder().decode(schema.data)).title, schema.name);
}
let count = 0;
for await (const message of reader.readMessages()) {
  assert.equal(message.logTime, START_NS + BigInt(message.sequence) * 100000000n);
  assert.equal(message.publishTime, message.logTime);
  ++count;
}
assert.equal(count, 53);
const names = [];
for await (const attachment of reader.readAttachments()) names.push(attachment.name);
assert.deepEqual(names, ["launch.yaml", "seed"]);

// Front to back, checksums and all.
const stream = new McapStreamReader({ validateCrcs: true });
stream.append(await readable.read(0n, await readable.size()));
const seen = {};
for (let record; (record = stream.nextRecord());) seen[record.type] = (seen[record.type] ?? 0) + 1;
assert.ok(stream.done());
assert.equal(seen.Message, 53);
console.log("the official JavaScript reader agrees");
