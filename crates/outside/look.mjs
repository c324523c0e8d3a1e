// Reads glTF files with the validator of their standard. The arguments are files; standard output gets a JSON array of
// reports.
import { readFileSync } from 'node:fs';
import { validateBytes } from 'gltf-validator';

const reports = process.argv.slice(2).map((file) => validateBytes(new Uint8Array(readFileSync(file))));
process.stdout.write(JSON.stringify(await Promise.all(reports)));
