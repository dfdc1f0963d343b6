// SPDX-License-Identifier: GPL-3.0-or-later
// node validate.mjs FILE.glb...: the Khronos validator over every file; any error, warning or info fails it.
import { readFile } from 'node:fs/promises';
import validator from 'gltf-validator';

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node validate.mjs FILE.glb...');
  process.exit(64);
}

let passed = 0;
let failed = 0;
for (const file of files) {
  try {
    const bytes = new Uint8Array(await readFile(file));
    const { issues } = await validator.validateBytes(bytes, { uri: file, maxIssues: 100 });
    const counts = `${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos`;
    const good = issues.numErrors === 0 && issues.numWarnings === 0 && issues.numInfos === 0;
    console.log(`${good ? 'ok' : 'FAILED'} ${file}: ${counts}`);
    for (const m of issues.messages) console.log(`  ${m.code} at ${m.pointer}: ${m.message}`);
    good ? ++passed : ++failed;
  } catch (error) {
    // Not a glTF at all, or not there.
    console.log(`FAILED ${file}: ${error.message ?? error}`);
    ++failed;
  }
}
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
