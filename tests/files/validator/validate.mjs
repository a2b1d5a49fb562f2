// What Khronos' validator finds in glTF files: reads [file, ...] on stdin and prints for each its errors.

import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import validator from 'gltf-validator';

async function errorsOf(file) {
  const beside = async (uri) => new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri))));
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: file,
    externalResourceFunction: beside,
  });
  return report.issues.messages.filter((one) => one.severity === 0).map((one) => `${one.pointer}: ${one.message}`);
}

const found = [];
for (const file of JSON.parse(readFileSync(0, 'utf8'))) found.push(await errorsOf(file));
process.stdout.write(JSON.stringify(found));
