// What the built page weighs, scripts and styles as gzip packs them: size.mjs FOLDER prints it, and ends with 1 when it is too much.
import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

export const mostBytes = 1_200_000;

function filesIn(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? filesIn(path) : [path];
  });
}

// Largest first.
export function packedFiles(folder) {
  return filesIn(folder)
    .filter((path) => /\.(js|css)$/.test(path))
    .map((path) => ({ path: relative(folder, path), bytes: gzipSync(readFileSync(path)).length }))
    .sort((a, b) => b.bytes - a.bytes);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const files = packedFiles(process.argv[2]);
  const all = files.reduce((sum, { bytes }) => sum + bytes, 0);
  for (const { path, bytes } of files) console.log(`${String(bytes).padStart(9)}  ${path}`);
  console.log(`${String(all).padStart(9)}  in all; ${mostBytes} at most`);
  // Without any of either this is no built page.
  const whole = ['.js', '.css'].every((end) => files.some(({ path }) => path.endsWith(end)));
  if (!whole) console.error('There is no page in this folder: a script or a style is missing.');
  process.exitCode = whole && all <= mostBytes ? 0 : 1;
}
