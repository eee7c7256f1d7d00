// The server under test, and its API as a client that is no browser uses it.
import { spawn, type ChildProcess } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';

function fromEnvironment(name: string, meaning: string): string {
  const value = process.env[name];
  if (!value) throw new Error(`${name} must name ${meaning}; e2e/run.sh sets it.`);
  return value;
}

const command = fromEnvironment('FACEPROBE', 'the command');
const photos = fromEnvironment('FACEPROBE_PHOTOS', 'the folder of the sample photos');

export const samplePath = (file: string): string => join(photos, file);
export const samplePhoto = (file: string): Buffer => readFileSync(samplePath(file));

export interface Server {
  address: string; // with a slash at its end
  process: ChildProcess;
}

export async function startServer(...options: string[]): Promise<Server> {
  const child = spawn(command, ['-q', 'serve', '--port', '0', ...options], { stdio: ['ignore', 'pipe', 'inherit'] });
  for await (const line of createInterface({ input: child.stdout })) return { address: line.trim(), process: child };
  throw new Error(`${command} serve ended before it named its address.`);
}

export async function stopServer(server: Server): Promise<void> {
  const { exitCode, signalCode } = server.process;
  if (exitCode !== null || signalCode !== null) return;
  const ended = new Promise((resolve) => server.process.once('exit', resolve));
  server.process.kill('SIGTERM');
  await ended;
}

// While `work` goes on the server does nothing, so that what the page shows stays as long as it is looked at, on a fast machine too.
export async function whileHeld(server: Server, work: () => Promise<void>): Promise<void> {
  server.process.kill('SIGSTOP');
  try {
    await work();
  } finally {
    server.process.kill('SIGCONT');
  }
}

interface Job {
  state: string;
  error?: { kind: string; message: string };
}

export interface File {
  path: string;
  bytes: number;
}

export interface MainLight {
  azimuth_deg: number;
  elevation_deg: number;
  irradiance: number;
  share_of_energy: number;
}

// What tests look at, of web/public/openapi.json.
export interface Estimate {
  id: string;
  name: string;
  job: Job;
  photo: { width_px: number; height_px: number };
  focal_px: number;
  spot: { at_px: [number, number]; distance_m: number; height_m: number };
  report: { faces: { light: { main_lights: MainLight[] } }[]; joint_light?: { main_lights: MainLight[] } };
  files: File[];
}

export interface Insertion {
  id: string;
  job: Job;
  files?: File[];
}

// Each request over a connection of its own: on a busy machine one that is kept may be closed by the server just when it is used again.
function ask(server: Server, path: string, request: RequestInit = {}): Promise<Response> {
  const headers = { ...(request.headers as Record<string, string>), connection: 'close' };
  return fetch(`${server.address}api/v1${path}`, { ...request, headers });
}

export async function get<T>(server: Server, path: string): Promise<T> {
  return answerOf(await ask(server, path));
}

export async function postPhoto(server: Server, photo: Buffer, name: string): Promise<Estimate> {
  const body = new Blob([new Uint8Array(photo)], { type: 'application/octet-stream' });
  return answerOf(await ask(server, `/estimates?name=${encodeURIComponent(name)}`, { method: 'POST', body }));
}

export async function estimateOf(server: Server, photo: Buffer, name: string): Promise<Estimate> {
  const { id } = await postPhoto(server, photo, name);
  return finished(server, `/estimates/${id}`);
}

export async function postInsertion(server: Server, estimate: string, request: object): Promise<Insertion> {
  const headers = { 'content-type': 'application/json' };
  const body = JSON.stringify(request);
  return answerOf(await ask(server, `/estimates/${estimate}/insertions`, { method: 'POST', headers, body }));
}

export async function insertionOf(server: Server, estimate: string, request: object): Promise<Insertion> {
  const { id } = await postInsertion(server, estimate, request);
  return finished(server, `/insertions/${id}`);
}

export async function forget(server: Server, path: string): Promise<void> {
  await ask(server, path, { method: 'DELETE' });
}

export async function forgetAllBut(server: Server, kept: Set<string>): Promise<void> {
  for (const { id } of await get<Estimate[]>(server, '/estimates')) {
    if (!kept.has(id)) await forget(server, `/estimates/${id}`);
  }
}

async function finished<T extends { job: Job }>(server: Server, path: string): Promise<T> {
  for (;;) {
    const thing = await get<T>(server, path);
    if (thing.job.state === 'done') return thing;
    if (thing.job.state === 'failed') throw new Error(`${path} failed: ${thing.job.error?.message}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

async function answerOf<T>(response: Response): Promise<T> {
  if (!response.ok) throw new Error(`${response.url} was answered with ${response.status}: ${await response.text()}`);
  return (await response.json()) as T;
}
