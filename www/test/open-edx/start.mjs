/** Starts Open edX's block for SCORM packages in a server of its own: Python with the libraries of requirements.txt. */

import { execFile, spawn } from 'node:child_process';
import { mkdir, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const run = promisify(execFile);
const here = (/** @type {string} */ name) => fileURLToPath(new URL(name, import.meta.url));

/** Python with the libraries. A copy of the installed list shows whether this has been done. */
async function python() {
    const folder = here('../../../target/test/open-edx');
    const program = join(folder, process.platform === 'win32' ? 'Scripts/python.exe' : 'bin/python');
    const [wanted, installed] = [here('requirements.txt'), join(folder, 'installed.txt')];
    const list = await readFile(wanted, 'utf8');
    if ((await readFile(installed, 'utf8').catch(() => '')) === list) return program;
    await mkdir(folder, { recursive: true });
    await run(process.platform === 'win32' ? 'python' : 'python3', ['-m', 'venv', '--clear', folder]);
    const words = ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', '--only-binary=:all:'];
    await run(program, [...words, '--require-hashes', '--requirement', wanted]);
    await writeFile(installed, list);
    return program;
}

/**
 * @param {string} zip the file of a package
 * @param {(address: string) => Promise<unknown>} use
 */
export async function withCourse(zip, use) {
    const folder = await mkdtemp(join(tmpdir(), 'course-'));
    const jquery = here('../../node_modules/jquery/dist/jquery.min.js');
    const server = spawn(await python(), [here('server.py'), zip, jquery, folder], {
        stdio: ['ignore', 'pipe', 'inherit'],
    });
    try {
        for await (const address of createInterface({ input: server.stdout })) return await use(address);
        throw new Error('the server of the course has ended');
    } finally {
        server.kill();
        await rm(folder, { recursive: true });
    }
}
