// Writes a ROS 2 bag of the lines that ../make_bag.py takes:
//   node make_bag.mjs MODULES OUT.mcap|OUT.db3 none|zstd|lz4|messages < lines
// MODULES: folder that holds node_modules. Chunks of MCAP are packed by the programs zstd and lz4;
// "messages" packs each message of a .db3. SQLite's files are written by Python.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const [modules, out, compression] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(modules), "package.json"));
const { McapWriter } = require("@mcap/core");
const { MessageWriter } = require("@foxglove/rosmsg2-serialization");
const { ros2humble } = require("@foxglove/rosmsg-msgs-common");

ros2humble["realsense2_camera_msgs/Extrinsics"] = {
  name: "realsense2_camera_msgs/Extrinsics",
  definitions: [
    { name: "rotation", type: "float64", isComplex: false, isArray: true, arrayLength: 9 },
    { name: "translation", type: "float64", isComplex: false, isArray: true, arrayLength: 3 },
  ],
};

const time = (stamp) => {
  const [seconds, microseconds] = stamp.split(".");
  return { sec: Number(seconds), nanosec: Number(microseconds.padEnd(6, "0")) * 1000 };
};
const header = (stamp, frame_id) => ({ stamp: time(stamp), frame_id });
const vector = ([x, y, z]) => ({ x: Number(x), y: Number(y), z: Number(z) });
const motion = (v) => ({ translation: vector(v), rotation: { ...vector(v.slice(3)), w: Number(v[6]) } });
const bytesOf = (file) => new Uint8Array(readFileSync(file));

// Type, stamp and content of a line's message.
const makers = {
  image(frame, stamp, encoding, width, height, file) {
    const data = bytesOf(file);
    return ["sensor_msgs/Image", stamp, { header: header(stamp, frame), height: Number(height),
      width: Number(width), encoding, is_bigendian: 0, step: data.length / Number(height), data }];
  },
  compressed: (frame, stamp, format, file) => ["sensor_msgs/CompressedImage", stamp,
    { header: header(stamp, frame), format: format.replaceAll("~", " "), data: bytesOf(file) }],
  camera_info: (frame, stamp, width, height, fx, fy, cx, cy, ...d) => ["sensor_msgs/CameraInfo", stamp,
    { header: header(stamp, frame), height: Number(height), width: Number(width),
      distortion_model: d.length > 5 ? "rational_polynomial" : "plumb_bob", d: d.map(Number),
      k: [fx, 0, cx, 0, fy, cy, 0, 0, 1].map(Number), r: [1, 0, 0, 0, 1, 0, 0, 0, 1],
      p: [fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0].map(Number) }],
  imu: (stamp, ...a) => ["sensor_msgs/Imu", stamp, { header: header(stamp, ""),
    linear_acceleration: vector(a), angular_velocity_covariance: [-1, 0, 0, 0, 0, 0, 0, 0, 0] }],
  imu6: (frame, stamp, ...v) => ["sensor_msgs/Imu", stamp, { header: header(stamp, frame),
    linear_acceleration: vector(v), angular_velocity: vector(v.slice(3)) }],
  tf: (stamp, parent, child, ...v) => ["tf2_msgs/TFMessage", stamp,
    { transforms: [{ header: header(stamp, parent), child_frame_id: child, transform: motion(v) }] }],
  odometry: (frame, stamp, child, x, y, yaw) => ["nav_msgs/Odometry", stamp,
    { header: header(stamp, frame), child_frame_id: child, pose: { pose: { position: vector([x, y, 0]),
      orientation: { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) } } } }],
  scan: (frame, stamp, angle_min, step, range_min, range_max, ...ranges) => ["sensor_msgs/LaserScan", stamp,
    { header: header(stamp, frame), angle_min: Number(angle_min), angle_increment: Number(step),
      angle_max: Number(angle_min) + step * (ranges.length - 1), range_min: Number(range_min),
      range_max: Number(range_max), ranges: ranges.map(Number) }],
  fix: (frame, stamp, status, latitude, longitude, altitude) => ["sensor_msgs/NavSatFix", stamp,
    { header: header(stamp, frame), status: { status: Number(status) }, latitude: Number(latitude),
      longitude: Number(longitude), altitude: Number(altitude) }],
  extrinsics: (stamp, ...t) => ["realsense2_camera_msgs/Extrinsics", stamp,
    { rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1], translation: t.map(Number) }],
  transform: (stamp, ...v) => ["geometry_msgs/Transform", stamp, motion(v)],
  number: (stamp, value) => ["std_msgs/Float32", stamp, { data: Number(value) }],
  string: (stamp, data) => ["std_msgs/String", stamp, { data }],
};

// A definition and all that it is made of, the first without name, as MessageWriter wants them.
function definitionsOf(type) {
  const all = new Map();
  const add = (name) => {
    if (all.has(name)) return;
    all.set(name, ros2humble[name]);
    ros2humble[name].definitions.filter((d) => d.isComplex).forEach((d) => add(d.type));
  };
  add(type);
  return [...all.values()];
}

const writers = new Map();
function serialized(type, content) {
  if (!writers.has(type)) writers.set(type, new MessageWriter(definitionsOf(type)));
  return writers.get(type).writeMessage(content);
}

const ros2Name = (type) => type.replace("/", "/msg/");
const packed = (program, bytes) => execFileSync(program, ["-q", "-c"], { input: bytes, maxBuffer: 1 << 30 });

function messages() {
  return readFileSync(0, "utf8").split("\n").filter(Boolean).map((line) => {
    const [kind, topic, ...words] = line.split(" ");
    const [type, stamp, content] = makers[kind](...words);
    const { sec, nanosec } = time(stamp);
    return { topic, type, ns: BigInt(sec) * 1000000000n + BigInt(nanosec), bytes: serialized(type, content) };
  });
}

async function writeMcap() {
  const parts = [];
  let position = 0n;
  const writable = { position: () => position,
    write: async (bytes) => { parts.push(Buffer.from(bytes)); position += BigInt(bytes.length); } };
  const compressChunk = compression === "none" ? undefined
    : (bytes) => ({ compression, compressedData: new Uint8Array(packed(compression, bytes)) });
  const writer = new McapWriter({ writable, compressChunk, chunkSize: 16384 });
  await writer.start({ profile: "ros2", library: "" });
  const channels = new Map();
  for (const { topic, type, ns, bytes } of messages()) {
    if (!channels.has(topic)) {
      const schemaId = await writer.registerSchema({ name: ros2Name(type), encoding: "ros2msg", data: new Uint8Array() });
      channels.set(topic, await writer.registerChannel({ schemaId, topic, messageEncoding: "cdr", metadata: new Map() }));
    }
    await writer.addMessage({ channelId: channels.get(topic), sequence: 0, logTime: ns, publishTime: ns, data: bytes });
  }
  await writer.end();
  writeFileSync(out, Buffer.concat(parts));
}

function writeDatabase() {
  const lines = messages().map(({ topic, type, ns, bytes }) => {
    const data = Buffer.from(compression === "messages" ? packed("zstd", bytes) : bytes);
    return JSON.stringify([topic, ros2Name(type), String(ns), data.toString("base64")]);
  });
  const script = path.join(path.dirname(fileURLToPath(import.meta.url)), "make_database.py");
  execFileSync("/usr/bin/python3", [script, out], { input: lines.join("\n"), maxBuffer: 1 << 30 });
}

await (out.endsWith(".db3") ? writeDatabase() : writeMcap());
