// SPDX-License-Identifier: Apache-2.0
// Prints as JSON what ktx-parse finds in a KTX 2, levels inflated by zstddec.
//   node ktx2.mjs FOLDER_OF_NODE_MODULES FILE
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const [folder, file] = process.argv.slice(2);
const require = createRequire(`${folder}/`);
const load = (name) => import(pathToFileURL(require.resolve(name)).href);
const { read } = await load("ktx-parse");
const { ZSTDDecoder } = await load("zstddec");

const container = read(readFileSync(file));
const decoder = new ZSTDDecoder();
await decoder.init();

const inflated = ({ levelData, uncompressedByteLength }) =>
  container.supercompressionScheme === 2
    ? decoder.decode(levelData, uncompressedByteLength)
    : levelData;

const texts = {};
for (const [key, value] of Object.entries(container.keyValue)) {
  texts[key] = typeof value === "string" ? value : Buffer.from(value).toString();
}

const block = container.dataFormatDescriptor[0];
console.log(
  JSON.stringify({
    format: container.vkFormat,
    type_bytes: container.typeSize,
    size: [container.pixelWidth, container.pixelHeight, container.pixelDepth],
    layers: container.layerCount,
    faces: container.faceCount,
    supercompression: container.supercompressionScheme,
    texts,
    model: block.colorModel,
    primaries: block.colorPrimaries,
    transfer: block.transferFunction,
    texel_bytes: block.bytesPlane[0],
    samples: block.samples.map((sample) => ({
      bit: sample.bitOffset,
      bits: sample.bitLength + 1,
      kind: sample.channelType,
    })),
    levels: container.levels.map((level) => ({
      bytes: level.uncompressedByteLength,
      texels: Buffer.from(inflated(level)).toString("hex"),
    })),
  }),
);
