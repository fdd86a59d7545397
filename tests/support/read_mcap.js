// Reads a ROS 2 bag with the libraries that Foxglove uses, check sums included, and prints it as JSON:
// counts and schemas by topic, the first message of each, long arrays by length and some elements.
// usage: NODE_PATH=.../node_modules node read_mcap.js FILE.mcap
const fs = require("fs");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");

function short(value) {
  if (typeof value === "bigint") return value.toString();
  if (ArrayBuffer.isView(value) || (Array.isArray(value) && value.length > 8)) {
    return { length: value.length, first: Array.from(value.slice(0, 64)).map(short) };
  }
  if (Array.isArray(value)) return value.map(short);
  if (value === null || typeof value !== "object") return value;
  return Object.fromEntries(Object.entries(value).map(([key, v]) => [key, short(v)]));
}

async function main() {
  const bytes = fs.readFileSync(process.argv[2]);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) =>
      new Uint8Array(bytes.subarray(Number(offset), Number(offset) + Number(size))),
  };
  // In order of the file, with all check sums.
  const stream = new McapStreamReader({ validateCrcs: true });
  stream.append(bytes);
  let streamed = 0;
  for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") streamed++;
  if (!stream.done()) throw new Error("the stream does not end");

  const reader = await McapIndexedReader.Initialize({ readable });
  const topics = {};
  let last = -1n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    if (message.logTime < last) throw new Error("messages out of order");
    last = message.logTime;
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    if (!topics[channel.topic]) {
      const text = new TextDecoder().decode(schema.data);
      const parser = new MessageReader(parse(text, { ros2: true }));
      topics[channel.topic] = { type: schema.name, count: 0, parser,
        first: short(parser.readMessage(message.data)) };
    }
    const topic = topics[channel.topic];
    topic.last = short(topic.parser.readMessage(message.data));
    topic.lastTime = message.logTime.toString();
    topic.count++;
  }
  for (const topic of Object.values(topics)) delete topic.parser;
  console.log(JSON.stringify({ profile: reader.header.profile, streamed,
    statistics: short(reader.statistics), topics }));
}
main().catch((error) => { console.error(String(error)); process.exit(1); });
